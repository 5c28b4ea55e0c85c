#include "harness/results/summary.hpp"

#include <fmt/core.h>

#include <map>
#include <numbers>
#include <set>

#include "harness/judge/judge.hpp"
#include "harness/results/summary/blocks.hpp"
#include "harness/results/table.hpp"
#include "harness/results/text_table.hpp"
#include "harness/runner.hpp"

namespace bqsa::harness {
namespace {

constexpr std::string_view kSummaryLegend =
    R"(success     runs judged a success of all runs of a method that applies; 95 %: Wilson's interval, for which the
            repetitions of a scenario, which are not independent, count as one run
claim       wrong: runs in which the method claims success and the judge finds a failure, or the other way round
by robot    success in % of families of two or more robots with a name; beside the family how many runs each method has
failures    each failed run once: by the judge's most telling verdict, or, if the method only gave up, by its reason
why         each run that gave up once: no free posture found; a way, but too far for one tick; arm singular; free
            postures, but no way there; a way within the tick that the method missed. A diagnosis, not a verdict
successes   of all successes: tip error at ticks (of each run the largest; median and largest of these), largest
            tip error between ticks, step and number of increments, smallest clearance
plans       wall clock of planning methods for the whole motion, over all successes
increments  clamping increments of a tick, over all ticks of all successes in which a link was cleared
time        wall clock of a tick, over all ticks from the second on of all successes, as if of one run; median and
            quantiles to 2.2 % (from histograms), max exact; slowest: of all runs, also those that gave up;
            total: of all runs, all that the methods did
motion      median over the successes: joint drift after a closed path; least and mean manipulability and least singular
            value of the tip's Jacobian [m^2 or m^3, m]; part of the joint motion that does not move the tip; root
            mean square of the joints' jerk
in pairs    scenarios to which both methods apply, each repetition by itself, by who succeeded; methods that never
            did are left out
)";

constexpr std::string_view kMotionLegend =
    R"(drift           of the joints after a closed path, all together and the largest; - if the path is open
manipulability  sqrt(det(J J')) of the tip's Jacobian at the ticks [m^2, in space m^3]; singular: its least singular value
self-motion     part of the joint motion that does not move the tip
jerk            root mean square over joints and ticks, from third differences
clears          times that the method, by its own account, began to clear a link of an obstacle
)";

/// What the names of the variants stand for.
std::string variant_notes(const std::vector<TableRow>& rows) {
  std::map<std::string, std::string> meanings;
  for (const TableRow& row : rows) {
    std::string meaning;
    if (!row.changed.empty()) meaning += fmt::format("  with {}\n", row.changed);
    if (!row.disturbance.empty()) meaning += fmt::format("  disturbed: {}\n", row.disturbance);
    if (!meaning.empty()) meanings[row.variant] = meaning;
  }
  std::string text;
  for (const auto& [variant, meaning] : meanings) {
    text += variant;
    text += '\n';
    text += meaning;
  }
  return text;
}

std::string origin_notes(const std::vector<TableRow>& rows) {
  Order reasons;
  Order builds;
  std::set<std::string> names;
  for (const TableRow& row : rows) {
    for (const std::string& reason : row.against_times) reasons.add(reason);
    builds.add(row.build);
    names.insert(row.scenario);
  }
  std::string text;
  for (const std::string& reason : reasons.names()) {
    text += fmt::format("~ times only indicative: {}\n", reason);
  }
  text += pipe_legend(rows);
  const std::size_t files = count_scenarios(rows);
  if (names.size() < files) {
    text +=
        fmt::format("{} scenario files share {} names; each file counts\n", files, names.size());
  }
  for (const std::string& build : builds.names()) text += fmt::format("made by {}\n", build);
  return text;
}

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

std::string family_of(const std::string& scenario) {
  const std::size_t number = scenario.find_last_of('_');
  if (number != std::string::npos && number > 0 && is_number(scenario.substr(number + 1))) {
    const std::size_t seed = scenario.find_last_of('_', number - 1);
    const bool has_seed = seed != std::string::npos && seed > 0 && scenario[seed + 1] == 's' &&
                          is_number(scenario.substr(seed + 2, number - seed - 2));
    if (has_seed) return scenario.substr(0, seed);
  }
  const std::size_t last = scenario.find_last_not_of("0123456789");
  if (last == std::string::npos) return scenario;
  const std::size_t end =
      last + 1 == scenario.size() ? last : scenario.find_last_not_of("_-", last);
  return end == std::string::npos ? scenario : scenario.substr(0, end + 1);
}

std::string failure_class(const TableRow& row) {
  if (!row.failures.empty() && row.failures.front() != name_of(Failure::kIncomplete)) {
    return verdict_of(row.failures.front());
  }
  if (!row.gave_up.empty()) return row.gave_up;
  if (row.claim.starts_with(name_of(Claim::kCrashed))) return name_of(Claim::kCrashed);
  if (row.claim == name_of(Claim::kUnsolved)) return kNoPlan;
  return verdict_of(name_of(Failure::kIncomplete));
}

std::string render_summary(const std::vector<TableRow>& all_rows) {
  if (all_rows.empty()) return "no runs\n";
  const std::vector<TableRow> rows = last_runs(all_rows);
  const Tallies tallies(rows);
  const std::string alarm = alarms(tallies);
  return fmt::format("{} runs on {} scenarios of {} families\n\n", rows.size(),
                     count_scenarios(rows), tallies.families.names().size()) +
         success_table(tallies) + alarm + '\n' + robot_table(tallies, rows) +
         failure_table(tallies) + '\n' + why_table(tallies) + accuracy_table(tallies) + '\n' +
         time_table(tallies) + '\n' + plan_table(tallies) + motion_table(tallies) +
         pair_table(tallies, rows) + variant_notes(rows) + std::string(success_legend()) +
         std::string(kSummaryLegend) + origin_notes(rows);
}

std::string render_failures(const std::vector<TableRow>& all_rows) {
  TextTable table({{"failed run", "", true},
                   {"method", "", true},
                   {"repe-", "tition", false, true},
                   {"class", "", true},
                   {"tick", ""},
                   {"link", ""},
                   {"obstacle", "", true},
                   {"because", "", true, true}});
  bool any = false;
  for (const TableRow& row : last_runs(all_rows)) {
    if (!row.applicable || row.success) continue;
    any = true;
    table.add_row({row.scenario, row.variant, std::to_string(row.repetition), failure_class(row),
                   row.failure_tick >= 0 ? std::to_string(row.failure_tick) : "-",
                   row.failure_link > 0 ? std::to_string(row.failure_link) : "-",
                   row.failure_obstacle.empty() ? "-" : row.failure_obstacle, row.claim_class});
  }
  return any ? table.text() : "no run failed\n";
}

std::string render_motions(const std::vector<TableRow>& all_rows) {
  TextTable table({{"motion", "", true},
                   {"method", "", true},
                   {"repe-", "tition", false, true},
                   {"judged", "", true},
                   {"drift", "[deg]"},
                   {"joint", "[deg]"},
                   {"manipulability", "least"},
                   {"", "mean"},
                   {"singular", "[m]"},
                   {"self-motion", "[%]"},
                   {"jerk", "[rad/s3]"},
                   {"clears", ""}});
  constexpr double kDegree = std::numbers::pi / 180;
  constexpr double kPercent = 1e-2;
  for (const TableRow& row : last_runs(all_rows)) {
    if (!row.applicable) continue;
    const MotionQuality& motion = row.motion;
    table.add_row({row.scenario, row.variant, std::to_string(row.repetition),
                   row.success ? "success" : failure_class(row),
                   figure(motion.closed_path_drift / kDegree),
                   figure(motion.closed_path_drift_joint / kDegree),
                   figure(motion.manipulability_min), figure(motion.manipulability_mean),
                   figure(motion.singular_value_min), figure(motion.null_space_share / kPercent),
                   figure(motion.jerk_rms), figure(row.clamp_starts)});
  }
  return table.text() + std::string(kMotionLegend);
}

}  // namespace bqsa::harness
