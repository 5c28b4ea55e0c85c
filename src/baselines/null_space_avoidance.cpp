#include "baselines/null_space_avoidance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bqsa::baselines {

void SelfMotions::assign(const TaskJacobian& J) {
  constexpr double kDependent = 1e-9;
  rank_ = 0;
  TaskJacobian rest = J;
  const double largest = J.rowwise().norm().maxCoeff();
  while (rank_ < J.rows()) {
    Eigen::Index next;
    if (rest.rowwise().squaredNorm().maxCoeff(&next) <= std::pow(kDependent * largest, 2)) break;
    JointVector row = rest.row(next).transpose();
    row = project(row);
    row.normalize();
    rows_[static_cast<std::size_t>(rank_++)] = row;
    rest -= (rest * row) * row.transpose();
  }
}

JointVector SelfMotions::project(const JointVector& v) const {
  JointVector rest = v;
  for (int k = 0; k < rank_; ++k) {
    const JointVector& row = rows_[static_cast<std::size_t>(k)];
    rest -= row.dot(rest) * row;
  }
  return rest;
}

double influence_gain(double clearance, const AvoidanceSettings& s) {
  return std::clamp((s.influence - clearance) / (s.influence - s.full_distance), 0.0, 1.0);
}

JointVector self_motion_away(double clearance, double speed, const JointVector& j0,
                             const JointVector& projected, const JointVector& tracking,
                             const AvoidanceSettings& settings) {
  if (settings.law == AvoidanceLaw::kGradientProjection) {
    return settings.gradient_gain * (settings.influence - clearance) * projected;
  }
  const double alpha = influence_gain(clearance, settings);
  const double wanted = alpha * speed - j0.dot(tracking);
  return alpha * wanted / (j0.dot(projected) + settings.regularization) * projected;
}

Eigen::Vector3d velocity_at(const Obstacle& obstacle, int tick, double dt,
                            const Eigen::Vector3d& p) {
  if (!obstacle.moves()) return Eigen::Vector3d::Zero();
  const Ellipsoid& from = obstacle.at(tick - 1);
  const Ellipsoid& to = obstacle.at(tick);
  const Eigen::Vector3d in_body = from.rotation().transpose() * (p - from.center());
  return (to.center() + to.rotation() * in_body - p) / dt;
}

double fitting_part(const Problem& problem, const JointVector& q, const JointVector& tracking,
                    const JointVector& avoidance) {
  double least = 0, most = 1;
  const auto keep = [&least, &most](double from, double by, double lower, double upper) {
    if (by == 0) {
      if (from < lower || from > upper) most = -1;
      return;
    }
    const double one = (lower - from) / by, other = (upper - from) / by;
    least = std::max(least, std::min(one, other));
    most = std::min(most, std::max(one, other));
  };
  for (int j = 0; j < problem.chain.joints(); ++j) {
    keep(tracking(j), avoidance(j), -problem.max_step(j), problem.max_step(j));
    const double from = q(j) + tracking(j);
    if (problem.limits.lower.size() > 0) {
      keep(from, avoidance(j), problem.limits.lower(j), std::numeric_limits<double>::infinity());
    }
    if (problem.limits.upper.size() > 0) {
      keep(from, avoidance(j), -std::numeric_limits<double>::infinity(), problem.limits.upper(j));
    }
  }
  return least <= most ? most : -1;
}

void NullSpaceAvoidance::prepare(const Problem& problem) {
  problem_ = &problem;
  counters_ = {};
  no_weights_ = JointVector::Ones(problem.chain.joints());
  no_clamping_ = JointVector::Zero(problem.chain.joints());
  points_.clear();
  points_.reserve(problem.chain.links().size() * problem.obstacles.size());
  search_->assign(problem, settings_.exempt_length, counters_);
}

void NullSpaceAvoidance::step(const StepInput& input, StepOutput& output) {
  output = {};
  const SerialChain& chain = problem_->chain;
  search_->go_to(input.tick - 1);  // where the obstacles are now, as the arm is at input.q
  chain.forward(input.q, pose_);
  ++counters_.kinematics;
  J_known_.fill(false);

  // Je⁺ xe: tracking, closed over the tip error.
  const TaskJacobian& J_tip = jacobian(chain.points() - 1);
  const TaskVector xe = (input.p_WT_desired - pose_.tip()).head(chain.dimension()) / problem_->dt;
  solve_hybrid_ik(J_tip, xe, no_weights_, no_clamping_, {}, ik_);
  ++counters_.linear_solves;
  const JointVector& tracking = ik_.q_dot;

  const double reach = settings_.influence + problem_->link_radius + problem_->margin;
  search_->search(pose_, reach, points_);
  if (!settings_.all_pairs) keep_closest_of_each_obstacle();
  if (!points_.empty()) self_motions_.assign(J_tip);
  JointVector avoidance = no_clamping_;
  for (const ClosestPoint& point : points_) {
    avoidance += away(point, tracking, input.tick);
    const Link& link = chain.links()[static_cast<std::size_t>(point.link)];
    record_clamp({.link = link.number, .obstacle = point.obstacle}, output);
  }

  const double dt = problem_->dt;
  double part = 1;
  if (settings_.step_limit == StepLimit::kScale) {
    part = std::max(0.0, fitting_part(*problem_, input.q, dt * tracking, dt * avoidance));
    if (part < 1) part *= 1 - 1e-12;  // a rounding below the limit
  }
  const JointVector q = input.q + dt * (tracking + part * avoidance);
  const Infeasible forbidden = forbidden_step(*problem_, input.q, q);
  if (forbidden != Infeasible::kNot) return hold(input.q, forbidden, 0, -1, output);
  output.q = q;
  output.state = TickState::kUnclaimed;
}

/// Of points ordered by obstacle.
void NullSpaceAvoidance::keep_closest_of_each_obstacle() {
  std::size_t kept = 0;
  for (const ClosestPoint& point : points_) {
    if (kept > 0 && points_[kept - 1].obstacle == point.obstacle) {
      if (point.distance < points_[kept - 1].distance) points_[kept - 1] = point;
    } else {
      points_[kept++] = point;
    }
  }
  points_.resize(kept);
}

JointVector NullSpaceAvoidance::away(const ClosestPoint& point, const JointVector& tracking,
                                     int tick) {
  const SerialChain& chain = problem_->chain;
  const Link& link = chain.links()[static_cast<std::size_t>(point.link)];
  const TaskVector u = point.direction.head(chain.dimension());
  JointVector j0 = no_clamping_;
  if (point.s > 0) j0 += point.s * (jacobian(link.end).transpose() * u);
  if (point.s < 1) j0 += (1 - point.s) * (jacobian(link.start).transpose() * u);
  double speed = settings_.escape_velocity;
  if (settings_.obstacle_velocity) {
    const Obstacle& obstacle = problem_->obstacles[static_cast<std::size_t>(point.obstacle)];
    speed += point.direction.dot(velocity_at(obstacle, tick, problem_->dt, point.p_obstacle));
  }
  const double clearance = point.distance - problem_->link_radius - problem_->margin;
  return self_motion_away(clearance, speed, j0, self_motions_.project(j0), tracking, settings_);
}

/// Jacobian of a point of the chain, made once a tick.
const TaskJacobian& NullSpaceAvoidance::jacobian(int point) {
  const auto k = static_cast<std::size_t>(point);
  if (!J_known_[k]) {
    problem_->chain.jacobian(pose_, point, J_points_[k]);
    ++counters_.jacobians;
    J_known_[k] = true;
  }
  return J_points_[k];
}

std::vector<ParameterDeclaration> avoidance_parameters(const AvoidanceSettings& defaults,
                                                       std::initializer_list<AvoidanceLaw> laws) {
  const auto has = [&laws](AvoidanceLaw law) { return std::ranges::find(laws, law) != laws.end(); };
  std::vector<ParameterDeclaration> declared = {
      {"influence", "m", defaults.influence, 1e-6, 10, "radius of the sphere of influence, d_m"}};
  if (has(AvoidanceLaw::kMaciejewskiKlein)) {
    declared.insert(declared.end(), {{"full_distance", "m", defaults.full_distance, 0, 10,
                                      "distance at which the gains reach 1, d_o (below d_m)"},
                                     {"escape_velocity", "m/s", defaults.escape_velocity, 0, 100,
                                      "speed away from the obstacle, v_0"},
                                     {"regularization", "m^2", defaults.regularization, 1e-12, 1,
                                      "regularization of the 1-D pseudo-inverse, delta"}});
  }
  if (has(AvoidanceLaw::kGradientProjection)) {
    declared.push_back({"gradient_gain", "rad/(s m^2)", defaults.gradient_gain, 0, 1e9,
                        "gain of gradient projection, mu"});
  }
  declared.push_back({"exempt_length", "m", defaults.exempt_length, 0, 10,
                      "part of the last link, from the tip, that may be near obstacles"});
  return declared;
}

ParameterDeclaration acting_points_parameter(const AvoidanceSettings& defaults) {
  return choice_parameter("points",
                          defaults.all_pairs ? std::vector<std::string>{"all", "closest"}
                                             : std::vector<std::string>{"closest", "all"},
                          "which points act: each obstacle's closest, or all within influence");
}

AvoidanceSettings read_avoidance(const ParameterValues& values, AvoidanceSettings settings) {
  settings.influence = values.number("influence");
  settings.exempt_length = values.number("exempt_length");
  if (settings.law == AvoidanceLaw::kGradientProjection) {
    settings.gradient_gain = values.number("gradient_gain");
    return settings;
  }
  settings.full_distance = values.number("full_distance");
  settings.escape_velocity = values.number("escape_velocity");
  settings.regularization = values.number("regularization");
  if (!(settings.full_distance < settings.influence)) {
    throw ParameterError("parameter 'full_distance': expected less than 'influence'");
  }
  return settings;
}

}  // namespace bqsa::baselines
