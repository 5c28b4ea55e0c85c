/// @file
/// What a reader sees of an evaluation, made from its record (claims_record.hpp).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace bqsa::harness::claims {

/// Two or more lines a claim, a legend, and a last line of counts.
std::string claims_table(const nlohmann::ordered_json& record);

/// One claim in full.
std::string claim_in_full(const nlohmann::ordered_json& claim);

/// The table as Markdown, without anything that differs between two evaluations with the same figures.
std::string claims_markdown(const nlohmann::ordered_json& record);

/// The text with all between the lines `<!-- claims -->` and `<!-- /claims -->` replaced by `table`.
/// @throws InputError if the lines are not there, once each and in this order
std::string with_claims_block(std::string_view text, std::string_view table);

}  // namespace bqsa::harness::claims
