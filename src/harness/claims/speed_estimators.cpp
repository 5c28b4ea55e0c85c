#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/measuring/contest.hpp"
#include "harness/measuring/speed_of_pairs.hpp"

namespace bqsa::harness::claims {
namespace {

Figure figure_of(const char* name, const Estimate& estimate) {
  return {name, estimate.value, estimate.interval};
}

/// Nothing is fitted. In the cache a pass takes the time of its multiply-adds at the machine's peak: 9 for each end-point
/// (6 map it, 3 give its level) and 5 a pair (3 give S12, 2 the discriminant). Out of the cache it
/// takes that or the time of reading the obstacles, whichever is longer.
Findings batch_model(const Arguments&, Laboratory& laboratory) {
  const Sweep* sweep = laboratory.sweep(kSpeedOfPairs);
  if (sweep == nullptr) {
    return {.figures = {}, .remarks = {fmt::format("no sweep {} was measured", kSpeedOfPairs)}};
  }
  for (const char* name : {"multiply_adds", "multiply_adds_float", "read_far", "batch",
                           "batch_float", "batch_far", "batch_float_far"}) {
    if (sweep->find(name) == nullptr) {
      return {.figures = {}, .remarks = {fmt::format("{} was not measured", name)}};
    }
  }
  constexpr double kOfPoint = 9, kOfPair = 5;
  constexpr double kLinks = kSpeedSize.links;
  constexpr double kCounted =
      (kOfPoint * (kLinks + 1) + kOfPair * kLinks) / (kMultiplyAddsOfPair * kLinks);
  const auto times = [&](const char* name) { return sweep->find(name)->seconds[0]; };
  const auto arithmetic = [&](const char* peak) {
    std::vector<double> predicted = times(peak);
    for (double& seconds : predicted) seconds *= kCounted;
    return predicted;
  };
  const std::vector<double> arithmetic_double = arithmetic("multiply_adds");
  const std::vector<double> arithmetic_float = arithmetic("multiply_adds_float");
  const std::vector<double> reading = times("read_far");
  std::vector<double> far, far_float;
  for (std::size_t process = 0; process < reading.size(); ++process) {
    far.push_back(std::max(arithmetic_double[process], reading[process]));
    far_float.push_back(std::max(arithmetic_float[process], reading[process] / 2));
  }
  return {.figures = {figure_of("double", time_ratio(arithmetic_double, times("batch"))),
                      figure_of("float", time_ratio(arithmetic_float, times("batch_float"))),
                      figure_of("far", time_ratio(far, times("batch_far"))),
                      figure_of("float_far", time_ratio(far_float, times("batch_float_far")))},
          .remarks = {}};
}

Findings sampled_safety(const Arguments&, Laboratory&) {
  const MissRate safe = safe_test_points();
  return {.figures = {{"point_pairs", static_cast<double>(safe.size.point_pairs())},
                      {"miss_rate", safe.miss_rate(), safe.miss_interval()}},
          .remarks = {fmt::format("N = {} of a link, M = {} of an obstacle",
                                  safe.size.test_points.link, safe.size.test_points.obstacle)}};
}

/// Times of the ticks of one run, of each replay.
struct TickTimes {
  std::vector<double> free;                   ///< mean of the free ticks, [replay] [s]
  std::vector<std::vector<double>> clearing;  ///< of every other tick, [replay][tick] [s]
};

/// Free ticks are timed stretch by stretch, since reading the clock takes as long as one of them; others
/// one by one.
void replay(const RecordedRun& recorded, const MethodSpec& method, TickTimes& times) {
  const std::unique_ptr<Method> made = method.entry.make(method.parameters);
  auto& reactive = dynamic_cast<ReactiveMethod&>(*made);
  reactive.prepare(recorded.problem);
  StepInput input;
  StepOutput output;
  const auto step = [&](std::size_t tick) {
    input.tick = static_cast<int>(tick);
    input.t = recorded.problem.time(input.tick);
    input.p_WT_desired = recorded.problem.desired_tip(input.t);
    input.R_WT_desired = recorded.problem.rotation_at(input.t);
    input.q = recorded.trajectory.q[tick - 1];
    reactive.step(input, output);
  };
  const auto is_free = [&](std::size_t tick) {
    return recorded.ticks[tick - 1].state == TickState::kFree;
  };
  double free_seconds = 0;
  int free_ticks = 0;
  std::vector<double>& clearing = times.clearing.emplace_back();
  for (std::size_t tick = 1; tick <= recorded.ticks.size();) {
    const double start = thread_cpu_seconds();
    if (!is_free(tick)) {
      step(tick++);
      clearing.push_back(thread_cpu_seconds() - start);
      continue;
    }
    for (; tick <= recorded.ticks.size() && is_free(tick); ++tick, ++free_ticks) step(tick);
    free_seconds += thread_cpu_seconds() - start;
  }
  times.free.push_back(free_seconds / std::max(free_ticks, 1));
}

/// Of every tick, the middle over replays: what a tick costs, not what disturbed it.
std::vector<double> middle_of_replays(const TickTimes& times) {
  std::vector<double> middles;
  for (std::size_t tick = 0; tick < times.clearing.front().size(); ++tick) {
    std::vector<double> replays;
    for (const std::vector<double>& one : times.clearing) replays.push_back(one[tick]);
    std::sort(replays.begin(), replays.end());
    middles.push_back(median_of(replays));
  }
  return middles;
}

Findings clearing_ticks(const Arguments& arguments, Laboratory& laboratory) {
  constexpr std::uint64_t kSeed = 1;
  constexpr int kReplays = 5;
  constexpr double kMicrosecond = 1e-6, kRare = 0.999;
  const MethodSpec method = laboratory.method(arguments.text("method"));
  std::vector<double> clearing;                                  // of all runs [s]
  std::vector<double> free_sum(kReplays), median_sum(kReplays);  // over runs, [replay] [s]
  std::string worst;
  double most = 0;
  for (int i = 0; i < laboratory.samples(arguments.whole("problems")); ++i) {
    const RecordedRun recorded =
        record_run(laboratory.generated(arguments.text("family"), kSeed, i), method);
    TickTimes times;
    for (int k = 0; k < kReplays; ++k) replay(recorded, method, times);
    if (times.clearing.front().empty() || times.free.front() == 0) continue;
    for (std::size_t k = 0; k < kReplays; ++k) {
      std::vector<double> sorted = times.clearing[k];
      std::sort(sorted.begin(), sorted.end());
      free_sum[k] += times.free[k];
      median_sum[k] += median_of(sorted);
    }
    const std::vector<double> middles = middle_of_replays(times);
    const double longest = *std::max_element(middles.begin(), middles.end());
    if (longest > most) {
      most = longest;
      worst = fmt::format("worst tick: {} {} {}", arguments.text("family"), kSeed, i);
    }
    clearing.insert(clearing.end(), middles.begin(), middles.end());
  }
  if (clearing.empty()) return {.figures = {}, .remarks = {"no run had ticks of both kinds"}};
  std::sort(clearing.begin(), clearing.end());
  return {.figures = {{"ticks", static_cast<double>(clearing.size())},
                      figure_of("median_ratio", time_ratio(median_sum, free_sum)),
                      {"median", median_of(clearing) / kMicrosecond},
                      {"rare", quantile_of(clearing, kRare) / kMicrosecond},
                      {"worst", most / kMicrosecond}},
          .remarks = {worst}};
}

}  // namespace

std::vector<Estimator> speed_estimators() {
  return {
      {.name = "batch_model",
       .what = "Time of the batched test in space as predicted from its multiply-adds, counted, "
               "and the peak and "
               "bandwidth measured in the same run, over its measured time",
       .timing = true,
       .arguments = {},
       .figures = {{"double", "-", "in the cache"},
                   {"float", "-", "in the cache, in single precision"},
                   {"far", "-", "out of the cache"},
                   {"float_far", "-", "out of the cache, in single precision"}},
       .estimate = batch_model},
      {.name = "sampled_safety",
       .what = "The smallest NM, in steps of 100, at which test points miss at most 3 % of first "
               "contacts",
       .arguments = {},
       .figures = {{"point_pairs", "-", "that NM"},
                   {"miss_rate", "-", "part of the first contacts missed with it"}},
       .estimate = sampled_safety},
      {.name = "clearing_ticks",
       .what = "Times of the ticks of a method that are not free, every tick the middle of five "
               "replays, on random problems",
       .timing = true,
       .arguments = {{"method", ArgumentKind::kText, {}, "a reactive method, M[:key=value,...]"},
                     {"family", ArgumentKind::kText, {}, "of generated problems, planar"},
                     {"problems", ArgumentKind::kWholeNumber, "20",
                      "how many, a quick evaluation"}},
       .figures = {{"ticks", "-", "that were not free"},
                   {"median_ratio", "-",
                    "median of these ticks over a free tick of the same runs, means over runs"},
                   {"median", "us", "of these ticks", true},
                   {"rare", "us", "that one in a thousand of them exceeds", true},
                   {"worst", "us", "of them", true}},
       .estimate = clearing_ticks},
  };
}

}  // namespace bqsa::harness::claims
