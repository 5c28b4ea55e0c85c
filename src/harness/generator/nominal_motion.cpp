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

bool NominalMotion::start_is_clear(const Obstacle& obstacle) const {
  return is_clear(0, obstacle, kStartClearance);
}

bool NominalMotion::path_is_clear(const Obstacle& obstacle) const {
  for (int tick = 1; tick <= problem().ticks; ++tick) {
    const Eigen::Vector3d& from = desired_[static_cast<std::size_t>(tick) - 1];
    const Eigen::Vector3d& to = desired_[static_cast<std::size_t>(tick)];
    if (harness::is_closer(from, to, obstacle.at(tick), kTipClearance)) return false;
    if (!obstacle.moves()) continue;
    if (harness::is_closer(from, to, obstacle.at(tick - 1), kTipClearance)) return false;
  }
  return true;
}

bool NominalMotion::inner_links_are_clear(const Obstacle& obstacle) const {
  for (const Link& link : problem().chain.links()) {
    for (int tick = 0; link.number < kFirstOuterLink && tick <= problem().ticks; ++tick) {
      if (is_closer(tick, link, obstacle, kInnerClearance)) return false;
    }
  }
  return true;
}

bool NominalMotion::outer_link_hits(const Obstacle& obstacle) const {
  for (const Link& link : problem().chain.links()) {
    for (int tick = 1; link.number >= kFirstOuterLink && tick <= problem().ticks; ++tick) {
      if (is_closer(tick, link, obstacle, -kHitDepth)) return true;
    }
  }
  return false;
}

}  // namespace bqsa::harness
