#include "bqsa/backward_search.hpp"

#include <cmath>

#include "bqsa/tip_closure.hpp"

namespace bqsa {

void BackwardSearch::prepare(const Problem& problem) {
  problem_ = &problem;
  task_ = TipTask(problem);
  counters_ = {};
  answered_ = false;
  lean(JointVector::Zero(problem.chain.joints()));
  certificate_.assign(problem, counters_);
}

void BackwardSearch::step(const StepInput& input, StepOutput& output) {
  clear(output);
  increments_left_ = settings_.max_increments;
  go_to(input.tick);
  task_.turn_to(input.R_WT_desired);

  if (!predict(input)) return hold(input.q, Infeasible::kDiverged, 0, -1, output);  // 1, 2
  if (is_clear(input)) return answer(input, output);  // 3 to 6 would find nothing to do
  const JointVector q_predicted = q_;

  const auto found = [&](Way way) {
    return search(input, q_predicted, way, output) == Infeasible::kNot;
  };
  if (settings_.release == Release::kFirst && found(Way::kTogether)) return;
  Infeasible reason = forbidden_step(*problem_, input.q, q_predicted);
  if (reason == Infeasible::kNot) reason = search(input, q_predicted, Way::kOneByOne, output);
  if (reason == Infeasible::kNot) return;
  const int link = output.link;
  const int obstacle = output.obstacle;
  const bool time_left = increments_left_ > 0;
  if (settings_.release == Release::kLast && time_left && found(Way::kTogether)) return;
  hold(input.q, reason, link, obstacle, output);
}

/// Steps 3 to 6: clears q_predicted in one of the ways; where the motion to what was found cannot be
/// certified, again with twice the distance.
Infeasible BackwardSearch::search(const StepInput& input, const JointVector& q_predicted, Way way,
                                  StepOutput& output) {
  double distance = settings_.safety_offset;
  MotionCertificate::Result motion;
  JointVector q_refused;
  for (int attempt = 0; attempt <= settings_.retries; ++attempt, distance *= 2) {
    keep(problem_->link_radius + problem_->margin + distance);
    output.clamp_count = 0;
    output.link = 0;
    output.obstacle = -1;
    if (q_ != q_predicted) {
      q_ = q_predicted;
      forward();
    }
    const Infeasible reason =
        way == Way::kOneByOne ? free_links(input, output) : release_links(input, output);
    if (reason != Infeasible::kNot) {
      if (!motion.certified) break;
      return reason;
    }
    if (attempt > 0 && q_ == q_refused) continue;  // more distance changed nothing
    q_refused = q_;
    motion = finish(input, q_predicted, output);  // 5, 6
    if (motion.certified) {
      answer(input, output);
      return Infeasible::kNot;
    }
  }
  output.link = motion.link;
  output.obstacle = motion.obstacle;
  return Infeasible::kNoFreeMotion;
}

void BackwardSearch::answer(const StepInput& input, StepOutput& output) {
  output.q = q_;
  answered_ = true;
  const double tip_error = task_.distance(pose_, input.p_WT_desired);
  output.state = tip_error > TipTask::tolerance(*problem_) ? TickState::kUnclaimed
                 : output.clamp_count > 0                  ? TickState::kClamped
                                                           : TickState::kFree;
}

/// Whether lists that were made before prove that nothing is in the way of the prediction.
bool BackwardSearch::is_clear(const StepInput& input) const {
  if (!searches_space() || settings_.release == Release::kFirst) return false;
  const double distance = problem_->link_radius + problem_->margin + settings_.safety_offset;
  return forbidden_step(*problem_, input.q, q_) == Infeasible::kNot &&
         certificate_.is_clear(input.tick, input.q, pose_start_, q_, pose_, distance);
}

Infeasible BackwardSearch::release_links(const StepInput& input, StepOutput& output) {
  const JointBox box = reachable_box(*problem_, input.q);
  if (!free_together(input.p_WT_desired, box, &output)) return Infeasible::kNoFreeConfiguration;
  return forbidden_step(*problem_, input.q, q_);
}

bool BackwardSearch::fit(int tick, const Eigen::Vector3d& p_WT, double distance,
                         const JointBox& box, JointVector& q) {
  go_to(tick);
  task_.turn_to(problem_->rotation_at(problem_->time(tick)));
  keep(problem_->link_radius + problem_->margin + distance);
  answered_ = false;
  q_ = q;
  forward();
  if (!free_together(p_WT, box, nullptr)) return false;
  q = q_;
  return true;
}

/// q_ = q, with its pose; that of the last answer is known.
void BackwardSearch::start_at(const JointVector& q) {
  if (!answered_ || q_ != q) {
    q_ = q;
    forward();
  }
  answered_ = false;
  pose_start_.p_WO = pose_.p_WO;
}

bool BackwardSearch::predict(const StepInput& input) {
  const SerialChain& chain = problem_->chain;
  start_at(input.q);
  x_dot_ = task_.error(pose_, input.p_WT_desired) / problem_->dt;
  const JointVector* phi = clamping_velocity(input.q);
  if (chain.in_plane() && !phi && predict_in_plane(input)) return true;

  task_.jacobian(pose_, J_tip_);
  ++counters_.jacobians;
  ik_start_.assign(J_tip_, settings_.ik);
  ++counters_.linear_solves;
  JointVector q_dot;
  ik_start_.solve(x_dot_, q_dot);
  if (phi) {
    JointVector self_motion;
    ik_start_.project(*phi, self_motion);
    const bool limited = settings_.joint_limits.band > 0;
    q_dot += (limited ? part_within_steps(*problem_, q_dot, self_motion) : 1) * self_motion;
  }
  q_ += problem_->dt * q_dot;
  if (settings_.corrections == 0) {
    forward();
    return q_.allFinite();
  }
  chain.forward_from(input.q, q_, pose_);
  ++counters_.kinematics;
  return correct_tip(input, ik_start_, x_dot_.norm() * problem_->dt);
}

/// phi of the predictor [rad/s], null if it is zero.
const JointVector* BackwardSearch::clamping_velocity(const JointVector& q) {
  if (settings_.joint_limits.band == 0) return leans_ ? &lean_ : nullptr;
  const bool clamps = clamp_at_limits(*problem_, settings_.joint_limits, q, phi_);
  phi_ += lean_;
  return clamps || leans_ ? &phi_ : nullptr;
}

/// The same for a planar arm where nothing is damped. All corrections are along the rows of the first
/// Jacobian, q = q_start + Jᵀ y, and Newton's method finds y. False, and all as it was, if it does not.
bool BackwardSearch::predict_in_plane(const StepInput& input) {
  constexpr double kSurely = 0.1;  // part of the tolerance that may be expected to be left
  const Eigen::Vector2d way = (input.p_WT_desired - pose_.tip()).head<2>();
  planar_tip_.assign(problem_->chain, pose_);
  ++counters_.jacobians;
  ++counters_.linear_solves;
  Eigen::Matrix2d inverse;
  if (!undamped_inverse(planar_tip_.gram(), settings_.ik, inverse)) return false;
  Eigen::Vector2d y = inverse * way;
  const double squared_before = way.squaredNorm();
  for (int k = 0; k < settings_.corrections; ++k) {
    const PlanarTip::Moved moved = planar_tip_.move(y);
    ++counters_.kinematics;
    if (!moved.slight) return false;
    const Eigen::Vector2d left = way - moved.way;
    y += moved.way_per_y.inverse() * left;
    // What a way of d leaves is of order d²; so what is left after this is of order left³ / way².
    const double squared = left.squaredNorm();
    const double enough = kSurely * settings_.tip_tolerance * squared_before;
    if (squared * squared * squared <= enough * enough) break;
  }
  planar_tip_.step(y, q_);
  forward();
  const double error = (input.p_WT_desired - pose_.tip()).norm();
  if (settings_.corrections == 0 ? std::isfinite(error) : error <= settings_.tip_tolerance)
    return true;
  start_at(input.q);
  return false;
}

MotionCertificate::Result BackwardSearch::finish(const StepInput& input, const JointVector&,
                                                 StepOutput&) {
  return certify(input);
}

JointVector BackwardSearch::hybrid_step(const JointVector& q, const JointVector& weights,
                                        const JointVector& phi) {
  HybridIkResult ik;
  problem_->chain.jacobian(pose_start_, problem_->chain.points() - 1, J_tip_);
  ++counters_.jacobians;
  solve_hybrid_ik(J_tip_, x_dot_, weights, phi, settings_.ik, ik);
  ++counters_.linear_solves;
  return q + problem_->dt * ik.q_dot;
}

bool BackwardSearch::correct_tip(const StepInput& input, const TrackingIk& ik,
                                 double error_before) {
  const double error = close_tip(task_, input.p_WT_desired, problem_->dt, settings_, ik,
                                 error_before, q_, pose_, counters_);
  return error <= TipTask::tolerance(*problem_);
}

bool BackwardSearch::free_together(const Eigen::Vector3d&, const JointBox&, StepOutput*) {
  return false;
}

void BackwardSearch::forward() {
  problem_->chain.forward(q_, pose_);
  ++counters_.kinematics;
}

bool BackwardSearch::take_increment() {
  ++counters_.iterations;
  return --increments_left_ >= 0;
}

}  // namespace bqsa
