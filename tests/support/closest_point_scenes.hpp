/// @file
/// Random arms among random obstacles, for the searches for closest points.
#pragma once

#include "bqsa/problem.hpp"
#include "support/random_scenes.hpp"

namespace bqsa::test_support {

/// A planar or spatial arm of seven joints among 1 to 8 ellipsoids of 5 to 40 cm, on the move every
/// third time, without path; the links have a radius every second time, and every fourth time
/// not all the same.
inline Problem random_closest_point_scene(Generator& generator, int trial) {
  const bool planar = trial % 2 == 0;
  Problem problem{.name = "scene",
                  .chain = planar ? planar_7r().chain : SerialChain(seven_joint_arm()),
                  .ticks = 4,
                  .dt = 0.02};
  problem.start = random_vector<7>(generator, 1.5);
  problem.link_radius = trial / 2 % 2 == 0 ? 0 : 0.02;
  for (std::size_t i = 0; trial % 8 > 5 && i < problem.chain.links().size(); ++i) {
    problem.link_radii.push_back(i % 3 == 0 ? 0.02 : 0.005 * static_cast<double>(i % 3));
  }
  const int count = 1 + trial % 8;
  for (int j = 0; j < count; ++j) {
    Ellipsoid shape = random_ellipsoid<3>(generator, 0.05, 0.4, 1.5);
    if (planar) {
      shape = embedded(rotated_ellipse(shape.center().head<2>(), shape.semi_axes().head<2>(),
                                       uniform(generator, -3, 3)));
    }
    Obstacle obstacle{"obstacle", shape};
    for (int tick = 0; trial % 3 == 0 && tick <= problem.ticks; ++tick) {
      const Eigen::AngleAxisd turn(0.1 * tick, Eigen::Vector3d::UnitZ());
      obstacle.motion.emplace_back(shape.center() + tick * Eigen::Vector3d(0.05, -0.03, 0),
                                   shape.semi_axes(), turn * shape.rotation());
    }
    problem.obstacles.push_back(obstacle);
  }
  return problem;
}

}  // namespace bqsa::test_support
