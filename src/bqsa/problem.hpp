/// @file
/// The problem that every method is given, byte for byte the same.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bqsa/geometry/ellipsoid.hpp"
#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa {

/// An obstacle that no link may enter. Planar problems hold ellipses as `embedded` ellipsoids.
struct Obstacle {
  std::string name;
  Ellipsoid shape;  ///< at t = 0

  /// Of a moving obstacle: the shape at the ticks 0 .. ticks, its semi-axes always the same; empty if
  /// it is at rest. From tick to tick the centre moves evenly on a straight line while the axes turn
  /// evenly about one fixed direction, by the smaller of the two angles that lead from one to the
  /// other. This is the motion that has to be avoided, between the ticks too.
  std::vector<Ellipsoid> motion = {};

  bool moves() const { return !motion.empty(); }
  const Ellipsoid& at(int tick) const {
    return motion.empty() ? shape : motion[static_cast<std::size_t>(tick)];
  }
};

/// Bounds a joint; empty vectors mean unlimited.
struct JointLimits {
  JointVector lower;         ///< [rad, m]
  JointVector upper;         ///< [rad, m]
  JointVector max_velocity;  ///< [rad/s, m/s]
};

/// What of the tip frame T the task prescribes.
enum class TaskKind {
  kPosition,  ///< where its origin is: 2 rows in the plane, 3 in space
  kAxis,      ///< also where its z axis points; it may spin about that: 5 rows
  kPose,      ///< also its whole orientation: 6 rows
};

/// Largest joint step between two ticks where no velocity limit is given [rad].
inline constexpr double kDefaultMaxStep = 15.0 * std::numbers::pi / 180.0;

/// The same of a prismatic joint [m].
inline constexpr double kDefaultMaxSlide = 0.05;

/// Follow x_d(t) with the tip from `start` on, no link in any obstacle at any time. SI units, frame
/// W. Path and motions are known beforehand, and every method may look ahead.
struct Problem {
  std::string name;
  SerialChain chain;
  std::vector<Obstacle> obstacles = {};

  /// Desired tip position x_d(t) for t in [0, duration()] [s -> m]. Planar problems leave z = 0.
  std::function<Eigen::Vector3d(double)> desired_tip = {};

  /// Desired orientation R_WT(t) of the tip frame for the same t, of which `task_kind` says what counts; empty
  /// if nothing does.
  std::function<Eigen::Matrix3d(double)> desired_rotation = {};
  TaskKind task_kind = TaskKind::kPosition;  ///< in the plane positions only

  int ticks = 0;  ///< control periods; the trajectory has ticks + 1 rows, row 0 is `start`
  double dt = 0;  ///< control period [s]

  JointVector start = {};   ///< joint values at t = 0 [rad, m]
  JointLimits limits = {};  ///< optional
  double link_radius = 0;   ///< every link is a capsule of this radius, or of at most this [m]
  std::vector<double> link_radii =
      {};                   ///< each link's own, none above link_radius; empty: all that [m]
  double margin = 0;        ///< clearance that methods are asked to keep, from `start` on [m]
  double tolerance = 1e-3;  ///< largest tip error at ticks that counts as success [m]
  double orientation_tolerance =
      1e-2;  ///< the same of the angle by which the tip is turned away [rad]

  double time(int tick) const { return tick * dt; }
  double duration() const { return ticks * dt; }
  int dimension() const { return chain.dimension(); }
  bool has_orientation() const { return task_kind != TaskKind::kPosition; }

  /// R_WT(t), the identity where none is desired.
  Eigen::Matrix3d rotation_at(double t) const {
    return desired_rotation ? desired_rotation(t) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  }

  /// Radius of one of SerialChain::links [m].
  double radius_of(std::size_t link) const {
    return link_radii.empty() ? link_radius : link_radii[link];
  }

  /// Largest step that joint j may make in one tick [rad, m].
  double max_step(int joint) const {
    if (limits.max_velocity.size() > 0) return limits.max_velocity(joint) * dt;
    return chain.is_prismatic(joint) ? kDefaultMaxSlide : kDefaultMaxStep;
  }

  /// Whether q [rad, m] keeps the joint limits.
  bool within_limits(const JointVector& q) const {
    return (limits.lower.size() == 0 || (q.array() >= limits.lower.array()).all()) &&
           (limits.upper.size() == 0 || (q.array() <= limits.upper.array()).all());
  }
};

}  // namespace bqsa
