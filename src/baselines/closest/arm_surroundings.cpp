#include "baselines/closest/arm_surroundings.hpp"

namespace bqsa::baselines {

Eigen::Vector3d velocity_at(const Obstacle& obstacle, int tick, double dt,
                            const Eigen::Vector3d& p) {
  if (!obstacle.moves()) return Eigen::Vector3d::Zero();
  const Ellipsoid& from = obstacle.at(tick - 1);
  const Ellipsoid& to = obstacle.at(tick);
  const Eigen::Vector3d in_body = from.rotation().transpose() * (p - from.center());
  return (to.center() + to.rotation() * in_body - p) / dt;
}

ParameterDeclaration exempt_length_parameter(double default_value) {
  return {"exempt_length",
          "m",
          default_value,
          0,
          10,
          "part of the last link, from the tip, that may be near obstacles"};
}

ParameterDeclaration acting_points_parameter(bool all_pairs_by_default) {
  return choice_parameter("points",
                          all_pairs_by_default ? std::vector<std::string>{"all", "closest"}
                                               : std::vector<std::string>{"closest", "all"},
                          "which points act: each obstacle's closest, or all within influence");
}

bool read_all_pairs(const ParameterValues& values) { return values.choice("points") == "all"; }

void ArmSurroundings::assign(const Problem& problem, const SurroundingsSettings& settings,
                             WorkCounters& counters) {
  problem_ = &problem;
  task_ = TipTask(problem);
  settings_ = settings;
  counters_ = &counters;
  no_weights_ = JointVector::Ones(problem.chain.joints());
  no_clamping_ = JointVector::Zero(problem.chain.joints());
  const std::size_t pairs = problem.chain.links().size() * problem.obstacles.size();
  points_.clear();
  points_.reserve(pairs);
  escapes_.clear();
  escapes_.reserve(pairs);
  search_->assign(problem, settings.exempt_length, counters);
}

void ArmSurroundings::look(int tick, const JointVector& q) {
  search_->go_to(tick - 1);
  problem_->chain.forward(q, pose_);
  ++counters_->kinematics;
  J_known_.fill(false);
  J_task_known_ = false;
  search_->search(pose_, settings_.influence + problem_->link_radius + problem_->margin, points_);
  std::erase_if(points_, [this](const ClosestPoint& point) {  // of links that are thinner
    return point.distance >= settings_.influence + radius_of(point) + problem_->margin;
  });
  if (!settings_.all_pairs) keep_closest_of_each_obstacle();
  escapes_.clear();
  for (const ClosestPoint& point : points_) escapes_.push_back(escape(point, tick));
}

TaskVector ArmSurroundings::task_velocity(const StepInput& input) {
  task_.turn_to(input.R_WT_desired);
  return task_.error(pose_, input.p_WT_desired) / problem_->dt;
}

const JointVector& ArmSurroundings::track(const StepInput& input) {
  solve_hybrid_ik(task_jacobian(), task_velocity(input), no_weights_, no_clamping_, {}, ik_);
  ++counters_->linear_solves;
  return ik_.q_dot;
}

void ArmSurroundings::record(const Escape& escape, StepOutput& output) const {
  const Link& link = problem_->chain.links()[static_cast<std::size_t>(escape.link)];
  record_clamp({.link = link.number, .obstacle = escape.obstacle}, output);
}

/// Of points ordered by obstacle.
void ArmSurroundings::keep_closest_of_each_obstacle() {
  std::size_t kept = 0;
  for (const ClosestPoint& point : points_) {
    if (kept > 0 && points_[kept - 1].obstacle == point.obstacle) {
      if (point.distance - radius_of(point) <
          points_[kept - 1].distance - radius_of(points_[kept - 1])) {
        points_[kept - 1] = point;
      }
    } else {
      points_[kept++] = point;
    }
  }
  points_.resize(kept);
}

Escape ArmSurroundings::escape(const ClosestPoint& point, int tick) {
  const SerialChain& chain = problem_->chain;
  const Link& link = chain.links()[static_cast<std::size_t>(point.link)];
  const TaskVector u = point.direction.head(chain.dimension());
  Escape escape{.link = point.link,
                .obstacle = point.obstacle,
                .clearance = point.distance - radius_of(point) - problem_->margin,
                .j0 = JointVector::Zero(chain.joints())};
  if (point.s > 0) escape.j0 += point.s * (jacobian(link.end).transpose() * u);
  if (point.s < 1) escape.j0 += (1 - point.s) * (jacobian(link.start).transpose() * u);
  if (settings_.obstacle_velocity) {
    const Obstacle& obstacle = problem_->obstacles[static_cast<std::size_t>(point.obstacle)];
    escape.approach =
        point.direction.dot(velocity_at(obstacle, tick, problem_->dt, point.p_obstacle));
  }
  return escape;
}

const TaskJacobian& ArmSurroundings::task_jacobian() {
  if (!task_.has_orientation()) return jacobian(problem_->chain.points() - 1);
  if (!J_task_known_) {
    task_.jacobian(pose_, J_task_);
    ++counters_->jacobians;
    J_task_known_ = true;
  }
  return J_task_;
}

const TaskJacobian& ArmSurroundings::jacobian(int point) {
  const auto k = static_cast<std::size_t>(point);
  if (!J_known_[k]) {
    problem_->chain.jacobian(pose_, point, J_points_[k]);
    ++counters_->jacobians;
    J_known_[k] = true;
  }
  return J_points_[k];
}

}  // namespace bqsa::baselines
