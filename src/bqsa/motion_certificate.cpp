#include "bqsa/motion_certificate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "bqsa/geometry/nearest_plane.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "bqsa/geometry/separation.hpp"

namespace bqsa {

/// From the outermost moving joint inwards: turning a point that moves with speed V and
/// acceleration A, at most `reach` from the axis, by dq adds dq² reach + 2 dq V to A and dq reach
/// to V.
MotionCertificate::PointBounds MotionCertificate::bounds_of(const SerialChain& chain,
                                                            const JointVector& dq, int point) {
  PointBounds bounds{0, 0};
  for (int j = chain.moving_joints(point) - 1; j >= 0; --j) {
    const double turn = std::abs(dq(j));
    bounds.acceleration += turn * turn * chain.reach(j, point) + 2 * turn * bounds.speed;
    bounds.speed += turn * chain.reach(j, point);
  }
  return bounds;
}

MotionCertificate::Motion MotionCertificate::motion_of(const Ellipsoid& from, const Ellipsoid& to) {
  Motion motion{&from, true, to.center() - from.center(), Eigen::Vector3d::UnitZ(), 0};
  if (to.rotation() != from.rotation()) {
    const Eigen::AngleAxisd turn(to.rotation() * from.rotation().transpose());
    motion.axis = turn.axis();
    motion.angle = turn.angle();
  }
  motion.rests = motion.angle == 0 && motion.way.isZero(0);
  return motion;
}

void MotionCertificate::assign(const Problem& problem, WorkCounters& counters) {
  problem_ = &problem;
  clearance_ = problem.link_radius + problem.margin;
  counters_ = &counters;
  const std::size_t all = problem.chain.links().size() * problem.obstacles.size();
  pairs_.reserve(all * (kMaxHalvings + 2));
  motions_.clear();
  for (const Obstacle& obstacle : problem.obstacles) {
    motions_.push_back(motion_of(obstacle.at(0), obstacle.at(0)));
  }
}

MotionCertificate::Result MotionCertificate::certify(int tick, const JointVector& q0,
                                                     const JointVector& q1) {
  ChainPose pose0, pose1;
  problem_->chain.forward(q0, pose0);
  problem_->chain.forward(q1, pose1);
  counters_->kinematics += 2;
  return certify(tick, q0, pose0, q1, pose1);
}

MotionCertificate::Result MotionCertificate::certify(int tick, const JointVector& q0,
                                                     const ChainPose& pose0, const JointVector& q1,
                                                     const ChainPose& pose1) {
  const SerialChain& chain = problem_->chain;
  q0_ = q0;
  dq_ = q1 - q0;
  for (int k = 0; k < chain.points(); ++k) {
    bounds_[static_cast<std::size_t>(k)] = bounds_of(chain, dq_, k);
  }
  for (std::size_t j = 0; j < motions_.size(); ++j) {
    const Obstacle& obstacle = problem_->obstacles[j];
    if (!obstacle.moves()) continue;
    assert(0 < tick && static_cast<std::size_t>(tick) < obstacle.motion.size());
    motions_[j] = motion_of(obstacle.at(tick - 1), obstacle.at(tick));
  }
  pairs_.clear();
  for (int i = 0; i < static_cast<int>(chain.links().size()); ++i) {
    const Link& link = chain.links()[static_cast<std::size_t>(i)];
    for (int j = 0; j < static_cast<int>(problem_->obstacles.size()); ++j) {
      pairs_.push_back({i, j, clearance_of(link, j, pose0)});
    }
  }
  return certify({0, 1, pose0, pose1}, 0, 0);
}

double MotionCertificate::clearance_of(const Link& link, int obstacle,
                                       const ChainPose& start) const {
  if (!(problem_->margin > 0)) return clearance_;
  constexpr double kSlack = 1e-3;
  const Ellipsoid& shape = *motions_[static_cast<std::size_t>(obstacle)].shape;
  const Eigen::Vector3d p1 = start.p_WO.col(link.start);
  const Eigen::Vector3d p2 = start.p_WO.col(link.end);
  ++counters_->quadratics;
  if (separation<3>(shape, p1, p2) > clearance_) return clearance_;
  ++counters_->distance_queries;
  const double distance = nearest_plane<3>(shape, p1, p2).distance;
  return std::clamp((1 - kSlack) * distance, problem_->link_radius, clearance_);
}

MotionCertificate::Result MotionCertificate::certify(const Part& part, std::size_t first_pair,
                                                     int halvings) {
  // The pairs that stay open are pushed above those of this level, and popped on return.
  const std::size_t first_open = pairs_.size();
  for (std::size_t k = first_pair; k < first_open; ++k) {
    const Pair pair = pairs_[k];
    if (!separated(part, pair)) pairs_.push_back(pair);
  }
  Result result;
  if (pairs_.size() > first_open) {
    if (halvings == kMaxHalvings) {
      const Pair open = pairs_[first_open];
      return {false, problem_->chain.links()[static_cast<std::size_t>(open.link)].number,
              open.obstacle};
    }
    const double middle = 0.5 * (part.s0 + part.s1);
    ChainPose pose;
    problem_->chain.forward(q0_ + middle * dq_, pose);
    ++counters_->kinematics;
    result = certify({part.s0, middle, part.pose0, pose}, first_open, halvings + 1);
    if (result.certified) {
      result = certify({middle, part.s1, pose, part.pose1}, first_open, halvings + 1);
    }
  }
  pairs_.resize(first_open);
  return result;
}

bool MotionCertificate::separated(const Part& part, const Pair& pair) const {
  const Link& link = problem_->chain.links()[static_cast<std::size_t>(pair.link)];
  const Motion& motion = motions_[static_cast<std::size_t>(pair.obstacle)];
  const Ellipsoid& shape = *motion.shape;
  const double h = part.s1 - part.s0;
  ++counters_->quadratics;

  // Corners y, from the centre, and what is left of the clearance for the sag.
  Eigen::Vector3d y_start0 = part.pose0.p_WO.col(link.start) - shape.center();
  Eigen::Vector3d y_start1 = part.pose1.p_WO.col(link.start) - shape.center();
  Eigen::Vector3d y_end0 = part.pose0.p_WO.col(link.end) - shape.center();
  Eigen::Vector3d y_end1 = part.pose1.p_WO.col(link.end) - shape.center();
  const PointBounds& start_bounds = bounds_[static_cast<std::size_t>(link.start)];
  const PointBounds& end_bounds = bounds_[static_cast<std::size_t>(link.end)];
  double acceleration = std::max(start_bounds.acceleration, end_bounds.acceleration);
  if (!motion.rests) {
    const Eigen::Matrix3d back0 =
        Eigen::AngleAxisd(-part.s0 * motion.angle, motion.axis).toRotationMatrix();
    const Eigen::Matrix3d back1 =
        Eigen::AngleAxisd(-part.s1 * motion.angle, motion.axis).toRotationMatrix();
    y_start0 = back0 * (y_start0 - part.s0 * motion.way);
    y_start1 = back1 * (y_start1 - part.s1 * motion.way);
    y_end0 = back0 * (y_end0 - part.s0 * motion.way);
    y_end1 = back1 * (y_end1 - part.s1 * motion.way);
    const double speed = std::max(start_bounds.speed, end_bounds.speed) + motion.way.norm();
    const double furthest = std::sqrt(std::max({y_start0.squaredNorm(), y_start1.squaredNorm(),
                                                y_end0.squaredNorm(), y_end1.squaredNorm()})) +
                            0.5 * h * speed;
    acceleration += 2 * motion.angle * speed + motion.angle * motion.angle * furthest;
  }
  const double room = h * h / 8 * acceleration + pair.clearance;

  const auto unit = [&shape](const Eigen::Vector3d& y) {
    return unit_point<double, 3>(shape.unit_map(), Eigen::Vector3d::Zero(), y);
  };
  const Eigen::Vector3d start0 = unit(y_start0), start1 = unit(y_start1);
  const Eigen::Vector3d end0 = unit(y_end0), end1 = unit(y_end1);
  const auto plane_of = [&](const Eigen::Vector3d& start, const Eigen::Vector3d& end) {
    const Eigen::Vector3d u = start + vertex(polar_form<double, 3>(start, end)) * (end - start);
    const double nearest =
        std::min({u.dot(start0), u.dot(start1), u.dot(end0), u.dot(end1)}) - u.norm();
    return nearest > room * (shape.unit_map().transpose() * u).norm();
  };
  if (plane_of(0.5 * (start0 + start1), 0.5 * (end0 + end1)) || plane_of(start0, end0) ||
      plane_of(start1, end1)) {
    return true;
  }
  if (!(pair.clearance > 0)) return false;

  ++counters_->distance_queries;
  const Eigen::Vector3d n = nearest_plane<3>(shape, shape.center() + 0.5 * (y_start0 + y_start1),
                                             shape.center() + 0.5 * (y_end0 + y_end1))
                                .normal;
  return std::min({n.dot(y_start0), n.dot(y_start1), n.dot(y_end0), n.dot(y_end1)}) -
             shape.support(n) >
         room;
}

}  // namespace bqsa
