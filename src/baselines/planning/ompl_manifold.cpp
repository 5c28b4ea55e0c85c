#include <ompl/base/ConstrainedSpaceInformation.h>
#include <ompl/base/Constraint.h>
#include <ompl/base/spaces/constraint/ProjectedStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>

#include <algorithm>
#include <utility>

#include "baselines/planning/ompl_motions.hpp"
#include "baselines/planning/ompl_space.hpp"

namespace bqsa::baselines {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

struct Values {
  const double* operator()(const ob::State* state) const {
    return state->as<ob::ConstrainedStateSpace::StateType>()->data();
  }
};

double* values_of(ob::State* state) {
  return state->as<ob::ConstrainedStateSpace::StateType>()->data();
}

/// All that the classes below share.
struct Manifold {
  PlanningScene& scene;
  const ConstrainedSettings& settings;
  TimeScale scale;

  TimedPosture read(const ob::State* state) const { return scale.read(Values()(state)); }
  void write(const TimedPosture& posture, ob::State* state) const {
    scale.write(posture, values_of(state));
  }
};

/// The tip is on the path: tip(q) - x_d(t) = 0.
class TipOnPath final : public ob::Constraint {
 public:
  explicit TipOnPath(const Manifold& manifold)
      : ob::Constraint(static_cast<unsigned>(manifold.scale.joints) + 1,
                       static_cast<unsigned>(manifold.scene.problem().dimension()), kTolerance),
        manifold_(manifold) {}

  void function(const Eigen::Ref<const Eigen::VectorXd>& x,
                Eigen::Ref<Eigen::VectorXd> out) const override {
    const Problem& problem = manifold_.scene.problem();
    const TimedPosture posture = manifold_.scale.read(x.data());
    ChainPose pose;
    problem.chain.forward(posture.q, pose);
    ++manifold_.scene.counters().kinematics;
    out = (pose.tip() - problem.desired_tip(posture.t)).head(problem.dimension());
  }

  /// Joints alone are moved. OMPL's own projection moves the time too, back as often as forth.
  bool project(Eigen::Ref<Eigen::VectorXd> x) const override {
    const TimeScale& scale = manifold_.scale;
    TimedPosture posture = scale.read(x.data());
    posture.t = std::clamp(posture.t, 0.0, scale.duration);
    if (manifold_.settings.hops == Hops::kTick) {
      posture.t = manifold_.scene.problem().time(scale.nearest_tick(posture.t));
    }
    if (!manifold_.scene.task().close(posture.t, posture.q)) return false;
    scale.write(posture, x.data());
    return true;
  }

 private:
  static constexpr double kTolerance = 1e-7;  // [m]
  const Manifold& manifold_;
};

/// Near states are drawn later than the state, where the joint velocities can get.
class ForwardSampler final : public ob::ProjectedStateSampler {
 public:
  ForwardSampler(const ob::ProjectedStateSpace* space, ob::StateSamplerPtr ambient,
                 const Manifold& manifold)
      : ob::ProjectedStateSampler(space, std::move(ambient)), manifold_(manifold) {}

  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    PlanningScene& scene = manifold_.scene;
    const Problem& problem = scene.problem();
    const TimedPosture from = manifold_.read(near);
    const int tick = manifold_.scale.nearest_tick(from.t);
    const int most = std::max(
        1, static_cast<int>(distance / manifold_.scale.scale * static_cast<double>(problem.ticks)));
    const int ticks = std::min(rng_.uniformInt(1, most), problem.ticks - tick);
    TimedPosture to = from;
    if (ticks > 0) {
      to.t = problem.time(tick + ticks);
      for (int k = 0; k < kDraws; ++k) {
        for (int j = 0; j < problem.chain.joints(); ++j) {
          const double way = std::min(distance, scene.largest_way(j, ticks));
          to.q(j) = from.q(j) + rng_.uniformReal(-way, way);
        }
        if (scene.task().close(to.t, to.q) && scene.in_time(from, to)) break;
        to.q = from.q;
      }
    }
    manifold_.write(to, state);
  }

 private:
  static constexpr int kDraws = 10;
  const Manifold& manifold_;
};

class PathSpace final : public ob::ProjectedStateSpace {
 public:
  PathSpace(const ob::StateSpacePtr& ambient, const ob::ConstraintPtr& constraint,
            const Manifold& manifold)
      : ob::ProjectedStateSpace(ambient, constraint), manifold_(manifold) {
    setName("postures on the path");
  }

  ob::StateSamplerPtr allocStateSampler() const override {
    if (manifold_.settings.sampling == Sampling::kNear) {
      return ob::ProjectedStateSpace::allocStateSampler();
    }
    return std::make_shared<ForwardSampler>(this, getSpace()->allocStateSampler(), manifold_);
  }

  /// From tick to tick an even share of what is left of the joints' way, put onto the path. Whether
  /// the motions are allowed is the motion validator's to say.
  bool discreteGeodesic(const ob::State* from, const ob::State* to, bool interpolate,
                        std::vector<ob::State*>* geodesic) const override {
    if (manifold_.settings.hops == Hops::kDelta) {
      return ob::ProjectedStateSpace::discreteGeodesic(from, to, interpolate, geodesic);
    }
    const auto keep = [&](const ob::State* state) {
      if (geodesic != nullptr) geodesic->push_back(cloneState(state));
    };
    if (geodesic != nullptr) geodesic->clear();
    keep(from);
    const Problem& problem = manifold_.scene.problem();
    const TimedPosture end = manifold_.read(to);
    TimedPosture posture = manifold_.read(from);
    const int last = manifold_.scale.nearest_tick(end.t);
    const int first = manifold_.scale.nearest_tick(posture.t);
    if (last <= first) return last == first && end.q == posture.q;
    ob::State* passed = allocState();
    bool closed = true;
    for (int tick = first + 1; tick < last && closed; ++tick) {
      posture.t = problem.time(tick);
      posture.q += (end.q - posture.q) / (last - tick + 1);
      closed = manifold_.scene.task().close(posture.t, posture.q);
      if (!closed) break;
      manifold_.write(posture, passed);
      keep(passed);
    }
    freeState(passed);
    if (closed) keep(to);
    return closed;
  }

 private:
  const Manifold& manifold_;
};

/// Motions are traced on the manifold, and each hop has to be later, in time and free with proof.
class HopValidator final : public WholeMotions {
 public:
  HopValidator(const ob::SpaceInformationPtr& information, const PathSpace& space,
               const Manifold& manifold)
      : WholeMotions(information), space_(space), manifold_(manifold) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    ++manifold_.scene.counters().iterations;
    const TimedPosture end = manifold_.read(to);
    if (!(end.t > manifold_.read(from).t) || !manifold_.scene.allows(end)) return false;
    if (!space_.getConstraint()->isSatisfied(to)) return false;
    std::vector<TimedPosture> hops;
    if (!trace(space_, manifold_, from, to, hops)) return false;
    for (std::size_t i = 1; i < hops.size(); ++i) {
      if (!(hops[i].t > hops[i - 1].t) || !manifold_.scene.allows(hops[i - 1], hops[i])) {
        return false;
      }
    }
    return true;
  }

  using WholeMotions::checkMotion;

  /// All postures of the motion, both ends with it.
  static bool trace(const PathSpace& space, const Manifold& manifold, const ob::State* from,
                    const ob::State* to, std::vector<TimedPosture>& hops) {
    std::vector<ob::State*> states;
    const bool arrived = space.discreteGeodesic(from, to, true, &states);
    for (ob::State* state : states) {
      hops.push_back(manifold.read(state));
      space.freeState(state);
    }
    // ProjectedStateSpace ends within delta of the target: the last hop is there to be checked too.
    const TimedPosture end = manifold.read(to);
    if (arrived && hops.back().q != end.q) hops.push_back(end);
    return arrived;
  }

 private:
  const PathSpace& space_;
  const Manifold& manifold_;
};

}  // namespace

std::vector<TimedPosture> plan_on_manifold(PlanningScene& scene, const TimedPosture& first,
                                           const ConstrainedSettings& settings, const Stop& stop) {
  const Problem& problem = scene.problem();
  const Manifold manifold{scene, settings, TimeScale(problem, settings.time_scale)};

  // Samples beyond the end of the path are clamped onto it; without them it is never reached.
  constexpr double kBeyondTheEnd = 1.25;
  const auto ambient =
      std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(problem.chain.joints()) + 1);
  ambient->setBounds(bounds_of(problem, settings.time_scale, kBeyondTheEnd));
  const auto space =
      std::make_shared<PathSpace>(ambient, std::make_shared<TipOnPath>(manifold), manifold);
  const auto information = std::make_shared<ob::ConstrainedSpaceInformation>(space);
  space->setDelta(settings.delta);
  space->registerDefaultProjection(std::make_shared<TimeAndFirstJoints<Values>>(
      space, settings.cell_time * settings.time_scale, settings.cell_joint));
  information->setStateValidityChecker(
      [&](const ob::State* state) { return scene.allows(manifold.read(state)); });
  information->setMotionValidator(std::make_shared<HopValidator>(information, *space, manifold));
  information->setup();

  ob::ScopedState<> start(space);
  manifold.write(first, start.get());
  const auto definition = std::make_shared<ob::ProblemDefinition>(information);
  definition->addStartState(start);
  definition->setGoal(std::make_shared<EndOfPath<Values>>(information, settings.time_scale));

  const ob::PlannerTerminationCondition condition(stop);
  const auto kpiece = std::make_shared<og::KPIECE1>(information);
  kpiece->setRange(settings.range);
  const ob::PlannerPtr planner = kpiece;
  planner->setProblemDefinition(definition);
  planner->setup();
  if (planner->solve(condition) != ob::PlannerStatus::EXACT_SOLUTION) return {};

  og::PathGeometric path = *definition->getSolutionPath()->as<og::PathGeometric>();
  if (settings.simplify) og::PathSimplifier(information).simplify(path, condition);
  std::vector<TimedPosture> way = {first};
  for (std::size_t i = 1; i < path.getStateCount(); ++i) {
    std::vector<TimedPosture> hops;
    if (!HopValidator::trace(*space, manifold, path.getState(static_cast<unsigned>(i) - 1),
                             path.getState(static_cast<unsigned>(i)), hops)) {
      return {};
    }
    way.insert(way.end(), hops.begin() + 1, hops.end());
  }
  return way;
}

}  // namespace bqsa::baselines
