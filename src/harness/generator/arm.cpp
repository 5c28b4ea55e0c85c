#include "harness/generator/arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "harness/generator/robot_file.hpp"
#include "harness/generator/scenario_draft.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {
namespace {

constexpr int kSpatialJoints = 7;

/// What the generator adds to a robot file.
struct SpatialArm {
  const char* file;
  double reach;  ///< of the flange from the point where the axes of joints 1 and 2 meet [m]
  std::array<double, kSpatialJoints> start_low, start_high;  ///< [rad]
};

/// Joint 7 does not move the tip and begins at 0. The elbow is well bent, the hand turned down.
constexpr std::array<SpatialArm, 2> kSpatialArms = {{
    {.file = "kuka_lbr_iiwa14.yaml",
     .reach = 0.946,
     .start_low = {-1, -0.3, -0.8, -2, -1, 0.5, 0},
     .start_high = {1, 1, 0.8, -0.8, 1, 1.7, 0}},
    {.file = "franka_panda.yaml",
     .reach = 0.857893,
     .start_low = {-1, -0.3, -0.8, -2.3, -1, 1, 0},
     .start_high = {1, 1, 0.8, -1, 1, 2.5, 0}},
}};

/// Refuses what a generated scenario does not write.
void check(const Robot& robot, const std::filesystem::path& file) {
  const ChainDescription& chain = robot.chain.description();
  const JointLimits& limits = robot.limits;
  const auto complete = [](const JointVector& numbers) {
    return numbers.size() == kSpatialJoints && numbers.allFinite();
  };
  const bool good = chain.dimension == 3 && chain.rows.size() == kSpatialJoints &&
                    chain.p_WB.isZero(0) && chain.R_WB.isIdentity(0) && complete(limits.lower) &&
                    complete(limits.upper) && complete(limits.max_velocity) &&
                    robot.link_radius == 0;
  if (good) return;
  throw InputError(
      fmt::format("{}: robot: expected a spatial arm of {} joints with all limits, its base at the "
                  "origin and upright, links without radius, got another one",
                  file.string(), kSpatialJoints));
}

constexpr double kAssumedSpeed = 1.570796;  // of joints whose speed no publication gives [rad/s]

/// What the generator adds to a robot file to make a real arm.
struct RealArm {
  const char* file;
  double shoulder;                 ///< height of the point that no joint moves [m]
  double reach;                    ///< of the gripper's tip from there, within the limits [m]
  std::vector<double> link_radii;  ///< nominal, of each link, the gripper's last [m]
  std::vector<double> start_low, start_high;  ///< [rad]
};

/// The elbow is well bent. Joints that do not move the tip begin at 0.
const std::vector<RealArm>& real_arm_table() {
  static const std::vector<RealArm> kArms = {
      {.file = "kuka_lbr_iiwa14.yaml",
       .shoulder = 0.360,
       .reach = 1.096,
       .link_radii = {0.07, 0.07, 0.07, 0.05},
       .start_low = {-1, -0.3, -0.8, -2, -1, 0.5, 0},
       .start_high = {1, 1, 0.8, -0.8, 1, 1.7, 0}},
      {.file = "franka_panda.yaml",
       .shoulder = 0.333,
       .reach = 0.991003,
       .link_radii = {0.06, 0.06, 0.06, 0.06, 0.05, 0.05},
       .start_low = {-1, -0.3, -0.8, -2.3, -1, 1, 0},
       .start_high = {1, 1, 0.8, -1, 1, 2.5, 0}},
      {.file = "ur5e.yaml",
       .shoulder = 0.1625,
       .reach = 1.096776,
       .link_radii = {0.06, 0.055, 0.05, 0.04, 0.04, 0.04, 0.04},
       .start_low = {-1, -2, 0.8, -2.2, -2, 0},
       .start_high = {1, -1, 2, -0.8, -1, 0}},
      {.file = "ur10e.yaml",
       .shoulder = 0.1807,
       .reach = 1.489241,
       .link_radii = {0.08, 0.07, 0.06, 0.05, 0.05, 0.05, 0.05},
       .start_low = {-1, -2, 0.8, -2.2, -2, 0},
       .start_high = {1, -1, 2, -0.8, -1, 0}},
      {.file = "puma560.yaml",
       .shoulder = 0,
       .reach = 1.027009,
       .link_radii = {0.08, 0.07, 0.07, 0.05},
       .start_low = {-1, 0.9, -3.4, -1, -1, 0},
       .start_high = {1, 1.5, -2.6, 1, 1, 0}},
  };
  return kArms;
}

JointVector joint_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

Arm real_arm(const RealArm& arm, const std::filesystem::path& file) {
  const Robot robot = load_robot(file).robot;
  ChainDescription chain = robot.chain.description();
  const auto joints = static_cast<Eigen::Index>(arm.start_low.size());
  const auto complete = [joints](const JointVector& numbers) {
    return numbers.size() == joints && numbers.allFinite();
  };
  JointLimits limits = robot.limits;
  if (limits.max_velocity.size() == 0) {
    limits.max_velocity = JointVector::Constant(joints, kAssumedSpeed);
  }
  chain.p_LT.z() += kGripper;
  const bool good = chain.dimension == 3 && !chain.is_placed() && robot.chain.joints() == joints &&
                    chain.p_WB.isZero(0) && chain.R_WB.isIdentity(0) && complete(limits.lower) &&
                    complete(limits.upper) && complete(limits.max_velocity) &&
                    SerialChain(chain).links().size() == arm.link_radii.size();
  if (!good) {
    throw InputError(fmt::format(
        "{}: robot: expected the spatial arm of {} joints and {} links, gripper included, with "
        "limits of all angles, its base at the origin and upright, got another one",
        file.string(), joints, arm.link_radii.size()));
  }
  return {.chain = chain,
          .limits = limits,
          .center = {0, 0, arm.shoulder},
          .reach = arm.reach,
          .link_radii = arm.link_radii,
          .start_low = joint_vector(arm.start_low),
          .start_high = joint_vector(arm.start_high),
          .name = robot.name};
}

}  // namespace

Arm planar_arm(int links) {
  constexpr double kFirstJoint = 1.5;   // [rad]
  constexpr double kOtherJoints = 0.8;  // [rad]
  const double length = rounded(kPlanarReach / links);
  Arm arm{.chain = planar_chain(std::vector<double>(static_cast<std::size_t>(links), length)),
          .limits = {.lower = {},
                     .upper = {},
                     .max_velocity = JointVector::Constant(links, kPlanarSpeed)},
          .reach = links * length};
  arm.start_high = JointVector::Constant(links, kOtherJoints);
  arm.start_high(0) = kFirstJoint;
  arm.start_low = -arm.start_high;
  return arm;
}

std::vector<Arm> spatial_arms(const std::filesystem::path& robots) {
  std::vector<Arm> arms;
  for (const SpatialArm& arm : kSpatialArms) {
    const std::filesystem::path file = robots / arm.file;
    const Robot robot = load_robot(file).robot;
    check(robot, file);
    const ChainDescription& chain = robot.chain.description();
    arms.push_back({.chain = chain,
                    .limits = robot.limits,
                    .center = {0, 0, chain.rows.front().d},
                    .reach = arm.reach,
                    .start_low = Eigen::Map<const Eigen::VectorXd>(arm.start_low.data(), 7),
                    .start_high = Eigen::Map<const Eigen::VectorXd>(arm.start_high.data(), 7)});
  }
  return arms;
}

std::vector<Arm> real_arms(const std::filesystem::path& robots) {
  std::vector<Arm> arms;
  for (const RealArm& arm : real_arm_table()) arms.push_back(real_arm(arm, robots / arm.file));
  return arms;
}

Arm random_arm(RandomStream& random) {
  constexpr double kQuarter = 1.5707963267948966;  // [rad]
  constexpr double kBent = 0.5;                    // least angle of a joint at the start [rad]
  constexpr double kWide = 1.5;                    // largest [rad]
  constexpr double kLimit = 2.9;                   // [rad]
  const int joints = random.whole(6, 8);
  const double length = random.uniform(0.9, 1.4);

  // Joint 1 turns about the vertical; the last link ends in the tip.
  std::vector<double> parts(static_cast<std::size_t>(joints));
  for (double& part : parts) part = random.uniform(0.5, 1.5);
  const double whole = std::accumulate(parts.begin(), parts.end(), 0.0);
  Arm arm;
  arm.limits = {.lower = JointVector::Constant(joints, -kLimit),
                .upper = JointVector::Constant(joints, kLimit),
                .max_velocity = JointVector(joints)};
  arm.start_low = JointVector(joints);
  arm.start_high = JointVector(joints);
  for (int j = 0; j < joints; ++j) {
    const double link = rounded(length * parts[static_cast<std::size_t>(j)] / whole);
    const bool along = j == 0 || random.chance(0.5);  // the joint's axis
    const bool turned = j == 0 || along || random.chance(0.5);
    const double alpha = turned ? (random.chance(0.5) ? kQuarter : -kQuarter) : 0;
    arm.chain.rows.push_back(
        {.a = along ? 0 : link, .alpha = alpha, .d = along ? link : 0, .offset = 0});
    arm.limits.max_velocity(j) = rounded(random.uniform(1.5, 2.5));
    const double side = random.chance(0.5) ? 1 : -1;
    arm.start_low(j) = j == 0 ? -1 : std::min(side * kBent, side * kWide);
    arm.start_high(j) = j == 0 ? 1 : std::max(side * kBent, side * kWide);
    arm.reach += j == 0 ? 0 : link;
  }
  arm.center = {0, 0, arm.chain.rows.front().d};
  for (std::size_t link = 0; link < SerialChain(arm.chain).links().size(); ++link) {
    arm.link_radii.push_back(rounded(random.uniform(0.03, 0.06)));
  }
  return arm;
}

}  // namespace bqsa::harness
