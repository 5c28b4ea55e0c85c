#include "bqsa/envelope/least_ellipsoid_around.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <variant>

#include "bqsa/envelope/frame_along.hpp"
#include "bqsa/envelope/least_ellipsoid.hpp"
#include "bqsa/envelope/overloaded.hpp"

namespace bqsa {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kEps = std::numeric_limits<double>::epsilon() / 2;

/// See the header: the ellipsoid scaled so that it contains all points within `distance` of itself.
Ellipsoid scaled_around(const Vector3d& center, const Vector3d& semi_axes, const Matrix3d& rotation,
                        double distance) {
  const double factor = 1 + distance / semi_axes.minCoeff() + 16 * kEps;
  return {center, factor * semi_axes, rotation};
}

/// How far from the solid's own place the stored frame may put its points.
double misplacement(const Vector3d& center, double size, const Matrix3d& rotation) {
  const double skew = (rotation.transpose() * rotation - Matrix3d::Identity()).norm();
  return (skew + 16 * kEps) * size + 16 * kEps * center.norm();
}

/// Semi-axes A across and C along the axis of a solid of revolution.
Ellipsoid of_revolution(const Vector3d& a, const Vector3d& b, double radius, double across,
                        double along, double least_semi_axis, double slack) {
  const Matrix3d rotation = frame_along(b - a);
  const Vector3d center = 0.5 * (a + b);
  const double size = 0.5 * (b - a).norm() + radius;
  const Vector3d semi_axes = Vector3d(across, across, along).cwiseMax(least_semi_axis);
  return scaled_around(
      center, semi_axes, rotation,
      slack + misplacement(center, size, rotation) + 16 * kEps * std::max(a.norm(), b.norm()));
}

}  // namespace

Ellipsoid least_ellipsoid_around(const Solid& solid, double least_semi_axis, double slack) {
  check(solid);
  if (!(least_semi_axis >= 0) || !(slack >= 0)) {
    throw std::invalid_argument("solid: expected no negative least semi-axis or slack");
  }
  using std::numbers::sqrt3;
  return std::visit(
      Overloaded{
          [&](const Ball& ball) {
            const Vector3d semi_axes = Vector3d::Constant(std::max(ball.radius, least_semi_axis));
            return scaled_around(ball.center, semi_axes, Matrix3d::Identity(), slack);
          },
          [&](const Box& box) {
            const Vector3d semi_axes = (sqrt3 * box.half_lengths).cwiseMax(least_semi_axis);
            return scaled_around(
                box.center, semi_axes, box.rotation,
                slack + misplacement(box.center, box.half_lengths.norm(), box.rotation));
          },
          [&](const Cylinder& cylinder) {
            const double along = 0.5 * sqrt3 * (cylinder.b - cylinder.a).norm();
            return of_revolution(cylinder.a, cylinder.b, cylinder.radius,
                                 std::sqrt(1.5) * cylinder.radius, along, least_semi_axis, slack);
          },
          [&](const Capsule& capsule) {
            const double r = capsule.radius;
            const double l = 0.5 * (capsule.b - capsule.a).norm();
            const double s = l + std::sqrt(l * l + 3 * r * r);
            return of_revolution(capsule.a, capsule.b, r, r * std::sqrt(1 + l / s),
                                 std::sqrt((l + s) * (l + r * r / s)), least_semi_axis, slack);
          },
          [&](const ConvexHull& hull) {
            const Ellipsoid shape =
                least_ellipsoid<3>(hull.vertices, {.least_semi_axis = least_semi_axis}).shape;
            return scaled_around(shape.center(), shape.semi_axes(), shape.rotation(),
                                 slack + hull.deviation);
          }},
      solid);
}

}  // namespace bqsa
