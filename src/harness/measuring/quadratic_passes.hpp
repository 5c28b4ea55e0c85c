/// @file
/// One pass of the quadratic test over all pairs of link and obstacle, form by form. Templated on the
/// scalar, so that what is counted is what is timed.
///
/// The answers are those of `hits` and of the categories, without their branches: else the time of a
/// pass would hang on how well the processor foresees the answers, and double where it does not.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "bqsa/geometry/paper_form.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "harness/measuring/unit_ball_map.hpp"

namespace bqsa::harness {

template <typename Scalar, int Dim>
using PointOf = Eigen::Matrix<Scalar, Dim, 1>;

/// `hits` without branches.
template <typename Scalar>
bool meets(const PolarForm<Scalar>& f) {
  const Scalar zero(0);
  const bool starts_inside = f.s11 <= zero;
  const bool ends_inside = f.s22 <= zero;
  const bool between = f.s12 < zero;
  const bool line_enters = f.s12 * f.s12 >= f.s11 * f.s22;
  return starts_inside | ends_inside | (between & line_enters);
}

/// Categories 3 to 5 of the parameter form, without branches.
template <typename Scalar>
bool meets(const ParameterForm<Scalar>& f) {
  const Scalar zero(0);
  const bool starts_inside = f.gamma <= zero;
  const bool ends_inside = f.alpha + f.beta + f.gamma <= zero;
  const bool falls_at_start = f.beta < zero;
  const bool rises_at_end = f.alpha + f.alpha + f.beta > zero;
  const bool line_enters = f.beta * f.beta - Scalar(4) * f.alpha * f.gamma >= zero;
  return starts_inside | ends_inside | (falls_at_start & rises_at_end & line_enters);
}

/// Categories 3 to 5 of `paper_category`, without branches.
template <typename Scalar>
bool meets(const PaperForm<Scalar>& f, const Scalar& x1, const Scalar& x2) {
  const Scalar zero(0);
  const auto value = [&f](const Scalar& x) { return (f.alpha * x + f.beta) * x + f.gamma; };
  const auto slope = [&f](const Scalar& x) { return (f.alpha + f.alpha) * x + f.beta; };
  const bool starts_inside = value(x1) <= zero;
  const bool ends_inside = value(x2) <= zero;
  const bool beyond_an_end = slope(x1) * slope(x2) > zero;
  const bool line_enters = discriminant(f) > zero;
  return line_enters & (starts_inside | ends_inside | !beyond_an_end);
}

/// By the polar form (segment_test.hpp), every end-point mapped once for the two links that share it:
/// 9 multiplications a pair in the plane, 14 in space, and 5 or 9 for the first point of the arm.
/// @param points  O_1 .. O_{n+1}
/// @param hit     of link i and obstacle j at j n + i, counted from 0
template <typename Scalar, int Dim>
void polar_pass(std::span<const UnitBallMap<Scalar, Dim>> obstacles,
                std::span<const PointOf<Scalar, Dim>> points, std::uint8_t* hit) {
  for (const UnitBallMap<Scalar, Dim>& obstacle : obstacles) {
    PointOf<Scalar, Dim> u = unit_point(obstacle.unit_map, obstacle.center, points[0]);
    Scalar level = inner(u, u) - Scalar(1);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const PointOf<Scalar, Dim> next = unit_point(obstacle.unit_map, obstacle.center, points[i]);
      const Scalar next_level = inner(next, next) - Scalar(1);
      *hit++ = meets(PolarForm<Scalar>{level, inner(u, next) - Scalar(1), next_level});
      for (int k = 0; k < Dim; ++k) u(k) = next(k);  // one by one, as they were stored
      level = next_level;
    }
  }
}

/// By the parameter form, pairs sharing nothing: 12 + 3 multiplications in the plane, 21 + 3 in space.
template <typename Scalar, int Dim>
void parameter_pass(std::span<const UnitBallMap<Scalar, Dim>> obstacles,
                    std::span<const PointOf<Scalar, Dim>> points, std::uint8_t* hit) {
  for (const UnitBallMap<Scalar, Dim>& obstacle : obstacles) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const ParameterForm<Scalar> f =
          parameter_form<Scalar, Dim>(unit_point(obstacle.unit_map, obstacle.center, points[i - 1]),
                                      unit_point(obstacle.unit_map, obstacle.center, points[i]));
      *hit++ = meets(f);
    }
  }
}

/// By the form that the paper prints: 22 + 3 multiplications, and 7 for its criteria at the ends, which it
/// does not count.
template <typename Scalar>
void paper_pass(std::span<const Conic<Scalar>> obstacles,
                std::span<const PointOf<Scalar, 2>> points, std::uint8_t* hit) {
  for (const Conic<Scalar>& obstacle : obstacles) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const PaperForm<Scalar> f = paper_form(obstacle, points[i - 1], points[i]);
      *hit++ = meets(f, points[i - 1].x(), points[i].x());
    }
  }
}

/// The same with products of the line's coefficients shared: 18 + 3 multiplications, and 7.
template <typename Scalar>
void paper_shared_pass(std::span<const Conic<Scalar>> obstacles,
                       std::span<const PointOf<Scalar, 2>> points, std::uint8_t* hit) {
  for (const Conic<Scalar>& obstacle : obstacles) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const PaperForm<Scalar> f = paper_form_shared(obstacle, points[i - 1], points[i]);
      *hit++ = meets(f, points[i - 1].x(), points[i].x());
    }
  }
}

/// The paper in space: an obstacle's shadows on the xy-, yz- and zx-plane.
template <typename Scalar>
using ShadowConics = std::array<Conic<Scalar>, 3>;

/// Lemma 1 with the paper's form: a link is taken to hit where its shadow does in all three planes. All
/// three are asked, as the paper has it: 3 (22 + 3) multiplications, and 3 times 7.
template <typename Scalar>
void projections_pass(std::span<const ShadowConics<Scalar>> obstacles,
                      std::span<const PointOf<Scalar, 3>> points, std::uint8_t* hit) {
  for (const ShadowConics<Scalar>& shadows : obstacles) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      unsigned planes_hit = 0;
      for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3;
        const PointOf<Scalar, 2> p1(points[i - 1](k), points[i - 1](l));
        const PointOf<Scalar, 2> p2(points[i](k), points[i](l));
        const PaperForm<Scalar> f = paper_form(shadows[static_cast<std::size_t>(k)], p1, p2);
        planes_hit += meets(f, p1.x(), p2.x());
      }
      *hit++ = planes_hit == 3;
    }
  }
}

}  // namespace bqsa::harness
