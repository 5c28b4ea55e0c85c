#include "harness/generator/arm_motion.hpp"

#include <algorithm>
#include <utility>

#include "harness/judge/exact_distance.hpp"

namespace bqsa::harness {

ArmMotion::ArmMotion(const Problem& problem, std::vector<JointVector> q)
    : problem_(problem), q_(std::move(q)) {
  for (const JointVector& angles : q_) problem_.chain.forward(angles, poses_.emplace_back());
}

Trajectory ArmMotion::trajectory() const {
  Trajectory trajectory{.t = {}, .q = q_};
  for (std::size_t tick = 0; tick < q_.size(); ++tick) {
    trajectory.t.push_back(problem_.time(static_cast<int>(tick)));
  }
  return trajectory;
}

bool ArmMotion::keeps_limits() const {
  return q_.size() == static_cast<std::size_t>(problem_.ticks) + 1 &&
         std::all_of(q_.begin(), q_.end(), [this](const JointVector& q) {
           return q.allFinite() && problem_.within_limits(q);
         });
}

bool ArmMotion::tracks() const {
  if (q_.size() != static_cast<std::size_t>(problem_.ticks) + 1) return false;
  for (int tick = 1; tick <= problem_.ticks; ++tick) {
    const Eigen::Vector3d desired = problem_.desired_tip(problem_.time(tick));
    if (!((pose(tick).tip() - desired).norm() <= problem_.tolerance)) return false;
    const JointVector& q = q_[static_cast<std::size_t>(tick)];
    const JointVector& q_last = q_[static_cast<std::size_t>(tick) - 1];
    for (int j = 0; j < problem_.chain.joints(); ++j) {
      if (!(std::abs(q(j) - q_last(j)) <= problem_.max_step(j))) return false;
    }
  }
  return true;
}

bool ArmMotion::is_closer(int tick, const Link& link, const Obstacle& obstacle,
                          double clearance) const {
  const ChainPose& at = pose(tick);
  return harness::is_closer(at.p_WO.col(link.start), at.p_WO.col(link.end), obstacle.at(tick),
                            clearance);
}

bool ArmMotion::is_clear(int tick, const Obstacle& obstacle, double clearance) const {
  const auto links = problem_.chain.links();
  return std::none_of(links.begin(), links.end(),
                      [&](const Link& link) { return is_closer(tick, link, obstacle, clearance); });
}

bool is_closer(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Ellipsoid& shape,
               double clearance) {
  const double outer_radius = (b - a).norm() / 2 + shape.semi_axes().maxCoeff();
  if (((a + b) / 2 - shape.center()).norm() > outer_radius + std::max(clearance, 0.0)) return false;
  return exact_distance(a, b, shape).clearance() < clearance;
}

}  // namespace bqsa::harness
