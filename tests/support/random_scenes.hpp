/// @file
/// Random spatial problems in which plain tracking would hit.
#pragma once

#include "bqsa/bqsa_spatial.hpp"
#include "support/paper_problems.hpp"
#include "support/replay.hpp"
#include "support/sampling.hpp"

namespace bqsa::test_support {

/// Seven joints, axes intersecting at shoulder, elbow and wrist; links 1, 3, 5 and 7 have a length.
inline ChainDescription seven_joint_arm() {
  ChainDescription arm;
  const double right = 90 * kDegree;
  arm.rows = {{0, -right, 0.34, 0}, {0, right, 0, 0}, {0, right, 0.4, 0}, {0, -right, 0, 0},
              {0, -right, 0.4, 0},  {0, right, 0, 0}, {0, 0, 0.126, 0}};
  return arm;
}

/// A seven-joint arm that moves its tip along a random straight line, in 150 ticks of 40 ms, with
/// one ellipsoid put on link 3, 5 or 7 where plain tracking leads it at tick 80. The tip's path is
/// clear and so is the start.
inline Problem random_arm_scene(Generator& generator) {
  Problem problem{
      .name = "random", .chain = SerialChain(seven_joint_arm()), .ticks = 150, .dt = 0.04};
  for (;;) {
    problem.obstacles.clear();
    problem.start = random_vector<7>(generator, 1.5);
    ChainPose pose;
    problem.chain.forward(problem.start, pose);
    const Eigen::Vector3d from = pose.tip();
    const Eigen::Vector3d to = from + random_vector<3>(generator, 0.35);
    problem.desired_tip = [from, to, end = problem.duration()](double t) -> Eigen::Vector3d {
      return from + t / end * (to - from);
    };
    BqsaSpatial tracking;
    const Replay nominal = replay(tracking, problem);
    if (nominal.last.state == TickState::kInfeasible) continue;

    problem.chain.forward(nominal.q[80], pose);
    const int link = 3 + 2 * static_cast<int>(uniform(generator, 0, 2.999));
    const Eigen::Vector3d on_link =
        pose.p_WO.col(link - 1) +
        uniform(generator, 0.1, 0.9) * (pose.p_WO.col(link) - pose.p_WO.col(link - 1));
    const Eigen::Vector3d semi_axes = random_vector<3>(generator, 0.04).array() + 0.06;
    const Ellipsoid shape(on_link, semi_axes, random_rotation<3>(generator));
    problem.obstacles = {{"obstacle", shape}};
    bool tip_clear = true;
    for (int tick = 0; tick <= problem.ticks; ++tick) {
      tip_clear = tip_clear && shape.level(problem.desired_tip(problem.time(tick))) > 0.2;
    }
    if (tip_clear && sampled_hits(problem, {problem.start}, 0).empty()) return problem;
  }
}

/// A random arm scene with three more ellipsoids on and beside links 3, 5 and 7. The start is
/// clear.
inline Problem crowded_arm_scene(Generator& generator) {
  for (;;) {
    Problem problem = random_arm_scene(generator);
    Problem without = problem;
    without.obstacles.clear();
    BqsaSpatial tracking;
    const Replay nominal = replay(tracking, without);
    ChainPose pose;
    for (const int link : {3, 5, 7}) {
      const auto tick = static_cast<std::size_t>(uniform(generator, 60, 100));
      problem.chain.forward(nominal.q[tick], pose);
      const Eigen::Vector3d center =
          pose.p_WO.col(link - 1) +
          uniform(generator, 0.2, 0.8) * (pose.p_WO.col(link) - pose.p_WO.col(link - 1)) +
          random_vector<3>(generator, 0.06);
      const Eigen::Vector3d semi_axes = random_vector<3>(generator, 0.02).array() + 0.04;
      const Ellipsoid shape(center, semi_axes, random_rotation<3>(generator));
      problem.obstacles.push_back({"one more", shape});
    }
    if (sampled_hits(problem, {problem.start}, 0).empty()) return problem;
  }
}

}  // namespace bqsa::test_support
