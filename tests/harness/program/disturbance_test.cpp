#include "harness/disturbance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "harness/runner.hpp"
#include "support/allocation_guard.hpp"
#include "test_methods.hpp"

namespace bqsa::harness {
namespace {

const JointVector kThree = Eigen::Vector3d(0.1, -0.2, 0.3);

TEST(JointSensors, TellTheTruthWhenNothingDisturbs) {
  JointSensors sensors({}, 1, "planar");
  const std::vector<JointVector> rows = {kThree, 2 * kThree, 3 * kThree};
  EXPECT_EQ(sensors.reading(rows), rows.back());
  EXPECT_EQ(sensors.executed(kThree), kThree);
  EXPECT_FALSE(Disturbance().on());
}

TEST(JointSensors, DrawTheSameNumbersEverywhere) {
  // std::seed_seq of 7, 1 and the letters of "planar", std::mt19937_64 and Box and Muller's
  // transform, computed apart from this program.
  const std::uint64_t seed = (std::uint64_t{1} << 32) + 7;
  JointSensors sensors({.joint_noise = 1}, seed, "planar");
  const JointVector noise = sensors.reading({JointVector::Zero(3)});
  EXPECT_NEAR(noise(0), 0.43186163167416675, 1e-14);
  EXPECT_NEAR(noise(1), 0.3001534135014891, 1e-14);
  EXPECT_NEAR(noise(2), -0.25200665770277836, 1e-14);
}

TEST(JointSensors, NoiseIsNormalAndNewForEachJointAndTick) {
  constexpr int kTicks = 100'000;
  constexpr double kSigma = 2e-3;
  JointSensors sensors({.joint_noise = kSigma}, 3, "planar");
  const std::vector<JointVector> rows = {kThree};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  double serial = 0;
  int within[4] = {};
  for (int tick = 0; tick < kTicks; ++tick) {
    const Eigen::Vector3d noise = (sensors.reading(rows) - kThree) / kSigma;
    sum += noise;
    covariance += noise * noise.transpose();
    serial += noise.dot(last);
    last = noise;
    for (int sigmas = 1; sigmas <= 3; ++sigmas) within[sigmas] += std::abs(noise(0)) < sigmas;
  }
  constexpr double kTolerance = 0.02;  // above 5 standard errors
  EXPECT_LT((sum / kTicks).norm(), kTolerance);
  EXPECT_LT((covariance / kTicks - Eigen::Matrix3d::Identity()).norm(), kTolerance);
  EXPECT_LT(std::abs(serial / kTicks), kTolerance);
  for (int sigmas = 1; sigmas <= 3; ++sigmas) {
    EXPECT_NEAR(within[sigmas] / double{kTicks}, std::erf(sigmas / std::sqrt(2.0)), 0.008);
  }
}

TEST(JointSensors, NoiseDependsOnSeedAndProblem) {
  const auto noise = [](std::uint64_t seed, const std::string& problem) {
    return JointSensors({.joint_noise = 1}, seed, problem).reading({kThree});
  };
  EXPECT_EQ(noise(1, "a"), noise(1, "a"));
  EXPECT_NE(noise(1, "a"), noise(2, "a"));
  EXPECT_NE(noise(1, "a"), noise(1, "b"));
  EXPECT_NE(noise(1, "a"), noise(1 + (std::uint64_t{1} << 32), "a"));
}

TEST(JointSensors, NameWhatTheyDoToAVariant) {
  EXPECT_EQ(suffix_of({}, 7), "");
  EXPECT_EQ(suffix_of({.joint_noise = 1e-3}, 7), "+noise=0.001+seed=7");
  EXPECT_EQ(suffix_of({.latency_ticks = 1}, 7), "+latency");
  EXPECT_EQ(suffix_of({.joint_noise = 0.5, .latency_ticks = 1}, 1), "+noise=0.5+seed=1+latency");
}

class DisturbedRunner : public ::testing::Test {
 protected:
  RunOutcome run(const Step& step, const Disturbance& disturbance, std::uint64_t seed = 1) {
    const MethodSpec spec = scripted("scripted", step);
    return run_method(problem_, spec.entry, spec.parameters,
                      {.seed = seed, .disturbance = disturbance});
  }

  const Problem problem_ = planar_scenario().problem;
};

TEST_F(DisturbedRunner, LatencyTellsTheJointAnglesOfOneTickAgo) {
  std::vector<JointVector> told;
  const RunOutcome outcome = run(
      [&](const StepInput& input, StepOutput& output) {
        EXPECT_EQ(input.p_WT_desired, problem_.desired_tip(problem_.time(input.tick)));
        told.push_back(input.q);
        output.q = problem_.start.array() + 1e-3 * input.tick;
      },
      {.latency_ticks = 1});
  const std::vector<JointVector>& rows = outcome.trajectory.q;
  ASSERT_EQ(rows.size(), told.size() + 1);
  EXPECT_EQ(told.at(0), rows.at(0));
  EXPECT_EQ(told.at(1), rows.at(0));
  for (std::size_t tick = 2; tick <= told.size(); ++tick) {
    EXPECT_EQ(told[tick - 1], rows[tick - 2]) << "tick " << tick;
    EXPECT_EQ(rows[tick](0), problem_.start(0) + 1e-3 * static_cast<double>(tick));
  }
}

TEST_F(DisturbedRunner, AMethodThatAnswersWhatItIsToldDoesNotMove) {
  // The answer is a set-point for sensors that are wrong by as much as the reading.
  int differ = 0;
  const RunOutcome outcome = run(
      [&](const StepInput& input, StepOutput& output) {
        stand_still(input, output);
        differ += (input.q - problem_.start).norm() > 1e-4;
      },
      {.joint_noise = 1e-3});
  EXPECT_GT(differ, problem_.ticks * 9 / 10);
  for (const JointVector& q : outcome.trajectory.q) {
    EXPECT_LT((q - problem_.start).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST_F(DisturbedRunner, ASetPointIsMissedByTheErrorOfTheReading) {
  std::vector<JointVector> told;
  const RunOutcome outcome = run(
      [&](const StepInput& input, StepOutput& output) {
        told.push_back(input.q);
        output.q = problem_.start;
      },
      {.joint_noise = 1e-3, .latency_ticks = 1});
  const std::vector<JointVector>& rows = outcome.trajectory.q;
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(problem_.ticks) + 1);
  for (std::size_t tick = 2; tick < rows.size(); ++tick) {
    const JointVector error = told[tick - 1] - rows[tick - 2];
    EXPECT_GT(error.norm(), 0);
    EXPECT_LT((rows[tick] - (problem_.start - error)).norm(), 1e-14) << "tick " << tick;
  }
}

TEST_F(DisturbedRunner, TheSameSeedGivesTheSameRunWhateverTheMethod) {
  const Disturbance noise{.joint_noise = 1e-3};
  const auto to_start = [&](const StepInput&, StepOutput& output) { output.q = problem_.start; };
  const auto to_zero = [&](const StepInput& input, StepOutput& output) {
    output.q = JointVector::Zero(input.q.size());
  };
  const RunOutcome one = run(to_start, noise);
  EXPECT_EQ(one.trajectory.q, run(to_start, noise).trajectory.q);
  EXPECT_NE(one.trajectory.q, run(to_start, noise, 2).trajectory.q);
  const RunOutcome other = run(to_zero, noise);
  for (std::size_t k = 1; k < one.trajectory.q.size(); ++k) {
    EXPECT_LT((one.trajectory.q[k] - problem_.start - other.trajectory.q[k]).norm(), 1e-14);
  }
}

TEST_F(DisturbedRunner, TakesNoMemoryBetweenTheFirstAndTheLastStep) {
  if (!test_support::kCountsAllocations) return;
  std::optional<test_support::AllocationGuard> guard;
  std::uint64_t allocations = 0;
  int steps = 0;
  run(
      [&](const StepInput& input, StepOutput& output) {
        if (!guard) guard.emplace();
        stand_still(input, output);
        allocations = guard->allocations();
        ++steps;
      },
      {.joint_noise = 1e-3, .latency_ticks = 1});
  EXPECT_EQ(allocations, 0u);
  EXPECT_EQ(steps, problem_.ticks);
}

}  // namespace
}  // namespace bqsa::harness
