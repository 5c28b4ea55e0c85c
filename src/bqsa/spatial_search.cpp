#include "bqsa/spatial_search.hpp"

#include <stdexcept>

namespace bqsa {
namespace {

/// Backward searches of one tick.
constexpr int kMaxSweeps = 4;

/// Share of a direction that must survive the projection on the self-motions.
constexpr double kVanishing = 1e-6;

}  // namespace

void SpatialSearch::prepare(const Problem& problem) {
  if (problem.dimension() != 3) throw std::invalid_argument("spatial BQSA needs a spatial arm");
  BackwardSearch::prepare(problem);
}

Infeasible SpatialSearch::free_links(const StepInput& input, StepOutput& output) {
  const std::span<const Link> links = problem_->chain.links();
  for (int sweep = 0;; ++sweep) {
    bool all_free = true;
    for (std::size_t k = links.size(); k-- > 0;) {
      const int obstacle = first_hit(links[k], 0);
      if (obstacle < 0) continue;
      all_free = false;
      output.link = links[k].number;
      output.obstacle = obstacle;
      if (sweep == kMaxSweeps) return Infeasible::kNoFreeConfiguration;
      const Infeasible reason = free_link(input, links[k], output);
      if (reason != Infeasible::kNot) return reason;
    }
    if (all_free) {
      output.link = 0;
      output.obstacle = -1;
      return Infeasible::kNot;
    }
  }
}

bool SpatialSearch::self_motion(const JointVector& direction, JointVector& phi) {
  task_.jacobian(pose_, J_tip_);
  ++counters_.jacobians;
  ik_.assign(J_tip_, settings_.ik);
  ++counters_.linear_solves;
  ik_.project(direction, phi);
  return phi.norm() > kVanishing * direction.norm();
}

bool SpatialSearch::move(const StepInput& input, const JointVector& from,
                         const JointVector& change) {
  q_ = from + change;
  forward();
  return correct_tip(input, ik_, 0);
}

void SpatialSearch::settle(const StepInput& input, const Link& link, const JointVector& colliding,
                           const JointVector& change) {
  JointVector q_free = q_;
  double hit = 0;
  double free = 1;
  for (int halving = 0; halving < settings_.settling; ++halving) {
    const double middle = 0.5 * (hit + free);
    if (move(input, colliding, middle * change) && first_hit(link, 0) < 0 &&
        forbidden_step(*problem_, input.q, q_) == Infeasible::kNot) {
      q_free = q_;
      free = middle;
    } else {
      hit = middle;
    }
  }
  q_ = q_free;
  forward();
}

void SpatialSearch::complete_clamps(int first, const JointVector& q_start, int increments,
                                    StepOutput& output) {
  for (int c = first; c < output.clamp_count; ++c) {
    Clamp& clamp = output.clamps[static_cast<std::size_t>(c)];
    clamp.offset = (q_ - q_start).cwiseAbs().maxCoeff();
    clamp.increments = c == first ? increments : 0;
  }
}

}  // namespace bqsa
