#include "baselines/weighted_least_norm.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>

#include "baselines/closest/exact_distance_search.hpp"
#include "baselines/plain_tracking.hpp"
#include "support/near_obstacles.hpp"
#include "support/replay.hpp"

namespace bqsa::baselines {
namespace {

using test_support::central_differences;
using test_support::Generator;
using test_support::near_obstacles;
using test_support::oracle_distance;
using test_support::tip_jacobian;
using test_support::uniform;

WeightedLeastNorm weighted_least_norm(const WeightedLeastNormSettings& settings) {
  return {settings, std::make_unique<ExactDistanceSearch>()};
}

TEST(WeightedLeastNorm, GradientOfTheLimitsIsThatOfChanAndDubey) {
  const auto H = [](double q) { return 3.0 * 3.0 / (4 * (2.0 - q) * (q + 1.0)); };
  EXPECT_EQ(H(0.5), 1);
  EXPECT_EQ(limit_gradient(0.5, -1, 2), 0);
  for (const double q : {-0.99, -0.7, 0.0, 0.4, 0.9, 1.5, 1.99}) {
    const double expected = (H(q + 1e-6) - H(q - 1e-6)) / 2e-6;
    EXPECT_NEAR(limit_gradient(q, -1, 2), expected, 1e-6 * (1 + std::abs(expected))) << q;
  }
  EXPECT_GT(limit_gradient(2, -1, 2), 1e10);
  EXPECT_LT(limit_gradient(2, -1, 2), 1e13);
  EXPECT_LT(limit_gradient(-1, -1, 2), -1e10);
  EXPECT_EQ(limit_gradient(0.3, -std::numeric_limits<double>::infinity(), 2), 0);
  EXPECT_EQ(limit_gradient(0.3, 0.3, 0.3), 0);
}

TEST(WeightedLeastNorm, SlopeOfTheCollisionFunctionIsItsDerivative) {
  const WeightedLeastNormSettings s{.gain = 0.7, .decay = 20, .exponent = 1.5};
  const auto f = [&s](double d) { return s.gain * std::exp(-s.decay * d) / std::pow(d, 1.5); };
  for (const double d : {0.001, 0.01, 0.05, 0.2}) {
    const double expected = (f(d + 1e-7) - f(d - 1e-7)) / 2e-7;
    EXPECT_NEAR(collision_slope(d, s), expected, 1e-6 * std::abs(expected)) << d;
  }
  EXPECT_EQ(collision_slope(-0.1, s), collision_slope(1e-5, s));
}

/// Unlike the method's own: limits and distances by their functions' central differences, the oracle's
/// distance, the weighted pseudo-inverse as it is printed, by dense elimination.
class Reference {
 public:
  Reference(const Problem& problem, const WeightedLeastNormSettings& settings)
      : problem_(problem), settings_(settings) {}

  Eigen::VectorXd velocity(const JointVector& q, const Eigen::VectorXd& x_dot,
                           const Eigen::VectorXd& motion) const {
    const Eigen::VectorXd inverse = weights(q, motion).cwiseInverse();
    const Eigen::MatrixXd J = tip_jacobian(problem_, q);
    const Eigen::MatrixXd JWJ = J * inverse.asDiagonal() * J.transpose();
    return inverse.asDiagonal() * J.transpose() * JWJ.fullPivLu().solve(x_dot);
  }

  Eigen::VectorXd weights(const JointVector& q, const Eigen::VectorXd& motion) const {
    Eigen::VectorXd w = Eigen::VectorXd::Ones(q.size());
    const JointLimits& limits = problem_.limits;
    const auto H = [&limits](const JointVector& at) {
      double sum = 0;
      for (Eigen::Index i = 0; i < limits.lower.size(); ++i) {
        const double range = limits.upper(i) - limits.lower(i);
        sum += range * range / (4 * (limits.upper(i) - at(i)) * (at(i) - limits.lower(i)));
      }
      return sum;
    };
    add(central_differences(H, q, 1e-6), motion, w);
    for (const Link& link : problem_.chain.links()) {
      for (const Obstacle& obstacle : problem_.obstacles) {
        const auto f = [&](const JointVector& at) {
          const double d = oracle_distance(problem_, at, link, obstacle);
          return settings_.gain * std::exp(-settings_.decay * d) * std::pow(d, -settings_.exponent);
        };
        if (oracle_distance(problem_, q, link, obstacle) < settings_.influence) {
          add(central_differences(f, q, 1e-6), motion, w);
        }
      }
    }
    return w;
  }

 private:
  static void add(const JointVector& gradient, const Eigen::VectorXd& motion, Eigen::VectorXd& w) {
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      if (gradient(i) * motion(i) >= 0) w(i) += std::abs(gradient(i));
    }
  }

  const Problem& problem_;
  WeightedLeastNormSettings settings_;
};

Problem random_problem(Generator& generator, int trial) {
  for (;;) {
    Problem problem = near_obstacles(generator, trial, 0.2);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(tip_jacobian(problem, problem.start));
    if (svd.singularValues().minCoeff() < 0.2) continue;
    const Eigen::Vector3d from = problem.desired_tip(0);
    const Eigen::Vector3d by(uniform(generator, -1, 1), uniform(generator, -1, 1),
                             problem.dimension() == 2 ? 0 : uniform(generator, -1, 1));
    problem.desired_tip = [from, by](double t) -> Eigen::Vector3d { return from + 0.1 * t * by; };
    if (trial % 4 < 2) {
      problem.limits.lower = problem.start - JointVector::Constant(7, uniform(generator, 0.05, 1));
      problem.limits.upper = problem.start + JointVector::Constant(7, uniform(generator, 0.05, 1));
    }
    return problem;
  }
}

TEST(WeightedLeastNorm, IsTheDenseFormulaForBothMotionsThatJudge) {
  Generator generator(1);
  int different = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const Problem problem = random_problem(generator, trial);
    const WeightedLeastNormSettings settings{
        .influence = 0.3, .gain = 0.1, .decay = 5, .exponent = 1, .exempt_length = 0};
    const Reference reference(problem, settings);
    const Eigen::VectorXd x_dot =
        (problem.desired_tip(problem.dt) - problem.desired_tip(0)).head(problem.dimension()) /
        problem.dt;
    const Eigen::MatrixXd J = tip_jacobian(problem, problem.start);
    const Eigen::VectorXd unweighted = J.transpose() * (J * J.transpose()).fullPivLu().solve(x_dot);

    WeightedLeastNormSettings planned_settings = settings;
    planned_settings.motion = JudgedMotion::kPlanned;
    WeightedLeastNorm planned = weighted_least_norm(planned_settings);
    const Eigen::VectorXd first = test_support::first_step(planned, problem) / problem.dt;
    const Eigen::VectorXd expected = reference.velocity(problem.start, x_dot, unweighted);
    EXPECT_LT((first - expected).norm(), 1e-5 * expected.norm()) << trial;
    different += (first - unweighted).norm() > 0.1 * expected.norm();

    // The last motion: in the first tick none, so that all weights count; then the first step's.
    WeightedLeastNorm last = weighted_least_norm(settings);
    last.prepare(problem);
    StepInput input{.q = problem.start};
    StepOutput output;
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(7);
    for (input.tick = 1; input.tick <= 3; ++input.tick) {
      input.p_WT_desired = problem.desired_tip(problem.time(input.tick));
      ChainPose pose;
      problem.chain.forward(input.q, pose);
      const Eigen::VectorXd v =
          (input.p_WT_desired - pose.tip()).head(problem.dimension()) / problem.dt;
      last.step(input, output);
      const Eigen::VectorXd found = (output.q - input.q) / problem.dt;
      EXPECT_LT((found - reference.velocity(input.q, v, motion)).norm(), 1e-5 * found.norm())
          << trial << ", tick " << input.tick;
      motion = found;
      input.q = output.q;
    }
  }
  EXPECT_GT(different, 12);
}

TEST(WeightedLeastNorm, PushesNothingAwayAndKeepsTheTipsVelocityWhateverTheWeights) {
  Generator generator(2);
  for (int trial = 0; trial < 12; ++trial) {
    Problem problem = random_problem(generator, trial);
    const WeightedLeastNormSettings settings{.influence = 0.3, .gain = 1e4};
    WeightedLeastNorm method = weighted_least_norm(settings);
    const JointVector step = test_support::first_step(method, problem);
    const Eigen::VectorXd dx =
        (problem.desired_tip(problem.dt) - problem.desired_tip(0)).head(problem.dimension());
    EXPECT_LT((tip_jacobian(problem, problem.start) * step - dx).norm(), 1e-9) << trial;
    const Eigen::Vector3d tip = problem.desired_tip(0);
    problem.desired_tip = [tip](double) { return tip; };
    EXPECT_LT(test_support::first_step(method, problem).norm(), 1e-12) << trial;
  }
}

TEST(WeightedLeastNorm, WithoutLimitsAndObstaclesIsPlainTracking) {
  Problem problem = test_support::planar_7r(100);
  problem.obstacles = {{"far", embedded(rotated_ellipse({20, 20}, {0.1, 0.1}, 0))}};
  const auto tracking = plain_tracking_method().make(ParameterValues({}));
  WeightedLeastNorm method = weighted_least_norm({});
  EXPECT_EQ(test_support::replay(method, problem).q,
            test_support::replay(static_cast<ReactiveMethod&>(*tracking), problem).q);
}

}  // namespace
}  // namespace bqsa::baselines
