/// @file
/// Random arms of joints that turn and joints that slide.
#pragma once

#include "bqsa/kinematics/chain_description.hpp"
#include "support/sampling.hpp"

namespace bqsa::test_support {

/// Any axes; every second or third joint slides. Some links have no length but what a slide gives.
inline ChainDescription random_prismatic_arm(Generator& generator, int joints) {
  ChainDescription arm;
  for (int j = 0; j < joints; ++j) {
    const bool offset = generator() % 4 != 0;
    arm.placements.push_back(
        {.R_PJ = random_rotation<3>(generator),
         .p_PJ = offset ? random_vector<3>(generator, 0.3) : Eigen::Vector3d::Zero(),
         .type = (static_cast<unsigned>(j) + generator() % 2) % 2 == 0 ? JointType::kPrismatic
                                                                       : JointType::kRevolute});
  }
  arm.placements.front().type = JointType::kRevolute;
  arm.placements.back().type = JointType::kPrismatic;
  arm.p_LT << 0.1, 0, 0.1;
  return arm;
}

/// Turns about the origin and slides along its own x: where the slide goes through 0 while the arm
/// turns, the end of it makes a parabola. A link of 0.3 m along z stands there.
inline ChainDescription swinging_slide() {
  ChainDescription arm;
  arm.placements.push_back({});
  Eigen::Matrix3d along_x;
  along_x << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // its z is x, its y is z
  arm.placements.push_back({.R_PJ = along_x, .type = JointType::kPrismatic});
  arm.p_LT << 0, 0.3, 0;
  return arm;
}

}  // namespace bqsa::test_support
