/// @file
/// The point of a segment that is nearest to a convex body, by a search with a proven end.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace bqsa::harness {

/// The nearest point of a convex body to a point outside of it.
struct Nearest {
  Eigen::Vector3d offset;  ///< from the body to the point
  Eigen::Vector3d normal;  ///< outward, unit; keeps its accuracy when the offset vanishes
  double distance;
};

/// The point of a segment that is nearest to a convex body.
struct ClosestPoint {
  double t;                ///< its parameter
  double distance;         ///< from the body
  Eigen::Vector3d offset;  ///< from the body to it
  Eigen::Vector3d normal;  ///< unit, of a plane that proves the distance: all of the segment lies
                           ///< that far above the highest point of the body
};

/// Where the search stops: the proven gap to the minimum, of lengths scaled to at most 1.
inline constexpr double kProvenGap = 1e-15;

/// Each of the searches halves its bracket at least every third step and ends long before this.
inline constexpr int kMaxSearchSteps = 300;

/// Minimises the convex t -> distance(p + t d) over [0, 1] by bracketing its derivative d . normal.
/// @param guess    where to look first
/// @param nearest  gives for a point the Nearest of the body, which the segment does not meet
template <typename NearestTo>
ClosestPoint closest_point(const Eigen::Vector3d& p, const Eigen::Vector3d& d, double guess,
                           const NearestTo& nearest) {
  /// A point of the segment, with the derivative of the distance there.
  struct Sample {
    double t;
    Nearest nearest;
    double slope;

    double distance() const { return nearest.distance; }
    double half_square_slope() const { return slope * nearest.distance; }
  };
  const auto sample = [&](double t) {
    const Nearest n = nearest(p + t * d);
    return Sample{t, n, d.dot(n.normal)};
  };
  Sample low = sample(0);
  Sample high = low.slope < 0 ? sample(1) : low;
  if (low.slope < 0 && high.slope > 0) {
    double t = guess;
    double low_weight = low.half_square_slope();
    double high_weight = high.half_square_slope();
    double width = 2;
    int replaced = 0;  // the end that the last step moved
    for (int k = 0; k < kMaxSearchSteps; ++k) {
      // Where the tangents at both ends meet bounds the minimum from below.
      const double rise = low.distance() - high.distance() + high.slope * (high.t - low.t);
      const double bound = low.distance() + low.slope * rise / (high.slope - low.slope);
      if (std::min(low.distance(), high.distance()) - bound <= kProvenGap) break;
      if (k % 3 == 2) {
        if (high.t - low.t > width / 2) t = low.t + (high.t - low.t) / 2;
        width = high.t - low.t;
      }
      if (!(t > low.t && t < high.t)) t = low.t + (high.t - low.t) / 2;
      if (!(t > low.t && t < high.t)) break;  // neighbouring numbers
      const Sample middle = sample(t);
      const double weight = middle.half_square_slope();
      // Regula falsi; an end that stays twice is shrunk by the rule of Anderson and Bjorck.
      if (middle.slope <= 0) {
        const double shrink = 1 - weight / low_weight;
        if (replaced < 0) high_weight *= shrink > 0 ? shrink : 0.5;
        replaced = -1;
        low = middle;
        low_weight = weight;
        if (middle.slope == 0) break;
      } else {
        const double shrink = 1 - weight / high_weight;
        if (replaced > 0) low_weight *= shrink > 0 ? shrink : 0.5;
        replaced = 1;
        high = middle;
        high_weight = weight;
      }
      t = low.t - (high.t - low.t) * low_weight / (high_weight - low_weight);
    }
  } else {
    low = high;  // the minimum is at this end
  }
  const Sample& best = low.distance() < high.distance() ? low : high;
  // The mean of both normals that is perpendicular to the segment gives the plane that proves the
  // bound of the tangents.
  const double steepness = high.slope - low.slope;
  const double share = steepness > 0 ? -low.slope / steepness : 0;
  return {best.t, best.distance(), best.nearest.offset,
          ((1 - share) * low.nearest.normal + share * high.nearest.normal).stableNormalized()};
}

}  // namespace bqsa::harness
