#include "harness/report/judged_claims.hpp"

#include <fmt/format.h>

#include "harness/claims/claims_record.hpp"
#include "harness/results/record_value.hpp"

namespace bqsa::harness::report {
namespace {

/// What claims say of where they stand if that is no place in the paper: `speed`, `none`.
constexpr std::string_view kPlaceInPaper = "section";

Json figures_json(const RecordValue& list) {
  Json figures = Json::array();
  for (const RecordValue& figure : list.list()) {
    const auto number = [&figure](const char* key) {
      return figure.has(key) ? number_or_null(figure[key].number()) : Json();
    };
    figures.push_back({{"name", figure["name"].text()},
                       {"value", number("value")},
                       {"lower", number("lower")},
                       {"upper", number("upper")},
                       {"unit", figure["unit"].text()},
                       {"meaning", figure["meaning"].text()}});
  }
  return figures;
}

Json bounds_json(const RecordValue& claim, const char* key) {
  Json bounds = Json::array();
  if (!claim.has(key)) return bounds;
  for (const RecordValue& bound : claim[key].list()) {
    bounds.push_back({{"figure", bound["figure"].text()},
                      {"bound", bound["bound"].text()},
                      {"outcome", bound["outcome"].text()}});
  }
  return bounds;
}

Json claim_json(const RecordValue& claim) {
  Json remarks = Json::array();
  for (const RecordValue& remark : claim["remarks"].list()) remarks.push_back(remark.text());
  const std::string source = claim["source"].text();
  return {{"id", claim["id"].text()},
          {"statement", claim["statement"].text()},
          {"source", source},
          {"paper", source.starts_with(kPlaceInPaper)},
          {"verdict", claim["verdict"].text()},
          {"expected", claim["expected"].text()},
          {"standing", claim["standing"].text()},
          {"reason", claim["reason"].text()},
          {"figures", figures_json(claim["figures"])},
          {"as_stated", bounds_json(claim, "as_stated")},
          {"correction", claim.has("correction") ? claim["correction"].text() : ""},
          {"corrected", bounds_json(claim, "corrected")},
          {"remarks", std::move(remarks)},
          {"note", claim["note"].text()}};
}

}  // namespace

Json claims_json(const std::filesystem::path& file) {
  const nlohmann::json json = claims::read_claims_record(file);
  try {
    const RecordValue record(json, "", "an evaluation of claims");
    const RecordValue build = record["build"], machine = record["machine"];
    Json claims = Json::array();
    for (const RecordValue& claim : record["claims"].list()) claims.push_back(claim_json(claim));
    constexpr std::size_t kCommitDigits = 10;
    return {{"file", file.string()},
            {"effort", record["effort"].text()},
            {"build", fmt::format("bqsa-bench {} (commit {}{}), {} {}", build["version"].text(),
                                  build["commit"].text().substr(0, kCommitDigits),
                                  build["dirty"].boolean() ? ", modified" : "",
                                  build["compiler"].text(), build["build_type"].text())},
            {"machine", fmt::format("{}, {}, {}", machine["processor"].text(), machine["os"].text(),
                                    machine["date"].text())},
            {"claims", std::move(claims)}};
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace bqsa::harness::report
