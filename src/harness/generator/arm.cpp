#include "harness/generator/arm.hpp"

#include <fmt/format.h>

#include <array>

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

}  // namespace bqsa::harness
