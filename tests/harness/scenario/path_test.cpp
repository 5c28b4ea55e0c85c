// Paths against points computed by hand.
#include "harness/scenario/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "harness/scenario/scenario_files.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

/// Scenario of a planar arm whose tip starts at (2, 0); the given path and timing.
std::string planar(const std::string& path, const std::string& timing) {
  return "schema: bqsa-scenario/1\nname: p\nunits: {length: m, angle: deg}\n"
         "robot: {kind: planar, links: [1, 1]}\nstart: [0, 0]\nstart_tolerance: 4\n"
         "task: {path: " +
         path + ", timing: " + timing + "}\n";
}

void expect_near(const Vector3d& got, const Vector3d& expected) {
  EXPECT_LT((got - expected).norm(), 1e-14) << got.transpose() << " != " << expected.transpose();
}

TEST(Path, EllipseArcRunsOnTheTurnedEllipseInItsParameter) {
  const TestDirectory directory;
  const Problem problem =
      directory
          .load(planar("{kind: ellipse_arc, center: [0.5, -0.2], semi_axes: [0.6, 0.3], "
                       "rotation: 90, from: 90, to: -90}",
                       "{duration: 4, ticks: 8}"))
          .problem;
  // Turned by 90 degrees the long axis is y and the short one -x.
  expect_near(problem.desired_tip(0), {0.2, -0.2, 0});
  expect_near(problem.desired_tip(2), {0.5, 0.4, 0});
  expect_near(problem.desired_tip(4), {0.8, -0.2, 0});
  const double h = std::sqrt(0.5);
  expect_near(problem.desired_tip(1), {0.5 - 0.3 * h, -0.2 + 0.6 * h, 0});
}

TEST(Path, CircleRunsFromUToV) {
  const TestDirectory directory;
  const std::string text =
      "schema: bqsa-scenario/1\nname: p\nunits: {length: mm, angle: deg}\n"
      "robot: {kind: dh, joints: [{a: 1000, alpha: 0, d: 0}, {a: 1000, alpha: 0, d: 0}]}\n"
      "start: [0, 0]\nstart_tolerance: 4000\n"
      "task: {path: {kind: circle, center: [100, 200, 300], radius: 50, axis_u: [0, 0.6, 0.8],\n"
      "              axis_v: [-1, 0, 0], from: -90, to: 270}, timing: {duration: 8, ticks: 8}}\n";
  const Problem problem = directory.load(text).problem;
  expect_near(problem.desired_tip(0), {0.15, 0.2, 0.3});
  expect_near(problem.desired_tip(2), {0.1, 0.23, 0.34});
  expect_near(problem.desired_tip(4), {0.05, 0.2, 0.3});
  expect_near(problem.desired_tip(6), {0.1, 0.17, 0.26});
  expect_near(problem.desired_tip(8), {0.15, 0.2, 0.3});
}

TEST(Path, LineRunsStraight) {
  const TestDirectory directory;
  const Problem problem = directory
                              .load(planar("{kind: line, start_point: [1, 0], end_point: [0, 1]}",
                                           "{duration: 10, ticks: 8, profile: linear}"))
                              .problem;
  expect_near(problem.desired_tip(2.5), {0.75, 0.25, 0});
  EXPECT_EQ(problem.desired_tip(10), Vector3d(0, 1, 0));
}

TEST(Path, PolylineRunsAtConstantSpeedOverAllItsPieces) {
  const TestDirectory directory;
  // Pieces of 0.3 m, 0 m and 0.9 m.
  const Problem problem =
      directory
          .load(planar("{kind: polyline, points: [[0, 0], [0.3, 0], [0.3, 0], [0.3, 0.9]]}",
                       "{duration: 12, ticks: 8}"))
          .problem;
  expect_near(problem.desired_tip(1), {0.1, 0, 0});
  expect_near(problem.desired_tip(3), {0.3, 0, 0});
  expect_near(problem.desired_tip(4), {0.3, 0.1, 0});
  expect_near(problem.desired_tip(12), {0.3, 0.9, 0});
}

TEST(Path, AllPointsOfALineMayCoincide) {
  const TestDirectory directory;
  const Problem problem =
      directory
          .load(planar("{kind: polyline, points: [[1, 0.5], [1, 0.5]]}", "{duration: 2, ticks: 2}"))
          .problem;
  for (const double t : {0.0, 0.7, 2.0}) expect_near(problem.desired_tip(t), {1, 0.5, 0});
}

TEST(Path, WaypointsKeepTheirOwnTimes) {
  const TestDirectory directory;
  directory.write("way.csv", "t,x,y\n0,1,0\n0.5,1,1\n4,-0.75,1\n");
  const Problem problem =
      directory.load(planar("{kind: waypoints, file: ./way.csv}", "{duration: 4, ticks: 8}"))
          .problem;
  expect_near(problem.desired_tip(0.25), {1, 0.5, 0});
  expect_near(problem.desired_tip(0.5), {1, 1, 0});
  expect_near(problem.desired_tip(1.5), {0.5, 1, 0});
  expect_near(problem.desired_tip(4), {-0.75, 1, 0});
}

TEST(Path, QuinticProfileIsSlowAtBothEnds) {
  const TestDirectory directory;
  const Problem problem = directory
                              .load(planar("{kind: line, start_point: [0, 0], end_point: [1, 0]}",
                                           "{duration: 4, ticks: 8, profile: quintic}"))
                              .problem;
  expect_near(problem.desired_tip(0), {0, 0, 0});
  expect_near(problem.desired_tip(1), {0.103515625, 0, 0});  // 10/4³ - 15/4⁴ + 6/4⁵
  expect_near(problem.desired_tip(2), {0.5, 0, 0});
  expect_near(problem.desired_tip(3), {0.896484375, 0, 0});
  expect_near(problem.desired_tip(4), {1, 0, 0});
}

TEST(Path, HoldsItsEndsOutsideOfItsTime) {
  const TestDirectory directory;
  const Problem problem = directory
                              .load(planar("{kind: line, start_point: [0, 0], end_point: [1, 0]}",
                                           "{duration: 0.7, ticks: 3}"))
                              .problem;
  expect_near(problem.desired_tip(-1), {0, 0, 0});
  expect_near(problem.desired_tip(1e9), {1, 0, 0});
  expect_near(problem.desired_tip(problem.time(problem.ticks)), {1, 0, 0});
}

TEST(Path, FractionAtInvertsTheProfile) {
  for (const Profile profile : {Profile::kLinear, Profile::kQuintic}) {
    for (int i = 0; i <= 100; ++i) {
      const double s = i / 100.0;
      EXPECT_NEAR(progress(profile, fraction_at(profile, s)), s, 1e-14) << i;
    }
  }
}

TEST(Path, ChordsStayWithinATenthOfAMicrometreOfAnArc) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int checked = 0;
  for (int i = 0; i < 20; ++i) {
    const Arc arc{.center = Vector3d::Zero(),
                  .u = std::exp(2 * uniform(random)) * Vector3d::UnitX(),
                  .v = std::exp(2 * uniform(random)) * Vector3d::UnitZ(),
                  .from = 4 * uniform(random),
                  .to = 4 * uniform(random)};
    const std::vector<double> s = chords(arc);
    ASSERT_EQ(s.front(), 0) << i;
    // Two turns are covered by the first.
    ASSERT_NEAR(s.back(), std::min(1.0, 2 * kPi / std::abs(arc.to - arc.from)), 1e-12) << i;
    for (std::size_t k = 0; k + 1 < s.size(); k += 17) {
      const Vector3d chord_middle = (point_at(arc, s[k]) + point_at(arc, s[k + 1])) / 2;
      const Vector3d arc_middle = point_at(arc, (s[k] + s[k + 1]) / 2);
      ASSERT_LT((chord_middle - arc_middle).norm(), 1.01e-7) << i;
      ++checked;
    }
  }
  EXPECT_GT(checked, 2000);
}

}  // namespace
}  // namespace bqsa::harness
