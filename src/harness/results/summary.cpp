#include "harness/results/summary.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "bqsa/method.hpp"
#include "harness/failure_class.hpp"
#include "harness/judge/judge.hpp"
#include "harness/results/table.hpp"
#include "harness/results/text_table.hpp"
#include "harness/runner.hpp"
#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kMicrosecond = 1e-6;
constexpr double kMillisecond = 1e-3;
constexpr double kDegree = std::numbers::pi / 180;

constexpr const char* kNoPlan = "no plan";
constexpr const char* kOther = "other";

constexpr std::string_view kSummaryLegend =
    R"(success     runs judged a success of all runs of a method that applies; 95 %: Wilson's interval
claim       wrong: runs in which the method claims success and the judge finds a failure, or the other way round
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
in pairs    scenarios to which both methods apply, by who succeeded; methods that never did are left out
)";

/// What the runs of one method on one family add up to.
struct Tally {
  int runs = 0;
  int not_applicable = 0;
  int successes = 0;
  int claims_wrong = 0;
  int disturbed_claims_wrong = 0;
  std::map<std::string, int> failures;  ///< by failure_class()
  int gave_up = 0;
  std::map<std::string, int> gave_up_by_class;  ///< by TableRow::claim_class

  std::vector<double> tip_errors_at_ticks_m;  ///< of each success
  double tip_error_between_ticks_m = 0;
  double clearance_m = std::numeric_limits<double>::infinity();
  double max_joint_step_rad = 0;
  LogHistogram increments;
  int increments_max = 0;

  std::vector<double> plans_s;  ///< of each success of a planning method
  LogHistogram step_times;
  double slowest_of_successes_s = TableRow::kNone;
  double slowest_s = TableRow::kNone;  ///< of all runs
  std::string slowest_scenario;
  int slowest_tick = 0;
  bool slowest_counts = true;  ///< nothing speaks against the time
  bool times_count = true;
  bool includes_pipe = false;  ///< the times
  double total_s = 0;

  void add(const TableRow& row);

 private:
  void add_success(const TableRow& row);
  void add_slowest(const TableRow& row);
};

bool no_verdict(const TableRow& row) {
  return std::find(row.failures.begin(), row.failures.end(), name_of(Failure::kDisagreement)) !=
         row.failures.end();
}

void Tally::add(const TableRow& row) {
  if (!row.applicable) {
    ++not_applicable;
    return;
  }
  ++runs;
  if (!row.claim_holds && !no_verdict(row)) {
    ++claims_wrong;
    if (!row.disturbance.empty()) ++disturbed_claims_wrong;
  }
  if (std::isfinite(row.run_s)) total_s += row.run_s;
  includes_pipe = includes_pipe || row.includes_pipe;
  add_slowest(row);
  if (!row.gave_up.empty()) {
    ++gave_up;
    ++gave_up_by_class[row.claim_class];
  }
  if (row.success) {
    add_success(row);
  } else {
    ++failures[failure_class(row)];
  }
}

void Tally::add_success(const TableRow& row) {
  ++successes;
  tip_errors_at_ticks_m.push_back(row.tip_error_at_ticks_m);
  tip_error_between_ticks_m = std::max(tip_error_between_ticks_m, row.tip_error_between_ticks_m);
  if (std::isfinite(row.plan_s)) plans_s.push_back(row.plan_s);
  if (std::isfinite(row.clearance_m)) clearance_m = std::min(clearance_m, row.clearance_m);
  max_joint_step_rad = std::max(max_joint_step_rad, row.max_joint_step_rad);
  increments.add_all(row.increments);
  increments_max = std::max(increments_max, row.increments_max);
  step_times.add_all(row.step_times);
  times_count = times_count && row.against_times.empty();
  slowest_of_successes_s = std::fmax(slowest_of_successes_s, row.slowest_s);
}

void Tally::add_slowest(const TableRow& row) {
  if (!std::isfinite(row.slowest_s) || row.slowest_s <= slowest_s) return;
  slowest_s = row.slowest_s;
  slowest_scenario = row.scenario;
  slowest_tick = row.slowest_tick;
  slowest_counts = row.against_times.empty();
}

/// Strings in order of first appearance.
class Order {
 public:
  void add(const std::string& name) {
    if (seen_.insert(name).second) names_.push_back(name);
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::set<std::string> seen_;
  std::vector<std::string> names_;
};

struct Summary {
  Order families;
  Order methods;
  std::map<std::pair<std::string, std::string>, Tally> tallies;  ///< by family and method

  explicit Summary(const std::vector<TableRow>& rows) {
    for (const TableRow& row : rows) {
      const std::string family = family_of(row.scenario);
      families.add(family);
      methods.add(row.variant);
      tallies[{family, row.variant}].add(row);
    }
  }

  /// Adds a heading for each family and below it what `cells_of` says of each method, of those that
  /// never apply in the first table only.
  template <typename CellsOf>
  void fill(TextTable& table, CellsOf cells_of, bool first = false) const {
    for (const std::string& family : families.names()) {
      table.add_heading(family);
      for (const std::string& method : methods.names()) {
        const auto tally = tallies.find({family, method});
        if (tally == tallies.end() || (tally->second.runs == 0 && !first)) continue;
        std::vector<std::string> cells = cells_of(tally->second);
        cells.insert(cells.begin(), fmt::format("  {}", method));
        table.add_row(std::move(cells));
      }
    }
  }
};

std::string count_text(std::int64_t count) { return std::to_string(count); }

std::string success_table(const Summary& summary) {
  TextTable table({{"judged", "", true},
                   {"runs", ""},
                   {"n/a", "", false, true},
                   {"success", ""},
                   {"%", ""},
                   {"95 %", "interval"},
                   {"failed", ""},
                   {"claim", "wrong"}});
  summary.fill(
      table,
      [](const Tally& tally) -> std::vector<std::string> {
        const auto [low, high] = wilson_interval(tally.successes, tally.runs);
        const bool ran = tally.runs > 0;
        return {count_text(tally.runs),
                count_text(tally.not_applicable),
                count_text(tally.successes),
                ran ? fmt::format("{:.1f}", 100.0 * tally.successes / tally.runs) : "-",
                ran ? fmt::format("{:.1f} to {:.1f}", 100 * low, 100 * high) : "-",
                count_text(tally.runs - tally.successes),
                count_text(tally.claims_wrong)};
      },
      /* first = */ true);
  return table.text();
}

/// What must not be overlooked: claims that the judge contradicts.
std::string alarms(const Summary& summary) {
  std::string text;
  for (const auto& [place, tally] : summary.tallies) {
    const auto& [family, method] = place;
    const int undisturbed = tally.claims_wrong - tally.disturbed_claims_wrong;
    if (undisturbed > 0) {
      text += fmt::format("! CLAIM AND VERDICT DIFFER in {} of {} runs: {} on {}\n", undisturbed,
                          tally.runs, method, family);
    }
    if (tally.disturbed_claims_wrong > 0) {
      text += fmt::format(
          "! claim and verdict differ in {} of {} runs: {} on {}, of what disturbed sensors told\n",
          tally.disturbed_claims_wrong, tally.runs, method, family);
    }
  }
  return text;
}

struct FailureColumn {
  std::string name;  ///< as failure_class() says it
  const char* head;
  const char* unit;
};

std::vector<FailureColumn> failure_columns() {
  return {{name_of(Infeasible::kNoFreeConfiguration), "no free", "config."},
          {name_of(Infeasible::kNoFreeMotion), "no free", "motion"},
          {name_of(Infeasible::kStepTooLarge), "step", "large"},
          {name_of(Infeasible::kJointLimit), "joint", "limit"},
          {name_of(Infeasible::kDiverged), "diver-", "ged"},
          {kNoPlan, "no", "plan"},
          {verdict_of(name_of(Failure::kCrashed)), "crashed", ""},
          {verdict_of(name_of(Failure::kTimedOut)), "timed", "out"},
          {verdict_of(name_of(Failure::kOutOfMemory)), "out of", "memory"},
          {verdict_of(name_of(Failure::kInputsChanged)), "changes", "inputs"},
          {verdict_of(name_of(Failure::kWorkHidden)), "hides", "work"},
          {verdict_of(name_of(Failure::kCollision)), "collides", ""},
          {verdict_of(name_of(Failure::kUndecided)), "unde-", "cided"},
          {verdict_of(name_of(Failure::kDrift)), "drifts", ""},
          {verdict_of(name_of(Failure::kJump)), "jumps", ""},
          {verdict_of(name_of(Failure::kJointLimit)), "breaks", "limits"},
          {verdict_of(name_of(Failure::kDisagreement)), "no", "verdict"}};
}

std::string failure_table(const Summary& summary) {
  const std::vector<FailureColumn> kinds = failure_columns();
  std::vector<TextTable::Column> columns = {{"failures", "", true}, {"failed", ""}};
  for (const FailureColumn& kind : kinds) columns.push_back({kind.head, kind.unit, false, true});
  columns.push_back({kOther, "", false, true});
  TextTable table(std::move(columns));
  summary.fill(table, [&kinds](const Tally& tally) {
    int others = tally.runs - tally.successes;
    std::vector<std::string> cells = {count_text(others)};
    for (const FailureColumn& kind : kinds) {
      const auto found = tally.failures.find(kind.name);
      const int count = found == tally.failures.end() ? 0 : found->second;
      cells.push_back(count_text(count));
      others -= count;
    }
    cells.push_back(count_text(others));
    return cells;
  });
  return table.text();
}

/// What stood in the way of methods that gave up; empty if no run was asked.
std::string why_table(const Summary& summary) {
  static constexpr std::array kClasses{FailureClass::kNoRoom, FailureClass::kLate,
                                       FailureClass::kSingular, FailureClass::kBranch,
                                       FailureClass::kMissed};
  TextTable table({{"why", "", true},
                   {"gave up", ""},
                   {"no room", ""},
                   {"late", ""},
                   {"singular", ""},
                   {"branch", ""},
                   {"missed", ""},
                   {"unknown", "", false, true}});
  bool any = false;
  summary.fill(table, [&any](const Tally& tally) {
    int unknown = tally.gave_up;
    std::vector<std::string> cells = {count_text(unknown)};
    for (const FailureClass kind : kClasses) {
      const auto found = tally.gave_up_by_class.find(name_of(kind));
      const int count = found == tally.gave_up_by_class.end() ? 0 : found->second;
      cells.push_back(count_text(count));
      unknown -= count;
      any = any || count > 0;
    }
    cells.push_back(count_text(unknown));
    return cells;
  });
  return any ? table.text() + '\n' : "";
}

std::string accuracy_table(const Summary& summary) {
  TextTable table({{"successes", "", true},
                   {"tip error [mm]", "median"},
                   {"", "max"},
                   {"[mm]", "between"},
                   {"clearance", "[mm]"},
                   {"max step", "[deg]"},
                   {"cleared", "ticks"},
                   {"increments", "median"},
                   {"", "p99"},
                   {"", "max"}});
  summary.fill(table, [](const Tally& tally) -> std::vector<std::string> {
    if (tally.successes == 0) return std::vector<std::string>(9, "-");
    std::vector<double> errors = tally.tip_errors_at_ticks_m;
    std::sort(errors.begin(), errors.end());
    return {figure(median_of(errors) / kMillimetre),
            figure(errors.back() / kMillimetre),
            figure(tally.tip_error_between_ticks_m / kMillimetre),
            figure(tally.clearance_m / kMillimetre),
            figure(tally.max_joint_step_rad / kDegree),
            count_text(tally.increments.total()),
            figure(std::round(tally.increments.quantile(0.5))),
            figure(std::round(tally.increments.quantile(0.99))),
            tally.increments.total() > 0 ? count_text(tally.increments_max) : "-"};
  });
  return table.text();
}

std::string time_table(const Summary& summary) {
  TextTable table({{"time", "", true},
                   {"ticks", ""},
                   {"[us]", "median"},
                   {"", "p99"},
                   {"", "p99.9"},
                   {"", "max"},
                   {"slowest", "[us]"},
                   {"in", "", true},
                   {"at", "tick"},
                   {"total", "[s]"}});
  summary.fill(table, [](const Tally& tally) -> std::vector<std::string> {
    const auto pooled = [&tally](double share) {
      const double seconds = tally.step_times.quantile(share) * RunTimes::kHistogramUnit;
      return figure(std::min(seconds, tally.slowest_of_successes_s) / kMicrosecond);
    };
    const bool timed = std::isfinite(tally.slowest_s);
    const char* doubt = tally.times_count || tally.step_times.total() == 0 ? "" : "~";
    const char* pipe = tally.includes_pipe && tally.step_times.total() > 0 ? kPipeMark : "";
    return {count_text(tally.step_times.total()),
            fmt::format("{}{}{}", pipe, doubt, pooled(0.5)),
            pooled(0.99),
            pooled(0.999),
            figure(tally.slowest_of_successes_s / kMicrosecond),
            fmt::format("{}{}{}", tally.includes_pipe ? kPipeMark : "",
                        tally.slowest_counts ? "" : "~", figure(tally.slowest_s / kMicrosecond)),
            tally.slowest_scenario,
            timed ? count_text(tally.slowest_tick) : "-",
            figure(tally.total_s)};
  });
  return table.text();
}

/// Of planning methods; empty if there is no plan.
std::string plan_table(const Summary& summary) {
  TextTable table(
      {{"plans", "", true}, {"solved", ""}, {"[ms]", "median"}, {"", "p99"}, {"", "max"}});
  bool any = false;
  for (const std::string& family : summary.families.names()) {
    table.add_heading(family);
    for (const std::string& method : summary.methods.names()) {
      const auto found = summary.tallies.find({family, method});
      if (found == summary.tallies.end() || found->second.plans_s.empty()) continue;
      const Tally& tally = found->second;
      any = true;
      std::vector<double> plans = tally.plans_s;
      std::sort(plans.begin(), plans.end());
      table.add_row(
          {fmt::format("  {}", method), count_text(std::ssize(plans)),
           fmt::format("{}{}{}", tally.includes_pipe ? kPipeMark : "", tally.times_count ? "" : "~",
                       figure(median_of(plans) / kMillisecond)),
           figure(quantile_of(plans, 0.99) / kMillisecond), figure(plans.back() / kMillisecond)});
    }
  }
  return any ? table.text() + '\n' : "";
}

/// Whether a method succeeded, by scenario file, for the runs of one family and method.
using Outcomes = std::map<std::pair<std::string, std::string>, bool>;

std::string pair_table(const Summary& summary, const std::vector<TableRow>& rows) {
  std::map<std::pair<std::string, std::string>, Outcomes> outcomes;
  for (const TableRow& row : rows) {
    if (!row.applicable) continue;
    outcomes[{family_of(row.scenario), row.variant}][{row.scenario, row.sha256}] = row.success;
  }
  TextTable table({{"in pairs (A, B)", "", true},
                   {"scenarios", ""},
                   {"both", ""},
                   {"only A", ""},
                   {"only B", ""},
                   {"none", ""}});
  bool any = false;
  for (const std::string& family : summary.families.names()) {
    table.add_heading(family);
    const std::vector<std::string>& methods = summary.methods.names();
    for (std::size_t a = 0; a < methods.size(); ++a) {
      for (std::size_t b = a + 1; b < methods.size(); ++b) {
        const Outcomes& of_a = outcomes[{family, methods[a]}];
        const Outcomes& of_b = outcomes[{family, methods[b]}];
        int counts[2][2] = {};
        int common = 0;
        for (const auto& [scenario, success] : of_a) {
          const auto other = of_b.find(scenario);
          if (other == of_b.end()) continue;
          ++common;
          ++counts[success][other->second];
        }
        const int by_a = counts[1][0] + counts[1][1];
        const int by_b = counts[0][1] + counts[1][1];
        if (by_a == 0 || by_b == 0) continue;  // a pair that says no more than the counts above
        any = true;
        table.add_row({fmt::format("  {}, {}", methods[a], methods[b]), count_text(common),
                       count_text(counts[1][1]), count_text(counts[1][0]), count_text(counts[0][1]),
                       count_text(counts[0][0])});
      }
    }
  }
  return any ? table.text() + '\n' : "";
}

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
  const Summary summary(rows);
  const std::string alarm = alarms(summary);
  return fmt::format("{} runs on {} scenarios of {} families\n\n", rows.size(),
                     count_scenarios(rows), summary.families.names().size()) +
         success_table(summary) + alarm + '\n' + failure_table(summary) + '\n' +
         why_table(summary) + accuracy_table(summary) + '\n' + time_table(summary) + '\n' +
         plan_table(summary) + pair_table(summary, rows) + variant_notes(rows) +
         std::string(success_legend()) + std::string(kSummaryLegend) + origin_notes(rows);
}

std::string render_failures(const std::vector<TableRow>& all_rows) {
  TextTable table({{"failed run", "", true},
                   {"method", "", true},
                   {"class", "", true},
                   {"tick", ""},
                   {"link", ""},
                   {"obstacle", "", true},
                   {"because", "", true, true}});
  bool any = false;
  for (const TableRow& row : last_runs(all_rows)) {
    if (!row.applicable || row.success) continue;
    any = true;
    table.add_row({row.scenario, row.variant, failure_class(row),
                   row.failure_tick >= 0 ? count_text(row.failure_tick) : "-",
                   row.failure_link > 0 ? count_text(row.failure_link) : "-",
                   row.failure_obstacle.empty() ? "-" : row.failure_obstacle, row.claim_class});
  }
  return any ? table.text() : "no run failed\n";
}

}  // namespace bqsa::harness
