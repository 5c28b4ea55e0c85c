#include "harness/results/table_row.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/judge/judge.hpp"
#include "harness/runner.hpp"

namespace bqsa::harness {
namespace {

using Json = nlohmann::json;

double number(const Json& value) { return value.is_null() ? TableRow::kNone : value.get<double>(); }

std::string pair_text(const Json& pair) {
  return fmt::format("({}, {})", pair.at("link").get<int>(),
                     pair.at("obstacle").get<std::string>());
}

std::string counted(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string problem_text(const Json& problem) {
  std::string text = fmt::format("{}, {}, {}, {} of {:.4g} ms, tolerance {:.4g} mm",
                                 counted(problem.at("joints").get<std::size_t>(), "joint"),
                                 counted(problem.at("links").get<std::size_t>(), "link"),
                                 counted(problem.at("obstacles").size(), "obstacle"),
                                 counted(problem.at("ticks").get<std::size_t>(), "tick"),
                                 1e3 * problem.at("dt_s").get<double>(),
                                 1e3 * problem.at("tolerance_m").get<double>());
  const double margin = problem.at("margin_m").get<double>();
  const double radius = problem.at("link_radius_m").get<double>();
  if (margin > 0) text += fmt::format(", margin {:.4g} mm", 1e3 * margin);
  if (radius > 0) text += fmt::format(", link radius {:.4g} mm", 1e3 * radius);
  return text;
}

std::string build_text(const Json& provenance) {
  constexpr std::size_t kCommitDigits = 10;
  return fmt::format(
      "bqsa-bench {} (commit {}{}), {} {}\n     on {}, {}",
      provenance.at("version").get<std::string>(),
      provenance.at("commit").get<std::string>().substr(0, kCommitDigits),
      provenance.at("dirty").get<bool>() ? ", modified" : "",
      provenance.at("compiler").get<std::string>(), provenance.at("build_type").get<std::string>(),
      provenance.at("processor").get<std::string>(), provenance.at("os").get<std::string>());
}

/// The failures in the judge's order, except that being incomplete comes last: what a run did wrong
/// before it stopped tells more.
std::vector<std::string> by_weight(std::vector<std::string> failures) {
  const std::string incomplete = name_of(Failure::kIncomplete);
  std::stable_partition(failures.begin(), failures.end(),
                        [&](const std::string& failure) { return failure != incomplete; });
  return failures;
}

void read_claim(const Json& claimed, TableRow& row) {
  row.claim = claimed.at("status").get<std::string>();
  if (row.claim == name_of(Claim::kInfeasible)) {
    row.claim += fmt::format(" at tick {}", claimed.at("tick").get<int>());
    row.claim_detail = claimed.at("reason").get<std::string>();
    if (!claimed.at("link").is_null()) {
      row.claim_detail += fmt::format(", link {}", claimed.at("link").get<int>());
    }
    if (!claimed.at("obstacle").is_null()) {
      row.claim_detail += ", " + claimed.at("obstacle").get<std::string>();
    }
  } else if (row.claim == name_of(Claim::kCrashed)) {
    const int tick = claimed.at("tick").get<int>();
    if (tick > 0) row.claim += fmt::format(" at tick {}", tick);
    row.claim_detail = claimed.at("message").get<std::string>();
    std::replace(row.claim_detail.begin(), row.claim_detail.end(), '\n', ' ');
  }
}

void read_judgement(const Json& judged, TableRow& row) {
  row.success = judged.at("success").get<bool>();
  row.failures = by_weight(judged.at("failures").get<std::vector<std::string>>());
  row.disagreement = judged.at("disagreement").get<std::string>();
  row.rows = judged.at("rows").get<int>();
  for (const Json& contact : judged.at("contacts")) row.collided.push_back(pair_text(contact));
  row.tip_error_at_ticks_m = number(judged.at("tip_error_at_ticks").at("max_m"));
  row.tip_error_between_ticks_m = number(judged.at("tip_error_between_ticks").at("max_m"));
  row.start_error_m = number(judged.at("start_error_m"));
  row.clearance_m = number(judged.at("clearance_m"));
  row.touching = judged.at("touching").get<bool>();
  row.max_joint_step_rad = number(judged.at("max_joint_step_rad"));
}

void read_run(const Json& record, TableRow& row) {
  read_judgement(record.at("judged"), row);
  row.claim_holds = record.at("claim_holds").get<bool>();
  const Json& ticks = record.at("ticks");
  for (const Json& pair : ticks.at("clamped_pairs")) {
    row.clamped.push_back(fmt::format("{} x {}", pair_text(pair), pair.at("ticks").get<int>()));
  }
  row.guard_fired = ticks.at("guard_fired").get<int>();
  if (!row.success) return;
  const Json& times = record.at("times");
  row.plan_s = number(times.at("plan_s"));
  row.step_median_s = number(times.at("warm_median_s"));
  row.step_p99_s = number(times.at("warm_p99_s"));
  row.against_times = times.at("against").get<std::vector<std::string>>();
}

}  // namespace

TableRow parse_run_record(std::string_view text) {
  try {
    const Json record = Json::parse(text);
    if (record.at("schema") != "bqsa-run/1") {
      throw InputError("expected schema bqsa-run/1, got " + record.at("schema").dump());
    }
    TableRow row;
    row.scenario = record.at("scenario").at("name").get<std::string>();
    row.problem = problem_text(record.at("problem"));
    row.ticks = record.at("problem").at("ticks").get<int>();
    row.variant = record.at("method").at("variant").get<std::string>();
    row.changed = record.at("method").at("changed").get<std::string>();
    row.build = build_text(record.at("provenance"));
    read_claim(record.at("claimed"), row);
    row.applicable = !record.at("judged").is_null();
    if (row.applicable) {
      read_run(record, row);
    } else {
      row.claim_detail = record.at("claimed").at("message").get<std::string>();
    }
    return row;
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("not a run record: {}", error.what()));
  }
}

}  // namespace bqsa::harness
