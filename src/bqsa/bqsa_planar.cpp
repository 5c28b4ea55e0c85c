#include "bqsa/bqsa_planar.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "bqsa/tip_closure.hpp"

namespace bqsa {

void BqsaPlanar::prepare(const Problem& problem) {
  if (problem.dimension() != 2 || problem.chain.points() != problem.chain.joints() + 1) {
    throw std::invalid_argument("planar BQSA needs a planar arm without a tool");
  }
  problem_ = &problem;
  counters_ = {};
  obstacles_.assign(problem.obstacles, counters_);
  certificate_.assign(problem, problem.link_radius + problem.margin, counters_);
  self_motion_.assign(problem.chain, counters_);
}

void BqsaPlanar::step(const StepInput& input, StepOutput& output) {
  const SerialChain& chain = problem_->chain;
  const int n = chain.joints();
  output = {};
  chain.forward(input.q, pose_);
  chain.jacobian(pose_, n, J_tip_);
  ++counters_.kinematics;
  ++counters_.jacobians;

  // 1, 2: predictor
  x_dot_ = (input.p_WT_desired - pose_.tip()).head<2>() / problem_->dt;
  q_ = hybrid_step(input.q, JointVector::Ones(n), JointVector::Zero(n));
  if (variant_ == PlanarVariant::kExact) {
    forward();
    const double error =
        close_tip(chain, input.p_WT_desired, problem_->dt, settings_, q_, pose_, counters_);
    if (!(error <= problem_->tolerance)) return hold(input.q, Infeasible::kDiverged, 0, -1, output);
  }
  const JointVector q_predicted = q_;
  const Infeasible forbidden = forbidden_step(*problem_, input.q, q_predicted);
  if (forbidden != Infeasible::kNot) return hold(input.q, forbidden, 0, -1, output);

  double distance = settings_.safety_offset;
  MotionCertificate::Result motion;
  for (int attempt = 0; attempt <= settings_.retries; ++attempt, distance *= 2) {
    obstacles_.keep(problem_->link_radius + problem_->margin + distance);
    output.clamp_count = 0;
    q_ = q_predicted;
    if (!search_backward(input.q, output)) {  // 3, 4
      if (!motion.certified) break;
      return hold(input.q, Infeasible::kNoFreeConfiguration, output.link, output.obstacle, output);
    }
    if (variant_ == PlanarVariant::kPaper && output.clamp_count > 0) {  // 5
      const JointVector q_paper = paper_step(input.q, q_predicted, output);
      chain.forward(q_paper, pose_);
      ++counters_.kinematics;
      output.guard_fired = !links_free(1, n) ||
                           forbidden_step(*problem_, input.q, q_paper) != Infeasible::kNot ||
                           !certificate_.certify(input.q, q_paper).certified;
      if (!output.guard_fired) q_ = q_paper;
    }
    motion = certificate_.certify(input.q, q_);  // 6
    if (motion.certified) {
      output.q = q_;
      output.state = output.clamp_count > 0 ? TickState::kClamped : TickState::kFree;
      return;
    }
  }
  hold(input.q, Infeasible::kNoFreeMotion, motion.link, motion.obstacle, output);
}

/// From the tip to the base: frees every link of q_ that is in category 3, 4 or 5 with any
/// obstacle. After link i, the links i .. n are free; so one sweep suffices.
bool BqsaPlanar::search_backward(const JointVector& q_last, StepOutput& output) {
  forward();
  const std::span<const Link> links = problem_->chain.links();
  for (std::size_t k = links.size(); k-- > 0;) {
    const Link& link = links[k];
    const int first = obstacles_.first_hit(pose_, link);
    if (first < 0) continue;
    const int first_clamp = output.clamp_count;
    for (int j = first; j >= 0 && output.clamp_count < StepOutput::kMaxClamps;
         j = obstacles_.first_hit(pose_, link, j + 1)) {
      output.clamps[static_cast<std::size_t>(output.clamp_count++)] = {link.number, j};
    }
    Clamp clamp;
    if (!free_link(link.number, q_last, clamp)) {
      output.link = link.number;
      output.obstacle = first;
      return false;
    }
    for (int c = first_clamp; c < output.clamp_count; ++c) {
      Clamp& recorded = output.clamps[static_cast<std::size_t>(c)];
      clamp.link = recorded.link;
      clamp.obstacle = recorded.obstacle;
      recorded = clamp;
    }
    forward();
  }
  return true;
}

/// Joints clamping (paper, section 3.3): turns link i in steps of dTheta to both sides, the side it
/// came from first, until it and the links up to the anchor are free. The first anchor is the
/// link's own outer end, as in the paper; where that fails, O_{a+1} further out.
bool BqsaPlanar::free_link(int link, const JointVector& q_last, Clamp& clamp) {
  const double came_from = q_last.head(link).sum() - q_.head(link).sum();
  const double first = came_from < 0 ? -1 : 1;
  for (int anchor = std::max(link, 3); anchor <= problem_->chain.joints(); ++anchor) {
    // Links inside of `link` are freed later in the sweep, unless that would move `link` again:
    // three links are needed for a self-motion, so with a = 3 or i <= 3 all inner links must be
    // free at once.
    const int lowest = link <= 3 || anchor == 3 ? 1 : link;
    std::array<Side, 2> sides{Side{first, 0, q_}, Side{-first, 0, q_}};
    while (sides[0].open || sides[1].open) {
      for (Side& side : sides) {
        if (!side.open) continue;
        ++clamp.increments;
        if (!advance(side, link, anchor, lowest, q_last)) continue;
        settle(side, link, anchor, lowest);
        q_ = side.q;
        clamp.anchor = anchor;
        clamp.offset = side.direction * side.offset;
        return true;
      }
    }
  }
  return false;
}

/// One more increment to one side. True if the links lowest .. anchor are free there.
bool BqsaPlanar::advance(Side& side, int link, int anchor, int lowest, const JointVector& q_last) {
  ++counters_.iterations;
  side.offset += settings_.increment;
  side.open =
      side.offset <= settings_.search_range &&
      self_motion_.turn_link(link, anchor, side.direction * settings_.increment, side.q, pose_) &&
      forbidden_step(*problem_, q_last, side.q) == Infeasible::kNot;
  return side.open && links_free(lowest, anchor);
}

/// Turns a link that was just freed back towards the obstacle, as far as it stays free.
void BqsaPlanar::settle(Side& side, int link, int anchor, int lowest) {
  double free = 0;
  double colliding = settings_.increment;
  for (int halving = 0; halving < settings_.settling; ++halving) {
    const double middle = 0.5 * (free + colliding);
    JointVector q = side.q;
    if (self_motion_.turn_link(link, anchor, side.direction * (free - middle), q, pose_) &&
        links_free(lowest, anchor)) {
      side.q = q;
      side.offset -= middle - free;
      free = middle;
    } else {
      colliding = middle;
    }
  }
}

/// Steps 5 of the paper: the clamping velocity phi, and weights that hold the joints beyond a + 1.
JointVector BqsaPlanar::paper_step(const JointVector& q_last, const JointVector& q_predicted,
                                   const StepOutput& output) {
  int anchor = 0;
  for (int c = 0; c < output.clamp_count; ++c) {
    anchor = std::max(anchor, output.clamps[static_cast<std::size_t>(c)].anchor);
  }
  const int n = problem_->chain.joints();
  JointVector weights = JointVector::Ones(n);
  weights.tail(std::max(0, n - anchor - 1)).setConstant(settings_.clamped_weight);  // Eq. 23
  const JointVector phi = (q_ - q_predicted) / problem_->dt;                        // Eq. 24
  return hybrid_step(q_last, weights, phi);
}

/// q + dt hybrid_ik(...) with the Jacobian and tip velocity of this tick (Eqs. 17, 18).
JointVector BqsaPlanar::hybrid_step(const JointVector& q, const JointVector& weights,
                                    const JointVector& phi) {
  solve_hybrid_ik(J_tip_, x_dot_, weights, phi, settings_.ik, ik_);
  ++counters_.linear_solves;
  return q + problem_->dt * ik_.q_dot;
}

/// Whether the links numbered lowest .. highest are free in pose_.
bool BqsaPlanar::links_free(int lowest, int highest) {
  for (const Link& link : problem_->chain.links()) {
    if (link.number < lowest || link.number > highest) continue;
    if (obstacles_.first_hit(pose_, link) >= 0) return false;
  }
  return true;
}

void BqsaPlanar::forward() {
  problem_->chain.forward(q_, pose_);
  ++counters_.kinematics;
}

}  // namespace bqsa
