#include "baselines/extended_jacobian.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>

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

ExtendedJacobian extended_jacobian(const ExtendedJacobianSettings& settings) {
  return {settings, std::make_unique<ExactDistanceSearch>()};
}

double barrier(double d, double influence) {
  const double x = d / influence;
  return x < 1 ? (1 - x) * (1 - x) * (1 - x) / x : 0;
}

TEST(ExtendedJacobian, SlopeOfTheBarrierIsItsDerivativeAndBoundedInContact) {
  for (const double d : {0.005, 0.02, 0.1, 0.19, 0.1999, 0.2, 0.21, 1.0}) {
    const double expected = (barrier(d + 1e-7, 0.2) - barrier(d - 1e-7, 0.2)) / 2e-7;
    EXPECT_NEAR(barrier_slope(d, 0.2), expected, 1e-6 * (1e-3 + std::abs(expected))) << d;
  }
  EXPECT_EQ(barrier_slope(-0.1, 0.2), barrier_slope(0.004, 0.2));
  EXPECT_EQ(barrier_slope(0, 0.2), barrier_slope(0.004, 0.2));
}

/// The extended task with nothing of the method's: H through the oracle's distances, grad H and the
/// further rows by central differences of H and of P grad H, bases by singular vectors.
class Reference {
 public:
  Reference(const Problem& problem, const ExtendedJacobianSettings& settings)
      : problem_(problem), settings_(settings) {}

  double H(const JointVector& q) const {
    double sum = settings_.posture_weight / 2 * (q - problem_.start).squaredNorm();
    for (const Link& link : problem_.chain.links()) {
      for (const Obstacle& obstacle : problem_.obstacles) {
        sum += barrier(oracle_distance(problem_, q, link, obstacle), settings_.influence);
      }
    }
    return sum;
  }

  JointVector gradient(const JointVector& q) const {
    return central_differences([this](const JointVector& at) { return H(at); }, q, 2e-5);
  }

  Eigen::MatrixXd self_motions(const JointVector& q) const {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(tip_jacobian(problem_, q), Eigen::ComputeFullV);
    return svd.matrixV().rightCols(q.size() - problem_.dimension());
  }

  Eigen::VectorXd G(const JointVector& q) const {
    return self_motions(q).transpose() * gradient(q);
  }

  Eigen::MatrixXd extended(const JointVector& q) const {
    const auto projected = [this](const JointVector& at) -> Eigen::VectorXd {
      const Eigen::MatrixXd Z = self_motions(at);
      return Z * (Z.transpose() * gradient(at));
    };
    Eigen::MatrixXd derivative(q.size(), q.size());
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      JointVector ahead = q, behind = q;
      ahead(j) += 2e-5;
      behind(j) -= 2e-5;
      derivative.col(j) = (projected(ahead) - projected(behind)) / 4e-5;
    }
    Eigen::MatrixXd Je(q.size(), q.size());
    Je << tip_jacobian(problem_, q), self_motions(q).transpose() * derivative;
    return Je;
  }

  Eigen::VectorXd velocity(const JointVector& q, const Eigen::VectorXd& x_dot) const {
    Eigen::VectorXd right(q.size());
    right << x_dot, -settings_.convergence / problem_.dt * G(q);
    return extended(q).fullPivLu().solve(right);
  }

 private:
  const Problem& problem_;
  ExtendedJacobianSettings settings_;
};

/// Among one or two obstacles, the arm well away from singularities.
Problem random_problem(Generator& generator, int trial) {
  for (;;) {
    Problem problem = near_obstacles(generator, trial, 0.15);
    if (problem.obstacles.size() > 2) continue;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(tip_jacobian(problem, problem.start));
    if (svd.singularValues().minCoeff() > 0.2) return problem;
  }
}

int two_at_most(int trial) { return trial % 2 == 0 ? 8 * trial : 8 * trial + 1; }

TEST(ExtendedJacobian, SolvesTheSquareSystemOfTipAndProjectedGradient) {
  Generator generator(1);
  double smallest = 1e9, largest = 0;
  for (int trial = 0; trial < 10; ++trial) {
    Problem problem = random_problem(generator, two_at_most(trial));
    problem.dt = 1e-4;  // no step is limited
    const Eigen::Vector3d from = problem.desired_tip(0);
    const Eigen::Vector3d by(uniform(generator, -1, 1), uniform(generator, -1, 1),
                             problem.dimension() == 2 ? 0 : uniform(generator, -1, 1));
    problem.desired_tip = [from, by](double t) -> Eigen::Vector3d { return from + t * by; };
    const ExtendedJacobianSettings settings{.influence = 0.2,
                                            .posture_weight = 0.5,
                                            .convergence = 1e-4,
                                            .damping = 1e-9,
                                            .exempt_length = 0,
                                            .correction = Correction::kNewton,
                                            .step_limit = StepLimit::kHold};
    const Reference reference(problem, settings);
    ExtendedJacobian method = extended_jacobian(settings);
    const Eigen::VectorXd found = test_support::first_step(method, problem) / problem.dt;
    const Eigen::VectorXd expected =
        reference.velocity(problem.start, by.head(problem.dimension()));
    EXPECT_LT((found - expected).norm(), 1e-3 * expected.norm()) << trial;
    smallest = std::min(smallest, expected.norm());
    largest = std::max(largest, expected.norm());
  }
  EXPECT_GT(smallest, 0.1);
  EXPECT_LT(largest, 1e3);
}

struct Converged {
  JointVector q;
  double tip_error;
};

/// Where the method has led the arm after so many ticks with the tip at rest.
Converged converge(const ExtendedJacobianSettings& settings, Problem problem, int ticks) {
  problem.ticks = ticks;
  ExtendedJacobian method = extended_jacobian(settings);
  const test_support::Replay run = test_support::replay(method, problem);
  ChainPose pose;
  problem.chain.forward(run.q.back(), pose);
  return {run.q.back(), (pose.tip() - problem.desired_tip(0)).norm()};
}

/// Along self-motions in random directions, each corrected for the tip, H is at a minimum.
TEST(ExtendedJacobian, ConvergesToAMinimumOfTheCriterionOnTheSelfMotions) {
  Generator generator(2);
  int away = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const Problem problem = random_problem(generator, two_at_most(trial));
    const ExtendedJacobianSettings settings{.influence = 0.3,
                                            .posture_weight = 1,
                                            .convergence = 0.3,
                                            .damping = 0.1,
                                            .exempt_length = 0};
    const Converged end = converge(settings, problem, 600);
    EXPECT_LT(end.tip_error, 1e-9) << trial;
    const Reference reference(problem, settings);
    const double before = reference.G(problem.start).norm();
    away += before > 1;
    const auto along = [&](const Eigen::VectorXd& v, double s) {
      JointVector q = end.q + s * v;
      for (int k = 0; k < 20; ++k) {
        ChainPose pose;
        problem.chain.forward(q, pose);
        const Eigen::VectorXd error =
            (problem.desired_tip(0) - pose.tip()).head(problem.dimension());
        const Eigen::MatrixXd J = tip_jacobian(problem, q);
        q += J.transpose() * (J * J.transpose()).fullPivLu().solve(error);
      }
      return reference.H(q);
    };
    const Eigen::MatrixXd Z = reference.self_motions(end.q);
    for (int sample = 0; sample < 10; ++sample) {
      const Eigen::VectorXd v = (Z * Eigen::VectorXd::NullaryExpr(Z.cols(), [&](Eigen::Index) {
                                   return uniform(generator, -1, 1);
                                 })).normalized();
      const double ahead = along(v, 1e-3), here = along(v, 0), behind = along(v, -1e-3);
      EXPECT_LT(std::abs(ahead - behind) / 2e-3, 1e-3 * (1 + before)) << trial;
      EXPECT_GT(ahead + behind, 2 * here) << trial;
    }
  }
  EXPECT_GT(away, 5);
}

/// The joints come back with the tip, as those of plain tracking do not: the posture is a function
/// of the tip's place.
TEST(ExtendedJacobian, RepeatsItsPostureOnAClosedPath) {
  Problem problem = test_support::planar_7r(800);
  problem.obstacles = {{"far", embedded(rotated_ellipse({20, 20}, {0.1, 0.1}, 0))}};
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Eigen::Vector3d tip = pose.tip();
  problem.desired_tip = [tip](double t) -> Eigen::Vector3d {
    const double angle = 0.2 * std::numbers::pi * t;
    return tip + 0.3 * Eigen::Vector3d(std::cos(angle) - 1, std::sin(angle), 0);
  };
  ExtendedJacobian method = extended_jacobian({.posture_weight = 1, .damping = 1e-6});
  const auto tracking = plain_tracking_method().make(ParameterValues({}));
  const auto left = [&](ReactiveMethod& on) {
    const test_support::Replay run = test_support::replay(on, problem);
    EXPECT_LT(run.tip_error, 1e-4);
    EXPECT_GT((run.q[400] - problem.start).norm(), 0.2);
    return (run.q.back() - problem.start).norm();
  };
  const double of_tracking = left(static_cast<ReactiveMethod&>(*tracking));
  EXPECT_GT(of_tracking, 0.03);
  EXPECT_LT(left(method), 0.01 * of_tracking);
}

/// Without correction, what keeps G at zero is dG/dq q_dot + dG/dt = 0 alone: its error is of the
/// first order in the control period.
TEST(ExtendedJacobian, StaysAtTheStationaryPointOfMovingObstacles) {
  Generator generator(3);
  int moved = 0;
  for (int trial = 0; trial < 6; ++trial) {
    Problem problem = random_problem(generator, two_at_most(trial));
    ExtendedJacobianSettings settings{.influence = 0.3,
                                      .posture_weight = 1,
                                      .convergence = 0.3,
                                      .damping = 0.1,
                                      .exempt_length = 0};
    // The stationary point is that of the posture `start`, which must therefore stay what it is.
    const JointVector posture = problem.start;
    const JointVector q0 = converge(settings, problem, 800).q;
    settings.convergence = 0;
    settings.damping = 1e-6;
    const auto remaining = [&](int ticks) {
      Problem moving = problem;
      moving.start = posture;
      moving.dt = 0.1 / ticks;
      moving.ticks = ticks;
      for (Obstacle& obstacle : moving.obstacles) {
        for (int tick = 0; tick <= ticks; ++tick) {
          obstacle.motion.emplace_back(
              obstacle.shape.center() + 0.02 * tick / ticks * Eigen::Vector3d(1, -1, 0),
              obstacle.shape.semi_axes(), obstacle.shape.rotation());
        }
      }
      ExtendedJacobian method = extended_jacobian(settings);
      method.prepare(moving);
      StepInput input{.p_WT_desired = problem.desired_tip(0), .q = q0};
      StepOutput output;
      for (input.tick = 1; input.tick <= ticks; ++input.tick) {
        method.step(input, output);
        input.q = output.q;
      }
      for (Obstacle& obstacle : moving.obstacles) {
        obstacle.shape = obstacle.motion.back();
        obstacle.motion.clear();
      }
      const Reference reference(moving, settings);
      return std::pair(reference.G(input.q).norm(), reference.G(q0).norm());
    };
    const auto [coarse, unmoved] = remaining(50);
    const double fine = remaining(100).first;
    if (unmoved < 1e-3) continue;  // near a link that no joint moves
    ++moved;
    EXPECT_LT(fine, 0.1 * unmoved) << trial;
    EXPECT_NEAR(fine / coarse, 0.5, 0.15) << trial;
  }
  EXPECT_GT(moved, 2);
}

/// Three links have one self-motion, and ZᵀAZ is one number; where it passes zero between two
/// configurations the square system has no solution.
TEST(ExtendedJacobian, AtAlgorithmicSingularitiesTheSelfMotionEndsAndTheTipGoesOn) {
  Generator generator(4);
  int found = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Problem problem{.name = "three links",
                    .chain = SerialChain(planar_chain({0.5, 0.5, 0.5})),
                    .ticks = 1,
                    .dt = 0.01};
    problem.start = test_support::random_vector<3>(generator, 1.5);
    ExtendedJacobianSettings settings{
        .posture_weight = 1, .convergence = 0.01, .correction = Correction::kNewton};
    const Reference reference(problem, settings);
    const auto curvature = [&](const JointVector& q) {
      return (reference.extended(q).bottomRows(1) * reference.self_motions(q)).value();
    };
    JointVector one = test_support::random_vector<3>(generator, 2);
    JointVector other = test_support::random_vector<3>(generator, 2);
    if (curvature(one) * curvature(other) > 0) continue;
    const bool rising = curvature(one) < 0;
    for (int k = 0; k < 60; ++k) {
      const JointVector middle = 0.5 * (one + other);
      ((curvature(middle) < 0) == rising ? one : other) = middle;
    }
    const TaskJacobian J = tip_jacobian(problem, one);
    if (Eigen::JacobiSVD<Eigen::MatrixXd>(J).singularValues()(1) < 0.1) continue;
    ++found;
    ChainPose pose;
    problem.chain.forward(one, pose);
    const Eigen::Vector2d x_dot(0.1, 0.05);
    StepInput input{.tick = 1, .p_WT_desired = pose.tip(), .q = one};
    input.p_WT_desired.head<2>() += problem.dt * x_dot;
    StepOutput output;
    ExtendedJacobian method = extended_jacobian(settings);
    method.prepare(problem);
    method.step(input, output);
    const Eigen::VectorXd q_dot = (output.q - one) / problem.dt;
    EXPECT_LT((J * q_dot - x_dot).norm(), 1e-9) << trial;
    EXPECT_LT((reference.self_motions(one).transpose() * q_dot).norm(), 1e-2) << trial;
    EXPECT_GT(reference.velocity(one, x_dot).norm(), 1e2) << trial;
  }
  EXPECT_GT(found, 5);
}

}  // namespace
}  // namespace bqsa::baselines
