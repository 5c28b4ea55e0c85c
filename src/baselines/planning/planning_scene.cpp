#include "baselines/planning/planning_scene.hpp"

#include <algorithm>
#include <cmath>

namespace bqsa::baselines {
namespace {

/// Kept from the largest step, for what rounding adds to a step [-].
constexpr double kRounding = 1e-9;

Problem with_margin(const Problem& problem, double clearance) {
  Problem roomier = problem;
  roomier.margin += clearance;
  return roomier;
}

}  // namespace

PlanningScene::PlanningScene(const Problem& problem, const PlanningReserve& reserve,
                             WorkCounters& counters)
    : problem_(problem),
      roomier_(with_margin(problem, reserve.clearance)),
      reserve_(reserve),
      counters_(counters) {
  reserve_.speed = std::min(reserve.speed, 1 - kRounding);
  task_.assign(problem_, counters_);
  with_reserve_.assign(roomier_, counters_);
  plain_.assign(problem_, counters_);
}

bool PlanningScene::in_time(const TimedPosture& from, const TimedPosture& to) const {
  const double ticks = (to.t - from.t) / problem_.dt;
  for (int j = 0; j < problem_.chain.joints(); ++j) {
    if (!(std::abs(to.q(j) - from.q(j)) <= largest_way(j, ticks))) return false;
  }
  return true;
}

bool PlanningScene::allows(const TimedPosture& posture) {
  return problem_.within_limits(posture.q) && with_reserve_.is_free(posture.t, posture.q);
}

bool PlanningScene::allows(const TimedPosture& from, const TimedPosture& to) {
  return in_time(from, to) && problem_.within_limits(to.q) &&
         with_reserve_.is_free(from.t, from.q, to.t, to.q);
}

bool PlanningScene::first_tick(TimedPosture& first) {
  first = {.t = problem_.time(1), .q = problem_.start};
  return task_.close(first.t, first.q) &&
         forbidden_step(problem_, problem_.start, first.q) == Infeasible::kNot &&
         plain_.is_free(0, problem_.start, first.t, first.q) && allows(first);
}

bool PlanningScene::at_ticks(const std::vector<TimedPosture>& way, Trajectory& trajectory) {
  trajectory = {.t = {0}, .q = {problem_.start}};
  std::size_t next = 0;
  for (int tick = 1; tick <= problem_.ticks; ++tick) {
    const double t = problem_.time(tick);
    while (next + 1 < way.size() && way[next].t < t) ++next;
    JointVector q = way[next].q;
    if (next > 0) {
      const TimedPosture& last = way[next - 1];
      const double part = std::clamp((t - last.t) / (way[next].t - last.t), 0.0, 1.0);
      q = last.q + part * (way[next].q - last.q);
    }
    if (!task_.close(t, q)) return false;
    trajectory.t.push_back(t);
    trajectory.q.push_back(q);
  }
  return true;
}

bool PlanningScene::solves(const Trajectory& trajectory) {
  const auto rows = static_cast<std::size_t>(problem_.ticks) + 1;
  if (trajectory.q.size() != rows || trajectory.q.front() != problem_.start) return false;
  for (int tick = 1; tick <= problem_.ticks; ++tick) {
    const JointVector& last = trajectory.q[static_cast<std::size_t>(tick) - 1];
    const JointVector& q = trajectory.q[static_cast<std::size_t>(tick)];
    if (task_.error(problem_.time(tick), q) > problem_.tolerance ||
        forbidden_step(problem_, last, q) != Infeasible::kNot ||
        !plain_.is_free(problem_.time(tick - 1), last, problem_.time(tick), q)) {
      return false;
    }
  }
  return true;
}

}  // namespace bqsa::baselines
