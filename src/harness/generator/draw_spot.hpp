/// @file
/// Random places on the links of an arm that tracks its path without avoidance.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "harness/generator/nominal_motion.hpp"
#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {

struct Spot {
  int tick = 0;
  std::size_t link = 0;                                 ///< of SerialChain::links
  Eigen::Vector3d point = Eigen::Vector3d::Zero();      ///< on the link [m]
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();     ///< unit vector along the link
  Eigen::Vector3d sideways = Eigen::Vector3d::UnitX();  ///< random unit vector orthogonal to it
};

/// At a tick from first_tick to last_tick, at 10 to 90 % of a link of number first_link and more.
Spot draw_spot(const NominalMotion& nominal, int first_tick, int last_tick, int first_link,
               RandomStream& random);

/// On an outer link in the middle half of the motion.
Spot draw_middle_spot(const NominalMotion& nominal, RandomStream& random);

}  // namespace bqsa::harness
