#include "bqsa/obstacle_field.hpp"

namespace bqsa {
namespace {

Ellipse as_seen(const Ellipsoid& shape, const Ellipse*) { return planar_section(shape); }
Ellipsoid as_seen(const Ellipsoid& shape, const Ellipsoid*) { return shape; }

}  // namespace

template <int Dim>
void ObstacleField<Dim>::assign(const std::vector<Obstacle>& obstacles, WorkCounters& counters) {
  counters_ = &counters;
  distance_ = 0;
  shapes_.clear();
  for (const Obstacle& obstacle : obstacles) {
    shapes_.push_back(as_seen(obstacle.shape, static_cast<const EllipsoidN<Dim>*>(nullptr)));
  }
}

template <int Dim>
bool ObstacleField<Dim>::hit(const ChainPose& pose, const Link& link, int obstacle) const {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  ++counters_->quadratics;
  const Vector p1 = pose.p_WO.col(link.start).template head<Dim>();
  const Vector p2 = pose.p_WO.col(link.end).template head<Dim>();
  return separation((*this)[obstacle], p1, p2) <= distance_;
}

template <int Dim>
int ObstacleField<Dim>::first_hit(const ChainPose& pose, const Link& link, int from) const {
  for (int j = from; j < static_cast<int>(shapes_.size()); ++j) {
    if (hit(pose, link, j)) return j;
  }
  return -1;
}

template class ObstacleField<2>;
template class ObstacleField<3>;

}  // namespace bqsa
