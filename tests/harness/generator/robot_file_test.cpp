// The published robots against their known poses and against products of exponentials.
#include "harness/generator/robot_file.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "../scenario/scenario_files.hpp"
#include "harness/generator/arm.hpp"
#include "support/sampling.hpp"

namespace bqsa::harness {
namespace {

const std::filesystem::path kRobots = BQSA_SOURCE_DIR "/robots";
constexpr double kDegree = std::numbers::pi / 180;

Eigen::Vector3d tip_of(const SerialChain& chain, const JointVector& q) {
  ChainPose pose;
  chain.forward(q, pose);
  return pose.tip();
}

/// An axis of a joint at q = 0.
struct Axis {
  Eigen::Vector3d direction;
  Eigen::Vector3d point;
};

/// The flange by the product of exponentials: turns about the axes at q = 0, last joint first.
Eigen::Vector3d by_exponentials(const std::vector<Axis>& axes, const Eigen::Vector3d& flange,
                                const JointVector& q) {
  Eigen::Vector3d p = flange;
  for (std::size_t j = axes.size(); j-- > 0;) {
    const Eigen::AngleAxisd turn(q(static_cast<Eigen::Index>(j)), axes[j].direction);
    p = axes[j].point + turn * (p - axes[j].point);
  }
  return p;
}

const Eigen::Vector3d kY = Eigen::Vector3d::UnitY();
const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();

struct PublishedRobot {
  const char* file;
  std::vector<Axis> axes;      ///< at q = 0
  Eigen::Vector3d flange;      ///< at q = 0 [m]
  std::vector<double> lower;   ///< [rad]
  std::vector<double> upper;   ///< [rad]
  std::vector<double> speeds;  ///< [rad/s]; empty if unknown
  int joints() const { return static_cast<int>(axes.size()); }
};

void PrintTo(const PublishedRobot& robot, std::ostream* out) { *out << robot.file; }

std::vector<double> in_radians(std::vector<double> degrees) {
  for (double& angle : degrees) angle *= kDegree;
  return degrees;
}

PublishedRobot iiwa() {
  return {"kuka_lbr_iiwa14.yaml",
          {{kZ, {0, 0, 0}},
           {kY, {0, 0, 0.36}},
           {kZ, {0, 0, 0}},
           {-kY, {0, 0, 0.78}},
           {kZ, {0, 0, 0}},
           {kY, {0, 0, 1.18}},
           {kZ, {0, 0, 0}}},
          {0, 0, 1.306},
          in_radians({-170, -120, -170, -120, -170, -120, -175}),
          in_radians({170, 120, 170, 120, 170, 120, 175}),
          in_radians({85, 85, 100, 75, 130, 135, 135})};
}

PublishedRobot panda() {
  return {"franka_panda.yaml",
          {{kZ, {0, 0, 0}},
           {kY, {0, 0, 0.333}},
           {kZ, {0, 0, 0}},
           {-kY, {0.0825, 0, 0.649}},
           {kZ, {0, 0, 0}},
           {-kY, {0, 0, 1.033}},
           {-kZ, {0.088, 0, 0}}},
          {0.088, 0, 0.926},
          {-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973},
          {2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973},
          {2.1750, 2.1750, 2.1750, 2.1750, 2.6100, 2.6100, 2.6100}};
}

PublishedRobot ur5e() {
  return {"ur5e.yaml",
          {{kZ, {0, 0, 0}},
           {-kY, {0, 0, 0.1625}},
           {-kY, {-0.425, 0, 0.1625}},
           {-kY, {-0.8172, 0, 0.1625}},
           {-kZ, {-0.8172, -0.1333, 0}},
           {-kY, {-0.8172, 0, 0.0628}}},
          {-0.8172, -0.2329, 0.0628},
          in_radians({-360, -360, -360, -360, -360, -360}),
          in_radians({360, 360, 360, 360, 360, 360}),
          in_radians({180, 180, 180, 180, 180, 180})};
}

PublishedRobot ur10e() {
  return {"ur10e.yaml",
          {{kZ, {0, 0, 0}},
           {-kY, {0, 0, 0.1807}},
           {-kY, {-0.6127, 0, 0.1807}},
           {-kY, {-1.18425, 0, 0.1807}},
           {-kZ, {-1.18425, -0.17415, 0}},
           {-kY, {-1.18425, 0, 0.06085}}},
          {-1.18425, -0.2907, 0.06085},
          in_radians({-360, -360, -360, -360, -360, -360}),
          in_radians({360, 360, 360, 360, 360, 360}),
          in_radians({120, 120, 180, 180, 180, 180})};
}

PublishedRobot puma560() {
  return {"puma560.yaml",
          {{kZ, {0, 0, 0}},
           {-kY, {0, 0, 0}},
           {-kY, {0.4318, 0, 0}},
           {kZ, {0.4521, -0.15005, 0}},
           {-kY, {0.4521, 0, 0.4318}},
           {kZ, {0.4521, -0.15005, 0}}},
          {0.4521, -0.15005, 0.4318},
          in_radians({-160, -45, -225, -110, -100, -266}),
          in_radians({160, 225, 45, 170, 100, 266}),
          {}};
}

class PublishedRobots : public ::testing::TestWithParam<PublishedRobot> {};

TEST_P(PublishedRobots, StandAtZeroAsPublished) {
  const RobotFile file = load_robot(kRobots / GetParam().file);
  EXPECT_EQ(file.name + ".yaml", GetParam().file);
  EXPECT_FALSE(file.source.empty());
  const Eigen::Vector3d flange = tip_of(file.robot.chain, JointVector::Zero(GetParam().joints()));
  EXPECT_LT((flange - GetParam().flange).norm(), 1e-12) << flange.transpose();
}

TEST_P(PublishedRobots, MoveAsTheProductOfExponentials) {
  const RobotFile file = load_robot(kRobots / GetParam().file);
  test_support::Generator generator(1);
  for (int i = 0; i < 1000; ++i) {
    const JointVector q = JointVector::NullaryExpr(
        GetParam().joints(), [&](Eigen::Index) { return test_support::uniform(generator, -3, 3); });
    const Eigen::Vector3d expected = by_exponentials(GetParam().axes, GetParam().flange, q);
    EXPECT_LT((tip_of(file.robot.chain, q) - expected).norm(), 1e-12) << i;
  }
}

TEST_P(PublishedRobots, HaveThePublishedLimits) {
  const JointLimits limits = load_robot(kRobots / GetParam().file).robot.limits;
  const auto expect = [](const JointVector& got, const std::vector<double>& published) {
    ASSERT_EQ(static_cast<std::size_t>(got.size()), published.size());
    for (std::size_t j = 0; j < published.size(); ++j) {
      EXPECT_DOUBLE_EQ(got(static_cast<Eigen::Index>(j)), published[j]) << j;
    }
  };
  expect(limits.lower, GetParam().lower);
  expect(limits.upper, GetParam().upper);
  expect(limits.max_velocity, GetParam().speeds);
}

std::string tested_name(const testing::TestParamInfo<PublishedRobot>& tested) {
  return std::filesystem::path(tested.param.file).stem().string();
}

INSTANTIATE_TEST_SUITE_P(Robots, PublishedRobots,
                         ::testing::Values(iiwa(), panda(), ur5e(), ur10e(), puma560()),
                         tested_name);

/// Index into spatial_arms().
class GeneratorsArms : public ::testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Arms, GeneratorsArms, ::testing::Values(0U, 1U));

TEST_P(GeneratorsArms, ReachAsFarAsTheGeneratorSays) {
  const Arm arm = spatial_arms(kRobots).at(GetParam());
  const SerialChain chain(arm.chain);
  const auto distance = [&](const JointVector& q) {
    return (tip_of(chain, q) - arm.center).norm();
  };
  // Coordinate search from random starts within the limits.
  test_support::Generator generator(2);
  double farthest = 0;
  for (int start = 0; start < 30; ++start) {
    JointVector q = JointVector::NullaryExpr(7, [&](Eigen::Index j) {
      return test_support::uniform(generator, arm.limits.lower(j), arm.limits.upper(j));
    });
    for (double step = 0.5; step > 1e-8;) {
      bool better = false;
      for (Eigen::Index j = 0; j < 7; ++j) {
        for (const double turn : {-step, step}) {
          JointVector next = q;
          next(j) = std::clamp(q(j) + turn, arm.limits.lower(j), arm.limits.upper(j));
          if (distance(next) <= distance(q)) continue;
          q = next;
          better = true;
        }
      }
      if (!better) step /= 2;
    }
    farthest = std::max(farthest, distance(q));
  }
  EXPECT_NEAR(arm.reach, farthest, 1e-6);
}

TEST_P(GeneratorsArms, BeginWithinTheirLimits) {
  const Arm arm = spatial_arms(kRobots).at(GetParam());
  for (Eigen::Index j = 0; j < 7; ++j) {
    EXPECT_LE(arm.limits.lower(j), arm.start_low(j));
    EXPECT_LE(arm.start_low(j), arm.start_high(j));
    EXPECT_LE(arm.start_high(j), arm.limits.upper(j));
  }
}

const std::string kSmall =
    "schema: bqsa-robot/1\n"
    "name: small\n"
    "description: one link\n"
    "source: none\n"
    "units: {length: m, angle: deg}\n"
    "robot: {kind: planar, links: [1]}\n";

TEST(RobotFile, RefusesWhatItIsNot) {
  const TestDirectory directory;
  const auto message = [&directory](const std::string& text) {
    return message_of(directory, [&] { load_robot(directory.write("r.yaml", text)); });
  };
  EXPECT_EQ(message(kSmall), "no error");
  EXPECT_EQ(message(with(kSmall, "robot/1", "robot/2")),
            "r.yaml:1: schema: expected bqsa-robot/1, got bqsa-robot/2");
  EXPECT_EQ(message(with(kSmall, "source: none\n", "")),
            "r.yaml:1: source: expected the publication of the figures, got nothing");
  EXPECT_EQ(message(with(kSmall, "source", "sources")),
            "r.yaml:4: sources: expected a known key, the nearest being source, got sources");
  EXPECT_EQ(message(with(kSmall, "[1]", "[-1]")),
            "r.yaml:6: robot.links[0]: expected a positive length, got -1");
}

TEST(RobotFile, SpatialFamiliesRefuseOtherArms) {
  const TestDirectory directory;
  directory.write("kuka_lbr_iiwa14.yaml", kSmall);
  EXPECT_EQ(message_of(directory, [&] { spatial_arms(directory.path()); }),
            "kuka_lbr_iiwa14.yaml: robot: expected a spatial arm of 7 joints with all limits, its "
            "base at the origin and upright, links without radius, got another one");
  std::filesystem::remove(directory.path() / "kuka_lbr_iiwa14.yaml");
  EXPECT_EQ(message_of(directory, [&] { spatial_arms(directory.path()); }),
            "kuka_lbr_iiwa14.yaml: expected a file, got nothing there");
}

}  // namespace
}  // namespace bqsa::harness
