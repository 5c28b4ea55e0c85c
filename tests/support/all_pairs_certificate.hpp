/// @file
/// The certificate of motion_certificate.hpp as it was before it left out pairs: every link is asked about
/// every obstacle. An oracle for what is left out.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "bqsa/geometry/nearest_plane.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "bqsa/geometry/separation.hpp"
#include "bqsa/problem.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa::test_support {

class AllPairsCertificate {
 public:
  /// The links' axes must keep link radius and margin of the problem. Where a motion starts closer
  /// than that, as sensors or an obstacle on the move may have it, it must keep the radius and come
  /// no closer than it started, to 0.1 %. Problem and counters must outlive the certificate. May
  /// allocate.
  void assign(const Problem& problem, WorkCounters& counters);

  struct Result {
    bool certified = true;
    int link = 0;       ///< number of the first link that could not be certified, else 0
    int obstacle = -1;  ///< its obstacle, else -1
  };

  /// The motion from q0 at the tick before `tick` to q1 at `tick`; of obstacles that move, `tick`
  /// is one of 1 .. ticks. Does not allocate.
  Result certify(int tick, const JointVector& q0, const JointVector& q1);

  /// The same for a caller who knows where the links are.
  /// @param pose0, pose1  of q0 and q1
  Result certify(int tick, const JointVector& q0, const ChainPose& pose0, const JointVector& q1,
                 const ChainPose& pose1);

 private:
  /// Parts shorter than 2^-kMaxHalvings of the motion are not halved again.
  static constexpr int kMaxHalvings = 12;

  struct Pair {
    int link;  ///< index into SerialChain::links
    int obstacle;
    double clearance;  ///< to be kept [m]
  };
  struct Part {
    double s0, s1;
    const ChainPose& pose0;
    const ChainPose& pose1;
  };

  /// What an obstacle does between the two ticks.
  struct Motion {
    const Ellipsoid* shape;  ///< at the earlier tick
    bool rests;
    Eigen::Vector3d way;   ///< v, of the centre [m]
    Eigen::Vector3d axis;  ///< of its turn, in W
    double angle;          ///< w, at most pi [rad]
  };

  /// Bounds, over all of the motion, of |dP/ds| and |d²P/ds²| of a link's end-point P [m].
  struct PointBounds {
    double speed, acceleration;
  };

  static Motion motion_of(const Ellipsoid& from, const Ellipsoid& to);
  static PointBounds bounds_of(const SerialChain& chain, const JointVector& dq, int point);

  double clearance_of(const Link& link, int obstacle, const ChainPose& start) const;
  Result certify(const Part& part, std::size_t first_pair, int halvings);
  bool separated(const Part& part, const Pair& pair) const;

  const Problem* problem_ = nullptr;
  double clearance_ = 0;     ///< link radius and margin [m]
  std::vector<Pair> pairs_;  ///< a stack: the pairs still open on each level of halving
  JointVector q0_, dq_;
  std::array<PointBounds, kMaxPoints> bounds_{};
  std::vector<Motion> motions_;  ///< an obstacle each
  WorkCounters* counters_ = nullptr;
};

/// From the outermost moving joint inwards: turning a point that moves with speed V and
/// acceleration A, at most `reach` from the axis, by dq adds dq² reach + 2 dq V to A and dq reach
/// to V.
inline AllPairsCertificate::PointBounds AllPairsCertificate::bounds_of(const SerialChain& chain,
                                                                       const JointVector& dq,
                                                                       int point) {
  PointBounds bounds{0, 0};
  for (int j = chain.moving_joints(point) - 1; j >= 0; --j) {
    const double turn = std::abs(dq(j));
    bounds.acceleration += turn * turn * chain.reach(j, point) + 2 * turn * bounds.speed;
    bounds.speed += turn * chain.reach(j, point);
  }
  return bounds;
}

inline AllPairsCertificate::Motion AllPairsCertificate::motion_of(const Ellipsoid& from,
                                                                  const Ellipsoid& to) {
  Motion motion{&from, true, to.center() - from.center(), Eigen::Vector3d::UnitZ(), 0};
  if (to.rotation() != from.rotation()) {
    const Eigen::AngleAxisd turn(to.rotation() * from.rotation().transpose());
    motion.axis = turn.axis();
    motion.angle = turn.angle();
  }
  motion.rests = motion.angle == 0 && motion.way.isZero(0);
  return motion;
}

inline void AllPairsCertificate::assign(const Problem& problem, WorkCounters& counters) {
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

inline AllPairsCertificate::Result AllPairsCertificate::certify(int tick, const JointVector& q0,
                                                                const JointVector& q1) {
  ChainPose pose0, pose1;
  problem_->chain.forward(q0, pose0);
  problem_->chain.forward(q1, pose1);
  counters_->kinematics += 2;
  return certify(tick, q0, pose0, q1, pose1);
}

inline AllPairsCertificate::Result AllPairsCertificate::certify(int tick, const JointVector& q0,
                                                                const ChainPose& pose0,
                                                                const JointVector& q1,
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

inline double AllPairsCertificate::clearance_of(const Link& link, int obstacle,
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

inline AllPairsCertificate::Result AllPairsCertificate::certify(const Part& part,
                                                                std::size_t first_pair,
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

inline bool AllPairsCertificate::separated(const Part& part, const Pair& pair) const {
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

}  // namespace bqsa::test_support
