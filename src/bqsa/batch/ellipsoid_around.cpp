#include "bqsa/batch/ellipsoid_around.hpp"

#include <cmath>
#include <stdexcept>

namespace bqsa {

template <int Dim>
EllipsoidN<Dim> ellipsoid_around(const EllipsoidN<Dim>& shape, double distance) {
  using Vector = typename EllipsoidN<Dim>::Vector;
  if (!(distance >= 0) || !std::isfinite(distance)) {
    throw std::invalid_argument("ellipsoid around: the distance must not be negative");
  }
  if (distance == 0) return shape;
  const Vector& a = shape.semi_axes();
  const auto axes = [&](double q) -> Vector {
    return ((1 + 1 / q) * a.array().square() + (1 + q) * distance * distance).sqrt();
  };

  // The sum of the axes has one minimum in log q, between those of the shortest and the longest axis,
  // which are least at q = a / distance. Golden section.
  constexpr double kGolden = 0.618'033'988'749'894'8;
  constexpr int kSteps = 30;
  double low = std::log(a.minCoeff() / distance);
  double high = std::log(a.maxCoeff() / distance);
  const auto size = [&](double log_q) { return axes(std::exp(log_q)).sum(); };
  for (int step = 0; step < kSteps; ++step) {
    const double width = kGolden * (high - low);
    if (size(high - width) < size(low + width)) {
      high = low + width;
    } else {
      low = high - width;
    }
  }
  constexpr double kRounding = 1e-15;
  return EllipsoidN<Dim>(shape.center(), (1 + 4 * kRounding) * axes(std::exp((low + high) / 2)),
                         shape.rotation());
}

template <int Dim>
double largest_excess_around(const EllipsoidN<Dim>& shape, double distance) {
  const EllipsoidN<Dim> around = ellipsoid_around(shape, distance);
  return ((around.semi_axes() - shape.semi_axes()).array() - distance).maxCoeff();
}

template Ellipse ellipsoid_around<2>(const Ellipse&, double);
template Ellipsoid ellipsoid_around<3>(const Ellipsoid&, double);
template double largest_excess_around<2>(const Ellipse&, double);
template double largest_excess_around<3>(const Ellipsoid&, double);

}  // namespace bqsa
