/// @file
/// The judge's own exact distance between a segment and a convex solid. Shares no code with FCL or
/// src/bqsa, of which it takes plain data.
#pragma once

#include <Eigen/Core>
#include <variant>

#include "bqsa/envelope/solid.hpp"
#include "harness/judge/exact_polytope.hpp"
#include "harness/judge/solid_clearance.hpp"

namespace bqsa::harness {

/// A solid made ready for many questions.
class ExactSolid {
 public:
  /// @throws std::invalid_argument if the solid is a hull that spans no plane
  explicit ExactSolid(const Solid& solid);

  /// Of the segment from a to b, which may be a point. Wholly inside is deep, not far.
  SolidClearance clearance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

 private:
  std::variant<ExactPolytope, Cylinder, Capsule> shape_;  // a ball is a capsule of one point
};

}  // namespace bqsa::harness
