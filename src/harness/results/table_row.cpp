#include "harness/results/table_row.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "harness/judge/judge.hpp"
#include "harness/results/provenance.hpp"
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

/// Empty if it has none, and of old records.
std::string robot_name(const RecordValue& problem) {
  const bool named = problem.has("robot") && !problem["robot"].is_null();
  return named ? problem["robot"].text() : "";
}

std::string problem_text(const RecordValue& problem) {
  const std::string robot = robot_name(problem);
  std::string text = robot.empty() ? "" : robot + ", ";
  text += fmt::format("{}, {}, {}, {} of {:.4g} ms, tolerance {}",
                      counted(problem["joints"].integer(), "joint"),
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

/// Empty if all obstacles are ellipsoids, and of old records.
std::string geometry_text(const RecordValue& problem) {
  if (!problem.has("geometry") || problem["geometry"].is_null()) return "";
  const RecordValue geometry = problem["geometry"];
  long ellipsoids = 0, missed = 0;
  double inflation = 0;
  const std::vector<RecordValue> solids = geometry["solids"].list();
  for (const RecordValue& solid : solids) {
    ellipsoids += solid["ellipsoids"].integer();
    inflation = std::max(inflation, solid["inflation_m"].number());
    if (!solid["within_bounds"].boolean()) ++missed;
  }
  std::string text =
      fmt::format("{} in {}, inflation up to {}, gaps narrower by up to {}",
                  counted(std::ssize(solids), "solid"), counted(ellipsoids, "ellipsoid"),
                  length_text(inflation), length_text(geometry["gap_lost_m"].number()));
  const double excess = geometry["radius_excess_m"].number();
  if (excess > 0) text += fmt::format(", link radius by up to {} more", length_text(excess));
  if (missed > 0) text += fmt::format("; bounds not reached for {}", counted(missed, "solid"));
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

void read_giving_up(const RecordValue& claimed, TableRow& row) {
  row.failure_tick = claimed["tick"].integer();
  row.claim = fmt::format("gave up at tick {}", row.failure_tick);
  row.gave_up = claimed["reason"].text();
  row.claim_detail = row.gave_up;
  if (!claimed["link"].is_null()) {
    row.failure_link = claimed["link"].integer();
    row.claim_detail += fmt::format(", link {}", row.failure_link);
  }
  if (!claimed["obstacle"].is_null()) {
    row.failure_obstacle = claimed["obstacle"].text();
    row.claim_detail += ", " + row.failure_obstacle;
  }
  if (claimed.has("class")) row.claim_class = claimed["class"].text();
}

void read_claim(const RecordValue& claimed, TableRow& row) {
  row.claim = claimed["status"].text();
  if (row.claim == name_of(Claim::kInfeasible)) {
    read_giving_up(claimed, row);
  } else if (row.claim == name_of(Claim::kCrashed) || row.claim == name_of(Claim::kTimedOut) ||
             row.claim == name_of(Claim::kOutOfMemory)) {
    const int tick = claimed["tick"].integer();
    row.failure_tick = tick;
    if (tick > 0) row.claim += fmt::format(" at tick {}", tick);
    row.claim_detail = claimed["message"].text();
  }
}

/// Pairs of links that collide; none of records that did not judge them.
std::vector<RecordValue> self_contacts(const RecordValue& judged) {
  if (!judged.has("self_collision") || judged["self_collision"].is_null()) return {};
  return judged["self_collision"]["contacts"].list();
}

std::string other_link_text(const RecordValue& contact) {
  return fmt::format("link {}", contact["other_link"].integer());
}

/// Where it went wrong, by the failure that tells most; of one that only stopped early the claim has
/// said it. Which joint of an arm with prismatic ones jumped is not recorded.
void read_place(const RecordValue& judged, TableRow& row) {
  if (row.success || row.failures.front() == name_of(Failure::kIncomplete)) return;
  row.failure_tick = -1;
  row.failure_link = 0;
  row.failure_obstacle.clear();
  const std::vector<RecordValue> contacts = judged["contacts"].list();
  const std::vector<RecordValue> self = self_contacts(judged);
  const std::string& failure = row.failures.front();
  if (failure == name_of(Failure::kCollision) && !contacts.empty()) {
    row.failure_tick = contacts.front()["first_tick"].integer();
    row.failure_link = contacts.front()["link"].integer();
    row.failure_obstacle = contacts.front()["obstacle"].text();
  } else if (failure == name_of(Failure::kSelfCollision) && !self.empty()) {
    row.failure_tick = self.front()["first_tick"].integer();
    row.failure_link = self.front()["link"].integer();
    row.failure_obstacle = other_link_text(self.front());
  } else if (failure == name_of(Failure::kDrift)) {
    row.failure_tick = judged["tip_error_at_ticks"]["max_tick"].integer();
  } else if (failure == name_of(Failure::kOrientation)) {
    row.failure_tick = judged["orientation_at_ticks"]["max_tick"].integer();
  } else if (failure == name_of(Failure::kJump) && !judged.has("max_joint_slide_tick")) {
    row.failure_tick = judged["max_joint_step_tick"].integer();
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
  for (const RecordValue& contact : self_contacts(judged)) {
    row.collided.push_back(
        fmt::format("({}, {})", contact["link"].integer(), other_link_text(contact)));
  }
  read_place(judged, row);
  if (row.success && !row.collided.empty()) {
    judged["contacts"].refuse("contradict judged.success");
  }
  row.tip_error_at_ticks_m = judged["tip_error_at_ticks"]["max_m"].number();
  row.tip_error_between_ticks_m = judged["tip_error_between_ticks"]["max_m"].number();
  if (judged.has("orientation_at_ticks")) {
    row.orientation_at_ticks_rad = judged["orientation_at_ticks"]["max_rad"].number();
    row.orientation_between_ticks_rad = judged["orientation_between_ticks"]["max_rad"].number();
  }
  row.start_error_m = judged["start_error_m"].number();
  row.clearance_m = judged["clearance_m"].number();
  row.touching = judged["touching"].boolean();
  row.max_joint_step_rad = judged["max_joint_step_rad"].number();
}

MotionQuality motion_quality_of(const RecordValue& motion) {
  return {.closed_path_drift = motion["closed_path_drift_rad"].number(),
          .closed_path_drift_joint = motion["closed_path_drift_joint_rad"].number(),
          .manipulability_min = motion["manipulability_min"].number(),
          .manipulability_mean = motion["manipulability_mean"].number(),
          .singular_value_min = motion["singular_value_min_m"].number(),
          .null_space_share = motion["null_space_share"].number(),
          .jerk_rms = motion["jerk_rms_rad_s3"].number()};
}

/// Whether the claim agrees with the verdict, which the record says and has to be right about.
bool read_claim_holds(const RecordValue& record, bool success) {
  static constexpr std::array kClaims{Claim::kSuccess,    Claim::kNothing, Claim::kInfeasible,
                                      Claim::kUnsolved,   Claim::kCrashed, Claim::kTimedOut,
                                      Claim::kOutOfMemory};
  const RecordValue status = record["claimed"]["status"];
  const std::string name = status.text();
  const auto* claim = std::find_if(kClaims.begin(), kClaims.end(),
                                   [&name](Claim known) { return name == name_of(known); });
  if (claim == kClaims.end()) {
    status.refuse(fmt::format("expected a claim, got {}", excerpt(name)));
  }
  const bool holds = record["claim_holds"].boolean();
  if (holds != claim_holds(*claim, success)) {
    record["claim_holds"].refuse("contradicts claimed.status and judged.success");
  }
  return holds;
}

LogHistogram histogram(const RecordValue& pairs) {
  LogHistogram counts;
  for (const RecordValue& pair : pairs.list()) {
    const std::vector<RecordValue> numbers = pair.list();
    if (numbers.size() != 2) pair.refuse("expected a pair of bin and count");
    counts.add_bin(numbers[0].integer(), numbers[1].integer());
  }
  return counts;
}

WorkCounters work_counters(const RecordValue& counters) {
  return {.quadratics = counters["quadratics"].whole(),
          .bounds = counters.has("bounds") ? counters["bounds"].whole() : 0,  // not in old records
          .point_pairs = counters["point_pairs"].whole(),
          .distance_queries = counters["distance_queries"].whole(),
          .kinematics = counters["kinematics"].whole(),
          .jacobians = counters["jacobians"].whole(),
          .linear_solves = counters["linear_solves"].whole(),
          .iterations = counters["iterations"].whole()};
}

void read_times(const RecordValue& times, TableRow& row) {
  for (const std::string& reason : texts(times["against"])) {
    if (reason != kNotASuccess) row.against_times.push_back(reason);
  }
  if (times.has("includes_pipe")) row.includes_pipe = times["includes_pipe"].boolean();
  row.slowest_s = times["warm_max_s"].number();
  row.slowest_tick = times["warm_max_tick"].integer();
  if (times.has("warm_max_q_rad")) {
    for (const RecordValue& angle : times["warm_max_q_rad"].list()) {
      row.slowest_q.push_back(angle.number());
    }
  }
  if (times.has("run_s")) row.run_s = times["run_s"].number();
  if (!row.success) return;
  row.plan_s = times["plan_s"].number();
  row.step_median_s = times["warm_median_s"].number();
  row.step_p99_s = times["warm_p99_s"].number();
  if (times.has("warm_histogram")) row.step_times = histogram(times["warm_histogram"]);
}

void read_run(const RecordValue& record, TableRow& row) {
  read_judgement(record["judged"], row);
  if (record.has("motion")) row.motion = motion_quality_of(record["motion"]);
  row.claim_holds = read_claim_holds(record, row.success);
  const RecordValue ticks = record["ticks"];
  for (const RecordValue& pair : ticks["clamped_pairs"].list()) {
    row.clamped.push_back(fmt::format("{} x {}", pair_text(pair), pair["ticks"].integer()));
  }
  row.guard_fired = ticks["guard_fired"].integer();
  if (ticks.has("clamp_starts")) row.clamp_starts = ticks["clamp_starts"].integer();
  if (row.success && ticks.has("increments_tick_histogram")) {
    row.increments = histogram(ticks["increments_tick_histogram"]);
    row.increments_max = ticks["increments_tick_max"].integer();
  }
  if (record.has("counters")) row.work = work_counters(record["counters"]);
  read_times(record["times"], row);
}

bool in_campaign(const RecordValue& record) {
  return record.has("campaign") && !record["campaign"].is_null();  // old records lack it
}

std::string disturbance_text(const RecordValue& record) {
  if (!record.has("disturbance")) return "";
  const RecordValue disturbance = record["disturbance"];
  const double noise = disturbance["joint_noise_rad"].number();
  std::string text;
  if (noise > 0) {
    const std::string seed = in_campaign(record)
                                 ? "of scenario and repetition"
                                 : std::to_string(record["provenance"]["seed"].whole());
    text = fmt::format("joint angles read with normal noise of {:.4g} rad, seed {}", noise, seed);
  }
  const int latency = disturbance["latency_ticks"].integer();
  if (latency > 0) {
    text += fmt::format("{}read {} late", text.empty() ? "joint angles " : ", ",
                        counted(latency, "tick"));
  }
  return text;
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
  row.geometry = geometry_text(record["problem"]);
  row.robot = robot_name(record["problem"]);
  row.ticks = record["problem"]["ticks"].integer();
  row.variant = record["method"]["variant"].text();
  row.changed = record["method"]["changed"].text();
  if (record["method"].has("seed") && !record["method"]["seed"].is_null()) {
    row.seed = std::to_string(record["method"]["seed"].whole());
  }
  if (in_campaign(record)) {
    row.key = record["campaign"]["key"].text();
    row.repetition = record["campaign"]["repetition"].integer();
  }
  row.disturbance = disturbance_text(record);
  row.build = build_text(record["provenance"]);
  row.compiler = record["provenance"]["compiler"].text();
  row.processor = record["provenance"]["processor"].text();
  read_claim(record["claimed"], row);
  row.applicable = !record["judged"].is_null();
  if (row.applicable) {
    read_run(record, row);
  } else {
    row.claim_detail = record["claimed"]["message"].text();
  }
  return row;
}

std::vector<TableRow> last_runs(const std::vector<TableRow>& rows) {
  std::vector<TableRow> shown;
  std::map<std::tuple<std::string, std::string, std::string, std::string, int>, std::size_t> places;
  for (const TableRow& row : rows) {
    const auto [place, first] = places.try_emplace(
        {row.scenario, row.sha256, row.variant, row.seed, row.repetition}, shown.size());
    if (first) {
      shown.push_back(row);
    } else {
      shown[place->second] = row;
    }
  }
  return shown;
}

std::size_t count_scenarios(const std::vector<TableRow>& rows) {
  std::set<std::pair<std::string, std::string>> files;
  for (const TableRow& row : rows) files.insert({row.scenario, row.sha256});
  return files.size();
}

}  // namespace bqsa::harness
