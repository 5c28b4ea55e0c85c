#include "bqsa/obstacle_field.hpp"

#include <utility>

#include "bqsa/geometry/nearest_plane.hpp"

namespace bqsa {
namespace {

Ellipse as_seen(const Ellipsoid& shape, const Ellipse*) { return planar_section(shape); }
Ellipsoid as_seen(const Ellipsoid& shape, const Ellipsoid*) { return shape; }

}  // namespace

template <int Dim>
void ObstacleField<Dim>::assign(const std::vector<Obstacle>& obstacles, WorkCounters& counters,
                                double clearance) {
  counters_ = &counters;
  distance_ = 0;
  tight_ = clearance > 0;
  shapes_.clear();
  movers_.clear();
  const EllipsoidN<Dim>* const kind = nullptr;
  for (const Obstacle& obstacle : obstacles) {
    if (obstacle.moves()) {
      Mover mover{shapes_.size(), {}};
      for (const Ellipsoid& shape : obstacle.motion) mover.motion.push_back(as_seen(shape, kind));
      movers_.push_back(std::move(mover));
    }
    shapes_.push_back(as_seen(obstacle.at(0), kind));
  }
}

template <int Dim>
void ObstacleField<Dim>::go_to(int tick) {
  for (const Mover& mover : movers_) {
    shapes_[mover.obstacle] = mover.motion[static_cast<std::size_t>(tick)];
  }
}

template <int Dim>
bool ObstacleField<Dim>::hit(const ChainPose& pose, const Link& link, int obstacle) const {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  ++counters_->quadratics;
  const Vector p1 = pose.p_WO.col(link.start).template head<Dim>();
  const Vector p2 = pose.p_WO.col(link.end).template head<Dim>();
  const double bound = separation((*this)[obstacle], p1, p2);
  if (bound > distance_) return false;
  if (!tight_ || bound <= 0) return true;
  ++counters_->distance_queries;
  return nearest_plane<Dim>((*this)[obstacle], p1, p2, distance_).distance <= distance_;
}

template <int Dim>
int ObstacleField<Dim>::first_hit(const ChainPose& pose, const Link& link, int from) const {
  for (int j = from; j < static_cast<int>(shapes_.size()); ++j) {
    if (hit(pose, link, j)) return j;
  }
  return -1;
}

template <int Dim>
typename ObstacleField<Dim>::Proximity ObstacleField<Dim>::proximity(const ChainPose& pose,
                                                                     const Link& link,
                                                                     int obstacle) const {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  const EllipsoidN<Dim>& shape = (*this)[obstacle];
  const Vector p1 = pose.p_WO.col(link.start).template head<Dim>();
  const Vector p2 = pose.p_WO.col(link.end).template head<Dim>();
  const Vector u1 = unit_point(shape, p1);
  const Vector u2 = unit_point(shape, p2);
  ++counters_->quadratics;
  const double t = vertex(polar_form<double, Dim>(u1, u2));
  const Vector u = u1 + t * (u2 - u1);
  const Vector normal = shape.unit_map().transpose() * u;
  const double steepness = normal.norm();
  if (!(steepness > 0)) return {-shape.semi_axes().minCoeff(), t, Vector::Zero()};
  const double distance = u.norm() * (u.norm() - 1) / steepness;
  if (!tight_ || distance <= 0 || distance > distance_) {
    return {distance, t, normal / steepness};
  }
  ++counters_->distance_queries;
  const NearestPlane<Dim> plane = nearest_plane<Dim>(shape, p1, p2);
  return {plane.distance, plane.t, plane.normal};
}

template class ObstacleField<2>;
template class ObstacleField<3>;

}  // namespace bqsa
