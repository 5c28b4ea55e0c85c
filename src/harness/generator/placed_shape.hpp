/// @file
/// An obstacle of a draft as it is, at the ticks.
#pragma once

#include <Eigen/Core>
#include <variant>

#include "bqsa/problem.hpp"
#include "harness/generator/scenario_draft.hpp"
#include "harness/judge/exact_solid.hpp"

namespace bqsa::harness {

/// An ellipsoid, which may move, or a solid at rest.
class PlacedShape {
 public:
  PlacedShape(const Obstacle& ellipsoid);  // NOLINT(google-explicit-constructor)
  PlacedShape(const ObstacleDraft& draft, const Problem& problem);

  bool moves() const;

  /// Whether a segment is closer to the shape at a tick than `clearance`, or, where that is negative,
  /// deeper in it [m].
  bool is_closer(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int tick,
                 double clearance) const;

 private:
  std::variant<Obstacle, ExactSolid> shape_;
  Eigen::Vector3d center_;  ///< of a solid [m]
  double radius_;           ///< of a sphere around it [m]
};

}  // namespace bqsa::harness
