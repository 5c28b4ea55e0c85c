#include "baselines/closest/closest_point_methods.hpp"

#include <gtest/gtest.h>

#include "baselines/test_point.hpp"
#include "support/assorted_scenes.hpp"
#include "support/warm_run.hpp"

namespace bqsa::baselines {
namespace {

using test_support::planar_7r;
using test_support::replay;
using test_support::Replay;

using Settings = std::vector<std::pair<std::string, std::string>>;

std::unique_ptr<ReactiveMethod> make(const MethodEntry& entry, const Settings& settings = {}) {
  ParameterValues values(entry.parameters);
  for (const auto& [name, value] : settings) values.set(name, value);
  return std::unique_ptr<ReactiveMethod>(
      static_cast<ReactiveMethod*>(entry.make(values).release()));
}

double largest_difference(const Replay& one, const Replay& other) {
  double largest = one.q.size() == other.q.size() ? 0 : 1e9;
  for (std::size_t k = 0; k < std::min(one.q.size(), other.q.size()); ++k) {
    largest = std::max(largest, (one.q[k] - other.q[k]).cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST(MaciejewskiKlein, WithFclMovesAsWithTheExactDistance) {
  const Problem problem = planar_7r(400);
  const Replay exact = replay(*make(maciejewski_klein_method()), problem);
  const Replay fcl = replay(*make(maciejewski_klein_method(), {{"closest", "fcl"}}), problem);
  EXPECT_LT(largest_difference(exact, fcl), 2e-2);
  EXPECT_GT(exact.clamped_ticks, 50);
}

TEST(MaciejewskiKlein, WithTestPointsIsTestPointWhereNothingMovesAndNoStepIsTooLarge) {
  const Problem problem = planar_7r(400);
  const Settings gains = {{"influence", "0.05"},
                          {"full_distance", "0.02"},
                          {"escape_velocity", "0.1"},
                          {"regularization", "1e-6"},
                          {"exempt_length", "0.1"}};
  const Replay expected = replay(*make(test_point_method(), gains), problem);
  for (const char* closest : {"test_points", "test_points_vectorized"}) {
    Settings settings = gains;
    settings.emplace_back("closest", closest);
    settings.emplace_back("points", "closest");
    const Replay found = replay(*make(maciejewski_klein_method(), settings), problem);
    EXPECT_LT(largest_difference(found, expected), 1e-9) << closest;
    EXPECT_EQ(found.clamped, expected.clamped) << closest;
  }
}

/// Planar and spatial problems with all that a problem may have.
TEST(ClosestPointMethods, RefuseNothingAndCountWhatTheyDo) {
  test_support::Generator generator(7);
  int used = 0;
  for (int trial = 0; trial < 24; ++trial) {
    Problem problem = trial % 2 == 0 ? test_support::random_planar_scene(generator)
                                     : test_support::random_arm_scene(generator);
    if (trial % 3 == 0) problem.link_radius = 0.01;
    if (trial % 4 == 0) problem.margin = 0.005;
    if (trial % 5 == 0) {
      test_support::set_in_motion(problem, {0.001, -0.001, 0}, Eigen::Vector3d::UnitZ(), 0.005,
                                  problem.obstacles[0]);
    }
    const std::uint64_t links = problem.chain.links().size();
    for (const MethodEntry& entry : {maciejewski_klein_method(), fcl_gp_method()}) {
      EXPECT_EQ(why_not_applicable(entry.capabilities, problem), "");
      const auto method = make(entry);
      const Replay run = replay(*method, problem);
      const bool held = run.last.state == TickState::kInfeasible;
      const std::uint64_t steps = run.q.size() - 1 + (held ? 1 : 0);
      const WorkCounters& work = method->counters();
      EXPECT_EQ(work.kinematics, steps) << entry.name;
      EXPECT_EQ(work.linear_solves, steps) << entry.name;
      EXPECT_EQ(work.point_pairs, 0U) << entry.name;
      EXPECT_GE(work.jacobians, steps) << entry.name;
      EXPECT_LE(work.jacobians, steps + 2 * static_cast<std::uint64_t>(run.clamped_ticks) + 2)
          << entry.name;
      if (entry.name == "fcl_gp") {
        EXPECT_EQ(work.distance_queries, steps * links * problem.obstacles.size());
      } else {
        EXPECT_LE(work.distance_queries, steps * links * problem.obstacles.size());
      }
      used += run.clamped_ticks > 0;
    }
  }
  EXPECT_GT(used, 30);
}

TEST(ClosestPointMethods, MakeEachJacobianOnceATickHoweverManyPointsAct) {
  Problem problem = planar_7r(400);
  problem.ticks = 300;
  Problem doubled = problem;
  for (const Obstacle& obstacle : problem.obstacles) doubled.obstacles.push_back(obstacle);
  // Without gain the two arms move alike.
  const Settings settings = {{"gradient_gain", "0"}, {"influence", "0.2"}, {"points", "all"}};
  const auto once = make(fcl_gp_method(), settings), twice = make(fcl_gp_method(), settings);
  const Replay run = replay(*once, problem);
  replay(*twice, doubled);
  EXPECT_GT(run.clamped_ticks, 100);
  EXPECT_GT(once->counters().jacobians, 400U);
  EXPECT_EQ(once->counters().jacobians, twice->counters().jacobians);
}

/// The null-space step is scaled so that limits hold: the methods never give up for its sake.
TEST(ClosestPointMethods, StayWithinTheLargestStep) {
  test_support::Generator generator(8);
  for (int trial = 0; trial < 20; ++trial) {
    Problem problem = test_support::random_planar_scene(generator);
    problem.limits.max_velocity = JointVector::Constant(7, 1.0);
    for (const MethodEntry& entry : {maciejewski_klein_method(), fcl_gp_method()}) {
      const Replay run = replay(*make(entry), problem);
      EXPECT_LE(run.largest_step, problem.max_step(0)) << entry.name << " " << trial;
    }
  }
}

TEST(ClosestPointMethods, MeetAnApproachingObstacleFasterThanOneAtRest) {
  // The arm's tip rests; a ball beside link 3 either rests or comes closer at 0.1 m/s.
  Problem resting = planar_7r(400);
  ChainPose pose;
  resting.chain.forward(resting.start, pose);
  const Eigen::Vector3d tip = pose.tip();
  resting.desired_tip = [tip](double) { return tip; };
  const Eigen::Vector3d middle = 0.5 * (pose.p_WO.col(2) + pose.p_WO.col(3));
  const Eigen::Vector3d along = (pose.p_WO.col(3) - pose.p_WO.col(2)).normalized();
  const Eigen::Vector3d across(-along.y(), along.x(), 0);
  const Ellipsoid ball(middle + 0.08 * across, {0.05, 0.05, 0.05});
  resting.obstacles = {{"ball", ball}};
  Problem moving = resting;
  for (int tick = 0; tick <= moving.ticks; ++tick) {
    moving.obstacles[0].motion.emplace_back(ball.center() - 0.1 * tick * moving.dt * across,
                                            ball.semi_axes());
  }
  const Settings gains = {{"influence", "0.05"},
                          {"full_distance", "0.03"},
                          {"escape_velocity", "0.1"},
                          {"regularization", "1e-9"}};
  StepInput input{.tick = 1, .t = resting.dt, .p_WT_desired = tip, .q = resting.start};
  double moved[2];
  for (const Problem* problem : {&resting, &moving}) {
    const auto method = make(maciejewski_klein_method(), gains);
    method->prepare(*problem);
    StepOutput output;
    method->step(input, output);
    moved[problem == &moving] = (output.q - input.q).norm();
  }
  EXPECT_NEAR(moved[1] / moved[0], 2, 1e-6);  // v_0 + 0.1 m/s against v_0
}

TEST(ClosestPointMethods, WarmStepsDoNotAllocateButForFcl) {
  if (!test_support::kCountsAllocations) GTEST_SKIP() << "the sanitizer brings its own malloc";
  test_support::Generator generator(9);
  Problem problem = test_support::crowded_arm_scene(generator);
  test_support::set_in_motion(problem, {0.001, -0.001, 0}, Eigen::Vector3d::UnitZ(), 0.005,
                              problem.obstacles[0]);
  for (const char* closest : {"exact", "test_points", "test_points_vectorized"}) {
    const auto method = make(maciejewski_klein_method(), {{"closest", closest}, {"points", "all"}});
    EXPECT_EQ(test_support::warm_run(*method, problem).allocations, 0U) << closest;
  }
  for (const char* solver : {"indep_mm", "libccd_mm"}) {
    for (const char* broadphase : {"off", "on"}) {
      const auto method = make(fcl_gp_method(), {{"solver", solver}, {"broadphase", broadphase}});
      const auto run = test_support::warm_run(*method, problem);
      std::printf("fcl_gp %s, broadphase %s: %.2f allocations a query of FCL's own\n", solver,
                  broadphase,
                  static_cast<double>(run.allocations) /
                      static_cast<double>(method->counters().distance_queries));
    }
  }
}

}  // namespace
}  // namespace bqsa::baselines
