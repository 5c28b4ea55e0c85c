#include "bqsa/kinematics/planar_tip.hpp"

#include <algorithm>
#include <cmath>

namespace bqsa {

void PlanarTip::assign(const SerialChain& chain, const ChainPose& pose) {
  joints_ = chain.joints();
  const double* p = pose.p_WO.data();
  const double* tip = &pose.p_WO(0, chain.points() - 1);
  double turn_x = 0, turn_y = 0, xx = 0, xy = 0, yy = 0;
  for (int j = 0; j < joints_; ++j, p += 3) {
    const double* next = j + 1 < joints_ ? p + 3 : tip;
    const double Jx = p[1] - tip[1];
    const double Jy = tip[0] - p[0];
    xx += Jx * Jx;
    xy += Jx * Jy;
    yy += Jy * Jy;
    turn_x += Jx;
    turn_y += Jy;
    per_joint_[static_cast<std::size_t>(j)] = {
        {Jx, Jy}, {turn_x, turn_y}, {next[0] - p[0], next[1] - p[1]}};
  }
  gram_ << xx, xy, xy, yy;
}

PlanarTip::Moved PlanarTip::move(const Eigen::Vector2d& y) const {
  double x_way = 0, y_way = 0, xx = 0, xy = 0, yx = 0, yy = 0, largest = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(joints_); ++j) {
    const auto& [J, turn_per_y, link] = per_joint_[j];
    const double turn = turn_per_y[0] * y(0) + turn_per_y[1] * y(1);
    const double squared = turn * turn;
    const double sine = turn - turn * squared * (1.0 / 6 - squared * (1.0 / 120));
    const double less = squared * (0.5 - squared * (1.0 / 24 - squared * (1.0 / 720)));
    // The link turned, less the link.
    const double dx = -link[0] * less - link[1] * sine;
    const double dy = link[0] * sine - link[1] * less;
    x_way += dx;
    y_way += dy;
    // A quarter turn of the link is what it does by its turn.
    const double x_turn = -link[1] - dy;
    const double y_turn = link[0] + dx;
    xx += x_turn * turn_per_y[0];
    xy += x_turn * turn_per_y[1];
    yx += y_turn * turn_per_y[0];
    yy += y_turn * turn_per_y[1];
    largest = std::max(largest, squared);
  }
  Moved moved{{x_way, y_way}, {}, largest <= kSlightTurn * kSlightTurn};
  moved.way_per_y << xx, xy, yx, yy;
  return moved;
}

void PlanarTip::step(const Eigen::Vector2d& y, JointVector& q) const {
  for (int j = 0; j < joints_; ++j) {
    const double* J = per_joint_[static_cast<std::size_t>(j)].J;
    q(j) += J[0] * y(0) + J[1] * y(1);
  }
}

}  // namespace bqsa
