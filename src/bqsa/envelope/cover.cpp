#include "bqsa/envelope/cover.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "bqsa/envelope/inflation.hpp"
#include "bqsa/envelope/least_ellipsoid_around.hpp"

namespace bqsa {
namespace {

/// Of the longest semi-axis.
constexpr double kAccuracy = 1e-3;

double volume(const Ellipsoid& ellipsoid) {
  return 4 * std::numbers::pi / 3 * ellipsoid.semi_axes().prod();
}

/// A part of the solid in its ellipsoid.
struct Piece {
  Part part;
  Ellipsoid ellipsoid;
  double inflation;

  Piece(Part of_solid, const Solid& whole, double least_semi_axis)
      : part(std::move(of_solid)),
        ellipsoid(least_ellipsoid_around(part.solid, least_semi_axis, part.slack)),
        inflation(
            largest_inflation(ellipsoid, whole, kAccuracy * ellipsoid.semi_axes().maxCoeff())) {}

  /// Whether division would not make it smaller.
  bool is_least(double least_semi_axis) const {
    constexpr double kRounding = 1e-9;
    return ellipsoid.semi_axes().maxCoeff() <= (1 + kRounding) * least_semi_axis;
  }

  double excess_volume() const { return volume(ellipsoid) - bqsa::volume(part.solid); }

  Eigen::Vector3d longest_axis() const {
    Eigen::Index longest = 0;
    ellipsoid.semi_axes().maxCoeff(&longest);
    return ellipsoid.rotation().col(longest);
  }
};

Cover ledger(const std::vector<Piece>& pieces, const Solid& solid, const CoverSettings& settings) {
  Cover result;
  double total = 0;
  for (const Piece& piece : pieces) {
    result.ellipsoids.push_back(piece.ellipsoid);
    result.inflation = std::max(result.inflation, piece.inflation);
    total += volume(piece.ellipsoid);
  }
  result.volume_ratio = total / bqsa::volume(solid);
  result.within_bounds =
      result.inflation <= settings.inflation && result.volume_ratio <= settings.volume_ratio;
  return result;
}

}  // namespace

Cover cover(const Solid& solid, const CoverSettings& settings) {
  if (!(settings.inflation > 0) || !(settings.volume_ratio > 0) || settings.max_ellipsoids < 1) {
    throw std::invalid_argument("cover: expected positive bounds and at least one ellipsoid");
  }
  const double least = settings.least_semi_axis;
  std::vector<Piece> pieces;
  pieces.emplace_back(Part{solid, settings.margin}, solid, least);
  Cover result = ledger(pieces, solid, settings);
  while (!result.within_bounds && static_cast<int>(pieces.size()) < settings.max_ellipsoids) {
    const bool inflates = result.inflation > settings.inflation;
    const auto worst =
        std::max_element(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) {
          return inflates ? a.inflation < b.inflation : a.excess_volume() < b.excess_volume();
        });
    if (!divisible(worst->part.solid) || worst->is_least(least)) break;
    const std::array<Part, 2> parts = halves(worst->part, worst->longest_axis());
    *worst = Piece(parts[0], solid, least);
    pieces.emplace_back(parts[1], solid, least);
    result = ledger(pieces, solid, settings);
  }
  return result;
}

}  // namespace bqsa
