/// @file
/// Random solids, flat ones too, with segments near them, for the tests of the judge.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "bqsa/envelope/solid.hpp"
#include "judge_scenes.hpp"
#include "support/sampling.hpp"
#include "support/solid_samples.hpp"

namespace bqsa::test_support {

inline constexpr std::size_t kFlat = 5;  ///< after the kinds of random_solid
inline const std::array<std::string, 6> kJudgedSolidNames = {"ball",    "box",  "cylinder",
                                                             "capsule", "hull", "flat"};

/// Of random_solid's kinds, or a polygon in space.
inline Solid judged_solid(std::size_t kind, double thin, Generator& generator) {
  if (kind != kFlat) return random_solid(kind, thin, 1, generator);
  const Eigen::Matrix3d turn = random_rotation<3>(generator);
  const Eigen::Vector3d center = random_vector<3>(generator, 1);
  const double width = log_uniform(generator, thin, 1), height = log_uniform(generator, thin, 1);
  std::vector<Eigen::Vector3d> points;
  const int count = std::uniform_int_distribution<int>(3, 9)(generator);
  for (int k = 0; k < count; ++k) {
    points.emplace_back(center + width * uniform(generator, -1, 1) * turn.col(0) +
                        height * uniform(generator, -1, 1) * turn.col(1));
  }
  ConvexHull hull = convex_hull(points);
  // Rounding lifts corners off the plane by 1e-16, which the grid of the hull seldom sees.
  return hull.span == 2 ? Solid(std::move(hull)) : judged_solid(kind, thin, generator);
}

/// The largest n . x of the solid, by formulas of its own.
inline double height(const Solid& solid, const Eigen::Vector3d& n) {
  if (const auto* ball = std::get_if<Ball>(&solid)) return n.dot(ball->center) + ball->radius;
  if (const auto* box = std::get_if<Box>(&solid)) {
    return n.dot(box->center) + (box->rotation.transpose() * n).cwiseAbs().dot(box->half_lengths);
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&solid)) {
    const Eigen::Vector3d axis = (cylinder->b - cylinder->a).normalized();
    return std::max(n.dot(cylinder->a), n.dot(cylinder->b)) +
           cylinder->radius * n.cross(axis).norm();
  }
  if (const auto* capsule = std::get_if<Capsule>(&solid)) {
    return std::max(n.dot(capsule->a), n.dot(capsule->b)) + capsule->radius;
  }
  double highest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : std::get<ConvexHull>(solid).vertices) {
    highest = std::max(highest, n.dot(p));
  }
  return highest;
}

/// A segment `gap` outside (negative: inside) of the solid's highest point in a random direction.
/// @param tangential  across that direction, so that `gap` is its clearance
inline Segment segment_near(Generator& generator, const Solid& solid, double length, double gap,
                            bool tangential) {
  const Eigen::Vector3d n = random_direction<3>(generator);
  Eigen::Vector3d d = random_direction<3>(generator);
  if (tangential) d = (d - n.dot(d) * n).normalized();
  const Eigen::Vector3d p = support_point(solid, n) + gap * n;
  const double share = uniform(generator, 0, 1);
  return {p - share * length * d, p + (1 - share) * length * d};
}

}  // namespace bqsa::test_support
