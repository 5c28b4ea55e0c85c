/// @file
/// Claims files (schema bqsa-claims/1, docs/claims.md).
#pragma once

#include <filesystem>
#include <vector>

#include "harness/claims/claim.hpp"

namespace bqsa::harness::claims {

/// Reads and validates a claims file: every claim has a source, a known estimator with arguments of
/// the right kind, and bounds on figures that it declares, in their units.
/// @throws InputError naming file, line, key, what was expected and what was found
std::vector<Claim> load_claims(const std::filesystem::path& file);

}  // namespace bqsa::harness::claims
