#include <ompl/util/RandomNumbers.h>

#include "baselines/planning/ompl_motions.hpp"
#include "baselines/planning/ompl_space.hpp"

namespace bqsa::baselines {
namespace {

namespace ob = ompl::base;

constexpr int kGoals = 10;
constexpr int kGoalDraws = 10000;

ob::RealVectorBounds joint_bounds(const Problem& problem) {
  const ob::RealVectorBounds with_time = bounds_of(problem, 1, 1);
  ob::RealVectorBounds bounds(static_cast<unsigned>(problem.chain.joints()));
  bounds.low.assign(with_time.low.begin() + 1, with_time.low.end());
  bounds.high.assign(with_time.high.begin() + 1, with_time.high.end());
  return bounds;
}

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
    const JointState goal = state_of(information->getStateSpace(), end.q);
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
  const auto is_free = [&](const JointVector& from, const JointVector& to) {
    return problem.within_limits(to) && scene.is_free_at_rest(from, to);
  };
  information->setStateValidityChecker([&](const ob::State* state) {
    const JointVector q = joints_of(state, joints);
    return is_free(q, q);
  });
  information->setMotionValidator(std::make_shared<StraightMotions>(
      information, [&](const JointVector& from, const JointVector& to) {
        ++scene.counters().iterations;
        return is_free(from, to);
      }));
  information->setup();

  const ob::GoalPtr goal = goals_of(scene, information, space->getBounds(), stop);
  if (goal == nullptr) return {};
  const auto path = rrt_connect(information, problem.start, goal, range, stop);
  return path ? simplified(*path, goal, stop) : std::vector<JointVector>();
}

}  // namespace bqsa::baselines
