#include "bqsa/bqsa_spatial.hpp"

#include <stdexcept>

namespace bqsa {
namespace {

/// Backward searches of one tick: freeing a link can push one that was freed before back in.
constexpr int kMaxSweeps = 4;

/// Share of the clamping direction that must survive the projection on the self-motions.
constexpr double kVanishing = 1e-6;

}  // namespace

void BqsaSpatial::prepare(const Problem& problem) {
  if (problem.dimension() != 3) throw std::invalid_argument("spatial BQSA needs a spatial arm");
  BackwardSearch::prepare(problem);
  obstacles_.assign(problem.obstacles, counters_);
}

/// From the tip to the base, until a whole sweep finds every link free.
Infeasible BqsaSpatial::free_links(const StepInput& input, StepOutput& output) {
  const std::span<const Link> links = problem_->chain.links();
  for (int sweep = 0;; ++sweep) {
    bool all_free = true;
    for (std::size_t k = links.size(); k-- > 0;) {
      const int obstacle = obstacles_.first_hit(pose_, links[k]);
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

/// Joints clamping: moves the arm along its self-motions until the link is free of all obstacles.
Infeasible BqsaSpatial::free_link(const StepInput& input, const Link& link, StepOutput& output) {
  const JointVector q_start = q_;
  const int first_clamp = output.clamp_count;
  int increments = 0;
  int recorded = -1;  // the last obstacle recorded
  JointVector phi;
  for (int obstacle = obstacles_.first_hit(pose_, link); obstacle >= 0;) {
    if (obstacle > recorded) {
      record_clamp({link.number, obstacle, problem_->chain.joints()}, output);
      recorded = obstacle;
    }
    if (!clamping_velocity(link, obstacle, phi)) return Infeasible::kNoFreeConfiguration;
    const JointVector colliding = q_;
    const JointVector change = settings_.increment / phi.cwiseAbs().maxCoeff() * phi;
    // The way travelled counts, not the way from the start, so that a link that moves to and fro ends too.
    if (++increments * settings_.increment > settings_.search_range || !take_increment()) {
      return Infeasible::kNoFreeConfiguration;
    }
    if (!move(input, colliding, change)) return Infeasible::kDiverged;
    const Infeasible forbidden = forbidden_step(*problem_, input.q, q_);
    if (forbidden != Infeasible::kNot) return forbidden;
    obstacle = obstacles_.first_hit(pose_, link);
    if (obstacle < 0) settle(input, link, colliding, change);
  }
  for (int c = first_clamp; c < output.clamp_count; ++c) {
    Clamp& clamp = output.clamps[static_cast<std::size_t>(c)];
    clamp.offset = (q_ - q_start).cwiseAbs().maxCoeff();
    clamp.increments = c == first_clamp ? increments : 0;
  }
  return Infeasible::kNot;
}

/// phi = N J(t*)ᵀ g. False if hardly anything of J(t*)ᵀ g is a self-motion.
bool BqsaSpatial::clamping_velocity(const Link& link, int obstacle, JointVector& phi) {
  const SerialChain& chain = problem_->chain;
  const Ellipsoid& shape = obstacles_[obstacle];
  const Eigen::Vector3d u1 = unit_point<3>(shape, pose_.p_WO.col(link.start));
  const Eigen::Vector3d u2 = unit_point<3>(shape, pose_.p_WO.col(link.end));
  const double t = vertex(polar_form<double, 3>(u1, u2));
  const Eigen::Vector3d g =
      (shape.unit_map().transpose() * (u1 + t * (u2 - u1))).stableNormalized();
  ++counters_.quadratics;

  chain.jacobian(pose_, link.start, J_start_);
  chain.jacobian(pose_, link.end, J_end_);
  chain.jacobian(pose_, chain.points() - 1, J_tip_);
  counters_.jacobians += 3;
  const JointVector outward = (1 - t) * (J_start_.transpose() * g) + t * (J_end_.transpose() * g);
  solve_hybrid_ik(J_tip_, TaskVector::Zero(3), JointVector::Ones(chain.joints()), outward,
                  settings_.ik, ik_);
  ++counters_.linear_solves;
  phi = ik_.q_dot;
  return phi.norm() > kVanishing * outward.norm();
}

/// q_ = from + change, then corrected until the tip is on its path. False if it stays off it.
bool BqsaSpatial::move(const StepInput& input, const JointVector& from, const JointVector& change) {
  q_ = from + change;
  forward();
  return correct_tip(input);
}

/// Takes back as much of the last increment as leaves the link free.
void BqsaSpatial::settle(const StepInput& input, const Link& link, const JointVector& colliding,
                         const JointVector& change) {
  JointVector q_free = q_;
  double hit = 0;
  double free = 1;
  for (int halving = 0; halving < settings_.settling; ++halving) {
    const double middle = 0.5 * (hit + free);
    if (move(input, colliding, middle * change) && obstacles_.first_hit(pose_, link) < 0 &&
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

}  // namespace bqsa
