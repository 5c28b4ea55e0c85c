#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include "baselines/planning/ompl_planners.hpp"
#include "baselines/planning/ompl_space.hpp"

namespace bqsa::baselines {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using RealVectorState = ob::RealVectorStateSpace::StateType;

constexpr int kGoals = 10;
constexpr int kGoalDraws = 10000;

JointVector read(const ob::State* state, int joints) {
  return Eigen::Map<const Eigen::VectorXd>(state->as<RealVectorState>()->values, joints);
}

ob::RealVectorBounds joint_bounds(const Problem& problem) {
  const ob::RealVectorBounds with_time = bounds_of(problem, 1, 1);
  ob::RealVectorBounds bounds(static_cast<unsigned>(problem.chain.joints()));
  bounds.low.assign(with_time.low.begin() + 1, with_time.low.end());
  bounds.high.assign(with_time.high.begin() + 1, with_time.high.end());
  return bounds;
}

/// Straight joint motions, free with proof.
class FreeMotions final : public ob::MotionValidator {
 public:
  FreeMotions(const ob::SpaceInformationPtr& information, PlanningScene& scene)
      : ob::MotionValidator(information), scene_(scene) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    ++scene_.counters().iterations;
    const int joints = scene_.problem().chain.joints();
    const JointVector q = read(to, joints);
    return scene_.problem().within_limits(q) && scene_.is_free_at_rest(read(from, joints), q);
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    if (checkMotion(from, to)) return true;
    if (last_valid.first != nullptr) si_->copyState(last_valid.first, from);
    last_valid.second = 0;
    return false;
  }

 private:
  PlanningScene& scene_;
};

/// Free postures with the tip at the end of the path.
ob::GoalPtr goals_of(PlanningScene& scene, const ob::SpaceInformationPtr& information,
                     const ob::RealVectorBounds& bounds, const Stop& stop) {
  const Problem& problem = scene.problem();
  const auto goals = std::make_shared<ob::GoalStates>(information);
  ompl::RNG random;
  TimedPosture end{.t = problem.duration(), .q = problem.start};
  for (int k = 0; k < kGoalDraws && !stop(); ++k) {
    if (goals->getStateCount() == kGoals) break;
    for (int j = 0; j < problem.chain.joints(); ++j) {
      const auto i = static_cast<std::size_t>(j);
      end.q(j) = random.uniformReal(bounds.low[i], bounds.high[i]);
    }
    if (!scene.task().close(end.t, end.q) || !problem.within_limits(end.q) ||
        !scene.is_free_at_rest(end.q, end.q)) {
      continue;
    }
    ob::ScopedState<ob::RealVectorStateSpace> goal(information->getStateSpace());
    Eigen::Map<Eigen::VectorXd>(goal->values, end.q.size()) = end.q;
    if (information->satisfiesBounds(goal.get())) goals->addState(goal);
  }
  return goals->hasStates() ? goals : nullptr;
}

}  // namespace

std::vector<JointVector> plan_in_joint_space(PlanningScene& scene, double range, const Stop& stop) {
  const Problem& problem = scene.problem();
  const int joints = problem.chain.joints();
  const auto space = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(joints));
  space->setBounds(joint_bounds(problem));
  const auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker([&](const ob::State* state) {
    const JointVector q = read(state, joints);
    return problem.within_limits(q) && scene.is_free_at_rest(q, q);
  });
  information->setMotionValidator(std::make_shared<FreeMotions>(information, scene));
  information->setup();

  ob::ScopedState<ob::RealVectorStateSpace> start(space);
  Eigen::Map<Eigen::VectorXd>(start->values, joints) = problem.start;
  const auto definition = std::make_shared<ob::ProblemDefinition>(information);
  definition->addStartState(start);
  const ob::GoalPtr goal = goals_of(scene, information, space->getBounds(), stop);
  if (goal == nullptr) return {};
  definition->setGoal(goal);

  const ob::PlannerTerminationCondition condition(stop);
  const auto rrt_connect = std::make_shared<og::RRTConnect>(information);
  rrt_connect->setRange(range);
  const ob::PlannerPtr planner = rrt_connect;
  planner->setProblemDefinition(definition);
  planner->setup();
  if (planner->solve(condition) != ob::PlannerStatus::EXACT_SOLUTION) return {};

  og::PathGeometric path = *definition->getSolutionPath()->as<og::PathGeometric>();
  og::PathSimplifier(information, goal).simplify(path, condition);
  std::vector<JointVector> corners;
  for (const ob::State* state : path.getStates()) corners.push_back(read(state, joints));
  return corners;
}

}  // namespace bqsa::baselines
