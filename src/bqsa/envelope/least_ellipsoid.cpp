#include "bqsa/envelope/least_ellipsoid.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "bqsa/envelope/core_search.hpp"
#include "bqsa/geometry/rounding.hpp"

namespace bqsa {
namespace {

using Eigen::Index;

template <int Dim>
using Points = std::span<const Eigen::Matrix<double, Dim, 1>>;

/// Coordinates beyond this, or extents below its inverse, would leave double precision when squared
/// and multiplied [m].
constexpr double kLargest = 1e50;

/// An extent below this part of the longest one is none: coordinates hardly resolve it.
constexpr double kFlat = 1e-8;

/// Likewise below this part of the least semi-axis, to which it would not add.
constexpr double kFlatInThickness = 1e-4;

[[noreturn]] void refuse(const std::string& expected, const std::string& got) {
  throw std::invalid_argument("least ellipsoid: expected " + expected + ", got " + got);
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

template <int Dim>
void check(Points<Dim> points, const LeastEllipsoidSettings& settings) {
  if (!(settings.volume_gap > 0) || !std::isfinite(settings.volume_gap)) {
    refuse("a positive volume gap", number(settings.volume_gap));
  }
  if (!(settings.least_semi_axis >= 0) || !(settings.least_semi_axis <= kLargest)) {
    refuse("a least semi-axis from 0 to " + number(kLargest) + " m",
           number(settings.least_semi_axis));
  }
  if (points.empty()) refuse("points", "none");
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int k = 0; k < Dim; ++k) {
      if (std::abs(points[i](k)) <= kLargest) continue;
      refuse("coordinates of at most " + number(kLargest) + " m",
             number(points[i](k)) + " in point " + std::to_string(i));
    }
  }
}

/// A frame along the extents of the points: from the first vertex to the furthest point, then to
/// the one furthest from the line, then to the one furthest from the plane.
template <int Dim>
struct Frame {
  Eigen::Matrix<double, Dim, 1> origin;
  Eigen::Matrix<double, Dim, Dim> directions;  ///< orthonormal columns
  std::array<double, Dim> extents{};           ///< [m]
  int span = 0;
  std::vector<Index> vertices;  ///< span + 1 points that span the flat
};

template <int Dim>
Index furthest(
    Points<Dim> points,
    const std::function<double(const Eigen::Matrix<double, Dim, 1>&)>& squared_distance) {
  Index result = 0;
  double most = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double squared = squared_distance(points[i]);
    if (squared <= most) continue;
    most = squared;
    result = static_cast<Index>(i);
  }
  return result;
}

template <int Dim>
Frame<Dim> frame_of(Points<Dim> points, double least_semi_axis) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  Frame<Dim> frame;
  const Vector& any = points.front();
  const Index first =
      furthest<Dim>(points, [&](const Vector& p) { return (p - any).squaredNorm(); });
  frame.origin = points[static_cast<std::size_t>(first)];
  frame.vertices = {first};
  Eigen::Matrix<double, Dim, Dim>& N = frame.directions;
  N.setZero();
  const auto across = [&](const Vector& p) -> Vector {
    Vector w = p - frame.origin;
    for (int round = 0; round < 2; ++round) w -= N * (N.transpose() * w);
    return w;
  };
  for (int k = 0; k < Dim; ++k) {
    const Index vertex =
        furthest<Dim>(points, [&](const Vector& p) { return across(p).squaredNorm(); });
    const Vector direction = across(points[static_cast<std::size_t>(vertex)]);
    const double extent = direction.norm();
    const double none =
        std::max({kFlat * frame.extents[0], kFlatInThickness * least_semi_axis, 1 / kLargest});
    if (!(extent > none)) break;
    frame.extents[static_cast<std::size_t>(k)] = extent;
    N.col(k) = direction / extent;
    frame.vertices.push_back(vertex);
    ++frame.span;
  }
  return frame;
}

/// The ellipsoid within the flat that the first Span directions of the frame span, in W: columns of
/// `axes` beyond Span are zero.
template <int Dim, int Span>
AffineBall<Dim> search_within(Points<Dim> points, const Frame<Dim>& frame, double volume_gap) {
  const Eigen::Matrix<double, Dim, Span> directions = frame.directions.template leftCols<Span>();
  const Eigen::Matrix<double, Span, 1> extents =
      Eigen::Map<const Eigen::Matrix<double, Span, 1>>(frame.extents.data());
  Eigen::Matrix<double, Span, Eigen::Dynamic> scaled(Span, static_cast<Index>(points.size()));
  for (Index i = 0; i < scaled.cols(); ++i) {
    const Eigen::Matrix<double, Dim, 1> w = points[static_cast<std::size_t>(i)] - frame.origin;
    scaled.col(i) = (directions.transpose() * w).cwiseQuotient(extents);
  }
  std::vector<Index> start = frame.vertices;
  for (int k = 0; k < Span; ++k) {
    Index least = 0, most = 0;
    scaled.row(k).minCoeff(&least);
    scaled.row(k).maxCoeff(&most);
    start.insert(start.end(), {least, most});
  }
  AffineBall<Span> found = core_search<Span>(scaled, start, volume_gap);
  const Eigen::Matrix<double, Dim, Span> to_W = directions * extents.asDiagonal();
  AffineBall<Dim> result{frame.origin + to_W * found.center,
                         Eigen::Matrix<double, Dim, Dim>::Zero(), std::move(found.contacts)};
  result.axes.template leftCols<Span>() = to_W * found.axes;
  return result;
}

template <int Dim>
AffineBall<Dim> search(Points<Dim> points, const Frame<Dim>& frame, double volume_gap) {
  if constexpr (Dim == 3) {
    if (frame.span == 3) return search_within<Dim, 3>(points, frame, volume_gap);
  }
  if (frame.span == 2) return search_within<Dim, 2>(points, frame, volume_gap);
  if (frame.span == 1) return search_within<Dim, 1>(points, frame, volume_gap);
  return {frame.origin, Eigen::Matrix<double, Dim, Dim>::Zero(), {{0, 1.0}}};
}

/// Semi-axes, longest first, none shorter than the least, and a rotation for them.
template <int Dim>
EllipsoidN<Dim> with_semi_axes(const AffineBall<Dim>& ball, double least_semi_axis) {
  const Eigen::JacobiSVD<Eigen::Matrix<double, Dim, Dim>> svd(ball.axes, Eigen::ComputeFullU);
  Eigen::Matrix<double, Dim, Dim> rotation = svd.matrixU();
  if (rotation.determinant() < 0) rotation.col(Dim - 1) *= -1;
  return {ball.center, svd.singularValues().cwiseMax(least_semi_axis), rotation};
}

/// The ellipsoid, grown about its centre until it certainly contains the points: see the header.
template <int Dim>
EllipsoidN<Dim> grown_around(Points<Dim> points, const EllipsoidN<Dim>& ellipsoid) {
  double reach = 1;
  for (const Eigen::Matrix<double, Dim, 1>& p : points) {
    const rounding::Length u = rounding::of_unit_point(ellipsoid, p);
    reach = std::max(reach, u.length + 2 * rounding::kHigherOrders * u.error);
  }
  const double factor = reach * (1 + 16 * rounding::kEps);
  return {ellipsoid.center(), factor * ellipsoid.semi_axes(), ellipsoid.rotation()};
}

}  // namespace

template <int Dim>
double least_axis_product(Points<Dim> points, std::span<const Contact> contacts, int span,
                          const Eigen::Matrix<double, Dim, Dim>& directions) {
  // det S is the squared product of the diagonal of R where Q R has the rows sqrt(u_i) (p_i - c)ᵀ,
  // and unlike S these keep all digits of a thin set.
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  using ExtendedVector = Eigen::Matrix<long double, Dim, 1>;
  long double total = 0;
  ExtendedVector center = ExtendedVector::Zero();
  for (const auto& [point, weight] : contacts) {
    center += static_cast<long double>(weight) * points[point].template cast<long double>();
    total += weight;
  }
  center /= total;
  Extended rows(std::max<Index>(static_cast<Index>(contacts.size()), Dim), Dim);
  rows.setZero();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ExtendedVector w = points[contacts[i].point].template cast<long double>() - center;
    rows.row(static_cast<Index>(i)) = std::sqrt(contacts[i].weight / total) * w.transpose();
  }
  const Extended within = rows * directions.template cast<long double>().leftCols(span);
  const Eigen::HouseholderQR<Extended> qr(within);
  long double product = 1;
  for (int k = 0; k < span; ++k) {
    product *= std::sqrt(static_cast<long double>(span)) * std::abs(qr.matrixQR()(k, k));
  }
  return static_cast<double>(product);
}

template <int Dim>
LeastEllipsoid<Dim> least_ellipsoid(Points<Dim> points, const LeastEllipsoidSettings& settings) {
  check<Dim>(points, settings);
  const Frame<Dim> frame = frame_of<Dim>(points, settings.least_semi_axis);
  if (frame.span < Dim && settings.least_semi_axis == 0) {
    const std::array<std::string, 3> flats = {"a point", "a line", "a plane"};
    refuse("a least semi-axis for points that lie in a flat",
           "none for points on " + flats[static_cast<std::size_t>(frame.span)]);
  }
  // The search leaves room for the growth that follows.
  AffineBall<Dim> found = search<Dim>(points, frame, settings.volume_gap / 2);
  const EllipsoidN<Dim> shape =
      grown_around<Dim>(points, with_semi_axes<Dim>(found, settings.least_semi_axis));
  const double least =
      least_axis_product<Dim>(points, found.contacts, frame.span, frame.directions);
  const double product = shape.semi_axes().head(frame.span).prod();
  return {shape, frame.span, product / least - 1, std::move(found.contacts)};
}

template LeastEllipsoid<2> least_ellipsoid<2>(Points<2>, const LeastEllipsoidSettings&);
template LeastEllipsoid<3> least_ellipsoid<3>(Points<3>, const LeastEllipsoidSettings&);
template double least_axis_product<2>(Points<2>, std::span<const Contact>, int,
                                      const Eigen::Matrix2d&);
template double least_axis_product<3>(Points<3>, std::span<const Contact>, int,
                                      const Eigen::Matrix3d&);

}  // namespace bqsa
