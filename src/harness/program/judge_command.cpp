#include <fmt/core.h>

#include <numbers>
#include <ostream>

#include "harness/judge/judge.hpp"
#include "harness/program/commands.hpp"
#include "harness/results/table.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/trajectory_csv.hpp"

namespace bqsa::harness {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kDegree = std::numbers::pi / 180;

void print_tip_error(const char* where, const TipError& error, std::ostream& out) {
  out << fmt::format(
      "tip error {} [mm]: max {:.4g} (tick {}), rms {:.4g}, mean {:.4g}; max along x {:.4g}, "
      "y {:.4g}, z {:.4g}\n",
      where, error.max / kMillimetre, error.max_tick, error.rms / kMillimetre,
      error.mean / kMillimetre, error.max_per_axis.x() / kMillimetre,
      error.max_per_axis.y() / kMillimetre, error.max_per_axis.z() / kMillimetre);
}

void print(const Judgement& judgement, const Problem& problem, std::ostream& out) {
  std::string verdict = judgement.success() ? "success" : "failure:";
  for (std::size_t i = 0; i < judgement.failures.size(); ++i) {
    verdict += (i == 0 ? " " : ", ") + verdict_of(name_of(judgement.failures[i]));
  }
  out << fmt::format("verdict: {}\n", verdict);
  out << fmt::format("rows: {} of {}\n", judgement.rows, problem.ticks + 1);
  if (!judgement.disagreement.empty()) {
    out << fmt::format("the judge's checkers disagree: {}\n", judgement.disagreement);
  }
  for (const Contact& contact : judgement.contacts) {
    out << fmt::format("collided: ({}, {}) from tick {}, at {} ticks{}\n", contact.link,
                       problem.obstacles[static_cast<std::size_t>(contact.obstacle)].name,
                       contact.first_tick, contact.ticks,
                       contact.at_tick ? "" : ", only between ticks");
  }
  if (judgement.rows == 0) return;  // nothing was measured
  if (!problem.obstacles.empty()) {
    out << fmt::format("clearance [mm]: {:.4g}, at ticks {:.4g}{}\n",
                       judgement.clearance / kMillimetre,
                       judgement.clearance_at_ticks / kMillimetre,
                       judgement.touching ? "; touching (within 0.001 mm of contact)" : "");
  }
  print_tip_error("at ticks", judgement.at_ticks, out);
  print_tip_error("between ticks", judgement.between_ticks, out);
  out << fmt::format("tip error of the start [mm]: {:.4g}; tolerance at ticks: {:.4g}\n",
                     judgement.start_error / kMillimetre, problem.tolerance / kMillimetre);
  out << fmt::format("largest joint step [deg]: {:.4g} (tick {})\n",
                     judgement.max_joint_step / kDegree, judgement.max_joint_step_tick);
}

}  // namespace

Status judge_command(const std::filesystem::path& scenario_file,
                     const std::filesystem::path& trajectory_file, const LoadOptions& load,
                     bool strict, const Console& console) {
  const Scenario scenario = load_scenario(scenario_file, load);
  const Problem& problem = scenario.problem;
  const Trajectory trajectory = read_trajectory(trajectory_file, problem.chain.joints());
  const Judgement judgement = Judge(problem).judge(trajectory);
  console.out << fmt::format("scenario: {}\ntrajectory: {}\n", problem.name,
                             trajectory_file.string());
  print(judgement, problem, console.out);
  console.out << success_legend();
  return strict && !judgement.success() ? kRunFailed : kOk;
}

}  // namespace bqsa::harness
