// Links with radii of their own, from the judge's readings to whole runs.
#include <gtest/gtest.h>

#include <string>

#include "harness/judge/judge.hpp"
#include "harness/judge/link_scene.hpp"
#include "harness/method_spec.hpp"
#include "harness/methods.hpp"
#include "harness/runner.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa::harness {
namespace {

/// With links of 20 mm.
Problem rail_arm() {
  Problem problem = load_scenario(BQSA_SOURCE_DIR "/tests/harness/program/rail_arm.yaml").problem;
  problem.link_radii.clear();
  problem.link_radius = 0.02;
  return problem;
}

Problem planar_7r() { return load_scenario(BQSA_SOURCE_DIR "/scenarios/planar_7r.yaml").problem; }

RunOutcome run(const Problem& problem, const MethodEntry& method) {
  return run_method(problem, method, ParameterValues(method.parameters), {.plan_budget_s = 2});
}

/// The reading of each pair is that of an arm of which all links have this link's radius.
TEST(LinkRadii, TheJudgeReadsEachLinkWithItsOwn) {
  Problem problem = rail_arm();
  const std::size_t links = problem.chain.links().size();
  for (std::size_t i = 0; i < links; ++i) {
    problem.link_radii.push_back(0.02 - 0.003 * static_cast<double>(i % 5));
  }
  const LinkScene scene(problem);
  PointPositions positions;
  scene.kinematics().place(problem.start, positions);
  for (const LinkObstaclePair& pair : scene.pairs()) {
    Problem other = problem;
    other.link_radii.clear();
    other.link_radius = problem.link_radii[static_cast<std::size_t>(pair.link)];
    const PairReading own = scene.read(positions, pair, {0, 1}, FclQuestion::kHitAndDistance);
    const PairReading same =
        LinkScene(other).read(positions, pair, {0, 1}, FclQuestion::kHitAndDistance);
    EXPECT_EQ(own.clearance, same.clearance);
    EXPECT_EQ(own.contradiction, "");
  }
}

/// A list of equal radii is the number.
TEST(LinkRadii, EqualOnesChangeNothing) {
  int moved = 0;
  for (const bool planar : {true, false}) {
    Problem number = planar ? planar_7r() : rail_arm();
    if (planar) number.link_radius = 0.002;
    Problem list = number;
    list.link_radii.assign(number.chain.links().size(), number.link_radius);
    for (const MethodEntry& method : methods()) {
      if (method.capabilities.plans) continue;  // as far as time goes
      if (!why_not_applicable(method.capabilities, number).empty()) continue;
      const RunOutcome one = run(number, method), other = run(list, method);
      ASSERT_EQ(one.trajectory.q.size(), other.trajectory.q.size()) << method.name;
      for (std::size_t k = 0; k < one.trajectory.q.size(); ++k) {
        ASSERT_EQ(one.trajectory.q[k], other.trajectory.q[k]) << method.name << ' ' << k;
      }
      EXPECT_EQ(one.counters, other.counters) << method.name;
      const Judgement first = Judge(number).judge(one.trajectory);
      const Judgement second = Judge(list).judge(other.trajectory);
      EXPECT_EQ(first.failures, second.failures) << method.name;
      EXPECT_EQ(first.clearance, second.clearance) << method.name;
      EXPECT_EQ(first.clearance_at_ticks, second.clearance_at_ticks) << method.name;
      moved += one.trajectory.q.size() > 50;
    }
  }
  EXPECT_GT(moved, 10);
}

/// The first link is thick, the others pass where it would not: the arm of one radius starts in
/// collision.
TEST(LinkRadii, OnlyTheThickLinkNeedsRoom) {
  Problem problem = planar_7r();
  const std::size_t links = problem.chain.links().size();
  problem.link_radii.assign(links, 0.001);
  problem.link_radii.front() = problem.link_radius = 0.1;
  Problem thick = problem;
  thick.link_radii.clear();
  int solved = 0;
  for (const MethodEntry& method : methods()) {
    if (!why_not_applicable(method.capabilities, problem).empty()) continue;
    const RunOutcome outcome = run(problem, method);
    const Judgement own = Judge(problem).judge(outcome.trajectory);
    if (outcome.claim == Claim::kSuccess) {
      EXPECT_TRUE(own.success()) << method.name;
    }
    if (!own.success()) continue;
    ++solved;
    EXPECT_FALSE(Judge(thick).judge(outcome.trajectory).success()) << method.name;
  }
  EXPECT_GT(solved, 8);
}

}  // namespace
}  // namespace bqsa::harness
