#include "bqsa/obstacle_field.hpp"

#include <utility>

#include "bqsa/geometry/nearest_plane.hpp"

namespace bqsa {

template <int Dim>
void ObstacleField<Dim>::assign(const std::vector<Obstacle>& obstacles, WorkCounters& counters,
                                double clearance, std::shared_ptr<NeighbourLists> neighbours) {
  obstacles_ = &obstacles;
  counters_ = &counters;
  tick_ = 0;
  distance_ = 0;
  slimness_ = {};
  tight_ = clearance > 0;
  if constexpr (Dim == 2) sections_.assign(obstacles, planar_section);
  if (neighbours == nullptr) {
    neighbours = std::make_shared<NeighbourLists>(std::make_shared<ObstacleIndex>(obstacles),
                                                  FreeBy::kSpace, counters);
  }
  neighbours_ = std::move(neighbours);
}

template <int Dim>
void ObstacleField<Dim>::assign(const Problem& problem, WorkCounters& counters,
                                std::shared_ptr<NeighbourLists> neighbours) {
  assign(problem.obstacles, counters, problem.link_radius + problem.margin, std::move(neighbours));
  slimness_ = slimness_of(problem);
}

template <int Dim>
bool ObstacleField<Dim>::hit(const Vector& p1, const Vector& p2, double distance,
                             int obstacle) const {
  ++counters_->quadratics;
  const double bound = separation((*this)[obstacle], p1, p2);
  if (bound > distance) return false;
  if (!tight_ || bound <= 0) return true;
  ++counters_->distance_queries;
  return nearest_plane<Dim>((*this)[obstacle], p1, p2, distance).distance <= distance;
}

template <int Dim>
int ObstacleField<Dim>::first_hit(const ChainPose& pose, const Link& link, int from) const {
  const Vector p1 = pose.p_WO.col(link.start).template head<Dim>();
  const Vector p2 = pose.p_WO.col(link.end).template head<Dim>();
  const double kept = distance(link);
  return neighbours_->find({tick_, link, pose, pose, 0, kept}, from,
                           [&](int obstacle) { return hit(p1, p2, kept, obstacle); });
}

template <int Dim>
typename ObstacleField<Dim>::Proximity ObstacleField<Dim>::proximity(const ChainPose& pose,
                                                                     const Link& link,
                                                                     int obstacle) const {
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
  if (!tight_ || distance <= 0 || distance > this->distance(link)) {
    return {distance, t, normal / steepness};
  }
  ++counters_->distance_queries;
  const NearestPlane<Dim> plane = nearest_plane<Dim>(shape, p1, p2);
  return {plane.distance, plane.t, plane.normal};
}

template class ObstacleField<2>;
template class ObstacleField<3>;

}  // namespace bqsa
