#include <fmt/core.h>

#include <array>

#include "bqsa/method.hpp"
#include "harness/failure_class.hpp"
#include "harness/judge/judge.hpp"
#include "harness/results/summary.hpp"
#include "harness/results/summary/blocks.hpp"
#include "harness/results/table.hpp"
#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {
namespace {

constexpr const char* kOther = "other";

/// Whether a method succeeded, by scenario file, its hash and repetition, for the runs of one family and
/// method.
using Outcomes = std::map<std::tuple<std::string, std::string, int>, bool>;

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
          {verdict_of(name_of(Failure::kSelfCollision)), "self-", "coll."},
          {verdict_of(name_of(Failure::kUndecided)), "unde-", "cided"},
          {verdict_of(name_of(Failure::kDrift)), "drifts", ""},
          {verdict_of(name_of(Failure::kOrientation)), "tilts", ""},
          {verdict_of(name_of(Failure::kJump)), "jumps", ""},
          {verdict_of(name_of(Failure::kJointLimit)), "breaks", "limits"},
          {verdict_of(name_of(Failure::kDisagreement)), "no", "verdict"}};
}

}  // namespace

std::string success_table(const Tallies& tallies) {
  TextTable table({{"judged", "", true},
                   {"runs", ""},
                   {"n/a", "", false, true},
                   {"success", ""},
                   {"%", ""},
                   {"95 %", "interval"},
                   {"failed", ""},
                   {"claim", "wrong"}});
  tallies.fill(
      table,
      [](const Tally& tally) -> std::vector<std::string> {
        const bool ran = tally.runs > 0;
        const auto problems = static_cast<double>(tally.problems.size());
        const auto [low, high] =
            wilson_interval(ran ? problems * tally.successes / tally.runs : 0, problems);
        return {std::to_string(tally.runs),
                std::to_string(tally.not_applicable),
                std::to_string(tally.successes),
                ran ? fmt::format("{:.1f}", 100.0 * tally.successes / tally.runs) : "-",
                ran ? fmt::format("{:.1f} to {:.1f}", 100 * low, 100 * high) : "-",
                std::to_string(tally.runs - tally.successes),
                std::to_string(tally.claims_wrong)};
      },
      /* first = */ true);
  return table.text();
}

std::string alarms(const Tallies& tallies) {
  std::string text;
  for (const auto& [place, tally] : tallies.by_family_and_method) {
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

std::string failure_table(const Tallies& tallies) {
  const std::vector<FailureColumn> kinds = failure_columns();
  std::vector<TextTable::Column> columns = {{"failures", "", true}, {"failed", ""}};
  for (const FailureColumn& kind : kinds) columns.push_back({kind.head, kind.unit, false, true});
  columns.push_back({kOther, "", false, true});
  TextTable table(std::move(columns));
  tallies.fill(table, [&kinds](const Tally& tally) {
    int others = tally.runs - tally.successes;
    std::vector<std::string> cells = {std::to_string(others)};
    for (const FailureColumn& kind : kinds) {
      const auto found = tally.failures.find(kind.name);
      const int count = found == tally.failures.end() ? 0 : found->second;
      cells.push_back(std::to_string(count));
      others -= count;
    }
    cells.push_back(std::to_string(others));
    return cells;
  });
  return table.text();
}

std::string why_table(const Tallies& tallies) {
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
  tallies.fill(table, [&any](const Tally& tally) {
    int unknown = tally.gave_up;
    std::vector<std::string> cells = {std::to_string(unknown)};
    for (const FailureClass kind : kClasses) {
      const auto found = tally.gave_up_by_class.find(name_of(kind));
      const int count = found == tally.gave_up_by_class.end() ? 0 : found->second;
      cells.push_back(std::to_string(count));
      unknown -= count;
      any = any || count > 0;
    }
    cells.push_back(std::to_string(unknown));
    return cells;
  });
  return any ? table.text() + '\n' : "";
}

std::string pair_table(const Tallies& tallies, const std::vector<TableRow>& rows) {
  std::map<std::pair<std::string, std::string>, Outcomes> outcomes;
  for (const TableRow& row : rows) {
    if (!row.applicable) continue;
    outcomes[{family_of(row.scenario), row.variant}][{row.scenario, row.sha256, row.repetition}] =
        row.success;
  }
  TextTable table({{"in pairs (A, B)", "", true},
                   {"pairs", ""},
                   {"both", ""},
                   {"only A", ""},
                   {"only B", ""},
                   {"none", ""}});
  bool any = false;
  for (const std::string& family : tallies.families.names()) {
    table.add_heading(family);
    const std::vector<std::string>& methods = tallies.methods.names();
    for (std::size_t a = 0; a < methods.size(); ++a) {
      for (std::size_t b = a + 1; b < methods.size(); ++b) {
        const Outcomes& of_a = outcomes[{family, methods[a]}];
        const Outcomes& of_b = outcomes[{family, methods[b]}];
        int counts[2][2] = {};
        int common = 0;
        for (const auto& [run, success] : of_a) {
          const auto other = of_b.find(run);
          if (other == of_b.end()) continue;
          ++common;
          ++counts[success][other->second];
        }
        const int by_a = counts[1][0] + counts[1][1];
        const int by_b = counts[0][1] + counts[1][1];
        if (by_a == 0 || by_b == 0) continue;  // a pair that says no more than the counts above
        any = true;
        table.add_row({fmt::format("  {}, {}", methods[a], methods[b]), std::to_string(common),
                       std::to_string(counts[1][1]), std::to_string(counts[1][0]),
                       std::to_string(counts[0][1]), std::to_string(counts[0][0])});
      }
    }
  }
  return any ? table.text() + '\n' : "";
}

}  // namespace bqsa::harness
