#include "bqsa/bqsa_projection.hpp"

#include <algorithm>
#include <array>

namespace bqsa {
namespace {

/// A link whose projection is shorter than this part of it is seen end-on: it has no angle there.
constexpr double kEndOn = 1e-6;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The projected link, from its inner to its outer end.
Eigen::Vector2d projected_link(const ChainPose& pose, const Link& link, CoordinatePlane plane) {
  return projected(pose.p_WO.col(link.end) - pose.p_WO.col(link.start), plane);
}

}  // namespace

void BqsaProjection::prepare(const Problem& problem) {
  SpatialSearch::prepare(problem);
  shadows_.assign(problem, counters_, neighbours()->index());
}

/// Joints clamping: the branches are searched in step, and the first that leads out wins.
Infeasible BqsaProjection::free_link(const StepInput& input, const Link& link, StepOutput& output) {
  const JointVector q_start = q_;
  const int first_clamp = output.clamp_count;
  for (int j = first_hit(link, 0); j >= 0; j = first_hit(link, j + 1)) {
    record_clamp({link.number, j, problem_->chain.joints()}, output);
  }

  problem_->chain.forward(input.q, pose_last_);
  ++counters_.kinematics;
  std::array<Branch, 2 * kCoordinatePlanes.size()> branches;
  for (std::size_t k = 0; k < kCoordinatePlanes.size(); ++k) {
    const CoordinatePlane plane = kCoordinatePlanes[k];
    if (plane_.value_or(plane) != plane) continue;
    const double came_from = cross(projected_link(pose_, link, plane),  // sign of the turn back
                                   projected_link(pose_last_, link, plane));
    const double first = came_from < 0 ? -1 : 1;
    branches[k] = {plane, first, 0, q_start, true};
    branches[k + kCoordinatePlanes.size()] = {plane, -first, 0, q_start, true};
  }

  const auto is_open = [](const Branch& branch) { return branch.open; };
  for (int increments = 0; std::any_of(branches.begin(), branches.end(), is_open);) {
    for (Branch& branch : branches) {
      if (!branch.open) continue;
      if (!take_increment()) return Infeasible::kNoFreeConfiguration;
      ++increments;
      if (!advance(input, link, branch)) continue;
      complete_clamps(first_clamp, q_start, increments, output);
      return Infeasible::kNot;
    }
  }
  return Infeasible::kNoFreeConfiguration;
}

/// One more increment of a branch, which ends where the link cannot or may not be turned further.
/// True if the link is free there; then q_ and pose_ hold the settled configuration.
bool BqsaProjection::advance(const StepInput& input, const Link& link, Branch& branch) {
  q_ = branch.q;
  forward();
  branch.offset += settings_.increment;
  JointVector rate;
  branch.open = branch.offset <= settings_.search_range && turn_rate(link, branch.plane, rate);
  if (!branch.open) return false;
  const JointVector colliding = q_;
  const JointVector change = branch.direction * settings_.increment * rate;
  branch.open =
      move(input, colliding, change) && forbidden_step(*problem_, input.q, q_) == Infeasible::kNot;
  if (!branch.open) return false;
  branch.q = q_;
  if (first_hit(link, 0) >= 0) return false;
  settle(input, link, colliding, change);
  return true;
}

/// Least-norm joint velocity that turns the projected link at 1 rad/s and leaves the tip in place.
/// With w = d psi / d theta it is N w / |N w|². False if there is none: the link is seen end-on, or
/// C has lost its rank.
bool BqsaProjection::turn_rate(const Link& link, CoordinatePlane plane, JointVector& rate) {
  const SerialChain& chain = problem_->chain;
  const Eigen::Vector2d d = projected_link(pose_, link, plane);
  const double length = (pose_.p_WO.col(link.end) - pose_.p_WO.col(link.start)).norm();
  if (d.norm() <= kEndOn * length) return false;

  chain.jacobian(pose_, link.start, J_start_);
  chain.jacobian(pose_, link.end, J_end_);
  counters_.jacobians += 2;
  JointVector w(chain.joints());
  for (int j = 0; j < chain.joints(); ++j) {
    w(j) = cross(d, projected(J_end_.col(j) - J_start_.col(j), plane)) / d.squaredNorm();
  }
  if (!self_motion(w, rate)) return false;
  rate /= rate.squaredNorm();
  return true;
}

}  // namespace bqsa
