#include "harness/results/summary/tallies.hpp"

#include <algorithm>
#include <cmath>

#include "harness/judge/judge.hpp"
#include "harness/results/summary.hpp"
#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {
namespace {

bool no_verdict(const TableRow& row) {
  return std::find(row.failures.begin(), row.failures.end(), name_of(Failure::kDisagreement)) !=
         row.failures.end();
}

}  // namespace

void Tally::add(const TableRow& row) {
  if (!row.applicable) {
    ++not_applicable;
    return;
  }
  ++runs;
  problems.insert({row.scenario, row.sha256, row.repetition > 0 ? "" : row.seed});
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
  motions.push_back(row.motion);
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
  slowest_repetition = row.repetition;
  slowest_counts = row.against_times.empty();
}

double median_over(const std::vector<MotionQuality>& motions, double MotionQuality::*figure) {
  std::vector<double> values;
  for (const MotionQuality& motion : motions) {
    if (std::isfinite(motion.*figure)) values.push_back(motion.*figure);
  }
  if (values.empty()) return TableRow::kNone;
  std::sort(values.begin(), values.end());
  return median_of(values);
}

Tallies::Tallies(const std::vector<TableRow>& rows) {
  for (const TableRow& row : rows) {
    const std::string family = family_of(row.scenario);
    families.add(family);
    methods.add(row.variant);
    by_family_and_method[{family, row.variant}].add(row);
  }
}

}  // namespace bqsa::harness
