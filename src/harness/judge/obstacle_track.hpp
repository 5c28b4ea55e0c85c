/// @file
/// Where an obstacle is at any time of a run: the motion that Problem declares, worked out by the
/// judge itself.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bqsa/problem.hpp"

namespace bqsa::harness {

/// A time of a run: the part s in [0, 1] of the motion that ends with a tick. No motion ends with
/// tick 0; its s is 1.
struct Instant {
  int tick = 0;
  double s = 1;
};

/// An obstacle at an instant, in W; its rates are per unit of s, and hold for the whole motion.
struct ObstacleState {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();        ///< [m]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< columns are its axes
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< of the centre [m]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();          ///< about the centre [rad]
};

class ObstacleTrack {
 public:
  /// The obstacle is copied.
  /// @param ticks  of the problem
  /// @throws std::invalid_argument if the motion is not one state a tick, or changes the semi-axes
  ObstacleTrack(const Obstacle& obstacle, int ticks);

  bool moves() const { return states_.size() > 1; }
  bool turns() const;
  ObstacleState at(const Instant& instant) const;

  /// Bound of how much the motion to a tick can change the obstacle's clearance to anything at
  /// rest [m]: the way of its centre, and its turn times the difference of its longest and its
  /// shortest semi-axis.
  ///
  /// The clearance of a convex body is the largest over all unit n of min n . (x - c) - h(n), h
  /// being the ellipsoid's support function. A turn w changes h(n) at the rate w . (n × y), with y
  /// the point of the surface that has the normal n, and |n × y|² = E(a⁴) / E(a²) - E(a²), the
  /// expectations over the squares of the semi-axes with the squared components of n as weights.
  /// That is largest, (longest - shortest)², for weights on these two alone.
  double travel(int tick) const;

 private:
  const ObstacleState& end_of(int tick) const;

  std::vector<ObstacleState> states_;  // at the ticks, with the rates of the motions to them
  double lever_;                       // longest less shortest semi-axis [m]
};

}  // namespace bqsa::harness
