#include "bqsa/motion_certificate.hpp"

#include <algorithm>
#include <cmath>

#include "bqsa/geometry/segment_test.hpp"

namespace bqsa {
namespace {

/// Bound on |d²P/ds²| of a point when every joint turns evenly by dq over s in [0, 1]. From the
/// outermost moving joint inwards: turning a point that moves with speed V and acceleration A, at
/// most `reach` from the axis, by dq adds dq² reach + 2 dq V to A and dq reach to V.
double acceleration_bound(const SerialChain& chain, const JointVector& dq, int point) {
  double speed = 0;
  double acceleration = 0;
  for (int j = chain.moving_joints(point) - 1; j >= 0; --j) {
    const double turn = std::abs(dq(j));
    acceleration += turn * turn * chain.reach(j, point) + 2 * turn * speed;
    speed += turn * chain.reach(j, point);
  }
  return acceleration;
}

}  // namespace

void MotionCertificate::assign(const Problem& problem, double clearance, WorkCounters& counters) {
  problem_ = &problem;
  clearance_ = clearance;
  counters_ = &counters;
  const std::size_t all = problem.chain.links().size() * problem.obstacles.size();
  pairs_.reserve(all * (kMaxHalvings + 2));
}

MotionCertificate::Result MotionCertificate::certify(int /*tick*/, const JointVector& q0,
                                                     const JointVector& q1) {
  const SerialChain& chain = problem_->chain;
  q0_ = q0;
  dq_ = q1 - q0;
  for (int k = 0; k < chain.points(); ++k) {
    acceleration_[static_cast<std::size_t>(k)] = acceleration_bound(chain, dq_, k);
  }
  pairs_.clear();
  for (int i = 0; i < static_cast<int>(chain.links().size()); ++i) {
    for (int j = 0; j < static_cast<int>(problem_->obstacles.size()); ++j) pairs_.push_back({i, j});
  }
  ChainPose pose0, pose1;
  chain.forward(q0, pose0);
  chain.forward(q1, pose1);
  counters_->kinematics += 2;
  return certify({0, 1, pose0, pose1}, 0, 0);
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
  const Ellipsoid& shape = problem_->obstacles[static_cast<std::size_t>(pair.obstacle)].shape;
  const auto corner = [&shape](const ChainPose& pose, int point) {
    return unit_point<3>(shape, pose.p_WO.col(point));
  };
  const Eigen::Vector3d start0 = corner(part.pose0, link.start);
  const Eigen::Vector3d start1 = corner(part.pose1, link.start);
  const Eigen::Vector3d end0 = corner(part.pose0, link.end);
  const Eigen::Vector3d end1 = corner(part.pose1, link.end);

  ++counters_->quadratics;

  const double h = part.s1 - part.s0;
  const double sag = h * h / 8 *
                     std::max(acceleration_[static_cast<std::size_t>(link.start)],
                              acceleration_[static_cast<std::size_t>(link.end)]);
  const auto plane_of = [&](const Eigen::Vector3d& start, const Eigen::Vector3d& end) {
    const Eigen::Vector3d u = start + vertex(polar_form<double, 3>(start, end)) * (end - start);
    const double nearest =
        std::min({u.dot(start0), u.dot(start1), u.dot(end0), u.dot(end1)}) - u.norm();
    return nearest > (sag + clearance_) * (shape.unit_map().transpose() * u).norm();
  };
  return plane_of(0.5 * (start0 + start1), 0.5 * (end0 + end1)) || plane_of(start0, end0) ||
         plane_of(start1, end1);
}

}  // namespace bqsa
