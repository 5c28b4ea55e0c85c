/// @file
/// The obstacles as a BQSA variant sees them, asked by the quadratic test.
#pragma once

#include <vector>

#include "bqsa/geometry/separation.hpp"
#include "bqsa/problem.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa {

/// All obstacles of a problem in Dim dimensions, with one distance that links must keep from all of
/// them. The distance gives links of radius r room to be and keeps results off the contact
/// threshold.
template <int Dim>
class ObstacleField {
 public:
  /// Takes over the obstacles, as they are at tick 0; planar fields take the plane section of each.
  /// Quadratics and distance queries are counted in `counters`, which must outlive the field. May
  /// allocate.
  ///
  /// @param clearance  link radius and margin [m]. If there are any, a link that the quadratic
  ///                   cannot show to be far enough away is asked for its tight distance
  ///                   (nearest_plane.hpp).
  void assign(const std::vector<Obstacle>& obstacles, WorkCounters& counters, double clearance = 0);

  /// From now on the obstacles are where they are at this tick. Does not allocate.
  void go_to(int tick);

  /// From now on a link that is not proven to be further away than this [m] counts as hitting.
  void keep(double distance) { distance_ = distance; }

  double distance() const { return distance_; }
  int size() const { return static_cast<int>(shapes_.size()); }

  const EllipsoidN<Dim>& operator[](int obstacle) const {
    return shapes_[static_cast<std::size_t>(obstacle)];
  }

  /// The first obstacle, counted from `from`, that the link hits: with which it is in category 3, 4
  /// or 5, or from which it is not far enough away; -1 if none.
  int first_hit(const ChainPose& pose, const Link& link, int from = 0) const;

  /// How link and obstacle lie to each other.
  struct Proximity {
    double distance;  ///< proven not to be less; not positive exactly if they meet [m]
    double t;         ///< parameter of the link's point P(t) that is next to the obstacle
    Eigen::Matrix<double, Dim, 1> normal;  ///< from the obstacle to that point, length 1; zero at
                                           ///< the centre
  };
  Proximity proximity(const ChainPose& pose, const Link& link, int obstacle) const;

 private:
  bool hit(const ChainPose& pose, const Link& link, int obstacle) const;

  struct Mover {
    std::size_t obstacle;                 ///< index
    std::vector<EllipsoidN<Dim>> motion;  ///< at every tick
  };

  std::vector<EllipsoidN<Dim>> shapes_;
  std::vector<Mover> movers_;
  double distance_ = 0;
  bool tight_ = false;  ///< whether `nearest_plane` is asked
  WorkCounters* counters_ = nullptr;
};

}  // namespace bqsa
