/// @file
/// One problem, written down in another way: moved, in other units, in another order.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "bqsa/bqsa_settings.hpp"
#include "bqsa/problem.hpp"

namespace bqsa::test_support {

/// The obstacle with `change` applied to its shape at every tick.
template <typename Change>
Obstacle changed(Obstacle obstacle, const Change& change) {
  obstacle.shape = change(obstacle.shape);
  for (Ellipsoid& shape : obstacle.motion) shape = change(shape);
  return obstacle;
}

/// The problem as seen from a frame V with p_V = R p_W + p: base, path and obstacles are elsewhere.
inline Problem moved(Problem problem, const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
  ChainDescription chain = problem.chain.description();
  chain.R_WB = R * chain.R_WB;
  chain.p_WB = R * chain.p_WB + p;
  problem.chain = SerialChain(chain);
  for (Obstacle& obstacle : problem.obstacles) {
    obstacle = changed(std::move(obstacle), [&R, &p](const Ellipsoid& shape) -> Ellipsoid {
      return {R * shape.center() + p, shape.semi_axes(), R * shape.rotation()};
    });
  }
  problem.desired_tip = [R, p, tip = problem.desired_tip](double t) -> Eigen::Vector3d {
    return R * tip(t) + p;
  };
  return problem;
}

/// The problem with all its lengths multiplied by `scale`.
inline Problem scaled(Problem problem, double scale) {
  ChainDescription chain = problem.chain.description();
  for (DhRow& row : chain.rows) {
    row.a *= scale;
    row.d *= scale;
  }
  chain.p_WB *= scale;
  chain.p_LT *= scale;
  problem.chain = SerialChain(chain);
  for (Obstacle& obstacle : problem.obstacles) {
    obstacle = changed(std::move(obstacle), [scale](const Ellipsoid& shape) -> Ellipsoid {
      return {scale * shape.center(), scale * shape.semi_axes(), shape.rotation()};
    });
  }
  problem.desired_tip = [scale, tip = problem.desired_tip](double t) -> Eigen::Vector3d {
    return scale * tip(t);
  };
  problem.link_radius *= scale;
  for (double& radius : problem.link_radii) radius *= scale;
  problem.margin *= scale;
  problem.tolerance *= scale;
  return problem;
}

/// The settings that go with `scaled`.
inline BqsaSettings scaled(BqsaSettings settings, double scale) {
  settings.ik.singular_threshold *= scale;
  settings.ik.lambda_max *= scale;
  settings.ik.residual_bound *= scale;
  settings.safety_offset *= scale;
  settings.contact_band *= scale;
  settings.tip_tolerance *= scale;
  return settings;
}

/// The problem with everything taking `factor` times as long.
inline Problem slowed(Problem problem, double factor) {
  problem.dt *= factor;
  if (problem.limits.max_velocity.size() > 0) problem.limits.max_velocity /= factor;
  problem.desired_tip = [factor, tip = problem.desired_tip](double t) { return tip(t / factor); };
  return problem;
}

/// The settings that go with `slowed`: Lemma 2's epsilon is a velocity.
inline BqsaSettings slowed(BqsaSettings settings, double factor) {
  settings.ik.residual_bound /= factor;
  return settings;
}

/// The problem with its obstacles listed in another order: the k-th is the one that was order[k].
/// An index can occur twice.
inline Problem with_obstacles(Problem problem, const std::vector<std::size_t>& order) {
  const std::vector<Obstacle> before = std::exchange(problem.obstacles, {});
  for (const std::size_t k : order) problem.obstacles.push_back(before.at(k));
  return problem;
}

/// A planar problem as one in space, where its arm has the z row of the task besides.
inline Problem in_space(Problem problem) {
  ChainDescription chain = problem.chain.description();
  chain.dimension = 3;
  problem.chain = SerialChain(chain);
  return problem;
}

}  // namespace bqsa::test_support
