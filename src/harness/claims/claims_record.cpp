#include "harness/claims/claims_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/results/provenance_json.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness::claims {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "bqsa-claims-result/1";

Json figure_json(const Figure& figure, const EvaluatedClaim& claim) {
  const FigureDeclaration* declaration = claim.declaration_of(figure);
  Json json = {{"name", figure.name}, {"value", figure.value}};
  if (figure.interval) {
    json["lower"] = figure.interval->lower;
    json["upper"] = figure.interval->upper;
  }
  json["unit"] = declaration->unit;
  json["meaning"] = declaration->meaning;
  json["absolute"] = declaration->absolute;
  return json;
}

Json bounds_json(const std::vector<Bound>& bounds, const std::vector<Outcome>& outcomes) {
  Json json = Json::array();
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    json.push_back({{"figure", bounds[i].figure},
                    {"bound", text_of(bounds[i])},
                    {"outcome", name_of(outcomes[i])}});
  }
  return json;
}

const char* name_of(Standing standing) {
  switch (standing) {
    case Standing::kAsExpected:
      return "as expected";
    case Standing::kBroken:
      return "no longer holds";
    case Standing::kNotDecidedHere:
      return "not decided here";
  }
  return "";
}

Json claim_json(const EvaluatedClaim& result) {
  const Claim& claim = *result.claim;
  Json estimators = Json::array();
  for (const EstimatorCall& call : claim.calls) {
    estimators.push_back({{"name", call.estimator->name},
                          {"as", call.prefix.substr(0, call.prefix.find('.'))},
                          {"what", call.estimator->what},
                          {"arguments", call.arguments.all()}});
  }
  Json figures = Json::array();
  for (const Figure& figure : result.figures) figures.push_back(figure_json(figure, result));
  Json json = {{"id", claim.id},
               {"statement", claim.statement},
               {"source", claim.source},
               {"verdict", name_of(result.verdict)},
               {"expected", name_of(claim.expected)},
               {"standing", name_of(result.standing)},
               {"reason", result.reason},
               {"timing", claim.timing()},
               {"estimators", estimators},
               {"figures", figures},
               {"remarks", result.remarks},
               {"as_stated", bounds_json(claim.as_stated, result.as_stated)}};
  if (claim.corrected) {
    json["correction"] = claim.corrected->text;
    json["corrected"] = bounds_json(claim.corrected->bounds, result.corrected);
  }
  json["note"] = claim.note;
  return json;
}

}  // namespace

Json claims_record(const std::vector<EvaluatedClaim>& claims, const EvaluationOrigin& origin) {
  Json list = Json::array();
  for (const EvaluatedClaim& claim : claims) list.push_back(claim_json(claim));
  Json record = {{"schema", kSchema},
                 {"command_line", origin.command_line},
                 {"claims_file", origin.claims_file},
                 {"effort", origin.full ? "full" : "quick"},
                 {"build", build_json(origin.build)},
                 {"machine", machine_json(origin.machine)}};
  if (origin.measured) {
    record["measured"] = {{"command_line", origin.measured->command_line},
                          {"effort", origin.measured->effort},
                          {"build", build_json(origin.measured->build)},
                          {"machine", machine_json(origin.measured->before)},
                          {"other_cores", origin.measured->other_cores},
                          {"instruction_set", origin.measured->instruction_set},
                          {"against", origin.measured->against}};
  }
  record["claims"] = list;
  return record;
}

Json read_claims_record(const std::filesystem::path& file) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 24;
  Json record = Json::parse(read_text_file(file, kMaxBytes), nullptr, false);
  const bool known = record.is_object() && record.contains("schema") && record["schema"] == kSchema;
  if (!known) {
    throw InputError(fmt::format("{}: expected an evaluation of claims ({}), got another file",
                                 file.string(), kSchema));
  }
  return record;
}

}  // namespace bqsa::harness::claims
