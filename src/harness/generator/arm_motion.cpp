#include "harness/generator/arm_motion.hpp"

#include <algorithm>
#include <utility>

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

bool ArmMotion::is_closer(int tick, std::size_t link, const PlacedShape& obstacle,
                          double clearance) const {
  const ChainPose& at = pose(tick);
  const Link& ends = problem_.chain.links()[link];
  return obstacle.is_closer(at.p_WO.col(ends.start), at.p_WO.col(ends.end), tick,
                            clearance + problem_.radius_of(link));
}

bool ArmMotion::is_clear(int tick, const PlacedShape& obstacle, double clearance) const {
  for (std::size_t link = 0; link < problem_.chain.links().size(); ++link) {
    if (is_closer(tick, link, obstacle, clearance)) return false;
  }
  return true;
}

}  // namespace bqsa::harness
