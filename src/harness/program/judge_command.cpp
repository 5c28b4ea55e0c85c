#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <ostream>

#include "harness/judge/judge.hpp"
#include "harness/judge/motion_quality.hpp"
#include "harness/program/commands.hpp"
#include "harness/results/table.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/trajectory_csv.hpp"

namespace bqsa::harness {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kPercent = 1e-2;
constexpr double kDegree = std::numbers::pi / 180;

void print_tip_error(const char* where, const TipError& error, std::ostream& out) {
  out << fmt::format(
      "tip error {} [mm]: max {:.4g} (tick {}), rms {:.4g}, mean {:.4g}; max along x {:.4g}, "
      "y {:.4g}, z {:.4g}\n",
      where, error.max / kMillimetre, error.max_tick, error.rms / kMillimetre,
      error.mean / kMillimetre, error.max_per_axis.x() / kMillimetre,
      error.max_per_axis.y() / kMillimetre, error.max_per_axis.z() / kMillimetre);
}

void print_orientation(const char* where, const OrientationError& error, std::ostream& out) {
  out << fmt::format("tip turned away {} [deg]: max {:.4g} (tick {}), mean {:.4g}\n", where,
                     error.max / kDegree, error.max_tick, error.mean / kDegree);
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
                       contact.obstacle, contact.first_tick, contact.ticks,
                       contact.at_tick ? "" : ", only between ticks");
  }
  for (const SelfContact& contact : judgement.self_contacts) {
    out << fmt::format("collided: ({}, link {}) from tick {}, at {} ticks{}\n", contact.first,
                       contact.second, contact.first_tick, contact.ticks,
                       contact.at_tick ? "" : ", only between ticks");
  }
  if (judgement.rows == 0) return;  // nothing was measured
  if (!problem.obstacles.empty()) {
    out << fmt::format("clearance [mm]: {:.4g}, at ticks {:.4g}{}\n",
                       judgement.clearance / kMillimetre,
                       judgement.clearance_at_ticks / kMillimetre,
                       judgement.touching ? "; touching (within 0.001 mm of contact)" : "");
  }
  if (std::isfinite(judgement.self_clearance_at_ticks)) {
    out << fmt::format("clearance of links from each other at ticks [mm]: {:.4g}\n",
                       judgement.self_clearance_at_ticks / kMillimetre);
  }
  print_tip_error("at ticks", judgement.at_ticks, out);
  print_tip_error("between ticks", judgement.between_ticks, out);
  if (problem.has_orientation()) {
    print_orientation("at ticks", judgement.orientation_at_ticks, out);
    print_orientation("between ticks", judgement.orientation_between_ticks, out);
  }
  out << fmt::format("tip error of the start [mm]: {:.4g}; tolerance at ticks: {:.4g}\n",
                     judgement.start_error / kMillimetre, problem.tolerance / kMillimetre);
  out << fmt::format("largest joint step [deg]: {:.4g} (tick {})\n",
                     judgement.max_joint_step / kDegree, judgement.max_joint_step_tick);
  if (!problem.chain.has_prismatic_joints()) return;
  out << fmt::format("largest step of a prismatic joint [mm]: {:.4g} (tick {})\n",
                     judgement.max_joint_slide / kMillimetre, judgement.max_joint_slide_tick);
}

void print(const MotionQuality& motion, int dimension, std::ostream& out) {
  if (std::isfinite(motion.closed_path_drift)) {
    out << fmt::format("joint drift after the closed path [deg]: {:.4g}, of one joint {:.4g}\n",
                       motion.closed_path_drift / kDegree,
                       motion.closed_path_drift_joint / kDegree);
  }
  if (std::isfinite(motion.manipulability_min)) {
    out << fmt::format(
        "manipulability [m^{}]: least {:.4g}, mean {:.4g}; least singular value [m]: {:.4g}\n",
        dimension, motion.manipulability_min, motion.manipulability_mean,
        motion.singular_value_min);
  }
  if (std::isfinite(motion.null_space_share)) {
    out << fmt::format("joint motion that does not move the tip [%]: {:.4g}\n",
                       motion.null_space_share / kPercent);
  }
  if (std::isfinite(motion.jerk_rms)) {
    out << fmt::format("joint jerk, rms [rad/s3]: {:.4g}\n", motion.jerk_rms);
  }
}

}  // namespace

Status judge_command(const std::filesystem::path& scenario_file,
                     const std::filesystem::path& trajectory_file, const LoadOptions& load,
                     bool strict, const Console& console) {
  const Scenario scenario = load_scenario(scenario_file, load);
  const Problem& problem = scenario.problem;
  const Trajectory trajectory = read_trajectory(trajectory_file, problem.chain.joints());
  const Judgement judgement =
      Judge(problem, scenario.truth, scenario.self_collision).judge(trajectory);
  console.out << fmt::format("scenario: {}\ntrajectory: {}\n", problem.name,
                             trajectory_file.string());
  print(judgement, problem, console.out);
  print(motion_quality(problem, trajectory, judgement.rows), problem.dimension(), console.out);
  console.out << success_legend();
  return strict && !judgement.success() ? kRunFailed : kOk;
}

}  // namespace bqsa::harness
