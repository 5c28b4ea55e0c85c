/// @file
/// FCL behind a plain interface: a capsule-shaped link against ellipsoids. Only the calls that were
/// measured to be right are used, in millimetres; everything here takes and returns metres.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::harness {

/// Answers for links of one radius against a fixed list of ellipsoids.
class FclCheck {
 public:
  /// @param radius  of every link [m]; 0: links are segments
  FclCheck(const std::vector<Ellipsoid>& obstacles, double radius);
  ~FclCheck();

  /// Whether the link from a to b meets the obstacle. The boolean of libccd; links without radius
  /// are judged by FCL's closed form for a sphere after the affine map of the ellipsoid to it.
  bool collides(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int obstacle) const;

  /// Distance of a link that does not collide [m]. Meaningless for one that does.
  double distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int obstacle) const;

  /// Asks the installed FCL questions with known answers: a hit and a miss for links with and
  /// without radius, a link inside an ellipsoid, a thin sheet.
  /// @throws std::runtime_error naming the question that it failed
  static void self_test();

 private:
  struct Shapes;
  std::unique_ptr<const Shapes> shapes_;
};

}  // namespace bqsa::harness
