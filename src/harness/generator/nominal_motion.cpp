#include "harness/generator/nominal_motion.hpp"

#include <algorithm>

#include "baselines/plain_tracking.hpp"
#include "harness/runner.hpp"

namespace bqsa::harness {
namespace {

std::vector<JointVector> track(const Problem& problem) {
  const MethodEntry none = baselines::plain_tracking_method();
  return run_method(problem, none, ParameterValues(none.parameters)).trajectory.q;
}

/// Of the link that ends in the tip.
double tip_radius(const Problem& problem) {
  return problem.radius_of(problem.chain.links().size() - 1);
}

}  // namespace

NominalMotion::NominalMotion(const Problem& problem) : ArmMotion(problem, track(problem)) {
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    desired_.push_back(problem.desired_tip(problem.time(tick)));
  }
}

bool NominalMotion::path_within(const Eigen::Vector3d& center, double least, double most) const {
  return std::all_of(desired_.begin(), desired_.end(), [&](const Eigen::Vector3d& p) {
    const double distance = (p - center).norm();
    return distance >= least && distance <= most;
  });
}

bool NominalMotion::start_is_clear(const PlacedShape& obstacle) const {
  return is_clear(0, obstacle, kStartClearance);
}

bool NominalMotion::path_is_clear(const PlacedShape& obstacle) const {
  const double clearance = kTipClearance + tip_radius(problem());
  for (int tick = 1; tick <= problem().ticks; ++tick) {
    const Eigen::Vector3d& from = desired_[static_cast<std::size_t>(tick) - 1];
    const Eigen::Vector3d& to = desired_[static_cast<std::size_t>(tick)];
    if (obstacle.is_closer(from, to, tick, clearance)) return false;
    if (!obstacle.moves()) continue;
    if (obstacle.is_closer(from, to, tick - 1, clearance)) return false;
  }
  return true;
}

bool NominalMotion::inner_links_are_clear(const PlacedShape& obstacle) const {
  for (std::size_t link = 0; link < problem().chain.links().size(); ++link) {
    const bool inner = problem().chain.links()[link].number < kFirstOuterLink;
    for (int tick = 0; inner && tick <= problem().ticks; ++tick) {
      if (is_closer(tick, link, obstacle, kInnerClearance)) return false;
    }
  }
  return true;
}

bool NominalMotion::outer_link_hits(const PlacedShape& obstacle) const {
  for (std::size_t link = 0; link < problem().chain.links().size(); ++link) {
    const bool outer = problem().chain.links()[link].number >= kFirstOuterLink;
    for (int tick = 1; outer && tick <= problem().ticks; ++tick) {
      if (is_closer(tick, link, obstacle, -kHitDepth)) return true;
    }
  }
  return false;
}

}  // namespace bqsa::harness
