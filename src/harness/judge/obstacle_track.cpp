#include "harness/judge/obstacle_track.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace bqsa::harness {
namespace {

/// The rotation about a fixed direction, by at most half a turn, that leads from one to the other
/// [rad].
Eigen::Vector3d turn_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(to * from.transpose()));
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d turned(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (!(angle > 0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

}  // namespace

ObstacleTrack::ObstacleTrack(const Obstacle& obstacle, int ticks)
    : lever_(obstacle.shape.semi_axes().maxCoeff() - obstacle.shape.semi_axes().minCoeff()) {
  if (!obstacle.moves()) {
    states_.push_back({obstacle.shape.center(), obstacle.shape.rotation()});
    return;
  }
  if (obstacle.motion.size() != static_cast<std::size_t>(ticks) + 1) {
    throw std::invalid_argument("obstacle " + obstacle.name + ": expected one state a tick");
  }
  states_.reserve(obstacle.motion.size());
  for (const Ellipsoid& shape : obstacle.motion) {
    if (shape.semi_axes() != obstacle.shape.semi_axes()) {
      throw std::invalid_argument("obstacle " + obstacle.name + ": expected equal semi-axes");
    }
    ObstacleState state{shape.center(), shape.rotation()};
    if (!states_.empty()) {
      state.velocity = shape.center() - states_.back().center;
      state.spin = turn_between(states_.back().rotation, shape.rotation());
    }
    states_.push_back(state);
  }
}

bool ObstacleTrack::turns() const {
  return std::any_of(states_.begin(), states_.end(),
                     [](const ObstacleState& state) { return state.spin.norm() > 0; });
}

const ObstacleState& ObstacleTrack::end_of(int tick) const {
  return moves() ? states_[static_cast<std::size_t>(tick)] : states_.front();
}

ObstacleState ObstacleTrack::at(const Instant& instant) const {
  ObstacleState state = end_of(instant.tick);
  const double left = 1 - instant.s;
  if (left > 0 && moves()) {
    state.center -= left * state.velocity;
    state.rotation = turned(-left * state.spin) * state.rotation;
  }
  return state;
}

double ObstacleTrack::travel(int tick) const {
  const ObstacleState& state = end_of(tick);
  return state.velocity.norm() + state.spin.norm() * lever_;
}

}  // namespace bqsa::harness
