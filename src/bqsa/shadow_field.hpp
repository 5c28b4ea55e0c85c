/// @file
/// The obstacles as their shadows on the three coordinate planes (paper, section 2.1, Lemma 1).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bqsa/neighbourhood/neighbour_lists.hpp"
#include "bqsa/shapes_over_time.hpp"
#include "bqsa/slimness.hpp"

namespace bqsa {

/// A plane of W, by its two axes in the order in which they count as first and second.
enum class CoordinatePlane { kXy, kYz, kZx };
inline constexpr std::array kCoordinatePlanes = {CoordinatePlane::kXy, CoordinatePlane::kYz,
                                                 CoordinatePlane::kZx};

/// Orthogonal projection on the plane, in its own two coordinates.
Eigen::Vector2d projected(const Eigen::Vector3d& p, CoordinatePlane plane);

/// All obstacles of a spatial problem by their shadows, with one distance that links must keep from
/// them. A link hits an obstacle if its own shadow hits the obstacle's in all three planes. By
/// Lemma 1 every link that hits in space does so here; the converse is false, so that links can hit
/// here that are free in space. A projection shortens all distances, so that the distance in any
/// one plane is a lower bound of the one in space. Obstacles that are proven to be free in a plane are not
/// asked (neighbour_lists.hpp); that changes no answer.
class ShadowField {
 public:
  /// Takes the shadows of all obstacles, of moving ones at every tick, and goes to tick 0.
  /// Quadratics, bounds and distance queries are counted in `counters`. Obstacles and counters must
  /// outlive the field. May allocate.
  ///
  /// @param clearance  link radius and margin [m]. If there are any, shadows that the quadratics
  ///                   cannot show to be far enough apart are asked for their tight distance
  ///                   (nearest_plane.hpp).
  /// @param index      of the same obstacles; if none is given, the field makes its own
  void assign(const std::vector<Obstacle>& obstacles, WorkCounters& counters, double clearance = 0,
              std::shared_ptr<const ObstacleIndex> index = nullptr);
  void assign(const std::vector<Obstacle>&&, WorkCounters&, double = 0,
              std::shared_ptr<const ObstacleIndex> = nullptr) = delete;

  /// The same for the obstacles, the link radii and the margin of a problem: a link keeps as much less
  /// than the distance to keep as it is thinner than the thickest.
  void assign(const Problem& problem, WorkCounters& counters,
              std::shared_ptr<const ObstacleIndex> index = nullptr);

  /// From now on the obstacles are where they are at this tick.
  void go_to(int tick) { tick_ = tick; }

  /// From now on shadows that are not proven to be further apart than this [m], that of the thickest
  /// link, count as hitting.
  void keep(double distance) { distance_ = distance; }

  /// The first obstacle, counted from `from`, that the link hits; -1 if none. The planes are asked
  /// in turn until one says free: one to three quadratics an obstacle. Does not allocate.
  int first_hit(const ChainPose& pose, const Link& link, int from = 0) const;

 private:
  using Shadows = std::array<Ellipse, kCoordinatePlanes.size()>;

  bool hit(const Shadows& shadows, const Eigen::Vector3d& p1, const Eigen::Vector3d& p2,
           double distance) const;

  ShapesOverTime<Shadows> shadows_;
  std::unique_ptr<NeighbourLists> neighbours_;
  int tick_ = 0;
  double distance_ = 0;
  Slimness slimness_{};
  bool tight_ = false;  ///< whether `nearest_plane` is asked
  WorkCounters* counters_ = nullptr;
};

}  // namespace bqsa
