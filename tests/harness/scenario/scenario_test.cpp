// Good scenarios become the problems that they describe, in SI units.
#include "harness/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "bqsa/kinematics/serial_chain.hpp"
#include "harness/scenario/scenario_files.hpp"
#include "harness/sha256.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
constexpr double kDegree = std::numbers::pi / 180;

Vector3d start_tip(const Problem& problem) {
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  return pose.tip();
}

Scenario shipped(const std::string& name) {
  return load_scenario(std::filesystem::path(BQSA_SOURCE_DIR) / "scenarios" / (name + ".yaml"));
}

constexpr const char* kPlanar = R"(schema: bqsa-scenario/1
name: every_planar_key
description: every key of a planar scenario
units: {length: m, angle: deg}
robot:
  kind: planar
  base: [0.5, 0.25]
  links: [1, 0.5, 0.25]
  limits: {lower: [-180, -90, -90], upper: [180, 90, 45], max_velocity: [30, 60, 90]}
  link_radius: 0.0625
start: [90, -45, -45]
start_tolerance: 2
task:
  path: {kind: line, start_point: [1, 1], end_point: [1.5, 1]}
  timing: {duration: 5, ticks: 20, profile: quintic}
obstacles:
  - {name: one, kind: ellipse, center: [-1, 1], semi_axes: [0.25, 0.5], rotation: 90}
margin: 0.01
tolerance: 0.002
)";

TEST(Scenario, AcceptsEveryKeyOfAPlanarScenario) {
  const TestDirectory directory;
  const Scenario scenario = directory.load(kPlanar);
  const Problem& problem = scenario.problem;
  EXPECT_EQ(scenario.description, "every key of a planar scenario");
  EXPECT_EQ(scenario.file, directory.path() / "s.yaml");
  EXPECT_EQ(problem.name, "every_planar_key");
  EXPECT_EQ(problem.dimension(), 2);
  EXPECT_EQ(problem.ticks, 20);
  EXPECT_EQ(problem.dt, 0.25);
  EXPECT_EQ(problem.link_radius, 0.0625);
  EXPECT_EQ(problem.margin, 0.01);
  EXPECT_EQ(problem.tolerance, 0.002);
  EXPECT_TRUE(problem.start.isApprox(Vector3d(90, -45, -45) * kDegree, 1e-15));
  EXPECT_TRUE(problem.limits.lower.isApprox(Vector3d(-180, -90, -90) * kDegree, 1e-15));
  EXPECT_TRUE(problem.limits.upper.isApprox(Vector3d(180, 90, 45) * kDegree, 1e-15));
  EXPECT_TRUE(problem.limits.max_velocity.isApprox(Vector3d(30, 60, 90) * kDegree, 1e-15));
  const double h = std::sqrt(0.5);
  EXPECT_LT((start_tip(problem) - Vector3d(0.75 + 0.5 * h, 1.25 + 0.5 * h, 0)).norm(), 1e-14);

  ASSERT_EQ(problem.obstacles.size(), 1U);
  const Ellipsoid& shape = problem.obstacles[0].shape;
  EXPECT_EQ(problem.obstacles[0].name, "one");
  EXPECT_EQ(shape.center(), Vector3d(-1, 1, 0));
  EXPECT_EQ(shape.semi_axes(), Vector3d(0.25, 0.5, 0.5));
  EXPECT_LT((shape.rotation().col(0) - Vector3d::UnitY()).norm(), 1e-15);
}

TEST(Scenario, AcceptsEveryKeyOfASpatialScenario) {
  for (const std::string kind : {"dh", "mdh"}) {
    SCOPED_TRACE(kind);
    const TestDirectory directory;
    const Problem problem =
        directory
            .load(
                "schema: bqsa-scenario/1\nname: s\nunits: {length: mm, angle: deg}\n"
                "robot:\n  kind: " +
                kind +
                "\n  base: [100, 200, 300]\n  rpy: [0, 0, 90]\n  joints:\n"
                "    - {a: 10, alpha: 90, d: 20, offset: 30, lower: -5, upper: 5,"
                " max_velocity: 45}\n"
                "    - {a: 400, alpha: 0, d: 0, max_velocity: 90}\n"
                "  tool: [0, 0, 50]\n  link_radius: 5\n"
                "start: [0, 0]\nstart_tolerance: 2000\ntask:\n"
                "  path: {kind: line, start_point: [100, 600, 320], end_point: [100, 600, 330]}\n"
                "  timing: {duration: 1, ticks: 4, profile: linear}\nobstacles:\n"
                "  - {name: a, kind: ellipsoid, center: [0, 0, 900], semi_axes: [50, 60, 70],"
                " rpy: [0, 0, 90]}\n"
                "  - {name: b, kind: ellipsoid, center: [0, 0, 900], semi_axes: [50, 60, 70],"
                " quaternion: [0, 1, 0, 0]}\n"
                "  - {name: c, kind: sphere, center: [0, 0, 900], radius: 50}\n")
            .problem;
    const ChainDescription& chain = problem.chain.description();
    EXPECT_EQ(chain.convention, kind == "dh" ? DhConvention::kStandard : DhConvention::kModified);
    ASSERT_EQ(chain.rows.size(), 2U);
    EXPECT_EQ(chain.rows[0].a, 0.01);
    EXPECT_DOUBLE_EQ(chain.rows[0].alpha, 90 * kDegree);
    EXPECT_EQ(chain.rows[0].d, 0.02);
    EXPECT_DOUBLE_EQ(chain.rows[0].offset, 30 * kDegree);
    EXPECT_EQ(chain.rows[1].offset, 0);
    EXPECT_EQ(chain.p_WB, Vector3d(0.1, 0.2, 0.3));
    EXPECT_LT((chain.R_WB.col(0) - Vector3d::UnitY()).norm(), 1e-15);
    EXPECT_EQ(chain.p_LT, Vector3d(0, 0, 0.05));
    EXPECT_EQ(problem.link_radius, 0.005);
    EXPECT_DOUBLE_EQ(problem.limits.lower(0), -5 * kDegree);
    EXPECT_TRUE(std::isinf(problem.limits.lower(1)) && problem.limits.lower(1) < 0);
    EXPECT_TRUE(std::isinf(problem.limits.upper(1)) && problem.limits.upper(1) > 0);
    EXPECT_DOUBLE_EQ(problem.limits.max_velocity(1), 90 * kDegree);
    ASSERT_EQ(problem.obstacles.size(), 3U);
    EXPECT_LT((problem.obstacles[1].shape.rotation().diagonal() - Vector3d(1, -1, -1)).norm(),
              1e-15);
    EXPECT_EQ(problem.obstacles[2].shape.semi_axes(), Vector3d::Constant(0.05));
  }
}

TEST(Scenario, WhatIsLeftOutHasItsDocumentedDefault) {
  const TestDirectory directory;
  const Scenario scenario = directory.load(
      "schema: bqsa-scenario/1\nname: s\nunits: {length: mm, angle: rad}\n"
      "robot: {kind: planar, links: [1000, 500]}\nstart: [0, 0]\n"
      "task:\n  path: {kind: ellipse_arc, center: [1000, 0], semi_axes: [500, 250], from: 0, to: "
      "1}\n"
      "  timing: {duration: 1, ticks: 4}\n");
  const Problem& problem = scenario.problem;
  EXPECT_EQ(scenario.description, "");
  EXPECT_TRUE(problem.obstacles.empty());
  EXPECT_EQ(problem.margin, 0);
  EXPECT_EQ(problem.tolerance, 1e-3);
  EXPECT_EQ(problem.link_radius, 0);
  EXPECT_EQ(problem.limits.lower.size() + problem.limits.upper.size(), 0);
  EXPECT_EQ(problem.limits.max_velocity.size(), 0);
  EXPECT_EQ(start_tip(problem), Vector3d(1.5, 0, 0));
  EXPECT_LT((problem.desired_tip(0.5) - Vector3d(1 + 0.5 * std::cos(0.5), 0.25 * std::sin(0.5), 0))
                .norm(),
            1e-15);
}

TEST(Scenario, SelfCollisionIsJudgedIfAskedFor) {
  const TestDirectory directory;
  const auto asked = [&](const std::string& lines) {
    return directory
        .load(
            "schema: bqsa-scenario/1\nname: folding\nunits: {length: m, angle: deg}\n"
            "robot: {kind: planar, links: [1, 1, 1, 1], link_radius: 0.01}\n"
            "start: [0, 60, 60, 60]\n"
            "task:\n  path: {kind: line, start_point: [0, 1.732050808], end_point: [0, 1.5]}\n"
            "  timing: {duration: 1, ticks: 10}\n" +
            lines)
        .self_collision;
  };
  EXPECT_FALSE(asked("").has_value());
  EXPECT_FALSE(asked("self_collision: false\n").has_value());
  ASSERT_TRUE(asked("self_collision: true\n").has_value());
  EXPECT_TRUE(asked("self_collision: true\n")->skip.empty());
  using Pairs = std::vector<std::pair<int, int>>;
  EXPECT_EQ(asked("self_collision: {skip: [[4, 2], [1, 3]]}\n")->skip, Pairs({{2, 4}, {1, 3}}));
}

TEST(Scenario, MillimetresAndDegreesGiveTheProblemOfMetresAndRadians) {
  const TestDirectory directory;
  const std::string head = "schema: bqsa-scenario/1\nname: s\n";
  const Problem a =
      directory
          .load(head +
                "units: {length: mm, angle: deg}\n"
                "robot: {kind: dh, base: [125, 0, 0], tool: [0, 0, 250], link_radius: 31.25,\n"
                "  limits: {lower: [-180, -180], upper: [180, 180], max_velocity: [90, 90]},\n"
                "  joints: [{a: 0, alpha: 90, d: 500, offset: 45}, {a: 375, alpha: 0, d: 0}]}\n"
                "start: [90, 0]\nstart_tolerance: 4000\n"
                "task: {path: {kind: circle, center: [0, 0, 750], radius: 62.5, from: 0, to: 180,\n"
                "  axis_u: [1, 0, 0], axis_v: [0, 1, 0]}, timing: {duration: 1, ticks: 4}}\n"
                "obstacles: [{name: a, kind: ellipsoid, center: [0, 0, 2000], rpy: [0, 45, 90],\n"
                "  semi_axes: [125, 250, 500]}]\nmargin: 1\ntolerance: 2\n")
          .problem;
  const Problem b =
      directory
          .load(
              head +
              "units: {length: m, angle: rad}\n"
              "robot: {kind: dh, base: [0.125, 0, 0], tool: [0, 0, 0.25], link_radius: 0.03125,\n"
              "  limits: {lower: [-3.141592653589793, -3.141592653589793],\n"
              "    upper: [3.141592653589793, 3.141592653589793],\n"
              "    max_velocity: [1.5707963267948966, 1.5707963267948966]},\n"
              "  joints: [{a: 0, alpha: 1.5707963267948966, d: 0.5, offset: 0.7853981633974483},\n"
              "    {a: 0.375, alpha: 0, d: 0}]}\n"
              "start: [1.5707963267948966, 0]\nstart_tolerance: 4\n"
              "task: {path: {kind: circle, center: [0, 0, 0.75], radius: 0.0625, from: 0,\n"
              "  to: 3.141592653589793, axis_u: [1, 0, 0], axis_v: [0, 1, 0]},\n"
              "  timing: {duration: 1, ticks: 4}}\n"
              "obstacles: [{name: a, kind: ellipsoid, center: [0, 0, 2],\n"
              "  rpy: [0, 0.7853981633974483, 1.5707963267948966],\n"
              "  semi_axes: [0.125, 0.25, 0.5]}]\nmargin: 0.001\ntolerance: 0.002\n")
          .problem;
  EXPECT_EQ(start_tip(a), start_tip(b));
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.limits.lower, b.limits.lower);
  EXPECT_EQ(a.limits.upper, b.limits.upper);
  EXPECT_EQ(a.limits.max_velocity, b.limits.max_velocity);
  EXPECT_EQ(a.link_radius, b.link_radius);
  EXPECT_EQ(a.margin, b.margin);
  EXPECT_EQ(a.tolerance, b.tolerance);
  EXPECT_EQ(a.obstacles[0].shape.center(), b.obstacles[0].shape.center());
  EXPECT_EQ(a.obstacles[0].shape.unit_map(), b.obstacles[0].shape.unit_map());
  for (int tick = 0; tick <= a.ticks; ++tick) {
    EXPECT_EQ(a.desired_tip(a.time(tick)), b.desired_tip(b.time(tick))) << tick;
  }
}

TEST(Scenario, RpyAndQuaternionOfOneRotationGiveOneEllipsoid) {
  const TestDirectory directory;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-3.2, 3.2);
  const auto number = [](double value) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
  };
  int cases = 0;
  for (; cases < 200; ++cases) {
    const double r = uniform(random), p = uniform(random), y = uniform(random);
    // The product of the half-angle quaternions of z, y and x, written out.
    const double cr = std::cos(r / 2), sr = std::sin(r / 2), cp = std::cos(p / 2);
    const double sp = std::sin(p / 2), cy = std::cos(y / 2), sy = std::sin(y / 2);
    const std::string quaternion =
        number(cy * cp * cr + sy * sp * sr) + ", " + number(cy * cp * sr - sy * sp * cr) + ", " +
        number(cy * sp * cr + sy * cp * sr) + ", " + number(sy * cp * cr - cy * sp * sr);
    const std::string shape = "kind: ellipsoid, center: [9, 9, 9], semi_axes: [1, 2, 3]";
    const Problem problem =
        directory
            .load(
                "schema: bqsa-scenario/1\nname: s\nunits: {length: m, angle: rad}\n"
                "robot: {kind: mdh, joints: [{a: 0, alpha: 0, d: 0}], tool: [1, 0, 0]}\n"
                "start: [0]\ntask: {path: {kind: line, start_point: [1, 0, 0],"
                " end_point: [1, 0, 0]}, timing: {duration: 1, ticks: 1}}\nobstacles:\n  - {" +
                shape + ", name: a, rpy: [" + number(r) + ", " + number(p) + ", " + number(y) +
                "]}\n  - {" + shape + ", name: b, quaternion: [" + quaternion + "]}\n")
            .problem;
    ASSERT_LT((problem.obstacles[0].shape.rotation() - problem.obstacles[1].shape.rotation())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-14)
        << "case " << cases;
  }
  EXPECT_EQ(cases, 200);
}

TEST(Scenario, ThePlanarScenarioHasItsDocumentedNumbers) {
  const Problem problem = shipped("planar_7r").problem;
  EXPECT_EQ(problem.chain.joints(), 7);
  EXPECT_EQ(problem.ticks, 400);
  EXPECT_EQ(problem.dt, 0.025);
  EXPECT_EQ(problem.tolerance, 1e-3);
  ASSERT_EQ(problem.obstacles.size(), 2U);
  EXPECT_EQ(problem.obstacles[0].name, "object");
  EXPECT_EQ(problem.obstacles[1].shape.semi_axes(), Vector3d(0.21, 0.10, 0.21));
  const Vector3d path_start(1.6 + 0.46 * std::cos(150 * kDegree),
                            -0.35 + 0.31 * std::sin(150 * kDegree), 0);
  EXPECT_LT((problem.desired_tip(0) - path_start).norm(), 1e-14);
  EXPECT_LT((start_tip(problem) - path_start).norm(), 0.005);
}

TEST(Scenario, ThePumaScenariosHaveTheirDocumentedNumbers) {
  for (const std::string name : {"puma560_ellipsoid", "puma560_wall"}) {
    SCOPED_TRACE(name);
    const Problem problem = shipped(name).problem;
    EXPECT_EQ(problem.chain.joints(), 6);
    EXPECT_EQ(problem.ticks, 360);
    // Documented in millimetres to two digits.
    EXPECT_LT((start_tip(problem) - Vector3d(0.64420, 0, 0.53297)).cwiseAbs().maxCoeff(), 5e-6);
    EXPECT_LT((problem.desired_tip(5) - Vector3d(0.6442, 0, 0.73297)).norm(), 1e-14);
    ASSERT_EQ(problem.obstacles.size(), 1U);
  }
  EXPECT_EQ(shipped("puma560_wall").problem.obstacles[0].shape.semi_axes(),
            Vector3d(0.0001, 0.1, 10));
}

TEST(Scenario, TheExampleOfTheDocumentationLoads) {
  std::ifstream stream(BQSA_SOURCE_DIR "/docs/scenario-format.md");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  const std::string fence = "```yaml\n";
  const std::size_t begin = page.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t end = page.find("```", begin + fence.size());
  const TestDirectory directory;
  const Problem problem =
      directory.load(page.substr(begin + fence.size(), end - begin - fence.size())).problem;
  EXPECT_EQ(problem.name, "two_links");
  EXPECT_LT((start_tip(problem) - problem.desired_tip(0)).norm(), 1e-15);
}

TEST(Scenario, Sha256IsThatOfTheFilesBytes) {
  const TestDirectory directory;
  EXPECT_EQ(directory.load(kPlanar).sha256,
            "d291dc21e3853d4d2112f3d7837c19132eb73a8a2f4e7359a93a5b4016554395");  // as sha256sum
                                                                                  // prints it
}

// Two links and a path along x at y = 1; what stands in the way moves.
std::string moving_scenario(const std::string& obstacle, const std::string& ticks = "10") {
  return "schema: bqsa-scenario/1\nname: s\nunits: {length: mm, angle: deg}\n"
         "robot: {kind: planar, links: [1000, 1000]}\nstart: [0, 90]\n"
         "task: {path: {kind: line, start_point: [1000, 1000], end_point: [500, 1000]},"
         " timing: {duration: 2, ticks: " +
         ticks + "}}\nobstacles: [{name: a, " + obstacle + "}]\n";
}

std::string moving_spatial_scenario(const std::string& obstacle) {
  return "schema: bqsa-scenario/1\nname: s\nunits: {length: mm, angle: deg}\n"
         "robot: {kind: dh, joints: [{a: 500, alpha: 90, d: 0}, {a: 500, alpha: 0, d: 0}]}\n"
         "start: [0, 0]\ntask: {path: {kind: line, start_point: [1000, 0, 0],"
         " end_point: [1000, 0, 0]}, timing: {duration: 2, ticks: 10}}\n"
         "obstacles: [{name: a, " +
         obstacle + "}]\n";
}

TEST(Scenario, ALinearMotionIsStraightAndTurnsEvenly) {
  const TestDirectory directory;
  const Obstacle planar =
      directory
          .load(moving_scenario("kind: ellipse, center: [-900, 50], semi_axes: [300, 20],"
                                " rotation: 20, motion: {kind: linear, velocity: [-30, 400],"
                                " angular_velocity: -90}"))
          .problem.obstacles[0];
  ASSERT_EQ(planar.motion.size(), 11U);
  EXPECT_EQ(planar.shape.unit_map(), planar.motion[0].unit_map());
  for (int tick = 0; tick <= 10; ++tick) {
    const double t = 0.2 * tick, angle = (20 - 90 * t) * kDegree;
    const Ellipsoid& shape = planar.at(tick);
    EXPECT_LT((shape.center() - Vector3d(-0.9 - 0.03 * t, 0.05 + 0.4 * t, 0)).norm(), 1e-15);
    EXPECT_LT((shape.rotation().col(0) - Vector3d(std::cos(angle), std::sin(angle), 0)).norm(),
              1e-14);
    EXPECT_EQ(shape.rotation().col(2), Vector3d::UnitZ());
    EXPECT_EQ(shape.semi_axes(), Vector3d(0.3, 0.02, 0.3));
  }
  const Obstacle spatial =
      directory
          .load(moving_spatial_scenario(
              "kind: ellipsoid, center: [0, 0, 900], semi_axes: [300, 20, 10], rpy: [10, 20, 30],"
              " motion: {kind: linear, velocity: [1, 2, 3], angular_velocity: [0, 30, -40]}"))
          .problem.obstacles[0];
  const Vector3d axis(0, 0.6, -0.8);
  for (int tick = 0; tick <= 10; ++tick) {
    const double t = 0.2 * tick, angle = 50 * kDegree * t;
    EXPECT_LT((spatial.at(tick).center() - Vector3d(1e-3 * t, 2e-3 * t, 0.9 + 3e-3 * t)).norm(),
              1e-15);
    for (int column = 0; column < 3; ++column) {
      // Rodrigues' formula.
      const Vector3d v = spatial.shape.rotation().col(column);
      const Vector3d turned = std::cos(angle) * v + std::sin(angle) * axis.cross(v) +
                              (1 - std::cos(angle)) * axis.dot(v) * axis;
      EXPECT_LT((spatial.at(tick).rotation().col(column) - turned).norm(), 1e-14) << tick;
    }
  }
}

TEST(Scenario, MotionWaypointsGiveThePoseAtEveryTick) {
  const TestDirectory directory;
  const std::string file = ", motion: {kind: waypoints, file: way.csv}";
  directory.write("way.csv", "t,x,y,angle\n0.5,-900,50,-10\n0.9,-800,50,30\n1.7,-800,250,-50\n");
  const Obstacle planar =
      directory
          .load(moving_scenario("kind: ellipse, center: [-900, 50], semi_axes: [300, 20]" + file))
          .problem.obstacles[0];
  ASSERT_EQ(planar.motion.size(), 11U);
  const double t_x_y_angle[][4] = {
      {0, -0.9, 0.05, -10}, {2, -0.9, 0.05, -10},  {3, -0.875, 0.05, 0}, {4, -0.825, 0.05, 20},
      {5, -0.8, 0.075, 20}, {8, -0.8, 0.225, -40}, {9, -0.8, 0.25, -50}, {10, -0.8, 0.25, -50}};
  for (const auto& [tick, x, y, angle] : t_x_y_angle) {
    const Ellipsoid& shape = planar.at(static_cast<int>(tick));
    EXPECT_LT((shape.center() - Vector3d(x, y, 0)).norm(), 1e-15) << tick;
    const double a = angle * kDegree;
    EXPECT_LT((shape.rotation().col(0) - Vector3d(std::cos(a), std::sin(a), 0)).norm(), 1e-14);
  }

  directory.write("way.csv", "t,x,y\n0,-900,50\n2,-900,150\n");
  const Obstacle unturned =
      directory
          .load(moving_scenario(
              "kind: ellipse, center: [-900, 50], semi_axes: [300, 20], rotation: 30" + file))
          .problem.obstacles[0];
  EXPECT_LT((unturned.at(5).center() - Vector3d(-0.9, 0.1, 0)).norm(), 1e-15);
  EXPECT_EQ(unturned.at(10).rotation(), unturned.shape.rotation());

  directory.write("way.csv", "t,x,y,z,r,p,y\n0,0,0,900,10,20,30\n2,0,0,800,50,40,-10\n");
  const Obstacle spatial = directory
                               .load(moving_spatial_scenario(
                                   "kind: ellipsoid, center: [0, 0, 900], semi_axes: [300, 20, 10],"
                                   " rpy: [10, 20, 30]" +
                                   file))
                               .problem.obstacles[0];
  const Problem halfway = directory
                              .load(moving_spatial_scenario(
                                  "kind: ellipsoid, center: [0, 0, 850], semi_axes: [300, 20, 10],"
                                  " rpy: [30, 30, 10]"))
                              .problem;
  EXPECT_LT((spatial.at(5).rotation() - halfway.obstacles[0].shape.rotation()).norm(), 1e-14);
  EXPECT_LT((spatial.at(5).center() - Vector3d(0, 0, 0.85)).norm(), 1e-15);
}

// The tip and the obstacle are compared where they are at one time, against samples of both.
TEST(Scenario, APathIsRefusedExactlyIfTheTipMeetsTheMovingObstacle) {
  const TestDirectory directory;
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto text_of = [](double number) { return std::to_string(number); };
  int met = 0, only_between = 0, clear = 0;
  for (int k = 0; k < 200; ++k) {
    // A ball of 20 mm that crosses the path near x = 750 mm, which the tip reaches after 1 s.
    const double x = 750 + 60 * uniform(random), crossing = 1 + 0.2 * uniform(random);
    const double speed = (k % 2 == 0 ? 1 : -1) * 2000;
    const std::string message = message_of(directory, [&] {
      directory.load(moving_scenario("kind: ellipse, semi_axes: [20, 20], center: [" + text_of(x) +
                                         ", " + text_of(1000 - crossing * speed) +
                                         "], motion: {kind: linear, velocity: [0, " +
                                         text_of(speed) + "]}",
                                     "11"));
    });
    const auto gap = [&](double t) {
      return std::hypot(1000 - 250 * t - x, (t - crossing) * speed) - 20;
    };
    double least = 1000, first = -1;
    for (int i = 0; i <= 200'000; ++i) {
      const double t = i * 1e-5;
      least = std::min(least, gap(t));
      if (first < 0 && gap(t) < 0) first = t;
    }
    if (std::abs(least) < 0.02) continue;
    if (least > 0) {
      ASSERT_EQ(message, "no error") << "case " << k;
      ++clear;
      continue;
    }
    ++met;
    const std::string expected =
        "s.yaml:6: task.path: expected a path free of obstacles, got one that enters obstacle a at "
        "t = ";
    ASSERT_EQ(message.substr(0, expected.size()), expected) << "case " << k;
    // Four digits are shown.
    ASSERT_NEAR(std::stod(message.substr(expected.size())), first, 5.2e-4) << "case " << k;
    bool at_tick = false;
    for (int tick = 0; tick <= 11; ++tick) at_tick = at_tick || gap(tick * 2.0 / 11) < 0;
    if (!at_tick) ++only_between;
  }
  EXPECT_GT(met, 25);
  EXPECT_GT(only_between, 15);
  EXPECT_GT(clear, 25);
}

// Against points all round the obstacle, of which many are long and thin and lie along or across the path.
TEST(Scenario, APathIsRefusedExactlyIfTheTipMeetsTheRestingObstacle) {
  const TestDirectory directory;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  int met = 0, clear = 0;
  for (int k = 0; k < 400; ++k) {
    const double radius = k % 2 == 0 ? 0 : 0.03;
    const double a = 0.01 + 0.6 * uniform(random);
    const double b = a * std::pow(10, -3 * uniform(random));
    const double turn = 180 * uniform(random);
    const double x = 0.2 + 1.6 * uniform(random);
    const double c = std::cos(turn * kDegree), s = std::sin(turn * kDegree);
    const double y = -(std::hypot(a * s, b * c) + radius) * (0.9 + 0.2 * uniform(random));
    double nearest = 1e9;
    bool crosses = false;
    constexpr int kAround = 20'000;
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      const double u = a * std::cos(angle), v = b * std::sin(angle);
      const double px = x + c * u - s * v, py = y + s * u + c * v;
      nearest = std::min(nearest, std::hypot(px - std::clamp(px, 0.0, 2.0), py));
      crosses = crosses || (py > 0 && px > 0 && px < 2);
    }
    const double gap = crosses ? -1 : nearest - radius;
    if (std::abs(gap) < 1e-3) continue;
    const std::string message = message_of(directory, [&] {
      directory.load(
          "schema: bqsa-scenario/1\nname: s\nunits: {length: m, angle: deg}\n"
          "robot: {kind: planar, links: [2, 2], link_radius: " +
          std::to_string(radius) +
          "}\nstart: [60, -120]\n"
          "task: {path: {kind: line, start_point: [2, 0], end_point: [0, 0]},"
          " timing: {duration: 2, ticks: 1}}\n"
          "obstacles: [{name: one, kind: ellipse, center: [" +
          std::to_string(x) + ", " + std::to_string(y) + "], semi_axes: [" + std::to_string(a) +
          ", " + std::to_string(b) + "], rotation: " + std::to_string(turn) + "}]\n");
    });
    if (message.find("a start free of collision") != std::string::npos) continue;
    ++(gap < 0 ? met : clear);
    const bool refused =
        message.find("expected a path free of obstacles, got one that enters obstacle one") !=
        std::string::npos;
    ASSERT_EQ(refused, gap < 0) << "case " << k << ": " << message;
    ASSERT_TRUE(refused || message == "no error") << "case " << k << ": " << message;
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(clear, 100);
}

TEST(Scenario, ASlowThinSheetIsMetByAFastTipBetweenTicks) {
  const TestDirectory directory;
  for (const char* x : {"530", "655", "700", "810", "960"}) {
    const std::string message = message_of(directory, [&] {
      directory.load(moving_scenario("kind: ellipse, center: [" + std::string(x) +
                                         ", 1000], semi_axes: [0.02, 10],"
                                         " motion: {kind: linear, velocity: [0, 0.001]}",
                                     "1"));
    });
    const std::string expected = "one that enters obstacle a at t = ";
    ASSERT_NE(message.find(expected), std::string::npos) << x << message;
    EXPECT_NEAR(std::stod(message.substr(message.find(expected) + expected.size())),
                (1000 - std::stod(x)) / 250, 1e-3);
  }
}

TEST(Scenario, APathThatKeepsTooNearToAMovingObstacleIsRefusedInsteadOfStalling) {
  const TestDirectory directory;
  // The ball goes along above the tip and touches it all the way; a hair higher it is clear.
  const auto load = [&directory](const std::string& height) {
    return message_of(directory, [&] {
      directory.load(moving_scenario("kind: ellipse, center: [1000, " + height +
                                     "], semi_axes: [100, 100],"
                                     " motion: {kind: linear, velocity: [-250, 0]}"));
    });
  };
  const std::string message = load("1100");
  EXPECT_TRUE(message.starts_with(
      "s.yaml:6: task.path: expected a path that 2097152 looks show to keep out of moving "
      "obstacles, got one that keeps too near to obstacle a for that, until t = "))
      << message;
  EXPECT_EQ(load("1100.02"), "no error");
}

// Two joints about -y and a hand that is turned, in URDF.
constexpr const char* kElbow =
    "<robot name='elbow'><link name='world'/><link name='upper'/><link name='lower'/>"
    "<link name='hand'/>"
    "<joint name='shoulder' type='revolute'><parent link='world'/><child link='upper'/>"
    "<origin xyz='0 0 0.5'/><axis xyz='0 -1 0'/>"
    "<limit lower='-2' upper='2' effort='1' velocity='1'/></joint>"
    "<joint name='elbow' type='revolute'><parent link='upper'/><child link='lower'/>"
    "<origin xyz='0.4 0 0'/><axis xyz='0 -1 0'/>"
    "<limit lower='-3' upper='3' effort='1' velocity='2'/></joint>"
    "<joint name='wrist' type='fixed'><parent link='lower'/><child link='hand'/>"
    "<origin xyz='0.3 0 0' rpy='0 0 1.5707963267948966'/></joint></robot>\n";

std::string urdf_scenario(const std::string& robot, const std::string& tip) {
  return "schema: bqsa-scenario/1\nname: s\nunits: {length: mm, angle: deg}\n"
         "robot: " +
         robot +
         "\nstart: [30, -60]\nstart_tolerance: 1\n"
         "task: {path: {kind: line, start_point: " +
         tip +
         ", end_point: [500, 0, 600]},"
         " timing: {duration: 2, ticks: 10}}\n";
}

TEST(Scenario, AnArmInUrdfStandsWhereItsFileSays) {
  const TestDirectory directory;
  directory.write("elbow.urdf", kElbow);
  const std::string text = urdf_scenario(
      "{kind: urdf, file: elbow.urdf, base_link: world, tip_link: hand, base: [0, 0, 100],"
      " tool: [0, -50, 0], link_radius: 20}",
      "[649.519, 0, 625]");
  const Scenario urdf = directory.load(text);
  EXPECT_EQ(urdf.sha256, sha256_of(text + kElbow));
  EXPECT_EQ(urdf.problem.chain.joints(), 2);
  EXPECT_EQ(urdf.problem.link_radius, 0.02);
  EXPECT_EQ(urdf.problem.limits.lower, (JointVector(2) << -2, -3).finished());
  EXPECT_EQ(urdf.problem.limits.max_velocity, (JointVector(2) << 1, 2).finished());
  EXPECT_LT((start_tip(urdf.problem) -
             Vector3d(0.35 * std::cos(30 * kDegree) + 0.4 * std::cos(30 * kDegree), 0,
                      0.6 + 0.4 * 0.5 - 0.35 * 0.5))
                .norm(),
            1e-15);
}

/// Values, limits and steps of a joint that slides are lengths, whatever the unit of angles.
TEST(Scenario, AJointThatSlidesIsGivenInLengths) {
  const TestDirectory directory;
  directory.write("slide.urdf", with(kElbow, "<joint name='elbow' type='revolute'>",
                                     "<joint name='elbow' type='prismatic'>"));
  const auto load = [&](const std::string& start, const std::string& tip) {
    return directory.load(
        with(urdf_scenario("{kind: urdf, file: slide.urdf, base_link: world, tip_link: hand}", tip),
             "start: [30, -60]", "start: " + start));
  };
  const Scenario scenario = load("[90, -100]", "[0, 100, 1200]");
  const Problem& problem = scenario.problem;
  EXPECT_TRUE(problem.chain.is_prismatic(1));
  EXPECT_DOUBLE_EQ(problem.start(0), 90 * kDegree);
  EXPECT_DOUBLE_EQ(problem.start(1), -0.1);
  EXPECT_EQ(problem.limits.upper, (JointVector(2) << 2, 3).finished());
  EXPECT_LT((start_tip(problem) - Vector3d(0, 0.1, 1.2)).norm(), 1e-15);
  const auto refusal = [&](const std::string& start, const std::string& tip) {
    return message_of(directory, [&] { load(start, tip); });
  };
  EXPECT_EQ(refusal("[90, 3001]", "[0, 0, 0]"),
            "s.yaml:5: start[1]: expected a length not above the limit 3000 mm, got 3001");
  EXPECT_EQ(refusal("[120, 0]", "[0, 0, 0]"),
            "s.yaml:5: start[0]: expected an angle not above the limit 114.592 deg, got 120");
  EXPECT_EQ(
      refusal("[90]", "[0, 0, 0]"),
      "s.yaml:5: start: expected a list of 2 angles and lengths, one a joint, got a list of 1");
  EXPECT_EQ(refusal("[90, 0]", "[0, 0, 4301]"),
            "s.yaml:7: task.path: expected a path within reach, 0 mm to 3700 mm from (0, 0, 500) "
            "mm, got (0, 0, 4301) mm, which is 3801 mm away");
}

TEST(Scenario, LinksMayHaveRadiiOfTheirOwn) {
  const TestDirectory directory;
  const auto load = [&](const std::string& radius) {
    return directory
        .load(
            "schema: bqsa-scenario/1\nname: s\nunits: {length: mm, angle: deg}\n"
            "robot: {kind: dh, joints: [{a: 0, alpha: 90, d: 0}, {a: 400, alpha: 0, d: 0}],"
            " tool: [0, 0, 50], link_radius: " +
            radius +
            "}\nstart: [0, 0]\ntask: {path: {kind: line, start_point: [400, -50, 0],"
            " end_point: [380, -50, 0]}, timing: {duration: 1, ticks: 1}}\n")
        .problem;
  };
  const Problem problem = load("[30, 20]");  // the first row has no length
  EXPECT_EQ(problem.link_radii, (std::vector<double>{0.03, 0.02}));
  EXPECT_EQ(problem.link_radius, 0.03);
  EXPECT_EQ(problem.radius_of(1), 0.02);
  EXPECT_EQ(load("30").radius_of(1), 0.03);
  const auto refusal = [&](const std::string& radius) {
    return message_of(directory, [&] { load(radius); });
  };
  EXPECT_EQ(
      refusal("[30, 20, 10]"),
      "s.yaml:4: robot.link_radius: expected a length, or a list of 2, one a link, got a list "
      "of 3");
  EXPECT_EQ(refusal("[30, -20]"),
            "s.yaml:4: robot.link_radius[1]: expected a length of 0 or more, got -20");
  EXPECT_EQ(refusal("capsules"),
            "s.yaml:4: robot.link_radius: expected capsules for a robot of kind urdf alone, got "
            "capsules");
  EXPECT_EQ(refusal("{}"), "s.yaml:4: robot.link_radius: expected a number, got a mapping");
}

/// The start is asked with the radius of each link, the path with that of the last.
TEST(Scenario, EachLinkNeedsTheRoomOfItsOwnRadius) {
  const TestDirectory directory;
  const auto load = [&](const std::string& radius) {
    return message_of(directory, [&] {
      directory.load(
          "schema: bqsa-scenario/1\nname: s\nunits: {length: m, angle: deg}\n"
          "robot: {kind: planar, links: [1, 1], link_radius: " +
          radius +
          "}\nstart: [0, 90]\ntask: {path: {kind: line, start_point: [1, 1], end_point: [0.5, 1]},"
          " timing: {duration: 1, ticks: 1}}\nobstacles:\n"
          "  - {name: below, kind: ellipse, center: [0.5, -0.2], semi_axes: [0.1, 0.1]}\n"
          "  - {name: above, kind: ellipse, center: [0.6, 1.2], semi_axes: [0.15, 0.15]}\n");
    });
  };
  EXPECT_EQ(load("[0.09, 0.04]"), "no error");
  EXPECT_EQ(load("[0.11, 0.04]"),
            "s.yaml:5: start: expected a start free of collision, got link 1, 0.01 m deep in "
            "obstacle below");
  EXPECT_TRUE(load("[0.04, 0.11]")
                  .starts_with("s.yaml:6: task.path: expected a path free of obstacles, got one "
                               "that enters obstacle above"));
}

TEST(Scenario, RadiiOfAnArmInUrdfMayComeFromItsFile) {
  const TestDirectory directory;
  const std::string ball =
      "<collision><origin xyz='0.2 0 0.1'/><geometry><sphere "
      "radius='0.05'/></geometry></collision>";
  const std::string mesh =
      "<collision><geometry><mesh filename='package://elbow/parts/hand.obj' scale='2 2 2'/>"
      "</geometry></collision>";
  const std::string urdf =
      with(with(kElbow, "<link name='upper'/>", "<link name='upper'>" + ball + "</link>"),
           "<link name='hand'/>", "<link name='hand'>" + mesh + "</link>");
  directory.write("elbow.urdf", urdf);
  std::filesystem::create_directory(directory.path() / "parts");
  const std::string points = "v 0 0 0.01\nv 0.01 0 0\nv 0 0.03 0\nf 1 2 3\n";
  directory.write("parts/hand.obj", points);
  const std::string text = urdf_scenario(
      "{kind: urdf, file: elbow.urdf, base_link: world, tip_link: hand, link_radius: capsules}",
      "[606.218, 0, 550]");
  const Scenario scenario = directory.load(text);
  ASSERT_EQ(scenario.problem.link_radii.size(), 3u);
  EXPECT_EQ(scenario.problem.link_radii[0], 0);
  EXPECT_DOUBLE_EQ(scenario.problem.link_radii[1], 0.15);
  EXPECT_NEAR(scenario.problem.link_radii[2], 0.02, 1e-8);  // (0.01, 0, 0) is across, twice
  EXPECT_EQ(scenario.problem.link_radius, scenario.problem.link_radii[1]);
  EXPECT_EQ(scenario.sha256, sha256_of(text + urdf + points));
  const auto refusal = [&] { return message_of(directory, [&] { directory.load(text); }); };
  std::filesystem::remove(directory.path() / "parts/hand.obj");
  EXPECT_TRUE(refusal().starts_with("elbow.urdf: ")) << refusal();
  EXPECT_TRUE(refusal().ends_with("parts/hand.obj: expected a file, got nothing there"))
      << refusal();
  directory.write("elbow.urdf", with(urdf, "package://elbow/parts", "file:///parts"));
  EXPECT_EQ(refusal(),
            "elbow.urdf: expected a mesh by package:// or a relative name, got "
            "'file:///parts/hand.obj'");
  directory.write("elbow.urdf", with(urdf, "package://elbow/parts", ".."));
  EXPECT_TRUE(
      refusal().ends_with("s.yaml:4: robot.file: expected a file in the scenario's directory "
                          "(unless --allow-outside is "
                          "given), got ../hand.obj"))
      << refusal();
}

TEST(Scenario, NamesTheRobotOfAnyKind) {
  const TestDirectory directory;
  EXPECT_EQ(directory.load(kPlanar).robot_name, "");
  const std::string named = with(kPlanar, "kind: planar", "kind: planar\n  name: Planar arm 3");
  EXPECT_EQ(directory.load(named).robot_name, "Planar arm 3");
  const std::string longest(100, 'x');
  for (const std::string kind : {"dh", "mdh"}) {
    EXPECT_EQ(directory
                  .load("schema: bqsa-scenario/1\nname: s\nunits: {length: mm, angle: deg}\n"
                        "robot: {kind: " +
                        kind + ", name: \"" + longest +
                        "\", joints: [{a: 0, alpha: 0, d: 0}], tool: [1000, 0, 0]}\n"
                        "start: [0]\ntask:\n"
                        "  path: {kind: circle, center: [0, 0, 0], radius: 1000, axis_u: [1, 0, 0],"
                        " axis_v: [0, 1, 0], from: 0, to: 9}\n"
                        "  timing: {duration: 1, ticks: 4}\n")
                  .robot_name,
              longest)
        << kind;
  }
}

TEST(Scenario, ARobotInUrdfHasTheNameOfItsFileUnlessItIsGivenAnother) {
  const TestDirectory directory;
  const auto name = [&directory](const std::string& in_file, const std::string& more) {
    directory.write("elbow.urdf",
                    with(kElbow, "robot name='elbow'", "robot name='" + in_file + "'"));
    const std::string robot =
        "{kind: urdf, file: elbow.urdf, base_link: world, tip_link: hand" + more + "}";
    return directory.load(urdf_scenario(robot, "[606.218, 0, 550]")).robot_name;
  };
  EXPECT_EQ(name("Elbow, left", ""), "Elbow, left");
  EXPECT_EQ(name("elbow", ", name: Arm 7"), "Arm 7");
  EXPECT_EQ(name(std::string(100, 'y'), ""), std::string(100, 'y'));
  EXPECT_EQ(name(std::string(101, 'y'), ""), "");  // what no scenario could call it
  EXPECT_EQ(name("  ", ""), "");
}

TEST(Scenario, WhatIsWrongWithAUrdfFileIsSaidWithItsName) {
  const TestDirectory directory;
  directory.write("elbow.urdf", kElbow);
  const auto refusal = [&](const std::string& robot) {
    return message_of(directory, [&] { directory.load(urdf_scenario(robot, "[0, 0, 0]")); });
  };
  EXPECT_EQ(refusal("{kind: urdf, file: elbow.urdf, base_link: world, tip_link: foot}"),
            "elbow.urdf: expected one of the robot's links, got 'foot'; there are 'hand', 'lower', "
            "'upper', 'world'");
  EXPECT_TRUE(refusal("{kind: urdf, file: none.urdf, base_link: world, tip_link: hand}")
                  .starts_with("none.urdf: "));
  EXPECT_EQ(refusal("{kind: urdf, file: ../elbow.urdf, base_link: world, tip_link: hand}"),
            "s.yaml:4: robot.file: expected a file in the scenario's directory (unless "
            "--allow-outside is given), got ../elbow.urdf");
  EXPECT_EQ(refusal("{kind: urdf, file: elbow.urdf, base_link: world}"),
            "s.yaml:4: robot.tip_link: expected the name of a link, got nothing");
  EXPECT_EQ(refusal("{kind: urdf, file: elbow.urdf, base_link: world, tip_link: hand, limits: "
                    "{lower: [0, 0]}}"),
            "s.yaml:4: robot.limits: expected a known key, the nearest being kind, got limits");
  const std::string elbow = "{kind: urdf, file: elbow.urdf, base_link: world, tip_link: hand";
  for (const std::string key : {"base", "rpy", "tool", "tool_rpy"}) {
    EXPECT_TRUE(refusal(elbow + ", " + key + ": [0, 0]}")
                    .starts_with("s.yaml:4: robot." + key + ": expected"))
        << refusal(elbow + ", " + key + ": [0, 0]}");
  }
}

TEST(Scenario, Sha256CountsTheFilesThatAScenarioNames) {
  const TestDirectory directory;
  directory.write("way.csv", "t,x,y\n0,-900,50\n2,-900,150\n");
  const std::string scenario = moving_scenario(
      "kind: ellipse, center: [-900, 50], semi_axes: [300, 20], motion: {kind: waypoints, file: "
      "way.csv}");
  const std::string path =
      with(scenario, "{kind: line, start_point: [1000, 1000], end_point: [500, 1000]}",
           "{kind: waypoints, file: path.csv}");
  directory.write("path.csv", "t,x,y\n0,1000,1000\n2,500,1000\n");
  // As `cat s.yaml way.csv | sha256sum` and `cat s.yaml path.csv way.csv | sha256sum` print it.
  EXPECT_EQ(directory.load(scenario).sha256,
            "b95d85b144f9b36dd669701c5705b42b32343c868922b4573c57e187f09f3dfe");
  EXPECT_EQ(directory.load(path).sha256,
            "d50b41ac5fa0541827a7ab1a5651261ca523e747572b25e05d168d0e5c173e08");
  directory.write("way.csv", "t,x,y\n0,-900,50\n2,-900,151\n");
  EXPECT_NE(directory.load(path).sha256,
            "d50b41ac5fa0541827a7ab1a5651261ca523e747572b25e05d168d0e5c173e08");
}

TEST(Scenario, AStartThatTouchesIsFree) {
  const TestDirectory directory;
  const auto load = [&directory](const std::string& height) {
    return message_of(directory, [&] {
      directory.load(
          "schema: bqsa-scenario/1\nname: s\nunits: {length: m, angle: deg}\n"
          "robot: {kind: planar, links: [1, 1]}\nstart: [0, 90]\n"
          "task: {path: {kind: line, start_point: [1, 1], end_point: [1, 0.9]},"
          " timing: {duration: 1, ticks: 1}}\n"
          "obstacles: [{name: a, kind: ellipse, center: [0.5, " +
          height + "], semi_axes: [0.25, 0.125]}]\n");
    });
  };
  EXPECT_EQ(load("0.125"), "no error");
  EXPECT_EQ(load("0.1249995"), "no error");
  EXPECT_EQ(load("0.124998"),
            "s.yaml:5: start: expected a start free of collision, got link 1, 2e-06 m deep in "
            "obstacle a");
}

// The path is 2 m long and has 1 tick: nothing but the continuous test can see the sheet.
TEST(Scenario, AStartMayBeAsNearAsTheMarginAndNoNearer) {
  const TestDirectory directory;
  const std::string text = R"(schema: bqsa-scenario/1
name: near
units: {length: m, angle: deg}
robot: {kind: planar, links: [1], link_radius: 0.02}
start: [0]
task:
  path: {kind: circle, center: [0, 0], radius: 1, axis_u: [1, 0], axis_v: [0, -1], from: 0, to: 30}
  timing: {duration: 1, ticks: 10}
obstacles:
  - {name: stone, kind: ellipse, center: [0.5, 0.27], semi_axes: [0.2, 0.2]}
margin: MARGIN
)";
  EXPECT_NO_THROW(directory.load(with(text, "MARGIN", "0.05")));
  EXPECT_NO_THROW(directory.load(with(text, "MARGIN", "0.0500009")));
  EXPECT_EQ(
      message_of(directory, [&] { directory.load(with(text, "MARGIN", "0.051")); }),
      "s.yaml:5: start: expected a start that keeps the margin of 0.051 m, got link 1, 0.05 m from "
      "obstacle stone");
}

TEST(Scenario, ACircleAtTheEdgeOfReachIsWithinIt) {
  const TestDirectory directory;
  const std::string text = R"(schema: bqsa-scenario/1
name: edge
units: {length: m, angle: deg}
robot: {kind: planar, links: [1]}
start: [0]
task:
  path: {kind: circle, center: [0, 0], radius: 1, axis_u: [1, 0], axis_v: [0, 1], from: 0, to: 360}
  timing: {duration: 1, ticks: 100}
)";
  EXPECT_NO_THROW(directory.load(text));
  const std::string message = message_of(
      directory, [&] { directory.load(with(text, "radius: 1,", "radius: 0.9999998,")); });
  EXPECT_TRUE(message.starts_with("s.yaml:7: task.path: expected a path within reach, 1 m to 1 m"))
      << message;
  EXPECT_NE(message.find("which is 0.9999997"), std::string::npos) << message;  // of the chord
}

TEST(Scenario, APathThroughAThinSheetIsRefusedWhereverItStands) {
  const TestDirectory directory;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.05, 1.9);
  int cases = 0;
  for (; cases < 100; ++cases) {
    const double x = uniform(random);
    const std::string message = message_of(directory, [&] {
      directory.load(
          "schema: bqsa-scenario/1\nname: s\nunits: {length: m, angle: deg}\n"
          "robot: {kind: planar, links: [2, 2]}\nstart: [60, -120]\n"
          "task: {path: {kind: line, start_point: [2, 0], end_point: [0, 0]},"
          " timing: {duration: 2, ticks: 1}}\n"
          "obstacles: [{name: sheet, kind: ellipse, center: [" +
          std::to_string(x) + ", 0], semi_axes: [0.00001, 0.02]}]\n");
    });
    ASSERT_TRUE(
        message.starts_with("s.yaml:6: task.path: expected a path free of obstacles, got "
                            "one that enters obstacle sheet at t = "))
        << "case " << cases << ": " << message;
    EXPECT_NEAR(std::stod(message.substr(message.rfind('=') + 1)), 2 - x, 1e-3) << "case " << cases;
  }
  EXPECT_EQ(cases, 100);
}

}  // namespace
}  // namespace bqsa::harness
