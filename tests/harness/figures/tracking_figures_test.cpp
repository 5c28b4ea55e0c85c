// Errors, paths and joint angles in figures against the judge's record and the trajectory.
#include "harness/figures/tracking_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "figure_data.hpp"
#include "harness/figures/trajectory_figures.hpp"

namespace bqsa::harness {
namespace {

constexpr double kDigits = 1e-9;  // relative, of numbers in CSV
constexpr double kDegree = std::numbers::pi / 180;

void expect_errors_of_the_judge(const Figure& figure, const JudgedRun& run) {
  const ReadTable ticks = data_of(figure, run.method);
  ASSERT_EQ(ticks.rows.size(), run.rows() - 1);
  const TipError& at_ticks = run.judgement.at_ticks;
  const TipError& between = run.judgement.between_ticks;
  double largest = 0;
  for (std::size_t k = 0; k < ticks.rows.size(); ++k) {
    largest = std::max(largest, ticks.number(k, "error [mm]"));
  }
  EXPECT_NEAR(largest, at_ticks.max * 1e3, at_ticks.max * 1e3 * kDigits);
  EXPECT_NEAR(ticks.number(static_cast<std::size_t>(at_ticks.max_tick) - 1, "error [mm]"), largest,
              largest * kDigits);
  for (int axis = 0; axis < run.problem().dimension(); ++axis) {
    const std::string name(1, "xyz"[axis]);
    double at_tick = 0;
    double anywhere = 0;
    for (std::size_t k = 0; k < ticks.rows.size(); ++k) {
      at_tick = std::max(at_tick, std::abs(ticks.number(k, name + " error [mm]")));
      anywhere = std::max({anywhere, -ticks.number(k, name + " least between [mm]"),
                           ticks.number(k, name + " greatest between [mm]")});
    }
    EXPECT_NEAR(at_tick, at_ticks.max_per_axis(axis) * 1e3, at_tick * kDigits) << name;
    EXPECT_NEAR(anywhere, std::max(at_ticks.max_per_axis(axis), between.max_per_axis(axis)) * 1e3,
                anywhere * kDigits)
        << name;
  }
}

TEST(TrackingFigures, ShowTheErrorsThatTheJudgeFinds) {
  const JudgedRun paper = run_of("planar_7r", "bqsa_paper");
  const JudgedRun exact = run_of("planar_7r", "bqsa");
  const Figure planar = planar_errors(paper, exact);
  expect_errors_of_the_judge(planar, paper);
  expect_errors_of_the_judge(planar, exact);

  const JudgedRun projection = run_of("puma560_ellipsoid", "bqsa_projection");
  const JudgedRun space = run_of("puma560_ellipsoid", "bqsa");
  const Figure spatial = spatial_errors(projection, space);
  expect_errors_of_the_judge(spatial, projection);
  expect_errors_of_the_judge(spatial, space);
}

TEST(TrackingFigures, ShowThePathByTheKinematicsOfTheMethods) {
  const JudgedRun run = run_of("puma560_ellipsoid", "bqsa_projection");
  const ReadTable path = data_of(spatial_trajectory(run, run), run.method);
  ChainPose pose;
  int ticks = 0;
  for (std::size_t k = 0; k < path.rows.size(); ++k) {
    const double t = path.number(k, "t [s]");
    const Eigen::Vector3d desired = run.problem().desired_tip(t);
    EXPECT_NEAR(path.number(k, "y desired [m]"), desired.y(), 1e-9) << t;
    EXPECT_NEAR(path.number(k, "z desired [m]"), desired.z(), 1e-9) << t;
    if (path.text(k, "at tick") != "1") continue;
    const auto row = static_cast<std::size_t>(std::lround(t / run.problem().dt));
    run.problem().chain.forward(run.trajectory().q[row], pose);
    EXPECT_NEAR(path.number(k, "y [m]"), pose.tip().y(), 1e-9) << t;
    EXPECT_NEAR(path.number(k, "z [m]"), pose.tip().z(), 1e-9) << t;
    ++ticks;
  }
  EXPECT_EQ(ticks, run.problem().ticks);
  EXPECT_GT(path.rows.size(), 10 * run.rows());
}

TEST(TrackingFigures, ShowTheTrajectoryAndItsDifferences) {
  const JudgedRun run = run_of("planar_7r", "bqsa_paper");
  const ReadTable joints = data_of(planar_joint_angles(run, run), run.method);
  ASSERT_EQ(joints.rows.size(), run.rows());
  EXPECT_EQ(joints.text(0, "v1 [deg/s]"), "");
  double largest_step = 0;
  for (std::size_t k = 0; k < run.rows(); ++k) {
    for (int j = 0; j < 7; ++j) {
      const std::string number = std::to_string(j + 1);
      const double q = run.trajectory().q[k](j);
      EXPECT_NEAR(joints.number(k, "q" + number + " [deg]") * kDegree, q, 1e-10);
      if (k == 0) continue;
      const double step = joints.number(k, "v" + number + " [deg/s]") * kDegree * run.problem().dt;
      EXPECT_NEAR(step, q - run.trajectory().q[k - 1](j), 1e-10);
      largest_step = std::max(largest_step, std::abs(step));
    }
  }
  EXPECT_NEAR(largest_step, run.judgement.max_joint_step, 1e-10);
  const std::string& drawing = planar_joint_angles(run, run).drawing;
  for (int j = 1; j <= 7; ++j) {
    EXPECT_NE(drawing.find("set label \"q_" + std::to_string(j) + "\""), std::string::npos);
  }
}

/// Links that were moved away are left in or near contact: those ticks are shaded, and not all others.
TEST(TrackingFigures, ShadeWhatIsCloseToAnObstacle) {
  const JudgedRun run = run_of("planar_7r", "bqsa");
  double shaded = 0;
  for (const Span& span : close_spans(run)) {
    EXPECT_LT(span.from, span.to);
    shaded += span.to - span.from;
  }
  double moved = 0;
  for (const ClampedPair& pair : run.outcome.clamped_pairs) moved += pair.ticks * run.problem().dt;
  EXPECT_NEAR(shaded, moved, 0.1 * moved);
}

}  // namespace
}  // namespace bqsa::harness
