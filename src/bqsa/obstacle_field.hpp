/// @file
/// The obstacles as a BQSA variant sees them, asked by the quadratic test.
#pragma once

#include <memory>
#include <vector>

#include "bqsa/geometry/separation.hpp"
#include "bqsa/neighbourhood/neighbour_lists.hpp"
#include "bqsa/shapes_over_time.hpp"
#include "bqsa/slimness.hpp"

namespace bqsa {

/// All obstacles of a problem in Dim dimensions, with one distance that links must keep from all of
/// them. The distance gives links of radius r room to be and keeps results off the contact
/// threshold. Obstacles that are proven to be far away are not asked (neighbour_lists.hpp); that changes no
/// answer.
template <int Dim>
class ObstacleField {
 public:
  /// Takes over the obstacles, as they are at tick 0; planar fields take the plane section of each.
  /// Quadratics, bounds and distance queries are counted in `counters`. Obstacles and counters must
  /// outlive the field. May allocate.
  ///
  /// @param clearance   link radius and margin [m]. If there are any, a link that the quadratic
  ///                    cannot show to be far enough away is asked for its tight distance
  ///                    (nearest_plane.hpp).
  /// @param neighbours  of the same obstacles, by space; if none are given, the field makes its own
  void assign(const std::vector<Obstacle>& obstacles, WorkCounters& counters, double clearance = 0,
              std::shared_ptr<NeighbourLists> neighbours = nullptr);
  void assign(const std::vector<Obstacle>&&, WorkCounters&, double = 0,
              std::shared_ptr<NeighbourLists> = nullptr) = delete;

  /// The same for the obstacles, the link radii and the margin of a problem: a link keeps as much less
  /// than the distance to keep as it is thinner than the thickest.
  void assign(const Problem& problem, WorkCounters& counters,
              std::shared_ptr<NeighbourLists> neighbours = nullptr);

  /// From now on the obstacles are where they are at this tick.
  void go_to(int tick) { tick_ = tick; }

  /// From now on a link, the thickest there is, that is not proven to be further away than this [m]
  /// counts as hitting.
  void keep(double distance) { distance_ = distance; }

  /// What the link has to keep [m].
  double distance(const Link& link) const {
    return distance_ - slimness_[static_cast<std::size_t>(link.end)];
  }

  const EllipsoidN<Dim>& operator[](int obstacle) const {
    if constexpr (Dim == 2)
      return sections_.at(obstacle, tick_);
    else
      return (*obstacles_)[static_cast<std::size_t>(obstacle)].at(tick_);
  }

  /// The first obstacle, counted from `from`, that the link hits: with which it is in category 3, 4
  /// or 5, or from which it is not far enough away; -1 if none. Does not allocate.
  int first_hit(const ChainPose& pose, const Link& link, int from = 0) const;

  /// How link and obstacle lie to each other.
  struct Proximity {
    double distance;  ///< proven not to be less; not positive exactly if they meet [m]
    double t;         ///< parameter of the link's point P(t) that is next to the obstacle
    Eigen::Matrix<double, Dim, 1> normal;  ///< from the obstacle to that point, length 1; zero at
                                           ///< the centre
  };
  Proximity proximity(const ChainPose& pose, const Link& link, int obstacle) const;

  /// Calls `visit(obstacle, proximity)` for all obstacles, in increasing order, that are not further from
  /// the link than the distance to keep and `beyond` [m].
  template <typename Visit>
  void visit_near(const ChainPose& pose, const Link& link, double beyond,
                  const Visit& visit) const {
    const double kept = distance(link);
    neighbours_->visit({tick_, link, pose, pose, 0, kept + beyond}, [&](int obstacle) {
      const Proximity near = proximity(pose, link, obstacle);
      if (!(kept - near.distance < -beyond)) visit(obstacle, near);
    });
  }

 private:
  using Vector = Eigen::Matrix<double, Dim, 1>;

  bool hit(const Vector& p1, const Vector& p2, double distance, int obstacle) const;

  const std::vector<Obstacle>* obstacles_ = nullptr;
  ShapesOverTime<Ellipse> sections_;  ///< of planar fields
  std::shared_ptr<NeighbourLists> neighbours_;
  int tick_ = 0;
  double distance_ = 0;
  Slimness slimness_{};
  bool tight_ = false;  ///< whether `nearest_plane` is asked
  WorkCounters* counters_ = nullptr;
};

}  // namespace bqsa
