#include "bqsa/bqsa_spatial.hpp"

namespace bqsa {

void BqsaSpatial::prepare(const Problem& problem) {
  SpatialSearch::prepare(problem);
  obstacles_.assign(problem.obstacles, counters_, problem.link_radius + problem.margin,
                    neighbours());
  release_.assign(problem, obstacles_, settings_, counters_);
}

/// Joints clamping: moves the arm along its self-motions until the link is free of all obstacles.
Infeasible BqsaSpatial::free_link(const StepInput& input, const Link& link, StepOutput& output) {
  const JointVector q_start = q_;
  const int first_clamp = output.clamp_count;
  int increments = 0;
  int recorded = -1;  // the last obstacle recorded
  JointVector phi;
  for (int obstacle = first_hit(link, 0); obstacle >= 0;) {
    if (obstacle > recorded) {
      record_clamp({link.number, obstacle, problem_->chain.joints()}, output);
      recorded = obstacle;
    }
    if (!clamping_velocity(link, obstacle, phi)) return Infeasible::kNoFreeConfiguration;
    const JointVector colliding = q_;
    const JointVector change = settings_.increment / phi.cwiseAbs().maxCoeff() * phi;
    // The way travelled counts, not the way from the start, so that a link that moves to and fro
    // ends too.
    if (++increments * settings_.increment > settings_.search_range || !take_increment()) {
      return Infeasible::kNoFreeConfiguration;
    }
    if (!move(input, colliding, change)) return Infeasible::kDiverged;
    const Infeasible forbidden = forbidden_step(*problem_, input.q, q_);
    if (forbidden != Infeasible::kNot) return forbidden;
    obstacle = first_hit(link, 0);
    if (obstacle < 0) settle(input, link, colliding, change);
  }
  complete_clamps(first_clamp, q_start, increments, output);
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
  counters_.jacobians += 2;
  const JointVector outward = (1 - t) * (J_start_.transpose() * g) + t * (J_end_.transpose() * g);
  return self_motion(outward, phi);
}

}  // namespace bqsa
