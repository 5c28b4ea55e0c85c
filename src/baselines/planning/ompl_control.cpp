#include <ompl/control/PathControl.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/control/StatePropagator.h>
#include <ompl/control/planners/est/EST.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include <algorithm>

#include "baselines/planning/ompl_planners.hpp"
#include "baselines/planning/ompl_space.hpp"

namespace bqsa::baselines {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

struct Values {
  const double* operator()(const ob::State* state) const {
    return state->as<ob::RealVectorStateSpace::StateType>()->values;
  }
};

double* values_of(ob::State* state) {
  return state->as<ob::RealVectorStateSpace::StateType>()->values;
}

/// What a state has for W s when the motion to it was not allowed: beyond the bounds of states.
constexpr double kNoState = -1;

/// One tick with a joint velocity: its self-motion is made, and the tip put onto the path. Planners
/// ask for the validity of states alone, so that a motion that is not allowed leads to none.
class SelfMotion final : public oc::StatePropagator {
 public:
  SelfMotion(const oc::SpaceInformationPtr& information, PlanningScene& scene,
             const TimeScale& scale)
      : oc::StatePropagator(information), scene_(scene), scale_(scale) {}

  void propagate(const ob::State* state, const oc::Control* control, double /*duration*/,
                 ob::State* result) const override {
    const TimedPosture from = scale_.read(Values()(state));
    const double* velocity = control->as<oc::RealVectorControlSpace::ControlType>()->values;
    TimedPosture to = from;
    const bool allowed = step(from, Eigen::Map<const Eigen::VectorXd>(velocity, scale_.joints), to);
    scale_.write(to, values_of(result));
    if (!allowed) values_of(result)[0] = kNoState;
  }
  bool canPropagateBackward() const override { return false; }

 private:
  static constexpr int kSlowerTries = 3;

  /// Where the velocity is too fast with what the path asks of the joints, half of it is tried.
  bool step(const TimedPosture& from, const JointVector& velocity, TimedPosture& to) const {
    const Problem& problem = scene_.problem();
    const int tick = scale_.nearest_tick(from.t);
    if (tick >= problem.ticks) return false;
    ++scene_.counters().iterations;
    to.t = problem.time(tick + 1);
    JointVector way = problem.dt * scene_.task().self_motion(from.q, velocity);
    for (int k = 0; k < kSlowerTries; ++k) {
      to.q = from.q + way;
      if (!scene_.task().close(to.t, to.q)) return false;
      if (scene_.in_time(from, to)) return scene_.allows(from, to);
      way /= 2;
    }
    return false;
  }

  PlanningScene& scene_;
  const TimeScale& scale_;
};

ob::PlannerPtr planner_of(const ControlSettings& settings,
                          const oc::SpaceInformationPtr& information) {
  if (settings.planner == ControlPlanner::kEst) {
    return std::make_shared<oc::EST>(information);
  }
  const auto rrt = std::make_shared<oc::RRT>(information);
  rrt->setIntermediateStates(true);
  return rrt;
}

}  // namespace

std::vector<TimedPosture> plan_with_controls(PlanningScene& scene, const TimedPosture& first,
                                             const ControlSettings& settings, const Stop& stop) {
  const Problem& problem = scene.problem();
  const TimeScale scale(problem, settings.time_scale);
  const auto joints = static_cast<unsigned>(problem.chain.joints());

  const auto space = std::make_shared<ob::RealVectorStateSpace>(joints + 1);
  space->setBounds(bounds_of(problem, settings.time_scale, 1));
  space->registerDefaultProjection(std::make_shared<TimeAndFirstJoints<Values>>(
      space, settings.cell_time * settings.time_scale, settings.cell_joint));

  const auto controls = std::make_shared<oc::RealVectorControlSpace>(space, joints);
  ob::RealVectorBounds velocities(joints);
  for (unsigned j = 0; j < joints; ++j) {
    const double fastest =
        std::min(settings.self_motion, scene.largest_way(static_cast<int>(j), 1) / problem.dt);
    velocities.setLow(j, -fastest);
    velocities.setHigh(j, fastest);
  }
  controls->setBounds(velocities);

  const auto information = std::make_shared<oc::SpaceInformation>(space, controls);
  information->setStatePropagator(std::make_shared<SelfMotion>(information, scene, scale));
  information->setPropagationStepSize(1);  // [ticks]
  information->setMinMaxControlDuration(1, static_cast<unsigned>(settings.hold_ticks));
  information->setStateValidityChecker(
      [&](const ob::State* state) { return space->satisfiesBounds(state); });
  information->setup();

  ob::ScopedState<ob::RealVectorStateSpace> start(space);
  scale.write(first, start->values);
  const auto definition = std::make_shared<ob::ProblemDefinition>(information);
  definition->addStartState(start);
  definition->setGoal(std::make_shared<EndOfPath<Values>>(information, settings.time_scale));

  const ob::PlannerTerminationCondition condition(stop);
  const ob::PlannerPtr planner = planner_of(settings, information);
  planner->setProblemDefinition(definition);
  planner->setup();
  if (planner->solve(condition) != ob::PlannerStatus::EXACT_SOLUTION) return {};

  oc::PathControl path = *definition->getSolutionPath()->as<oc::PathControl>();
  path.interpolate();
  std::vector<TimedPosture> way;
  for (const ob::State* state : path.getStates()) way.push_back(scale.read(Values()(state)));
  return way;
}

}  // namespace bqsa::baselines
