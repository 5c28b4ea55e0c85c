#include "harness/figures/judged_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/judge/exact_distance.hpp"
#include "harness/method_spec.hpp"
#include "harness/methods.hpp"
#include "harness/results/provenance.hpp"

namespace bqsa::harness {
namespace {

constexpr double kClose = 1e-4;      // [m]
constexpr int kSamplesBetween = 10;  // of the tip, between two ticks

bool is_close(const JudgedRun& run, std::size_t row) {
  for (const Obstacle& obstacle : run.problem().obstacles) {
    const Ellipsoid& shape = obstacle.at(static_cast<int>(row));
    for (std::size_t i = 0; i < run.links.size(); ++i) {
      const LinkSegment& link = run.links[i];
      const SegmentDistance distance =
          exact_distance(run.start_of(link, row), run.end_of(link, row), shape);
      if (distance.clearance() - run.problem().radius_of(i) < kClose) return true;
    }
  }
  return false;
}

}  // namespace

JudgedRun judged_run(const Scenario& scenario, std::string_view method) {
  const MethodSpec spec = parse_method_spec(method, methods());
  const Problem& problem = scenario.problem;
  const std::string why_not = why_not_applicable(spec.entry.capabilities, problem);
  if (!why_not.empty()) {
    throw InputError(fmt::format("{}: expected a scenario for {}, got one that is not ({})",
                                 scenario.file.string(), method, why_not));
  }
  JudgedRun run{.scenario = scenario,
                .method = std::string(method),
                .outcome = run_method(problem, spec.entry, spec.parameters),
                .judgement = {},
                .links = {},
                .positions = {}};
  run.judgement = Judge(problem, scenario.truth, scenario.self_collision).judge(run.trajectory());
  const JudgeKinematics kinematics(problem.chain.description());
  run.links.assign(kinematics.links().begin(), kinematics.links().end());
  run.positions.resize(static_cast<std::size_t>(run.judgement.rows));
  for (std::size_t row = 0; row < run.rows(); ++row) {
    kinematics.place(run.trajectory().q[row], run.positions[row]);
  }
  return run;
}

std::vector<TipSample> tip_samples(const JudgedRun& run) {
  const Problem& problem = run.problem();
  const JudgeKinematics kinematics(problem.chain.description());
  PointPositions positions;
  std::vector<TipSample> samples;
  for (std::size_t row = 1; row < run.rows(); ++row) {
    for (int sample = row == 1 ? kSamplesBetween + 1 : 1; sample <= kSamplesBetween + 1; ++sample) {
      const bool at_tick = sample == kSamplesBetween + 1;
      const double s = at_tick ? 1 : static_cast<double>(sample) / (kSamplesBetween + 1);
      const Eigen::VectorXd before = run.trajectory().q[row - 1];
      const Eigen::VectorXd after = run.trajectory().q[row];
      kinematics.place(at_tick ? after : Eigen::VectorXd(before + s * (after - before)), positions);
      const double t = (static_cast<double>(row) - 1 + s) * problem.dt;
      samples.push_back({t, at_tick, problem.desired_tip(t), positions.tip()});
    }
  }
  return samples;
}

std::vector<Span> close_spans(const JudgedRun& run) {
  std::vector<Span> spans;
  const double half = run.problem().dt / 2;
  bool before = false;
  for (std::size_t row = 0; row < run.rows(); ++row) {
    const bool now = is_close(run, row);
    if (now && !before) spans.push_back({run.time(row) - half, 0});
    if (now) spans.back().to = run.time(row) + half;
    before = now;
  }
  return spans;
}

std::string verdict_text(const JudgedRun& run) {
  std::string text = run.judgement.success() ? "success" : "";
  for (const Failure failure : run.judgement.failures) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", name_of(failure));
  }
  return fmt::format("{}: {}", run.method, text);
}

std::string run_provenance(const JudgedRun& run) {
  return fmt::format("{} on {} (sha256 {}), judged: {}; bqsa-bench {}", run.method,
                     run.problem().name, run.scenario.sha256.substr(0, 12), verdict_text(run),
                     version_text());
}

}  // namespace bqsa::harness
