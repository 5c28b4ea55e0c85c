/// @file
/// FCL behind a plain interface: a capsule-shaped link against ellipsoids and solids. Only the calls that were
/// measured to be right are used, in millimetres; everything here takes and returns metres.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "bqsa/envelope/solid.hpp"
#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::harness {

/// Answers for links of one radius against a fixed list of ellipsoids, and of solids behind them.
class FclCheck {
 public:
  /// @param radius  of every link [m]; 0: links are segments
  /// @param solids  are obstacles too, with the numbers from that of the ellipsoids on
  FclCheck(const std::vector<Ellipsoid>& obstacles, double radius,
           const std::vector<Solid>& solids = {});
  ~FclCheck();

  /// Whether the link from a to b meets the obstacle. The boolean of libccd; links without radius
  /// are judged against ellipsoids by FCL's closed form for a sphere after the affine map of the
  /// ellipsoid to it.
  bool collides(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int obstacle) const;

  /// Distance of a link that does not collide from an ellipsoid [m]. Meaningless for one that does,
  /// and not for solids: with links of little or no radius FCL's own search ends too early at their
  /// edges and corners, up to 0.1 m too far away.
  double distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int obstacle) const;

  /// Whether a link that does not collide is this far from the obstacle, to within `tolerance` [m]:
  /// made thicker by a little less it still misses, by a little more it hits, both by libccd.
  bool confirms(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int obstacle, double distance,
                double tolerance) const;

  /// Asks the installed FCL questions with known answers: a hit and a miss for links with and
  /// without radius, a link inside each kind of obstacle, thin and flat sheets.
  /// @throws std::runtime_error naming the question that it failed
  static void self_test();

 private:
  struct Shapes;
  bool capsule_collides(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius,
                        int obstacle) const;

  std::unique_ptr<const Shapes> shapes_;
};

}  // namespace bqsa::harness
