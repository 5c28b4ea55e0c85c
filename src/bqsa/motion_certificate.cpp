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

/// The same where some joints slide: that adds dq to V and nothing to A, and whatever the joints
/// further out have slid may add to the reach.
MotionCertificate::PointBounds MotionCertificate::sliding_bounds_of(const SerialChain& chain,
                                                                    const JointVector& q0,
                                                                    const JointVector& q1,
                                                                    int point) {
  PointBounds bounds{0, 0};
  double slid = 0;
  for (int j = chain.moving_joints(point) - 1; j >= 0; --j) {
    const double change = std::abs(q1(j) - q0(j));
    if (chain.is_prismatic(j)) {
      bounds.speed += change;
      slid += std::max(std::abs(q0(j)), std::abs(q1(j)));
      continue;
    }
    const double radius = chain.reach(j, point) + slid;
    bounds.acceleration += change * change * radius + 2 * change * bounds.speed;
    bounds.speed += change * radius;
  }
  return bounds;
}

/// The same for all points: V <= T r + S and A <= T² r + 2 T S with T and S the sums of the changes
/// of the joints that turn and of those that slide.
MotionCertificate::PointBounds MotionCertificate::bounds_of_all(const JointVector& q0,
                                                                const JointVector& q1) const {
  const SerialChain& chain = problem_->chain;
  if (!chain.has_prismatic_joints()) {
    const double turn = (q1 - q0).cwiseAbs().sum();
    return {turn * reach_, turn * turn * reach_};
  }
  double turn = 0, slide = 0;
  double radius = reach_;
  for (int j = 0; j < chain.joints(); ++j) {
    const double change = std::abs(q1(j) - q0(j));
    (chain.is_prismatic(j) ? slide : turn) += change;
    if (chain.is_prismatic(j)) radius += std::max(std::abs(q0(j)), std::abs(q1(j)));
  }
  return {turn * radius + slide, turn * turn * radius + 2 * turn * slide};
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
  slimness_ = slimness_of(problem);
  counters_ = &counters;
  neighbours_ = std::make_shared<NeighbourLists>(std::make_shared<ObstacleIndex>(problem.obstacles),
                                                 FreeBy::kSpace, counters);
  const SerialChain& chain = problem.chain;
  reach_ = 0;
  for (int j = 0; j < chain.joints(); ++j) {
    for (int k = 0; k < chain.points(); ++k) reach_ = std::max(reach_, chain.reach(j, k));
  }
  const std::size_t all = chain.links().size() * problem.obstacles.size();
  pairs_.reserve(std::min<std::size_t>(all * (kMaxHalvings + 1), 4096));
  motions_.clear();
  for (const int j : neighbours_->index()->movers()) {
    const Ellipsoid& shape = problem.obstacles[static_cast<std::size_t>(j)].at(0);
    motions_.push_back({0, motion_of(shape, shape)});
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
  if (is_clear(tick, q0, pose0, q1, pose1, 0)) return {};
  q0_ = q0;
  dq_ = q1 - q0;
  for (int k = 0; k < chain.points(); ++k) {
    bounds_[static_cast<std::size_t>(k)] = chain.has_prismatic_joints()
                                               ? sliding_bounds_of(chain, q0, q1, k)
                                               : bounds_of(chain, dq_, k);
  }
  pairs_.clear();
  const Part all{0, 1, pose0, pose1};
  for (int i = 0; i < static_cast<int>(chain.links().size()); ++i) {
    const Link& link = chain.links()[static_cast<std::size_t>(i)];
    const Passage passage = passage_of(tick, link, pose0, pose1, bounds_of(link), clearance(link));
    neighbours_->visit(passage, [&](int j) {
      const Pair pair = pair_of(i, j, tick, pose0);
      if (!separated(all, pair)) pairs_.push_back(pair);
    });
  }
  return halve(all, 0, 0);
}

/// The motion of the link by bounds on its ends' motion.
Passage MotionCertificate::passage_of(int tick, const Link& link, const ChainPose& pose0,
                                      const ChainPose& pose1, const PointBounds& bounds,
                                      double clearance) const {
  return {.tick = tick,
          .link = link,
          .from = pose0,
          .to = pose1,
          .sag = bounds.acceleration / 8,
          .distance = clearance + kShortestPart * bounds.speed +
                      kShortestPart * kShortestPart * bounds.acceleration};
}

/// Of both ends of the link.
MotionCertificate::PointBounds MotionCertificate::bounds_of(const Link& link) const {
  const PointBounds& start = bounds_[static_cast<std::size_t>(link.start)];
  const PointBounds& end = bounds_[static_cast<std::size_t>(link.end)];
  return {std::max(start.speed, end.speed), std::max(start.acceleration, end.acceleration)};
}

bool MotionCertificate::is_clear(int tick, const JointVector& q0, const ChainPose& pose0,
                                 const JointVector& q1, const ChainPose& pose1,
                                 double distance) const {
  const std::span<const Link> links = problem_->chain.links();
  if (links.empty()) return true;
  Passage passage =
      passage_of(tick, links.front(), pose0, pose1, bounds_of_all(q0, q1), clearance_);
  passage.distance = std::max(passage.distance, distance);
  return neighbours_->all_clear(links, passage);
}

MotionCertificate::Pair MotionCertificate::pair_of(int link, int obstacle, int tick,
                                                   const ChainPose& start) {
  const Obstacle& body = problem_->obstacles[static_cast<std::size_t>(obstacle)];
  Pair pair{link, obstacle, -1, 0};
  if (body.moves()) {
    assert(0 < tick && static_cast<std::size_t>(tick) < body.motion.size());
    const std::span<const std::int32_t> movers = neighbours_->index()->movers();
    pair.mover = static_cast<int>(std::ranges::lower_bound(movers, obstacle) - movers.begin());
    KnownMotion& known = motions_[static_cast<std::size_t>(pair.mover)];
    if (known.tick != tick) known = {tick, motion_of(body.at(tick - 1), body.at(tick))};
  }
  const Link& segment = problem_->chain.links()[static_cast<std::size_t>(link)];
  pair.clearance = clearance_of(segment, body.moves() ? body.at(tick - 1) : body.shape, start);
  return pair;
}

double MotionCertificate::clearance_of(const Link& link, const Ellipsoid& shape,
                                       const ChainPose& start) const {
  const double clearance = this->clearance(link);
  if (!(problem_->margin > 0)) return clearance;
  constexpr double kSlack = 1e-3;
  const Eigen::Vector3d p1 = start.p_WO.col(link.start);
  const Eigen::Vector3d p2 = start.p_WO.col(link.end);
  ++counters_->quadratics;
  if (separation<3>(shape, p1, p2) > clearance) return clearance;
  ++counters_->distance_queries;
  const double distance = nearest_plane<3>(shape, p1, p2).distance;
  const double radius = problem_->link_radius - slimness_[static_cast<std::size_t>(link.end)];
  return std::clamp((1 - kSlack) * distance, radius, clearance);
}

/// Certifies the pairs from first_open on, which were found open in this part.
MotionCertificate::Result MotionCertificate::halve(const Part& part, std::size_t first_open,
                                                   int halvings) {
  const std::size_t end = pairs_.size();
  if (end == first_open) return {};
  if (halvings == kMaxHalvings) {
    const Pair& open = pairs_[first_open];
    return {false, problem_->chain.links()[static_cast<std::size_t>(open.link)].number,
            open.obstacle};
  }
  const double middle = 0.5 * (part.s0 + part.s1);
  ChainPose pose;
  problem_->chain.forward(q0_ + middle * dq_, pose);
  ++counters_->kinematics;
  for (const Part& half :
       {Part{part.s0, middle, part.pose0, pose}, Part{middle, part.s1, pose, part.pose1}}) {
    // The pairs that stay open are pushed above those of this part, and popped again.
    for (std::size_t k = first_open; k < end; ++k) {
      const Pair pair = pairs_[k];
      if (!separated(half, pair)) pairs_.push_back(pair);
    }
    const Result result = halve(half, end, halvings + 1);
    pairs_.resize(end);
    if (!result.certified) return result;
  }
  return {};
}

bool MotionCertificate::separated(const Part& part, const Pair& pair) const {
  const Link& link = problem_->chain.links()[static_cast<std::size_t>(pair.link)];
  const Obstacle& body = problem_->obstacles[static_cast<std::size_t>(pair.obstacle)];
  const Motion motion = pair.mover < 0 ? Motion::rest(body.shape)
                                       : motions_[static_cast<std::size_t>(pair.mover)].motion;
  const Ellipsoid& shape = *motion.shape;
  const double h = part.s1 - part.s0;
  ++counters_->quadratics;

  // Corners y, from the centre, and what is left of the clearance for the sag.
  Eigen::Vector3d y_start0 = part.pose0.p_WO.col(link.start) - shape.center();
  Eigen::Vector3d y_start1 = part.pose1.p_WO.col(link.start) - shape.center();
  Eigen::Vector3d y_end0 = part.pose0.p_WO.col(link.end) - shape.center();
  Eigen::Vector3d y_end1 = part.pose1.p_WO.col(link.end) - shape.center();
  const PointBounds bounds = bounds_of(link);
  double acceleration = bounds.acceleration;
  if (!motion.rests) {
    const Eigen::Matrix3d back0 =
        Eigen::AngleAxisd(-part.s0 * motion.angle, motion.axis).toRotationMatrix();
    const Eigen::Matrix3d back1 =
        Eigen::AngleAxisd(-part.s1 * motion.angle, motion.axis).toRotationMatrix();
    y_start0 = back0 * (y_start0 - part.s0 * motion.way);
    y_start1 = back1 * (y_start1 - part.s1 * motion.way);
    y_end0 = back0 * (y_end0 - part.s0 * motion.way);
    y_end1 = back1 * (y_end1 - part.s1 * motion.way);
    const double speed = bounds.speed + motion.way.norm();
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
