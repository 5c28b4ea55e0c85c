/// @file
/// One step of an arm that is near obstacles, and derivatives through the real distances.
#pragma once

#include <algorithm>
#include <cmath>

#include "baselines/closest/segment_ellipsoid_distance.hpp"
#include "bqsa/method.hpp"
#include "support/closest_point_scenes.hpp"
#include "support/distance_oracle.hpp"

namespace bqsa::test_support {

/// Distance of a link's axis to an obstacle at rest, the arm being at q [m].
inline double oracle_distance(const Problem& problem, const JointVector& q, const Link& link,
                              const Obstacle& obstacle) {
  ChainPose pose;
  problem.chain.forward(q, pose);
  return static_cast<double>(
      DistanceOracle(pose.p_WO.col(link.start), pose.p_WO.col(link.end), obstacle.shape)
          .distance());
}

/// An arm of seven joints whose tip is to rest, among obstacles at rest: every link is more than
/// 2 cm away from all of them, and of at least two links and obstacles less than `reach` [m].
inline Problem near_obstacles(Generator& generator, int trial, double reach) {
  for (;;) {
    Problem problem = random_closest_point_scene(generator, trial);
    problem.link_radius = 0;
    problem.link_radii.clear();
    for (Obstacle& obstacle : problem.obstacles) obstacle.motion.clear();
    int near = 0;
    double least = 1;
    ChainPose pose;
    problem.chain.forward(problem.start, pose);
    for (const Link& link : problem.chain.links()) {
      for (const Obstacle& obstacle : problem.obstacles) {
        const double distance = baselines::segment_distance(pose.p_WO.col(link.start),
                                                            pose.p_WO.col(link.end), obstacle.shape)
                                    .distance;
        least = std::min(least, distance);
        near += distance < reach;
      }
    }
    if (least < 0.02 || near < 2) continue;
    const Eigen::Vector3d tip = pose.tip();
    problem.desired_tip = [tip](double) { return tip; };
    return problem;
  }
}

/// Gradient of f at q by central differences.
template <typename Function>
JointVector central_differences(const Function& f, const JointVector& q, double h) {
  JointVector gradient(q.size());
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    JointVector ahead = q, behind = q;
    ahead(j) += h;
    behind(j) -= h;
    gradient(j) = (f(ahead) - f(behind)) / (2 * h);
  }
  return gradient;
}

/// Jacobian of the tip at q.
inline TaskJacobian tip_jacobian(const Problem& problem, const JointVector& q) {
  ChainPose pose;
  TaskJacobian J;
  problem.chain.forward(q, pose);
  problem.chain.jacobian(pose, problem.chain.points() - 1, J);
  return J;
}

/// What the first step from the start adds to it [rad].
inline JointVector first_step(ReactiveMethod& method, const Problem& problem) {
  method.prepare(problem);
  StepOutput output;
  method.step({.tick = 1,
               .t = problem.dt,
               .p_WT_desired = problem.desired_tip(problem.dt),
               .q = problem.start},
              output);
  return output.q - problem.start;
}

}  // namespace bqsa::test_support
