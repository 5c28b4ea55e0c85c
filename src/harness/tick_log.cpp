#include "harness/tick_log.hpp"

#include <algorithm>
#include <numeric>

#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {
namespace {

constexpr int kFirstWarmTick = 2;

}  // namespace

TickLog::TickLog(const Problem& problem) : tally_(problem.obstacles.size()) {
  step_s_.reserve(static_cast<std::size_t>(problem.ticks));
  increments_.reserve(static_cast<std::size_t>(problem.ticks));
}

void TickLog::add_step(const StepInput& input, double seconds) {
  step_s_.push_back(seconds);
  if (input.tick < kFirstWarmTick || seconds <= slowest_s_) return;
  slowest_s_ = seconds;
  q_slowest_ = input.q;
}

void TickLog::add_clamps(const StepOutput& output, int tick) {
  int increments = 0;
  for (int i = 0; i < output.clamp_count; ++i) {
    const Clamp& clamp = output.clamps[static_cast<std::size_t>(i)];
    tally_.add(clamp, tick);
    increments += clamp.increments;
    increments_max_ = std::max(increments_max_, clamp.increments);
  }
  increments_total_ += increments;
  if (output.clamp_count > 0) increments_.push_back(increments);
}

void TickLog::summarize(RunOutcome& outcome) const {
  outcome.clamped_pairs = tally_.pairs();
  outcome.clamp_starts = tally_.starts();
  outcome.increments_total = increments_total_;
  outcome.increments_max = increments_max_;
  summarize(outcome.times);
  summarize(outcome.increments);
}

void TickLog::summarize(RunTimes& times) const {
  if (step_s_.empty()) return;
  times.first_step_s = step_s_.front();
  std::vector<double> warm(step_s_.begin() + 1, step_s_.end());
  if (warm.empty()) return;
  const auto slowest = std::max_element(warm.begin(), warm.end());
  times.warm_steps = static_cast<int>(warm.size());
  times.warm_max_s = *slowest;
  times.warm_max_tick = kFirstWarmTick + static_cast<int>(slowest - warm.begin());
  times.warm_max_q = q_slowest_;
  for (const double seconds : warm) times.warm_histogram.add(seconds / RunTimes::kHistogramUnit);

  std::sort(warm.begin(), warm.end());
  times.warm_median_s = median_of(warm);
  times.warm_p99_s = quantile_of(warm, 0.99);
  times.warm_p999_s = quantile_of(warm, 0.999);
}

void TickLog::summarize(TickIncrements& summary) const {
  if (increments_.empty()) return;
  std::vector<double> increments = increments_;
  std::sort(increments.begin(), increments.end());
  const double sum = std::accumulate(increments.begin(), increments.end(), 0.0);
  summary.mean = sum / static_cast<double>(increments.size());
  summary.median = median_of(increments);
  summary.p99 = quantile_of(increments, 0.99);
  summary.max = static_cast<int>(increments.back());
  for (const double count : increments) summary.histogram.add(count);
}

}  // namespace bqsa::harness
