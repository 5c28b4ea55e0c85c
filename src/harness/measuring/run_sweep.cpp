#include "harness/measuring/run_sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "harness/input_error.hpp"
#include "harness/measuring/bystanders.hpp"
#include "harness/measuring/detector_passes.hpp"
#include "harness/measuring/speed_of_pairs.hpp"
#include "harness/measuring/speed_of_steps.hpp"
#include "harness/methods.hpp"

namespace bqsa::harness {
namespace {

constexpr std::array<std::string_view, 9> kSweepNames{"plane_nm", "plane_nk",    "space_nm",
                                                      "space_nk", "step_nk",     "space_step_nk",
                                                      kGateSweep, kSpeedOfPairs, kSpeedOfSteps};

constexpr std::array kSteps{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10'000};
constexpr int kPairs = 27;        ///< nk where NM varies (paper, Fig. 5)
constexpr int kPointPairs = 600;  ///< NM where nk varies (Fig. 6)
constexpr std::array kBystanders{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};

constexpr std::uint64_t kWorkloadSeed = 1;
constexpr int kPaperPasses = 100;
constexpr int kGateRounds = 10;  ///< times those of other sweeps

bool is_in_the_papers_figures(std::string_view detector) {
  return detector == "test_points" || detector == "bqsa_paper" || detector == "bqsa_projections";
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Mean of the paper's 100 single passes, after one to get warm [s].
double paper_mean(DetectorPasses& passes) {
  passes.make(1);
  const double start = wall_seconds();
  passes.make(kPaperPasses);
  return (wall_seconds() - start) / kPaperPasses;
}

/// Adds what came out of a contest of all series at all sizes, size by size.
void add(const std::vector<ContestTimes>& times, Sweep& sweep) {
  const std::vector<double> seconds = typical_seconds(times);
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    sweep.series[i % sweep.series.size()].seconds.push_back({seconds[i]});
  }
}

/// A size of a sweep of detectors, ready to be measured.
struct DetectorsAtSize {
  Workload workload;
  std::vector<DetectorPasses> passes;  ///< of each detector; refer to the workload
};

void sweep_detectors(int dimension, const SweepSettings& settings, const SweepProgress& progress,
                     Sweep& sweep) {
  std::vector<const Detector*> chosen;
  for (const Detector& detector : detectors()) {
    if (!detector.is_for(dimension)) continue;
    chosen.push_back(&detector);
    sweep.series.push_back(
        {.name = std::string(detector.name), .seconds = {}, .paper_seconds = {}});
  }
  if (progress) progress(sweep.name);
  std::deque<DetectorsAtSize> all_sizes;  // where addresses stay
  std::vector<Contestant> contestants;
  for (const int step : kSteps) {
    const WorkloadSize size = sweep.axis == SweepAxis::kPointPairs
                                  ? workload_size(dimension, kPairs, step)
                                  : workload_size(dimension, step, kPointPairs);
    sweep.sizes.push_back(size);
    DetectorsAtSize& at = all_sizes.emplace_back(
        DetectorsAtSize{.workload = make_workload(size, kWorkloadSeed), .passes = {}});
    require_right_answers(at.workload, chosen, settings.verified_pairs);
    at.passes.reserve(chosen.size());
    for (const Detector* detector : chosen) {
      DetectorPasses& passes = at.passes.emplace_back(*detector, at.workload);
      contestants.push_back(
          {passes.name(), [&passes](int repetitions) { passes.make(repetitions); }});
    }
  }
  add(run_contest(contestants, settings.contest), sweep);
  if (!settings.paper_protocol) return;
  for (DetectorsAtSize& at : all_sizes) {
    for (std::size_t c = 0; c < at.passes.size(); ++c) {
      if (!is_in_the_papers_figures(at.passes[c].name())) continue;
      sweep.series[c].paper_seconds.push_back(paper_mean(at.passes[c]));
      sweep.series[c].paper_passes.push_back(kPaperPasses);
    }
  }
}

void sweep_steps(int dimension, const SweepSettings& settings, const SweepProgress& progress,
                 Sweep& sweep) {
  const Problem lonely = lonely_problem(dimension);
  const std::vector<Obstacle> bystanders = draw_bystanders(lonely, kBystanders.back());
  std::vector<const MethodEntry*> chosen;
  for (const MethodEntry& method : methods()) {
    const bool fits = why_not_applicable(method.capabilities, lonely).empty();
    if (method.capabilities.plans || !fits) continue;
    chosen.push_back(&method);
    sweep.series.push_back({.name = method.name, .seconds = {}, .paper_seconds = {}});
  }
  if (progress) progress(sweep.name);
  std::deque<Problem> problems;  // where addresses stay, as with the loops
  std::deque<ControlLoop> loops;
  std::vector<Contestant> contestants;
  for (const int k : kBystanders) {
    Problem& problem = problems.emplace_back(lonely);
    problem.obstacles.assign(bystanders.begin(), bystanders.begin() + k);
    sweep.sizes.push_back({.dimension = dimension,
                           .links = static_cast<int>(lonely.chain.links().size()),
                           .obstacles = k});
    for (const MethodEntry* method : chosen) {
      ControlLoop& loop = loops.emplace_back(with_defaults(*method), problem);
      contestants.push_back({method->name, [&loop](int steps) { loop.run(steps); }});
    }
  }
  add(run_contest(contestants, settings.contest), sweep);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    require_left_alone(with_defaults(*chosen[i % chosen.size()]), lonely, loops[i]);
  }
}

/// What the gate has to call a tie, and what a difference.
void sweep_gate(const SweepSettings& settings, const SweepProgress& progress, Sweep& sweep) {
  if (progress) progress(sweep.name);
  const WorkloadSize size = workload_size(2, kPairs, kPointPairs);
  const Workload workload = make_workload(size, kWorkloadSeed);
  const Detector& detector = detector_named("bqsa");
  require_right_answers(workload, {&detector}, settings.verified_pairs);
  DetectorPasses once(detector, workload), again(detector, workload), half_more(detector, workload);
  sweep.sizes.push_back(size);
  for (const char* name : {"once", "once_again", "half_more"}) {
    sweep.series.push_back({.name = name, .seconds = {}, .paper_seconds = {}});
  }
  ContestSettings contest = settings.contest;
  contest.rounds *= kGateRounds;  // three contestants alone would be through in no time
  contest.budget_s *= kGateRounds;
  add(run_contest({{"once", [&](int passes) { once.make(passes); }},
                   {"once_again", [&](int passes) { again.make(passes); }},
                   {"half_more", [&](int passes) { half_more.make(passes + (passes + 1) / 2); }}},
                  contest),
      sweep);
}

}  // namespace

std::span<const std::string_view> sweep_names() { return kSweepNames; }

bool is_of_steps(std::string_view sweep_name) {
  return sweep_name.ends_with("step_nk") || sweep_name == kSpeedOfSteps;
}

bool is_at_one_size(std::string_view sweep_name) {
  return sweep_name == kGateSweep || sweep_name == kSpeedOfPairs || sweep_name == kSpeedOfSteps;
}

SweepSettings quick_sweeps() { return {}; }

SweepSettings full_sweeps() {
  return {.contest = {.rounds = 50, .block_s = 5e-4, .budget_s = 0.1, .fewest_rounds = 9},
          .verified_pairs = 50'000};
}

Sweep run_sweep(std::string_view name, const SweepSettings& settings,
                const SweepProgress& progress) {
  Sweep sweep{.name = std::string(name), .axis = axis_of(name), .sizes = {}, .series = {}};
  if (std::find(kSweepNames.begin(), kSweepNames.end(), name) == kSweepNames.end()) {
    throw InputError(
        fmt::format("sweep: expected one of {}, got '{}'", fmt::join(kSweepNames, ", "), name));
  }
  const int dimension = name.starts_with("space") ? 3 : 2;
  if (name == kGateSweep) {
    sweep_gate(settings, progress, sweep);
  } else if (name == kSpeedOfPairs) {
    if (progress) progress(sweep.name);
    measure_speed_of_pairs(settings.contest, settings.verified_pairs, sweep);
  } else if (name == kSpeedOfSteps) {
    if (progress) progress(sweep.name);
    measure_speed_of_steps(settings.contest, sweep);
  } else if (is_of_steps(name)) {
    sweep_steps(dimension, settings, progress, sweep);
  } else {
    sweep_detectors(dimension, settings, progress, sweep);
  }
  return sweep;
}

}  // namespace bqsa::harness
