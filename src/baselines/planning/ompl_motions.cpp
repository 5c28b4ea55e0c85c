#include "baselines/planning/ompl_motions.hpp"

#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <memory>

namespace bqsa::baselines {

namespace ob = ompl::base;
namespace og = ompl::geometric;

JointVector joints_of(const ob::State* state, Eigen::Index joints) {
  return Eigen::Map<const Eigen::VectorXd>(state->as<ob::RealVectorStateSpace::StateType>()->values,
                                           joints);
}

JointState state_of(const ob::StateSpacePtr& space, const JointVector& q) {
  JointState state(space);
  Eigen::Map<Eigen::VectorXd>(state->values, q.size()) = q;
  return state;
}

bool WholeMotions::checkMotion(const ob::State* from, const ob::State* to,
                               std::pair<ob::State*, double>& last_valid) const {
  if (checkMotion(from, to)) return true;
  if (last_valid.first != nullptr) si_->copyState(last_valid.first, from);
  last_valid.second = 0;
  return false;
}

bool StraightMotions::checkMotion(const ob::State* from, const ob::State* to) const {
  const auto joints = static_cast<Eigen::Index>(si_->getStateDimension());
  return si_->satisfiesBounds(to) && allowed_(joints_of(from, joints), joints_of(to, joints));
}

std::optional<og::PathGeometric> rrt_connect(const ob::SpaceInformationPtr& information,
                                             const JointVector& start, const ob::GoalPtr& goal,
                                             double range, const Stop& stop) {
  const auto definition = std::make_shared<ob::ProblemDefinition>(information);
  definition->addStartState(state_of(information->getStateSpace(), start));
  definition->setGoal(goal);
  og::RRTConnect planner(information);
  planner.setRange(range);
  planner.setProblemDefinition(definition);
  planner.setup();
  const ob::PlannerTerminationCondition condition(stop);
  if (planner.solve(condition) != ob::PlannerStatus::EXACT_SOLUTION) return std::nullopt;
  return *definition->getSolutionPath()->as<og::PathGeometric>();
}

std::vector<JointVector> simplified(og::PathGeometric path, const ob::GoalPtr& goal,
                                    const Stop& stop) {
  const ob::SpaceInformationPtr& information = path.getSpaceInformation();
  og::PathSimplifier(information, goal).simplify(path, ob::PlannerTerminationCondition(stop));
  const auto joints = static_cast<Eigen::Index>(information->getStateDimension());
  std::vector<JointVector> corners;
  for (const ob::State* state : path.getStates()) corners.push_back(joints_of(state, joints));
  return corners;
}

}  // namespace bqsa::baselines
