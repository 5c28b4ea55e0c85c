#include "bqsa/obstacle_field.hpp"

namespace bqsa {
namespace {

Ellipse as_seen(const Ellipsoid& shape, Ellipse*) { return planar_section(shape); }
Ellipsoid as_seen(const Ellipsoid& shape, Ellipsoid*) { return shape; }

}  // namespace

template <int Dim>
void ObstacleField<Dim>::assign(const std::vector<Obstacle>& obstacles, WorkCounters& counters) {
  counters_ = &counters;
  shapes_.clear();
  for (const Obstacle& obstacle : obstacles) {
    shapes_.push_back(as_seen(obstacle.shape, static_cast<EllipsoidN<Dim>*>(nullptr)));
  }
  grown_ = shapes_;
  offset_ = 0;
}

template <int Dim>
void ObstacleField<Dim>::grow(double offset) {
  if (offset == offset_) return;
  for (std::size_t j = 0; j < shapes_.size(); ++j) grown_[j] = shapes_[j].grown(offset);
  offset_ = offset;
}

template <int Dim>
PolarForm<double> ObstacleField<Dim>::quadratic(const ChainPose& pose, const Link& link,
                                                int obstacle) const {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  ++counters_->quadratics;
  const Vector p1 = pose.p_WO.col(link.start).template head<Dim>();
  const Vector p2 = pose.p_WO.col(link.end).template head<Dim>();
  return polar_form((*this)[obstacle], p1, p2);
}

template <int Dim>
int ObstacleField<Dim>::first_hit(const ChainPose& pose, const Link& link, int from) const {
  for (int j = from; j < size(); ++j) {
    if (hits(quadratic(pose, link, j))) return j;
  }
  return -1;
}

template class ObstacleField<2>;
template class ObstacleField<3>;

}  // namespace bqsa
