#include "bqsa/envelope/solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "bqsa/envelope/frame_along.hpp"
#include "bqsa/envelope/overloaded.hpp"

namespace bqsa {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kEps = std::numeric_limits<double>::epsilon() / 2;

/// Sides of the prism that replaces a cylinder when it is divided lengthwise.
constexpr int kSides = 64;

void expect(bool holds, const char* expectation) {
  if (!holds) throw std::invalid_argument(std::string("solid: expected ") + expectation);
}

void expect_length(double length, const char* expectation) {
  expect(length > 0 && std::isfinite(length), expectation);
}

void expect_segment(const Vector3d& a, const Vector3d& b) {
  expect(a.allFinite() && b.allFinite(), "finite end-points of the axis");
}

/// Unit vector, or zero.
Vector3d direction_of(const Vector3d& v) {
  const double length = v.norm();
  return length > 0 ? Vector3d(v / length) : Vector3d::Zero();
}

std::vector<Vector3d> corners(const Box& box) {
  std::vector<Vector3d> result;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vector3d signs((corner & 1U) != 0 ? 1 : -1, (corner & 2U) != 0 ? 1 : -1,
                         (corner & 4U) != 0 ? 1 : -1);
    result.emplace_back(box.center + box.rotation * box.half_lengths.cwiseProduct(signs));
  }
  return result;
}

/// Corners of a prism around the cylinder.
std::vector<Vector3d> corners(const Cylinder& cylinder) {
  const Matrix3d frame = frame_along(cylinder.b - cylinder.a);
  const double radius = cylinder.radius / std::cos(std::numbers::pi / kSides);
  std::vector<Vector3d> result;
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    const Vector3d out = radius * (std::cos(angle) * frame.col(0) + std::sin(angle) * frame.col(1));
    result.emplace_back(cylinder.a + out);
    result.emplace_back(cylinder.b + out);
  }
  return result;
}

double size_of(const std::vector<Vector3d>& points) {
  double size = 0;
  for (const Vector3d& p : points) size = std::max(size, p.cwiseAbs().maxCoeff());
  return size;
}

/// See the header for what rounding may lose.
std::array<Part, 2> halves_of_hull(const ConvexHull& hull, double slack,
                                   const Vector3d& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low, reach = 0;
  for (const Vector3d& vertex : hull.vertices) {
    low = std::min(low, direction.dot(vertex));
    high = std::max(high, direction.dot(vertex));
    reach = std::max(reach, (vertex - hull.vertices.front()).norm());
  }
  const double half_extent = 0.5 * (high - low) / direction.norm();
  expect(half_extent > 0, "a direction along which the solid extends");
  const std::array<std::vector<Vector3d>, 2> points = cut(hull, direction, 0.5 * (low + high));
  const double lost =
      (hull.deviation + 16 * kEps * size_of(hull.vertices)) * (1 + 2 * reach / half_extent);
  std::array<Part, 2> result;
  for (std::size_t side = 0; side < 2; ++side) {
    result[side] = {convex_hull(points[side]), slack + lost};
  }
  return result;
}

/// A corner computed with rounding errors is within 16 roundings of its place.
std::array<Part, 2> halves_of_corners(const std::vector<Vector3d>& points, double slack,
                                      const Vector3d& direction) {
  return halves_of_hull(convex_hull(points), slack + 16 * kEps * size_of(points), direction);
}

/// Shorter solids of the same kind on both halves of the axis.
template <typename Revolved>
std::array<Part, 2> halves_along(const Revolved& solid, double slack) {
  const Vector3d middle = 0.5 * (solid.a + solid.b);
  const double rounding = 4 * kEps * std::max(solid.a.norm(), solid.b.norm());
  return {Part{Revolved{solid.a, middle, solid.radius}, slack + rounding},
          Part{Revolved{middle, solid.b, solid.radius}, slack + rounding}};
}

}  // namespace

void check(const Solid& solid) {
  std::visit(
      Overloaded{
          [](const Ball& ball) {
            expect(ball.center.allFinite(), "a finite centre of the ball");
            expect_length(ball.radius, "a positive radius of the ball");
          },
          [](const Box& box) {
            expect(box.center.allFinite(), "a finite centre of the box");
            for (const double length : box.half_lengths) {
              expect_length(length, "positive half lengths of the box");
            }
            expect(box.rotation.isUnitary(1e-9) && box.rotation.determinant() > 0,
                   "an orthonormal, right-handed rotation of the box");
          },
          [](const Cylinder& cylinder) {
            expect_segment(cylinder.a, cylinder.b);
            expect_length((cylinder.b - cylinder.a).norm(), "a positive length of the cylinder");
            expect_length(cylinder.radius, "a positive radius of the cylinder");
          },
          [](const Capsule& capsule) {
            expect_segment(capsule.a, capsule.b);
            expect_length(capsule.radius, "a positive radius of the capsule");
          },
          [](const ConvexHull& hull) { expect(!hull.vertices.empty(), "a hull with corners"); }},
      solid);
}

double volume(const Solid& solid) {
  constexpr double kPi = std::numbers::pi;
  return std::visit(
      Overloaded{[](const Ball& ball) { return 4 * kPi / 3 * std::pow(ball.radius, 3); },
                 [](const Box& box) { return 8 * box.half_lengths.prod(); },
                 [](const Cylinder& cylinder) {
                   return kPi * cylinder.radius * cylinder.radius *
                          (cylinder.b - cylinder.a).norm();
                 },
                 [](const Capsule& capsule) {
                   const double r = capsule.radius;
                   return kPi * r * r * ((capsule.b - capsule.a).norm() + 4 * r / 3);
                 },
                 [](const ConvexHull& hull) { return volume(hull); }},
      solid);
}

Vector3d support_point(const Solid& solid, const Vector3d& n) {
  return std::visit(
      Overloaded{
          [&](const Ball& ball) -> Vector3d { return ball.center + ball.radius * direction_of(n); },
          [&](const Box& box) -> Vector3d {
            const Vector3d m = box.rotation.transpose() * n;
            return box.center + box.rotation * box.half_lengths.cwiseProduct(m.cwiseSign());
          },
          [&](const Cylinder& cylinder) -> Vector3d {
            const Vector3d axis = direction_of(cylinder.b - cylinder.a);
            const double along = axis.dot(n);
            // Twice, for of a direction along the axis the first round leaves rounding errors alone,
            // which may be along the axis, too.
            Vector3d across = n - along * axis;
            across -= across.dot(axis) * axis;
            return (along > 0 ? cylinder.b : cylinder.a) + cylinder.radius * direction_of(across);
          },
          [&](const Capsule& capsule) -> Vector3d {
            return (n.dot(capsule.b - capsule.a) > 0 ? capsule.b : capsule.a) +
                   capsule.radius * direction_of(n);
          },
          [&](const ConvexHull& hull) -> Vector3d {
            return *std::max_element(
                hull.vertices.begin(), hull.vertices.end(),
                [&](const Vector3d& p, const Vector3d& q) { return n.dot(p) < n.dot(q); });
          }},
      solid);
}

bool divisible(const Solid& solid) {
  const ConvexHull* hull = std::get_if<ConvexHull>(&solid);
  return !std::holds_alternative<Ball>(solid) && (hull == nullptr || hull->span > 0);
}

std::array<Part, 2> halves(const Part& part, const Vector3d& direction) {
  using Halves = std::array<Part, 2>;
  const double slack = part.slack;
  return std::visit(
      Overloaded{
          [](const Ball&) -> Halves {
            throw std::invalid_argument("solid: a ball is its own envelope, undivided");
          },
          [&](const Box& box) -> Halves {
            return halves_of_corners(corners(box), slack, direction);
          },
          [&](const Cylinder& cylinder) -> Halves {
            const double along =
                std::abs(direction_of(direction).dot(direction_of(cylinder.b - cylinder.a)));
            if (along > std::numbers::sqrt2 / 2) return halves_along(cylinder, slack);
            return halves_of_corners(corners(cylinder), slack, direction);
          },
          [&](const Capsule& capsule) -> Halves { return halves_along(capsule, slack); },
          [&](const ConvexHull& hull) -> Halves { return halves_of_hull(hull, slack, direction); }},
      part.solid);
}

}  // namespace bqsa
