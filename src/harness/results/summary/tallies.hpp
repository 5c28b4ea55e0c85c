/// @file
/// What runs add up to, by family of scenarios and method: the numbers behind the summary.
#pragma once

#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/log_histogram.hpp"
#include "harness/results/table_row.hpp"
#include "harness/results/text_table.hpp"

namespace bqsa::harness {

/// What the runs of one method on one family add up to.
struct Tally {
  int runs = 0;
  int not_applicable = 0;
  int successes = 0;
  /// Runs that are not repetitions of each other: scenario file, its hash, and the seed outside of
  /// campaigns.
  std::set<std::tuple<std::string, std::string, std::string>> problems;
  int claims_wrong = 0;
  int disturbed_claims_wrong = 0;
  std::map<std::string, int> failures;  ///< by failure_class()
  int gave_up = 0;
  std::map<std::string, int> gave_up_by_class;  ///< by TableRow::claim_class

  std::vector<double> tip_errors_at_ticks_m;  ///< of each success
  double tip_error_between_ticks_m = 0;
  double clearance_m = std::numeric_limits<double>::infinity();
  double max_joint_step_rad = 0;
  std::vector<MotionQuality> motions;  ///< of each success
  LogHistogram increments;
  int increments_max = 0;

  std::vector<double> plans_s;  ///< of each success of a planning method
  LogHistogram step_times;
  double slowest_of_successes_s = TableRow::kNone;
  double slowest_s = TableRow::kNone;  ///< of all runs
  std::string slowest_scenario;
  int slowest_tick = 0;
  int slowest_repetition = 0;  ///< 0 outside of campaigns
  bool slowest_counts = true;  ///< nothing speaks against the time
  bool times_count = true;
  bool includes_pipe = false;  ///< the times
  double total_s = 0;

  void add(const TableRow& row);

 private:
  void add_success(const TableRow& row);
  void add_slowest(const TableRow& row);
};

/// Median of one figure over the motions that have it, not a number if none has.
double median_over(const std::vector<MotionQuality>& motions, double MotionQuality::*figure);

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

/// The runs of all rows, by family and method.
struct Tallies {
  Order families;
  Order methods;
  std::map<std::pair<std::string, std::string>, Tally> by_family_and_method;

  explicit Tallies(const std::vector<TableRow>& rows);

  /// Adds a heading for each family and below it what `cells_of` says of each method, of those that
  /// never apply in the first table only.
  template <typename CellsOf>
  void fill(TextTable& table, CellsOf cells_of, bool first = false) const {
    for (const std::string& family : families.names()) {
      table.add_heading(family);
      for (const std::string& method : methods.names()) {
        const auto tally = by_family_and_method.find({family, method});
        if (tally == by_family_and_method.end() || (tally->second.runs == 0 && !first)) continue;
        std::vector<std::string> cells = cells_of(tally->second);
        cells.insert(cells.begin(), "  " + method);
        table.add_row(std::move(cells));
      }
    }
  }
};

}  // namespace bqsa::harness
