#include "harness/results/table_row.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "harness/judge/judge.hpp"
#include "harness/results/record_value.hpp"
#include "harness/runner.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

std::string pair_text(const RecordValue& pair) {
  return fmt::format("({}, {})", pair["link"].integer(), pair["obstacle"].text());
}

std::vector<std::string> texts(const RecordValue& list) {
  std::vector<std::string> all;
  for (const RecordValue& value : list.list()) all.push_back(value.text());
  return all;
}

std::string counted(long count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string problem_text(const RecordValue& problem) {
  std::string text = fmt::format(
      "{}, {}, {}, {} of {:.4g} ms, tolerance {}", counted(problem["joints"].integer(), "joint"),
      counted(problem["links"].integer(), "link"),
      counted(std::ssize(problem["obstacles"].list()), "obstacle"),
      counted(problem["ticks"].integer(), "tick"), 1e3 * problem["dt_s"].number(),
      length_text(problem["tolerance_m"].number()));
  const double margin = problem["margin_m"].number();
  const double radius = problem["link_radius_m"].number();
  if (margin > 0) text += fmt::format(", margin {}", length_text(margin));
  if (radius > 0) text += fmt::format(", link radius {}", length_text(radius));
  return text;
}

std::string build_text(const RecordValue& provenance) {
  constexpr std::size_t kCommitDigits = 10;
  return fmt::format(
      "bqsa-bench {} (commit {}{}), {} {}\n     on {}, {}", provenance["version"].text(),
      provenance["commit"].text().substr(0, kCommitDigits),
      provenance["dirty"].boolean() ? ", modified" : "", provenance["compiler"].text(),
      provenance["build_type"].text(), provenance["processor"].text(), provenance["os"].text());
}

/// The failures in the judge's order, except that being incomplete comes last: what a run did wrong
/// before it stopped tells more.
std::vector<std::string> by_weight(std::vector<std::string> failures) {
  const std::string incomplete = name_of(Failure::kIncomplete);
  std::stable_partition(failures.begin(), failures.end(),
                        [&](const std::string& failure) { return failure != incomplete; });
  return failures;
}

void read_claim(const RecordValue& claimed, TableRow& row) {
  row.claim = claimed["status"].text();
  if (row.claim == name_of(Claim::kInfeasible)) {
    row.claim = fmt::format("gave up at tick {}", claimed["tick"].integer());
    row.claim_detail = claimed["reason"].text();
    if (!claimed["link"].is_null()) {
      row.claim_detail += fmt::format(", link {}", claimed["link"].integer());
    }
    if (!claimed["obstacle"].is_null()) {
      row.claim_detail += ", " + claimed["obstacle"].text();
    }
  } else if (row.claim == name_of(Claim::kCrashed)) {
    const int tick = claimed["tick"].integer();
    if (tick > 0) row.claim += fmt::format(" at tick {}", tick);
    row.claim_detail = claimed["message"].text();
  }
}

void read_judgement(const RecordValue& judged, TableRow& row) {
  row.failures = by_weight(texts(judged["failures"]));
  row.success = row.failures.empty();
  if (judged["success"].boolean() != row.success) {
    judged["success"].refuse("contradicts judged.failures");
  }
  row.disagreement = judged["disagreement"].text();
  row.rows = judged["rows"].integer();
  for (const RecordValue& contact : judged["contacts"].list()) {
    row.collided.push_back(pair_text(contact));
  }
  if (row.success && !row.collided.empty()) {
    judged["contacts"].refuse("contradict judged.success");
  }
  row.tip_error_at_ticks_m = judged["tip_error_at_ticks"]["max_m"].number();
  row.tip_error_between_ticks_m = judged["tip_error_between_ticks"]["max_m"].number();
  row.start_error_m = judged["start_error_m"].number();
  row.clearance_m = judged["clearance_m"].number();
  row.touching = judged["touching"].boolean();
  row.max_joint_step_rad = judged["max_joint_step_rad"].number();
}

void read_run(const RecordValue& record, TableRow& row) {
  read_judgement(record["judged"], row);
  row.claim_holds = record["claim_holds"].boolean();
  const RecordValue ticks = record["ticks"];
  for (const RecordValue& pair : ticks["clamped_pairs"].list()) {
    row.clamped.push_back(fmt::format("{} x {}", pair_text(pair), pair["ticks"].integer()));
  }
  row.guard_fired = ticks["guard_fired"].integer();
  if (!row.success) return;
  const RecordValue times = record["times"];
  row.plan_s = times["plan_s"].number();
  row.step_median_s = times["warm_median_s"].number();
  row.step_p99_s = times["warm_p99_s"].number();
  row.against_times = texts(times["against"]);
}

}  // namespace

std::string length_text(double metres) {
  constexpr double kLong = 10;
  return metres >= kLong ? fmt::format("{:.4g} m", metres) : fmt::format("{:.4g} mm", 1e3 * metres);
}

TableRow parse_run_record(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, /* allow_exceptions = */ false);
  if (json.is_discarded()) throw InputError("cut short or damaged; left out");
  const RecordValue record(json);
  const std::string schema = record["schema"].text();
  if (schema != "bqsa-run/1") {
    record["schema"].refuse(fmt::format("expected bqsa-run/1, got {}", excerpt(schema)));
  }
  TableRow row;
  row.scenario = record["scenario"]["name"].text();
  row.sha256 = record["scenario"]["sha256"].text();
  row.problem = problem_text(record["problem"]);
  row.ticks = record["problem"]["ticks"].integer();
  row.variant = record["method"]["variant"].text();
  row.changed = record["method"]["changed"].text();
  row.build = build_text(record["provenance"]);
  read_claim(record["claimed"], row);
  row.applicable = !record["judged"].is_null();
  if (row.applicable) {
    read_run(record, row);
  } else {
    row.claim_detail = record["claimed"]["message"].text();
  }
  return row;
}

}  // namespace bqsa::harness
