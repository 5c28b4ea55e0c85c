/// @file
/// Segments near ellipsoids, and arms with obstacles, for the tests of the judge.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bqsa/method.hpp"
#include "bqsa/problem.hpp"
#include "support/sampling.hpp"

namespace bqsa::test_support {

enum class Shape { kEgg, kSphere, kNeedle, kSheet };
inline constexpr std::array kShapes = {Shape::kEgg, Shape::kSphere, Shape::kNeedle, Shape::kSheet};

inline std::string name_of(Shape shape) {
  switch (shape) {
    case Shape::kEgg:
      return "egg";
    case Shape::kSphere:
      return "sphere";
    case Shape::kNeedle:
      return "needle";
    case Shape::kSheet:
      return "sheet";
  }
  return "unknown";
}

/// Semi-axes of an obstacle of a workshop [m]; the sheet is 0.2 mm x 20 m.
inline Eigen::Vector3d semi_axes(Generator& generator, Shape shape) {
  switch (shape) {
    case Shape::kEgg:
      return {uniform(generator, 0.05, 0.5), uniform(generator, 0.05, 0.5),
              uniform(generator, 0.05, 0.5)};
    case Shape::kSphere:
      return Eigen::Vector3d::Constant(uniform(generator, 0.05, 0.5));
    case Shape::kNeedle: {
      const double thickness = log_uniform(generator, 1e-4, 1e-2);
      return {thickness, thickness, uniform(generator, 1, 10)};
    }
    case Shape::kSheet:
      return {10, 10, 1e-4};
  }
  return Eigen::Vector3d::Ones();
}

struct Segment {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
};

/// A segment through a point `gap` outside (negative: inside) of a random point of the surface.
/// @param tangential  perpendicular to the surface's normal there, so that `gap` is its clearance
inline Segment segment_at(Generator& generator, const Ellipsoid& ellipsoid, double length,
                          double gap, bool tangential) {
  const Eigen::Vector3d s = random_direction<3>(generator);
  const Eigen::Vector3d normal =
      (ellipsoid.rotation() * s.cwiseQuotient(ellipsoid.semi_axes())).normalized();
  Eigen::Vector3d d = random_direction<3>(generator);
  if (tangential) d = (d - normal.dot(d) * normal).normalized();
  const Eigen::Vector3d p = surface_point<3>(ellipsoid, s) + gap * normal;
  const double share = uniform(generator, 0, 1);
  return {p - share * length * d, p + (1 - share) * length * d};
}

/// A problem in an empty world, without limits, whose tip may be anywhere.
inline Problem free_problem(ChainDescription chain, int ticks) {
  const int joints = chain.joints();
  return {.name = "test",
          .chain = SerialChain(std::move(chain)),
          .obstacles = {},
          .desired_tip = [](double) { return Eigen::Vector3d::Zero(); },
          .ticks = ticks,
          .dt = 0.01,
          .start = JointVector::Zero(joints),
          .limits = {},
          .link_radius = 0,
          .margin = 0,
          .tolerance = std::numeric_limits<double>::infinity()};
}

/// Gives the obstacle one more state: `way` [m] on and turned by up to `turn` [rad], about z alone
/// in the plane.
inline void move_obstacle(Generator& generator, bool planar, double way, double turn,
                          Obstacle& obstacle) {
  if (obstacle.motion.empty()) obstacle.motion.push_back(obstacle.shape);
  const Ellipsoid last = obstacle.motion.back();
  Eigen::Vector3d step = way * random_direction<3>(generator);
  Eigen::Vector3d axis = random_direction<3>(generator);
  if (planar) {
    step.z() = 0;
    axis = Eigen::Vector3d::UnitZ();
  }
  const Eigen::AngleAxisd spin(uniform(generator, -turn, turn), axis);
  obstacle.motion.emplace_back(last.center() + step, last.semi_axes(),
                               Eigen::Matrix3d(spin.toRotationMatrix() * last.rotation()));
}

/// The obstacle at the part s of the motion to a tick, by the slerp of unit quaternions.
inline Ellipsoid obstacle_between(const Obstacle& obstacle, int tick, double s) {
  if (!obstacle.moves()) return obstacle.shape;
  const Ellipsoid& from = obstacle.at(tick - 1);
  const Ellipsoid& to = obstacle.at(tick);
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(from.rotation()).slerp(s, Eigen::Quaterniond(to.rotation()));
  return {(1 - s) * from.center() + s * to.center(), from.semi_axes(),
          turn.normalized().toRotationMatrix()};
}

/// From the problem's start by the same joint step every tick.
inline Trajectory steady_motion(const Problem& problem, const JointVector& step) {
  Trajectory trajectory;
  for (int k = 0; k <= problem.ticks; ++k) {
    trajectory.t.push_back(problem.time(k));
    trajectory.q.push_back(problem.start + k * step);
  }
  return trajectory;
}

}  // namespace bqsa::test_support
