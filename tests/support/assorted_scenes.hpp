/// @file
/// Random problems of all that a problem can have: obstacles at rest and on the move, one or
/// several, link radius, margin, limits of speed.
#pragma once

#include <utility>
#include <vector>

#include "bqsa/bqsa_planar.hpp"
#include "support/random_scenes.hpp"

namespace bqsa::test_support {

/// Seven links of 0.4 m and a straight path, in 150 ticks; plain tracking leads one of the links 3
/// to 7 into one ellipse, at tick 80. The tip's path is clear and so is the start.
inline Problem random_planar_scene(Generator& generator) {
  for (;;) {
    Problem problem = planar_7r(150);
    problem.obstacles.clear();
    problem.start = JointVector::NullaryExpr(
        7, [&](Eigen::Index i) { return uniform(generator, i == 0 ? -1.5 : -0.8, 0.8); });
    ChainPose pose;
    problem.chain.forward(problem.start, pose);
    const Eigen::Vector3d from = pose.tip();
    const Eigen::Vector3d to = 0.6 * from + Eigen::Vector3d(uniform(generator, -0.6, 0.6),
                                                            uniform(generator, -0.6, 0.6), 0);
    problem.desired_tip = [from, to, end = problem.duration()](double t) -> Eigen::Vector3d {
      return from + t / end * (to - from);
    };
    BqsaPlanar tracking(PlanarVariant::kExact);
    const Replay nominal = replay(tracking, problem);
    if (nominal.last.state == TickState::kInfeasible) continue;

    problem.chain.forward(nominal.q[80], pose);
    const int link = static_cast<int>(uniform(generator, 3, 7.999));
    const Eigen::Vector3d on_link =
        pose.p_WO.col(link - 1) +
        uniform(generator, 0.1, 0.9) * (pose.p_WO.col(link) - pose.p_WO.col(link - 1));
    const double size = uniform(generator, 0.03, 0.12);
    const Ellipse shape =
        rotated_ellipse(on_link.head<2>(), {size, uniform(generator, 0.4, 1) * size},
                        uniform(generator, 0, std::numbers::pi));
    problem.obstacles = {{"obstacle", embedded(shape)}};
    bool tip_clear = true;
    for (int tick = 0; tick <= problem.ticks; ++tick) {
      const Eigen::Vector3d tip = problem.desired_tip(problem.time(tick));
      tip_clear = tip_clear && shape.level(tip.head<2>()) > 0.2;
    }
    if (tip_clear && sampled_hits(problem, {problem.start}, 0).empty()) return problem;
  }
}

/// Lets the obstacle drift and turn evenly through where it is now, which it reaches at tick 80.
inline void set_in_motion(const Problem& problem, const Eigen::Vector3d& drift,  // a tick [m]
                          const Eigen::Vector3d& axis, double turn,              // a tick [rad]
                          Obstacle& obstacle) {
  const Ellipsoid& now = obstacle.shape;
  std::vector<Ellipsoid> motion;
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    motion.emplace_back(
        now.center() + (tick - 80) * drift, now.semi_axes(),
        Eigen::AngleAxisd((tick - 80) * turn, axis).toRotationMatrix() * now.rotation());
  }
  obstacle.motion = std::move(motion);
  obstacle.shape = obstacle.motion.front();
}

/// The problem with a further obstacle on its path, where the tip is at the tick.
inline Problem blocked(Problem problem, int tick) {
  const Eigen::Vector3d tip = problem.desired_tip(problem.time(tick));
  problem.obstacles.push_back({"on the path", Ellipsoid(tip, {0.03, 0.02, 0.03})});
  return problem;
}

/// Problems in the plane or in space, all different. Of every four one has a single obstacle at
/// rest, one a single moving obstacle, one link radius, margin and speed limits, one several
/// obstacles, of which one moves. All starts are clear.
inline std::vector<Problem> assorted_scenes(int dimension, int count, std::uint64_t seed) {
  Generator generator(seed);
  const bool planar = dimension == 2;
  std::vector<Problem> scenes;
  while (static_cast<int>(scenes.size()) < count) {
    const int kind = static_cast<int>(scenes.size()) % 4;
    Problem problem = planar ? random_planar_scene(generator) : random_arm_scene(generator);
    if (kind == 3) {
      for (int more = 0; more < 3; ++more) {
        const Problem other = planar ? random_planar_scene(generator) : random_arm_scene(generator);
        const Ellipsoid& shape = problem.obstacles.front().shape;
        Eigen::Vector3d aside = random_direction<3>(generator);
        if (planar) aside = Eigen::Vector3d(aside.x(), aside.y(), 0).normalized();
        const double away = shape.semi_axes().maxCoeff() + uniform(generator, 0, 0.15);
        const Ellipsoid& like = other.obstacles.front().shape;
        problem.obstacles.push_back(
            {"one more",
             Ellipsoid(shape.center() + away * aside, 0.8 * like.semi_axes(), like.rotation())});
      }
    }
    if (kind == 1 || kind == 3) {
      Eigen::Vector3d drift = random_vector<3>(generator, 1e-3);
      Eigen::Vector3d axis = random_direction<3>(generator);
      if (planar) {
        drift.z() = 0;
        axis = Eigen::Vector3d::UnitZ();
      }
      set_in_motion(problem, drift, axis, uniform(generator, -0.02, 0.02),
                    problem.obstacles.back());
    }
    if (kind == 2) {
      problem.link_radius = uniform(generator, 0.002, 0.006);
      problem.margin = uniform(generator, 0.001, 0.003);
      problem.limits.max_velocity =
          JointVector::Constant(problem.chain.joints(), 0.15 / problem.dt);
    }
    const double room = 2 * (problem.link_radius + problem.margin) + 1e-3;
    if (sampled_hits(problem, {problem.start}, 0, room).empty()) scenes.push_back(problem);
  }
  return scenes;
}

}  // namespace bqsa::test_support
