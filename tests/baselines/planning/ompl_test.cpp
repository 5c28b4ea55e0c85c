// The planners of OMPL: what they claim is looked at with dense sampling and nothing of theirs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "baselines/planning/ompl_methods.hpp"
#include "support/assorted_scenes.hpp"

namespace bqsa::baselines {
namespace {

using test_support::assorted_scenes;
using test_support::planar_7r;
using test_support::sampled_hits;
using ::testing::IsEmpty;

constexpr double kGenerousBudget = 60;  // [s]

using Changes = std::vector<std::pair<std::string, std::string>>;

std::unique_ptr<PlanningMethod> make(const MethodEntry& entry, const Changes& changes = {}) {
  ParameterValues values(entry.parameters);
  for (const auto& [name, value] : changes) values.set(name, value);
  return std::unique_ptr<PlanningMethod>(
      dynamic_cast<PlanningMethod*>(entry.make(values).release()));
}

PlanningMethod::Plan plan_of(const Problem& problem, const Changes& changes, std::uint64_t seed,
                             double budget = kGenerousBudget) {
  const std::unique_ptr<PlanningMethod> method = make(ompl_method(), changes);
  method->prepare(problem);
  return method->plan(budget, seed);
}

struct Variant {
  std::string name;
  Changes changes;

  friend std::ostream& operator<<(std::ostream& out, const Variant& variant) {
    return out << variant.name;
  }
};

std::vector<Variant> variants() {
  return {{"kpiece", {}},
          {"kpiece_by_tick", {{"hops", "tick"}}},
          {"kpiece_sampling_near", {{"sampling", "near"}}},
          {"kpiece_as_found", {{"simplify", "off"}}},
          {"rrt", {{"planner", "rrt"}}},
          {"est", {{"planner", "est"}}}};
}

/// Rows, start, tips, steps, limits and freedom of a trajectory that claims to solve the problem.
void expect_solves(const Problem& problem, const Trajectory& trajectory) {
  ASSERT_EQ(trajectory.q.size(), static_cast<std::size_t>(problem.ticks) + 1);
  ASSERT_EQ(trajectory.t.size(), trajectory.q.size());
  EXPECT_EQ(trajectory.q.front(), problem.start);
  ChainPose pose;
  for (int tick = 1; tick <= problem.ticks; ++tick) {
    SCOPED_TRACE(tick);
    const auto row = static_cast<std::size_t>(tick);
    const JointVector& q = trajectory.q[row];
    ASSERT_NEAR(trajectory.t[row], tick * problem.dt, 1e-12);
    problem.chain.forward(q, pose);
    ASSERT_LT((pose.tip() - problem.desired_tip(tick * problem.dt)).norm(), 1e-8);
    for (int j = 0; j < q.size(); ++j) {
      ASSERT_LE(std::abs(q(j) - trajectory.q[row - 1](j)), problem.max_step(j));
      if (problem.limits.lower.size() == 0) continue;
      ASSERT_GE(q(j), problem.limits.lower(j));
      ASSERT_LE(q(j), problem.limits.upper(j));
    }
  }
  EXPECT_THAT(sampled_hits(problem, trajectory.q, 8, problem.link_radius + problem.margin),
              IsEmpty());
}

class OmplVariant : public testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(All, OmplVariant, testing::ValuesIn(variants()),
                         testing::PrintToStringParamName());

// Resting and moving obstacles, link radius with margin and limits of speed, several obstacles.
TEST_P(OmplVariant, ClaimsOnlyWhatSolvesTheProblem) {
  for (const int dimension : {2, 3}) {
    int solved = 0;
    const std::vector<Problem> scenes = assorted_scenes(dimension, 8, 71);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      SCOPED_TRACE("dimension " + std::to_string(dimension) + ", scene " + std::to_string(i));
      const PlanningMethod::Plan plan = plan_of(scenes[i], GetParam().changes, i, 0.5);
      if (plan.solved) {
        expect_solves(scenes[i], plan.trajectory);
      } else {
        EXPECT_THAT(plan.trajectory.q, IsEmpty());
      }
      solved += plan.solved;
    }
    EXPECT_GE(solved, 4);  // not all of these scenes can be solved, and slow machines solve fewer
  }
}

TEST_P(OmplVariant, SolvesThePlanarSceneOfThePaperFromAStartBesideItsPath) {
  const Problem problem = planar_7r();
  const PlanningMethod::Plan plan = plan_of(problem, GetParam().changes, 1);
  ASSERT_TRUE(plan.solved);
  expect_solves(problem, plan.trajectory);
}

TEST_P(OmplVariant, OneSeedGivesOneTrajectoryAndAnotherSeedAnother) {
  const Problem problem = planar_7r(150);
  const PlanningMethod::Plan first = plan_of(problem, GetParam().changes, 5);
  const PlanningMethod::Plan other = plan_of(problem, GetParam().changes, 6);
  const PlanningMethod::Plan again = plan_of(problem, GetParam().changes, 5);
  ASSERT_TRUE(first.solved && other.solved && again.solved);
  EXPECT_EQ(first.trajectory.q, again.trajectory.q);
  EXPECT_NE(first.trajectory.q, other.trajectory.q);
}

TEST_P(OmplVariant, KeepsItsBudgetAndClaimsNothingWhereThePathIsBlocked) {
  const Problem problem = test_support::blocked(planar_7r(150), 75);
  const auto start = std::chrono::steady_clock::now();
  const PlanningMethod::Plan plan = plan_of(problem, GetParam().changes, 1, 0.3);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  EXPECT_FALSE(plan.solved);
  EXPECT_THAT(plan.trajectory.q, IsEmpty());
  EXPECT_GT(spent.count(), 0.29);
  EXPECT_LT(spent.count(), 3);
}

constexpr double kTightSpeed = 0.5;  // [rad/s]

/// The scene of the paper with the joints just able to do what a known solution does.
Problem with_tight_limits(Problem problem, const Trajectory& known) {
  const JointVector room = JointVector::Constant(7, 0.05);  // [rad]
  problem.limits.lower = known.q.front();
  problem.limits.upper = known.q.front();
  for (const JointVector& q : known.q) {
    problem.limits.lower = problem.limits.lower.cwiseMin(q - room);
    problem.limits.upper = problem.limits.upper.cwiseMax(q + room);
  }
  problem.limits.max_velocity = JointVector::Constant(7, kTightSpeed);
  return problem;
}

TEST(Ompl, KeepsLimitsOfAngleAndSpeedThatItMeetsWithoutThem) {
  Problem problem = planar_7r();
  const PlanningMethod::Plan known = plan_of(problem, {}, 3);
  ASSERT_TRUE(known.solved);
  const Changes as_found = {{"simplify", "off"}};  // simplified plans are slow
  int beyond = 0;
  int too_fast = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Problem limited = with_tight_limits(problem, known.trajectory);
    const PlanningMethod::Plan free = plan_of(problem, as_found, seed);
    const PlanningMethod::Plan plan = plan_of(limited, as_found, seed);
    ASSERT_TRUE(free.solved && plan.solved);
    expect_solves(limited, plan.trajectory);
    for (std::size_t row = 1; row < free.trajectory.q.size(); ++row) {
      const JointVector& q = free.trajectory.q[row];
      const JointVector step = q - free.trajectory.q[row - 1];
      beyond += !limited.within_limits(q);
      too_fast += step.cwiseAbs().maxCoeff() > kTightSpeed * problem.dt;
    }
  }
  EXPECT_GT(beyond, 0);  // else nothing would have been limited
  EXPECT_GT(too_fast, 0);
}

TEST(Ompl, GetsOutOfTheWayOfAnObstacleThatComesLater) {
  test_support::Generator generator(9);
  Problem problem = test_support::random_planar_scene(generator);
  problem.obstacles.clear();
  const PlanningMethod::Plan before = plan_of(problem, {}, 2);
  ASSERT_TRUE(before.solved);

  // An ellipse that drifts through the middle of link 5 of that plan at tick 80.
  ChainPose pose;
  problem.chain.forward(before.trajectory.q[80], pose);
  const Eigen::Vector3d on_link = (pose.p_WO.col(4) + pose.p_WO.col(5)) / 2;
  Obstacle comer{"comer", Ellipsoid(on_link, {0.05, 0.03, 0.05})};
  test_support::set_in_motion(problem, {-0.004, -0.002, 0}, Eigen::Vector3d::UnitZ(), 0.01, comer);
  problem.obstacles.push_back(comer);
  ASSERT_FALSE(sampled_hits(problem, before.trajectory.q, 4).empty());
  ASSERT_TRUE(sampled_hits(problem, {problem.start}, 0).empty());

  const PlanningMethod::Plan plan = plan_of(problem, {}, 2);
  ASSERT_TRUE(plan.solved);
  expect_solves(problem, plan.trajectory);
}

TEST(Ompl, BudgetParameterLowersTheBudget) {
  const Problem problem = test_support::blocked(planar_7r(150), 75);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(plan_of(problem, {{"budget", "0.1"}}, 1).solved);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  EXPECT_LT(spent.count(), kGenerousBudget / 2);
}

TEST(Ompl, ClaimsNothingFromAStartInsideAnObstacle) {
  Problem problem = planar_7r();
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  problem.obstacles.push_back({"on link 3", Ellipsoid(pose.p_WO.col(2), {0.05, 0.05, 0.05})});
  EXPECT_FALSE(plan_of(problem, {}, 1).solved);
}

TEST(Ompl, CountsItsWork) {
  const Problem problem = planar_7r();
  const std::unique_ptr<PlanningMethod> method = make(ompl_method());
  method->prepare(problem);
  ASSERT_TRUE(method->plan(kGenerousBudget, 1).solved);
  const WorkCounters work = method->counters();
  EXPECT_GT(work.iterations, 10);
  EXPECT_GT(work.distance_queries, 100);
  EXPECT_GT(work.kinematics, work.jacobians);
  EXPECT_EQ(work.jacobians, work.linear_solves);
  method->prepare(problem);
  EXPECT_EQ(method->counters().iterations, 0);
}

TEST(OmplJoint, IsFreeFromStartToEndOfThePathAndSaysThatItDoesNotFollowIt) {
  const Problem problem = planar_7r();
  const std::unique_ptr<PlanningMethod> method = make(ompl_joint_method());
  method->prepare(problem);
  const PlanningMethod::Plan plan = method->plan(kGenerousBudget, 1);
  EXPECT_FALSE(plan.solved);
  ASSERT_EQ(plan.trajectory.q.size(), static_cast<std::size_t>(problem.ticks) + 1);
  EXPECT_EQ(plan.trajectory.q.front(), problem.start);
  ChainPose pose;
  problem.chain.forward(plan.trajectory.q.back(), pose);
  EXPECT_LT((pose.tip() - problem.desired_tip(problem.duration())).norm(), 1e-8);
  for (std::size_t row = 1; row < plan.trajectory.q.size(); ++row) {
    const JointVector step = plan.trajectory.q[row] - plan.trajectory.q[row - 1];
    ASSERT_LE(step.cwiseAbs().maxCoeff(), kDefaultMaxStep);
  }
  EXPECT_THAT(sampled_hits(problem, plan.trajectory.q, 8), IsEmpty());
  EXPECT_EQ(method->plan(kGenerousBudget, 1).trajectory.q, plan.trajectory.q);
}

}  // namespace
}  // namespace bqsa::baselines
