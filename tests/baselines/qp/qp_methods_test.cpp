#include "baselines/qp/qp_methods.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "baselines/closest/segment_ellipsoid_distance.hpp"
#include "support/assorted_scenes.hpp"
#include "support/warm_run.hpp"

namespace bqsa::baselines {
namespace {

using test_support::Generator;
using test_support::planar_7r;
using test_support::replay;
using test_support::Replay;
using test_support::uniform;

using Settings = std::vector<std::pair<std::string, std::string>>;

std::unique_ptr<ReactiveMethod> make(const MethodEntry& entry, const Settings& settings = {}) {
  ParameterValues values(entry.parameters);
  for (const auto& [name, value] : settings) values.set(name, value);
  return std::unique_ptr<ReactiveMethod>(
      static_cast<ReactiveMethod*>(entry.make(values).release()));
}

std::vector<MethodEntry> both() { return {qp_method(), compact_qp_method()}; }

double largest_difference(const Replay& one, const Replay& other) {
  double largest = one.q.size() == other.q.size() ? 0 : 1e9;
  for (std::size_t k = 0; k < std::min(one.q.size(), other.q.size()); ++k) {
    largest = std::max(largest, (one.q[k] - other.q[k]).cwiseAbs().maxCoeff());
  }
  return largest;
}

/// Twice round a circle of 0.3 m without obstacles, back where it began.
Problem circles() {
  Problem problem = planar_7r(400);
  problem.obstacles.clear();
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Eigen::Vector3d begin = pose.tip();
  problem.desired_tip = [begin](double t) -> Eigen::Vector3d {
    const double angle = 4 * std::numbers::pi * t / 10;
    return begin + 0.3 * Eigen::Vector3d(std::cos(angle) - 1, std::sin(angle), 0);
  };
  return problem;
}

/// The pseudo-inverse, by singular values, is what least joint velocity means.
TEST(Qp, IsThePseudoInverseWithoutObstaclesAndDrifts) {
  const Problem problem = circles();
  JointVector q = problem.start;
  ChainPose pose;
  TaskJacobian J;
  for (int tick = 1; tick <= problem.ticks; ++tick) {
    problem.chain.forward(q, pose);
    problem.chain.jacobian(pose, problem.chain.points() - 1, J);
    const Eigen::Vector2d dx = (problem.desired_tip(problem.time(tick)) - pose.tip()).head<2>();
    q += Eigen::JacobiSVD<Eigen::MatrixXd>(J, Eigen::ComputeThinU | Eigen::ComputeThinV).solve(dx);
  }
  const Replay least = replay(*make(qp_method()), problem);
  EXPECT_LT((least.q.back() - q).norm(), 1e-9);
  EXPECT_GT((q - problem.start).norm(), 0.1);  // it drifts
  const Replay undriven = replay(*make(compact_qp_method(), {{"drift_gain", "0"}}), problem);
  EXPECT_LT(largest_difference(least, undriven), 1e-9);

  const Replay driven = replay(*make(compact_qp_method(), {{"drift_gain", "2"}}), problem);
  EXPECT_LT((driven.q.back() - problem.start).norm(), 0.02 * (q - problem.start).norm());
  EXPECT_LT(driven.tip_error, 1e-3);
}

double least_distance(const Problem& problem, const JointVector& q) {
  ChainPose pose;
  problem.chain.forward(q, pose);
  double least = 1e9;
  for (const Link& link : problem.chain.links()) {
    for (const Obstacle& obstacle : problem.obstacles) {
      least = std::min(least, segment_distance(pose.p_WO.col(link.start), pose.p_WO.col(link.end),
                                               obstacle.shape)
                                  .distance);
    }
  }
  return least;
}

/// One tick of 1e-6 s from random postures with an obstacle near one link and a tip that moves on. The
/// distance, measured before and after, shrinks no faster than permitted; were the row not there, it
/// would in many of the scenes.
TEST(Qp, LinksApproachNoFasterThanTheDamperPermits) {
  Generator generator(1);
  for (const MethodEntry& entry : both()) {
    int damped = 0, scenes = 0;
    while (scenes < 200) {
      Problem problem = planar_7r(400);
      problem.dt = 1e-6;
      problem.start = test_support::random_vector<7>(generator, 1.2);
      problem.limits.max_velocity = JointVector::Constant(7, 1e3);
      ChainPose pose;
      problem.chain.forward(problem.start, pose);
      const Eigen::Vector3d tip = pose.tip();
      const int link = 2 + scenes % 4;
      const Eigen::Vector3d beside = 0.5 * (pose.p_WO.col(link) + pose.p_WO.col(link + 1));
      const Eigen::Vector2d aside = test_support::random_direction<2>(generator);
      problem.obstacles = {
          {"ball", Ellipsoid(beside + 0.08 * Eigen::Vector3d(aside.x(), aside.y(), 0),
                             {0.05, 0.05, 0.05})}};
      const double before = least_distance(problem, problem.start);
      if (before < 0.012 || before > 0.045) continue;
      ++scenes;
      const Eigen::Vector2d speed = test_support::random_direction<2>(generator);
      problem.desired_tip = [=](double t) -> Eigen::Vector3d {
        return tip + 0.5 * t * Eigen::Vector3d(speed.x(), speed.y(), 0);
      };
      const StepInput input{.tick = 1,
                            .t = problem.dt,
                            .p_WT_desired = problem.desired_tip(problem.dt),
                            .q = problem.start};
      const auto rate = [&](const char* influence, bool& acted) {
        const auto method = make(entry, {{"influence", influence},
                                         {"safe_distance", "0"},
                                         {"gain", "3"},
                                         {"max_velocity", "1000"},
                                         {"exempt_length", "0"}});
        method->prepare(problem);
        StepOutput output;
        method->step(input, output);
        EXPECT_EQ(output.state, TickState::kUnclaimed);
        acted = output.clamp_count > 0;
        return (least_distance(problem, output.q) - before) / problem.dt;
      };
      bool acted;
      const double with = rate("0.05", acted);
      const double permitted = 3 * before;
      EXPECT_GT(with, -permitted - 1e-4) << entry.name << " " << scenes;
      bool not_acted;
      const double without = rate("0.0001", not_acted);
      EXPECT_FALSE(not_acted);
      EXPECT_EQ(acted, without < -permitted - 1e-9) << entry.name << " " << scenes;
      if (acted) {
        EXPECT_NEAR(with, -permitted, 1e-4) << entry.name << " " << scenes;
        ++damped;
      }
    }
    EXPECT_GT(damped, 20) << entry.name;
  }
}

TEST(Qp, SolvesPlanar7rAndTheWall) {
  for (const MethodEntry& entry : both()) {
    for (const Problem& problem : {planar_7r(400), test_support::puma560_wall()}) {
      const Replay run = replay(*make(entry), problem);
      EXPECT_EQ(run.q.size(), static_cast<std::size_t>(problem.ticks) + 1);
      EXPECT_LT(run.tip_error, problem.tolerance) << entry.name;
      EXPECT_EQ(test_support::sampled_hits(problem, run.q, 3).size(), 0U)
          << entry.name << " " << problem.name;
      EXPECT_GT(run.clamped_ticks, 20) << entry.name;
    }
  }
}

TEST(Qp, MovesAlikeWithTheNetwork) {
  const Problem problem = planar_7r(400);
  const Replay expected = replay(*make(qp_method()), problem);
  const Replay found = replay(*make(qp_method(), {{"solver", "dual_network"}}), problem);
  EXPECT_LT(largest_difference(expected, found), 1e-2);
  EXPECT_LT(found.tip_error, problem.tolerance);
}

/// Wherever the path asks for more than the limits permit, the arm stops and says why.
TEST(Qp, KeepsLimitsAndSaysWhyItGivesUp) {
  Generator generator(3);
  int too_fast = 0, at_limit = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Problem problem = trial % 2 == 0 ? test_support::random_planar_scene(generator)
                                     : test_support::random_arm_scene(generator);
    const int joints = problem.chain.joints();
    problem.limits.max_velocity = JointVector::Constant(joints, uniform(generator, 0.05, 0.4));
    problem.limits.lower = problem.start.array() - uniform(generator, 0.02, 0.3);
    problem.limits.upper = problem.start.array() + uniform(generator, 0.02, 0.3);
    for (const MethodEntry& entry : both()) {
      const Replay run = replay(*make(entry), problem);
      for (std::size_t k = 1; k < run.q.size(); ++k) {
        ASSERT_EQ(forbidden_step(problem, run.q[k - 1], run.q[k]), Infeasible::kNot) << trial;
      }
      if (run.last.state != TickState::kInfeasible) continue;
      EXPECT_EQ(run.last.q, run.q.back());
      too_fast += run.last.reason == Infeasible::kStepTooLarge;
      at_limit += run.last.reason == Infeasible::kJointLimit;
      EXPECT_NE(run.last.reason, Infeasible::kDiverged) << trial;
    }
  }
  EXPECT_GT(too_fast, 5);
  EXPECT_GT(at_limit, 5);
  Problem outside = planar_7r(400);
  outside.limits.upper = outside.start.array() - 1;
  outside.limits.lower = outside.start.array() - 2;
  for (const MethodEntry& entry : both()) {
    const Replay run = replay(*make(entry), outside);
    EXPECT_EQ(run.q.size(), 1U);
    EXPECT_EQ(run.last.reason, Infeasible::kJointLimit);
  }
}

TEST(Qp, GoesOnWhereNoVelocityKeepsAllConstraints) {
  // A ball that moves into the first link faster than it may turn away.
  Problem problem = planar_7r(400);
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Eigen::Vector3d tip = pose.tip();
  problem.desired_tip = [tip](double) { return tip; };
  const Eigen::Vector3d middle = 0.5 * (pose.p_WO.col(0) + pose.p_WO.col(1));
  const Ellipsoid ball(middle + Eigen::Vector3d(0.09, 0, 0), {0.05, 0.05, 0.05});
  problem.obstacles = {{"ball", ball}};
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    problem.obstacles[0].motion.emplace_back(ball.center() - Eigen::Vector3d(0.05 * tick, 0, 0),
                                             ball.semi_axes());
  }
  problem.limits.max_velocity = JointVector::Constant(7, 1);
  for (const MethodEntry& entry : both()) {
    const auto method = make(entry);
    method->prepare(problem);
    StepOutput output;
    method->step({.tick = 1, .t = problem.dt, .p_WT_desired = tip, .q = problem.start}, output);
    EXPECT_EQ(output.state, TickState::kUnclaimed) << entry.name;
    EXPECT_EQ(output.clamp_count, 1) << entry.name;
    EXPECT_GT(output.q(0) - problem.start(0), 0.5 * problem.max_step(0)) << entry.name;
  }
}

TEST(Qp, RefusesASafeDistanceBeyondTheInfluence) {
  for (const MethodEntry& entry : both()) {
    EXPECT_THROW(make(entry, {{"influence", "0.01"}, {"safe_distance", "0.01"}}), ParameterError);
  }
}

TEST(Qp, CountsWhatItDoesAndAllocatesNothing) {
  Generator generator(9);
  Problem problem = test_support::crowded_arm_scene(generator);
  test_support::set_in_motion(problem, {0.001, -0.001, 0}, Eigen::Vector3d::UnitZ(), 0.005,
                              problem.obstacles[0]);
  // More obstacles near a link than rows are kept for.
  for (int more = 0; more < 40; ++more) problem.obstacles.push_back(problem.obstacles[1]);
  const auto ticks = static_cast<std::uint64_t>(problem.ticks);
  for (const MethodEntry& entry : both()) {
    std::vector<Settings> variants = {{}, {{"points", "closest"}}};
    if (entry.name == "qp") {
      variants.push_back({{"solver", "dual_network"}, {"network_steps", "200"}});
    } else {
      variants.push_back({{"constraints", "equality"}});
    }
    for (const Settings& settings : variants) {
      const auto method = make(entry, settings);
      const test_support::WarmRun run = test_support::warm_run(*method, problem);
      EXPECT_TRUE(!test_support::kCountsAllocations || run.allocations == 0) << entry.name;
      const WorkCounters& work = method->counters();
      EXPECT_EQ(work.kinematics, ticks);
      EXPECT_EQ(work.linear_solves, (entry.name == "qp" ? 1 : 2) * ticks);
      EXPECT_GT(work.iterations, 0U);
      EXPECT_EQ(work.quadratics, 0U);
    }
  }
}

}  // namespace
}  // namespace bqsa::baselines
