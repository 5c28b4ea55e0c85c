#include "bqsa/bqsa_spatial.hpp"

#include <algorithm>

namespace bqsa {
namespace {

/// Furthest estimate of the way out that is believed [increments].
constexpr double kLargestStretch = 8;

/// Configurations tried between colliding and free.
constexpr int kMaxTrials = 12;

}  // namespace

void BqsaSpatial::prepare(const Problem& problem) {
  SpatialSearch::prepare(problem);
  obstacles_.assign(problem, counters_, neighbours());
  release_.assign(problem, task_, obstacles_, settings_, counters_);
}

/// Joints clamping: moves the arm along its self-motions until the link is free of all obstacles.
Infeasible BqsaSpatial::free_link(const StepInput& input, const Link& link, StepOutput& output) {
  const JointVector q_start = q_;
  const int first_clamp = output.clamp_count;
  int increments = 0;
  Infeasible reason = push_out(input, link, Stride::kEstimated, output, increments);
  if (reason != Infeasible::kNot) {
    output.clamp_count = first_clamp;
    q_ = q_start;
    forward();
    reason = push_out(input, link, Stride::kIncrement, output, increments);
  }
  if (reason == Infeasible::kNot) complete_clamps(first_clamp, q_start, increments, output);
  return reason;
}

/// Moves the arm until the link is free, and counts the increments.
Infeasible BqsaSpatial::push_out(const StepInput& input, const Link& link, Stride stride,
                                 StepOutput& output, int& increments) {
  double way = 0;     // of the fastest joint
  int recorded = -1;  // the last obstacle recorded
  JointVector phi;
  for (int obstacle = first_hit(link, 0); obstacle >= 0;) {
    if (obstacle > recorded) {
      record_clamp({link.number, obstacle, problem_->chain.joints()}, output);
      recorded = obstacle;
    }
    if (!clamping_velocity(link, obstacle, phi)) return Infeasible::kNoFreeConfiguration;
    const JointVector colliding = q_;
    const double fastest = phi.cwiseAbs().maxCoeff();
    const double gap_hit = gap(link, obstacle);
    double stretch = settings_.increment;
    if (stride == Stride::kEstimated) {
      const double estimate = -gap_hit / phi.squaredNorm() * fastest + 0.5 * resolution();
      stretch = std::clamp(estimate, way > 0 ? settings_.increment : 0.0,
                           kLargestStretch * settings_.increment);
    }
    const JointVector change = stretch / fastest * phi;
    // The way travelled counts, not the way from the start, so that a link that moves to and fro
    // ends too.
    way += stretch;
    ++increments;
    if (way > settings_.search_range || !take_increment()) return Infeasible::kNoFreeConfiguration;
    if (!move(input, colliding, change)) return Infeasible::kDiverged;
    const Infeasible forbidden = forbidden_step(*problem_, input.q, q_);
    if (forbidden != Infeasible::kNot) return forbidden;
    const int hit = obstacle;
    obstacle = first_hit(link, 0);
    if (obstacle < 0) find_exit(input, link, hit, gap_hit, colliding, change);
  }
  return Infeasible::kNot;
}

/// Takes back as much of the last move, made from `colliding`, as leaves the link free: by the secant
/// method on its gap to the obstacle that was left last, to what halvings of an increment would leave.
void BqsaSpatial::find_exit(const StepInput& input, const Link& link, int obstacle, double gap_hit,
                            const JointVector& colliding, const JointVector& change) {
  const double fine = resolution() / change.cwiseAbs().maxCoeff();
  JointVector q_free = q_;
  double hit = 0;
  double free = 1;
  double gap_free = gap(link, obstacle);
  for (int trial = 0; trial < kMaxTrials; ++trial) {
    const double exit = hit - gap_hit / (gap_free - gap_hit) * (free - hit);
    if (free - std::max(hit, exit) <= fine) break;
    double middle = exit + 0.5 * fine;
    if (!(middle > hit && middle < free)) middle = 0.5 * (hit + free);
    if (move(input, colliding, middle * change) && first_hit(link, 0) < 0 &&
        forbidden_step(*problem_, input.q, q_) == Infeasible::kNot) {
      q_free = q_;
      free = middle;
      gap_free = gap(link, obstacle);
    } else {
      hit = middle;
      gap_hit = std::min(gap(link, obstacle), -gap_free);
    }
  }
  q_ = q_free;
  forward();
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
