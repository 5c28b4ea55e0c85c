/// @file
/// Segment-ellipsoid pairs of all families (segment_families.hpp) in the layout of the batched test,
/// with the answers of 113-bit arithmetic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "../geometry/segment_families.hpp"
#include "bqsa/batch/obstacle_batch.hpp"
#include "support/exact_segment_test.hpp"

namespace bqsa::test_support {

inline constexpr std::array kAllFamilies = {Family::kRandom,       Family::kVertical,
                                            Family::kNearVertical, Family::kHorizontal,
                                            Family::kZeroLength,   Family::kContained,
                                            Family::kFar,          Family::kNeedle,
                                            Family::kSheet,        Family::kMillimetresToKilometres,
                                            Family::kTangent,      Family::kEndOnSurface};

/// The exact test of the same link and the ellipsoid `scale` times as large.
inline ExactSegmentTest scaled(const ExactSegmentTest& exact, double scale) {
  const Quad square = Quad(scale) * scale;
  return {(exact.start_level + 1) / square - 1,
          (exact.end_level + 1) / square - 1,
          (exact.product + 1) / square - 1,
          exact.length2 / square,
          exact.area2 / (square * square),
          exact.towards / square,
          exact.beyond / square};
}

inline bool is_hit(const ExactSegmentTest& exact) { return exact.category() >= 3; }

/// Obstacles of a family and one chain of links among them: link 2 j is the one made for obstacle j,
/// the others lead from there to the next.
template <int Dim>
struct BatchCase {
  std::vector<EllipsoidN<Dim>> shapes;
  std::vector<Eigen::Matrix<double, Dim, 1>> points;

  int links() const { return static_cast<int>(points.size()) - 1; }
  int own_link(int obstacle) const { return 2 * obstacle; }

  const Eigen::Matrix<double, Dim, 1>& start(int link) const {
    return points[static_cast<std::size_t>(link)];
  }
  const Eigen::Matrix<double, Dim, 1>& end(int link) const {
    return points[static_cast<std::size_t>(link) + 1];
  }

  /// The least that holds the chain.
  Workspace workspace() const {
    Workspace least{.reach = 0, .link_length = 0};
    for (const auto& p : points) least.reach = std::max(least.reach, p.cwiseAbs().maxCoeff());
    for (int i = 0; i < links(); ++i) {
      least.link_length = std::max(least.link_length, (end(i) - start(i)).norm());
    }
    least.reach *= 1 + 1e-6;  // rounded to float a point may lie further out
    return least;
  }

  template <typename Real>
  std::vector<Real> coordinates() const {
    std::vector<Real> numbers;
    for (const auto& p : points) {
      for (const double x : p) numbers.push_back(static_cast<Real>(x));
    }
    return numbers;
  }
};

template <int Dim>
BatchCase<Dim> make_batch_case(Family family, int obstacles, Generator& generator) {
  BatchCase<Dim> batch;
  for (int j = 0; j < obstacles; ++j) {
    const Pair<Dim> pair = make_pair<Dim>(family, generator);
    batch.shapes.push_back(pair.ellipsoid);
    batch.points.push_back(pair.p1);
    batch.points.push_back(pair.p2);
  }
  return batch;
}

}  // namespace bqsa::test_support
