#include "harness/generator/nominal_motion.hpp"

#include <algorithm>

#include "baselines/plain_tracking.hpp"
#include "harness/judge/exact_distance.hpp"
#include "harness/runner.hpp"

namespace bqsa::harness {
namespace {

/// Whether the segment is closer to the shape than `clearance`, or, where that is negative, deeper
/// in it [m].
bool segment_is_closer(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Ellipsoid& shape,
                       double clearance) {
  const double outer_radius = (b - a).norm() / 2 + shape.semi_axes().maxCoeff();
  if (((a + b) / 2 - shape.center()).norm() > outer_radius + std::max(clearance, 0.0)) return false;
  return exact_distance(a, b, shape).clearance() < clearance;
}

}  // namespace

NominalMotion::NominalMotion(const Problem& problem) : problem_(problem) {
  const MethodEntry none = baselines::plain_tracking_method();
  q_ = run_method(problem_, none, ParameterValues(none.parameters)).trajectory.q;
  for (const JointVector& q : q_) problem_.chain.forward(q, poses_.emplace_back());
  for (int tick = 0; tick <= problem_.ticks; ++tick) {
    desired_.push_back(problem_.desired_tip(problem_.time(tick)));
  }
}

bool NominalMotion::path_within(const Eigen::Vector3d& center, double least, double most) const {
  return std::all_of(desired_.begin(), desired_.end(), [&](const Eigen::Vector3d& p) {
    const double distance = (p - center).norm();
    return distance >= least && distance <= most;
  });
}

bool NominalMotion::keeps_limits() const {
  return q_.size() == desired_.size() && std::all_of(q_.begin(), q_.end(), [this](const auto& q) {
           return q.allFinite() && problem_.within_limits(q);
         });
}

bool NominalMotion::tracks() const {
  if (q_.size() != desired_.size()) return false;
  for (std::size_t tick = 1; tick < q_.size(); ++tick) {
    if (!((poses_[tick].tip() - desired_[tick]).norm() <= problem_.tolerance)) return false;
    for (int j = 0; j < problem_.chain.joints(); ++j) {
      if (!(std::abs(q_[tick](j) - q_[tick - 1](j)) <= problem_.max_step(j))) return false;
    }
  }
  return true;
}

bool NominalMotion::closer(int tick, const Link& link, const Obstacle& obstacle,
                           double clearance) const {
  const ChainPose& at = pose(tick);
  return segment_is_closer(at.p_WO.col(link.start), at.p_WO.col(link.end), obstacle.at(tick),
                           clearance);
}

bool NominalMotion::start_is_clear(const Obstacle& obstacle) const {
  const auto links = problem_.chain.links();
  return std::none_of(links.begin(), links.end(),
                      [&](const Link& link) { return closer(0, link, obstacle, kStartClearance); });
}

bool NominalMotion::path_is_clear(const Obstacle& obstacle) const {
  for (int tick = 1; tick <= problem_.ticks; ++tick) {
    const Eigen::Vector3d& from = desired_[static_cast<std::size_t>(tick) - 1];
    const Eigen::Vector3d& to = desired_[static_cast<std::size_t>(tick)];
    if (segment_is_closer(from, to, obstacle.at(tick), kTipClearance)) return false;
    if (!obstacle.moves()) continue;
    if (segment_is_closer(from, to, obstacle.at(tick - 1), kTipClearance)) return false;
  }
  return true;
}

bool NominalMotion::inner_links_are_clear(const Obstacle& obstacle) const {
  for (const Link& link : problem_.chain.links()) {
    for (int tick = 0; link.number < kFirstOuterLink && tick <= problem_.ticks; ++tick) {
      if (closer(tick, link, obstacle, kInnerClearance)) return false;
    }
  }
  return true;
}

bool NominalMotion::outer_link_hits(const Obstacle& obstacle) const {
  for (const Link& link : problem_.chain.links()) {
    for (int tick = 1; link.number >= kFirstOuterLink && tick <= problem_.ticks; ++tick) {
      if (closer(tick, link, obstacle, -kHitDepth)) return true;
    }
  }
  return false;
}

}  // namespace bqsa::harness
