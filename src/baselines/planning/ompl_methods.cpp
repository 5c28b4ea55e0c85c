#include "baselines/planning/ompl_methods.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "baselines/planning/ompl_planners.hpp"
#include "baselines/planning/planning_scene.hpp"

namespace bqsa::baselines {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kSource =
    "Sucan, Moll and Kavraki: The Open Motion Planning Library, IEEE Robotics and Automation "
    "Magazine "
    "19(4), 2012; OMPL 1.5.2";

Stop after(double seconds) {
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  return [end] { return Clock::now() >= end; };
}

enum class Planner { kKpiece, kRrt, kEst };

struct Settings {
  Planner planner = Planner::kKpiece;
  PlanningReserve reserve;
  ConstrainedSettings constrained;
  ControlSettings control;
  double budget = 0;  ///< [s]
};

class Ompl final : public PlanningMethod {
 public:
  explicit Ompl(const Settings& settings) : settings_(settings) {}

  void prepare(const Problem& problem) override {
    problem_ = &problem;
    counters_ = {};
  }

  /// Plans again with fresh planners, and the random numbers that follow, until a plan passes the
  /// check at the ticks or the time is over.
  Plan plan(double budget_s, std::uint64_t seed) override {
    const Stop stop = after(std::min(budget_s, settings_.budget));
    start_ompl(seed);
    PlanningScene scene(*problem_, settings_.reserve, counters_);
    TimedPosture first;
    if (!scene.first_tick(first)) return {};
    while (!stop()) {
      const std::vector<TimedPosture> way = way_from(scene, first, stop);
      Plan plan;
      plan.solved =
          !way.empty() && scene.at_ticks(way, plan.trajectory) && scene.solves(plan.trajectory);
      if (plan.solved) return plan;
    }
    return {};
  }

 private:
  std::vector<TimedPosture> way_from(PlanningScene& scene, const TimedPosture& first,
                                     const Stop& stop) const {
    if (problem_->ticks == 1) return {first};
    return settings_.planner == Planner::kKpiece
               ? plan_on_manifold(scene, first, settings_.constrained, stop)
               : plan_with_controls(scene, first, settings_.control, stop);
  }

  Settings settings_;
  const Problem* problem_ = nullptr;
};

/// A whole number of ticks for each straight motion between corners, at least what the joint
/// velocities need, the others where the joints are fastest.
/// @return empty if there are not enough ticks
std::vector<int> ticks_of(const PlanningScene& scene, const std::vector<JointVector>& corners) {
  std::vector<double> needed;
  std::vector<int> ticks;
  int left = scene.problem().ticks;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    double longest = 0;
    for (int j = 0; j < corners[i].size(); ++j) {
      const double way = std::abs(corners[i](j) - corners[i - 1](j));
      longest = std::max(longest, way / scene.largest_way(j, 1));
    }
    if (longest > left) return {};
    needed.push_back(longest);
    ticks.push_back(std::max(1, static_cast<int>(std::ceil(longest))));
    left -= ticks.back();
  }
  if (left < 0) return {};
  for (; left > 0; --left) {
    std::size_t fastest = 0;
    for (std::size_t i = 1; i < ticks.size(); ++i) {
      if (needed[i] * ticks[fastest] > needed[fastest] * ticks[i]) fastest = i;
    }
    ++ticks[fastest];
  }
  return ticks;
}

class OmplJoint final : public PlanningMethod {
 public:
  explicit OmplJoint(double range) : range_(range) {}

  void prepare(const Problem& problem) override {
    problem_ = &problem;
    counters_ = {};
  }

  Plan plan(double budget_s, std::uint64_t seed) override {
    const Stop stop = after(budget_s);
    start_ompl(seed);
    PlanningScene scene(*problem_, {}, counters_);
    while (!stop()) {
      const std::vector<JointVector> corners = plan_in_joint_space(scene, range_, stop);
      if (corners.size() < 2) continue;
      const std::vector<int> ticks = ticks_of(scene, corners);
      if (ticks.empty()) continue;
      Plan plan{.solved = false, .trajectory = timed(corners, ticks)};
      plan.solved = scene.solves(plan.trajectory);
      return plan;
    }
    return {};
  }

 private:
  Trajectory timed(const std::vector<JointVector>& corners, const std::vector<int>& ticks) const {
    Trajectory trajectory{.t = {0}, .q = {problem_->start}};
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      for (int k = 1; k <= ticks[i]; ++k) {
        const double part = static_cast<double>(k) / ticks[i];
        trajectory.t.push_back(problem_->time(static_cast<int>(trajectory.t.size())));
        trajectory.q.push_back(corners[i] + part * (corners[i + 1] - corners[i]));
      }
    }
    return trajectory;
  }

  double range_;
  const Problem* problem_ = nullptr;
};

std::vector<ParameterDeclaration> parameters() {
  return {
      choice_parameter("planner", {"kpiece", "rrt", "est"},
                       "KPIECE1 on the manifold; RRT or EST with joint velocities as controls"),
      {"range", "rad", 0.6, 1e-3, 10, "longest motion of kpiece, of a joint or in W s"},
      {"time_scale", "rad", 2, 1e-2, 1000,
       "W of kpiece: what the whole duration counts in distances"},
      choice_parameter("hops", {"delta", "tick"},
                       "kpiece traces its motions by delta, as OMPL does it, or from tick to tick"),
      {"delta", "rad", 0.05, 1e-4, 1, "step on the manifold of hops = delta"},
      choice_parameter("sampling", {"forward", "near"},
                       "kpiece draws states later and within joint velocity, or all around"),
      choice_parameter("simplify", {"on", "off"}, "simplifies the path of kpiece"),
      {"cell_time", "-", 0.05, 1e-4, 1, "projection cell along the path, as a part of it"},
      {"cell_joint", "rad", 0.3, 1e-3, 10, "projection cell in joints 1 and 2"},
      {"control_time_scale", "rad", 10, 1e-2, 1000, "W of rrt and est"},
      {"self_motion", "rad/s", 1, 1e-3, 100, "largest joint velocity of a control (rrt, est)"},
      integer_parameter("hold_ticks", "-", 30, 1, 1000, "longest hold of a control (rrt, est)"),
      {"clearance", "m", 0, 0, 1, "kept beyond margin and link radius while planning"},
      {"speed", "-", 1, 0.01, 1, "share of the joint velocity limits used while planning"},
      {"budget", "s", 1e6, 1e-3, 1e6, "upper bound of the time for planning"},
  };
}

std::unique_ptr<Method> make(const ParameterValues& values) {
  Settings settings;
  const std::string& planner = values.choice("planner");
  settings.planner = planner == "kpiece" ? Planner::kKpiece
                     : planner == "rrt"  ? Planner::kRrt
                                         : Planner::kEst;
  settings.reserve = {.clearance = values.number("clearance"), .speed = values.number("speed")};
  settings.constrained = {
      .hops = values.choice("hops") == "tick" ? Hops::kTick : Hops::kDelta,
      .sampling = values.choice("sampling") == "forward" ? Sampling::kForward : Sampling::kNear,
      .time_scale = values.number("time_scale"),
      .range = values.number("range"),
      .delta = values.number("delta"),
      .cell_time = values.number("cell_time"),
      .cell_joint = values.number("cell_joint"),
      .simplify = values.choice("simplify") == "on"};
  settings.control = {.planner = planner == "est" ? ControlPlanner::kEst : ControlPlanner::kRrt,
                      .time_scale = values.number("control_time_scale"),
                      .cell_time = values.number("cell_time"),
                      .cell_joint = values.number("cell_joint"),
                      .self_motion = values.number("self_motion"),
                      .hold_ticks = values.integer("hold_ticks")};
  settings.budget = values.number("budget");
  return std::make_unique<Ompl>(settings);
}

}  // namespace

MethodEntry ompl_method() {
  return {
      .name = "ompl",
      .summary = "planner: OMPL's KPIECE1 on the tip's path, or its RRT and EST over self-motions",
      .source = kSource,
      .capabilities = {.planar = true,
                       .spatial = true,
                       .link_radius = true,
                       .margin = true,
                       .moving = true,
                       .plans = true},
      .parameters = parameters(),
      .make = make};
}

MethodEntry ompl_joint_method() {
  return {.name = "ompl_joint",
          .summary = "planner: OMPL's RRTConnect in joint space; does not follow the path",
          .source = kSource,
          .capabilities =
              {.planar = true, .spatial = true, .link_radius = true, .margin = true, .plans = true},
          .parameters = {{"range", "rad", 0, 0, 10, "longest motion; 0 for OMPL's own choice"}},
          .make = [](const ParameterValues& values) {
            return std::make_unique<OmplJoint>(values.number("range"));
          }};
}

}  // namespace bqsa::baselines
