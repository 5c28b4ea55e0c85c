/// @file
/// Random solids, and points that are theirs in 113-bit arithmetic.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "bqsa/envelope/solid.hpp"
#include "support/exact_segment_test.hpp"
#include "support/sampling.hpp"

namespace bqsa::test_support {

using QuadPoint = std::array<Quad, 3>;

inline QuadPoint quad_point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

inline Eigen::Vector3d rounded(const QuadPoint& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

inline Quad dot(const QuadPoint& a, const QuadPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// a + s b
inline QuadPoint plus(const QuadPoint& a, Quad s, const QuadPoint& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

inline Quad square_root(Quad x) {
  Quad root = std::sqrt(static_cast<double>(x));
  for (int round = 0; round < 3; ++round) root = (root + x / root) / 2;
  return root;
}

/// Along v, of the length given.
inline QuadPoint of_length(const QuadPoint& v, Quad length) {
  return plus(QuadPoint{0, 0, 0}, length / square_root(dot(v, v)), v);
}

/// In [0, 1]; 0 and 1 themselves in a third of the cases each if `surface`.
inline double fraction(Generator& generator, bool surface) {
  const double kind = surface ? uniform(generator, 0, 3) : 2;
  return kind < 1 ? 0 : kind < 1.5 ? 1 : uniform(generator, 0, 1);
}

struct SampleOf {
  Generator& generator;

  double radius_fraction() const { return std::sqrt(fraction(generator, true)); }

  QuadPoint operator()(const Ball& ball) const {
    const QuadPoint out = quad_point(random_direction<3>(generator));
    return plus(quad_point(ball.center), radius_fraction(), of_length(out, ball.radius));
  }

  QuadPoint operator()(const Box& box) const {
    QuadPoint p = quad_point(box.center);
    for (int k = 0; k < 3; ++k) {
      const Quad x = Quad(box.half_lengths(k)) * (2 * Quad(fraction(generator, true)) - 1);
      p = plus(p, x, quad_point(box.rotation.col(k)));
    }
    return p;
  }

  QuadPoint operator()(const Cylinder& cylinder) const {
    const QuadPoint along = plus(quad_point(cylinder.b), -1, quad_point(cylinder.a));
    const QuadPoint any = quad_point(random_direction<3>(generator));
    const QuadPoint across = plus(any, -dot(any, along) / dot(along, along), along);
    const QuadPoint on_axis = plus(quad_point(cylinder.a), fraction(generator, true), along);
    return plus(on_axis, radius_fraction(), of_length(across, cylinder.radius));
  }

  QuadPoint operator()(const Capsule& capsule) const {
    const QuadPoint along = plus(quad_point(capsule.b), -1, quad_point(capsule.a));
    const QuadPoint on_axis = plus(quad_point(capsule.a), fraction(generator, true), along);
    const QuadPoint out = quad_point(random_direction<3>(generator));
    return plus(on_axis, radius_fraction(), of_length(out, capsule.radius));
  }

  /// A corner, or a point on a face's triangle, on an edge or inside.
  QuadPoint operator()(const ConvexHull& hull) const {
    const auto any = [&](std::size_t count) {
      return std::uniform_int_distribution<std::size_t>(0, count - 1)(generator);
    };
    std::vector<std::size_t> corners;
    const int kind = static_cast<int>(any(3));
    if (kind == 0 || hull.triangles.empty()) {
      for (int k = 0; k < 5; ++k) corners.push_back(any(hull.vertices.size()));
    } else {
      const auto& triangle = hull.triangles[any(hull.triangles.size())];
      for (int k = 0; k < (kind == 1 ? 3 : 2); ++k) {
        corners.push_back(static_cast<std::size_t>(triangle[static_cast<std::size_t>(k)]));
      }
    }
    Quad total = 0;
    QuadPoint p{0, 0, 0};
    for (const std::size_t corner : corners) {
      const Quad weight = uniform(generator, 0, 1);
      total += weight;
      p = plus(p, weight, quad_point(hull.vertices[corner]));
    }
    for (Quad& x : p) x /= total;
    return p;
  }
};

/// A random point of the solid; often one of its surface or its rim.
inline QuadPoint sample(const Solid& solid, Generator& generator) {
  return std::visit(SampleOf{generator}, solid);
}

inline const std::array<std::string, 5> kSolidNames = {"ball", "box", "cylinder", "capsule",
                                                       "hull"};

/// Lengths from `thin` to 1, anywhere within `offset` of the origin.
inline Solid random_solid(std::size_t kind, double thin, double offset, Generator& generator) {
  const auto length = [&] { return log_uniform(generator, thin, 1); };
  const Eigen::Vector3d center = random_vector<3>(generator, offset);
  const Eigen::Vector3d half_axis = length() * random_direction<3>(generator);
  switch (kind) {
    case 0:
      return Ball{center, length()};
    case 1:
      return Box{center, {length(), length(), length()}, random_rotation<3>(generator)};
    case 2:
      return Cylinder{center - half_axis, center + half_axis, length()};
    case 3:
      return Capsule{center - half_axis, center + half_axis, length()};
    default: {
      const Eigen::Vector3d stretch(length(), length(), length());
      const Eigen::Matrix3d turn = random_rotation<3>(generator);
      std::vector<Eigen::Vector3d> points;
      for (int k = 0; k < 20; ++k) {
        points.emplace_back(center + turn * stretch.cwiseProduct(random_vector<3>(generator, 1)));
      }
      return convex_hull(points);
    }
  }
}

}  // namespace bqsa::test_support
