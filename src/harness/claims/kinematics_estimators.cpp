#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "bqsa/hybrid_ik.hpp"
#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/laboratory.hpp"

namespace bqsa::harness::claims {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Random draws of tasks: Jacobians with known singular values, velocities, weights.
class TaskDraw {
 public:
  explicit TaskDraw(std::uint64_t seed) : generator_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(generator_); }

  VectorXd direction(int size) {
    VectorXd v(size);
    for (double& x : v) x = normal_(generator_);
    return v.normalized();
  }

  /// Columns orthonormal.
  MatrixXd orthonormal(int rows, int columns) {
    MatrixXd random(rows, columns);
    for (int c = 0; c < columns; ++c) random.col(c) = direction(rows);
    return Eigen::HouseholderQR<MatrixXd>(random).householderQ() *
           MatrixXd::Identity(rows, columns);
  }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

constexpr std::uint64_t kSeed = 19860301;

/// A Jacobian J = U S Vᵀ, with the left direction of its smallest singular value.
struct DrawnJacobian {
  MatrixXd J;
  VectorXd weakest;
};

/// @param smallest  singular value [m]; 0 makes it rank-deficient
DrawnJacobian draw_jacobian(TaskDraw& draw, double smallest) {
  const int m = draw.whole(2, 3), n = draw.whole(m + 1, 7);
  const MatrixXd U = draw.orthonormal(m, m), V = draw.orthonormal(n, m);
  VectorXd s(m);
  for (double& value : s) value = draw.uniform(0.1, 1);
  s(m - 1) = smallest;
  return {U * s.asDiagonal() * V.transpose(), U.col(m - 1)};
}

/// Residual of damped least squares by its normal equations [m/s].
double damped_residual(const MatrixXd& J, const VectorXd& x_dot, double lambda) {
  const MatrixXd damped =
      J * J.transpose() + lambda * lambda * MatrixXd::Identity(J.rows(), J.rows());
  return (x_dot - J * (J.transpose() * damped.ldlt().solve(x_dot))).norm();
}

Findings lemma_2(const Arguments& arguments, Laboratory& laboratory) {
  const int samples = laboratory.samples(arguments.whole("samples"));
  const double eps = arguments.number("eps");
  constexpr double kRounding = 1e-9;
  HybridIkSettings settings;
  settings.residual_bound = eps;
  settings.lambda_max = 1e6;  // the bound alone decides
  TaskDraw draw(kSeed);
  int violations = 0, violations_beyond = 0, deficient_violations = 0, worse_with_damping = 0;
  for (int sample = 0; sample < samples; ++sample) {
    const double s_m = draw.log_uniform(1e-4, 0.9 * settings.singular_threshold);
    const DrawnJacobian full = draw_jacobian(draw, s_m);
    const double speed = eps * draw.log_uniform(1.1, 1000);
    const VectorXd x_dot = speed * draw.direction(static_cast<int>(full.J.rows()));
    const JointVector ones = JointVector::Ones(full.J.cols());
    const JointVector zero = JointVector::Zero(full.J.cols());
    HybridIkResult result;
    solve_hybrid_ik(full.J, x_dot, ones, zero, settings, result);
    violations += (x_dot - full.J * result.q_dot).norm() > eps * (1 + kRounding);

    // Along the weakest direction the next larger factor is too large.
    const VectorXd worst = speed * full.weakest;
    constexpr double kLarger = 1.001;
    solve_hybrid_ik(full.J, worst, ones, zero, settings, result);
    violations_beyond += damped_residual(full.J, worst, kLarger * result.lambda) > eps;
    worse_with_damping += damped_residual(full.J, x_dot, result.lambda) >
                          damped_residual(full.J, x_dot, 0.5 * result.lambda);

    const DrawnJacobian deficient = draw_jacobian(draw, 0);
    const VectorXd demanded = speed * deficient.weakest;
    const VectorXd best = deficient.J.completeOrthogonalDecomposition().solve(demanded);
    deficient_violations += (demanded - deficient.J * best).norm() > eps;
  }
  const auto share = [&](int count) { return static_cast<double>(count) / samples; };
  return {.figures = {{"violations", static_cast<double>(violations)},
                      {"violations_beyond", share(violations_beyond)},
                      {"violations_deficient", share(deficient_violations)},
                      {"worse_with_damping", share(worse_with_damping)}},
          .remarks = {}};
}

/// Joint speeds per tip speed along the weakest direction of Jacobians close to a singularity, times
/// the singular value at which damping begins; the damping is that which no bound on the residual
/// holds down.
Findings damped_speed(const Arguments& arguments, Laboratory& laboratory) {
  const int samples = laboratory.samples(arguments.whole("samples"));
  HybridIkSettings settings;
  settings.residual_bound = 10;  // any residual of a tip speed of 1 m/s
  TaskDraw draw(kSeed);
  double damped = 0, undamped = 0;
  for (int sample = 0; sample < samples; ++sample) {
    const double s_m = draw.log_uniform(1e-4, 0.9 * settings.singular_threshold);
    const DrawnJacobian drawn = draw_jacobian(draw, s_m);
    const JointVector ones = JointVector::Ones(drawn.J.cols());
    HybridIkResult result;
    solve_hybrid_ik(drawn.J, drawn.weakest, ones, JointVector::Zero(ones.size()), settings, result);
    const VectorXd exact = drawn.J.completeOrthogonalDecomposition().solve(drawn.weakest);
    damped = std::max(damped, settings.singular_threshold * result.q_dot.norm());
    undamped = std::max(undamped, settings.singular_threshold * exact.norm());
  }
  return {.figures = {{"damped", damped}, {"undamped", undamped}}, .remarks = {}};
}

/// What becomes of a clamping velocity in the kernel of J when joints are clamped by weights.
Findings clamping_velocity(const Arguments& arguments, Laboratory& laboratory) {
  const int samples = laboratory.samples(arguments.whole("samples"));
  const double clamped_weight = arguments.number("weight");
  TaskDraw draw(kSeed);
  double lost = 0, disturbed = 0;
  std::vector<double> left;
  for (int sample = 0; sample < samples; ++sample) {
    const MatrixXd J = draw_jacobian(draw, draw.uniform(0.1, 1)).J;
    const auto n = static_cast<int>(J.cols());
    const auto m = static_cast<int>(J.rows());
    JointVector weights = JointVector::Ones(n);
    const int clamped = draw.whole(1, n - m);
    weights.tail(clamped).setConstant(clamped_weight);
    const VectorXd x_dot = draw.direction(m);
    const VectorXd any = draw.direction(n);
    const VectorXd in_kernel = any - J.transpose() * (J * J.transpose()).ldlt().solve(J * any);
    const JointVector zero = JointVector::Zero(n), ones = JointVector::Ones(n);
    HybridIkResult alone, with_phi, self_motion, unweighted;
    solve_hybrid_ik(J, VectorXd::Zero(m), weights, in_kernel, {}, self_motion);
    solve_hybrid_ik(J, x_dot, weights, zero, {}, alone);
    solve_hybrid_ik(J, x_dot, weights, any, {}, with_phi);
    solve_hybrid_ik(J, x_dot, ones, zero, {}, unweighted);
    lost = std::max(lost, (self_motion.q_dot - in_kernel).norm() / in_kernel.norm());
    disturbed = std::max(disturbed, (J * (with_phi.q_dot - alone.q_dot)).norm());
    left.push_back(alone.q_dot.tail(clamped).norm() / unweighted.q_dot.tail(clamped).norm());
  }
  std::sort(left.begin(), left.end());
  return {.figures = {{"self_motion_lost", lost},
                      {"task_disturbed", disturbed},
                      {"clamped_motion_left", median_of(left)}},
          .remarks = {}};
}

}  // namespace

std::vector<Estimator> kinematics_estimators() {
  const ArgumentDeclaration samples{"samples", ArgumentKind::kWholeNumber, "3000",
                                    "of a quick evaluation; a full one takes twenty times as many"};
  return {
      {.name = "lemma_2",
       .what = "Damping by Lemma 2 as corrected, on random Jacobians close to and at a singularity",
       .arguments = {samples,
                     {"eps", ArgumentKind::kNumber, "1e-3", "bound on the residual [m/s]"}},
       .figures =
           {{"violations", "-", "full rank: residuals above eps"},
            {"violations_beyond", "-",
             "full rank: share of tasks in which a factor 0.1 % larger exceeds eps"},
            {"violations_deficient", "-",
             "share of rank-deficient tasks in which the least of all residuals exceeds eps"},
            {"worse_with_damping", "-",
             "share of tasks in which twice the damping gives the larger residual"}},
       .estimate = lemma_2},
      {.name = "damped_speed",
       .what =
           "Largest joint speeds of damped least squares on random Jacobians near a singularity",
       .arguments = {samples},
       .figures = {{"damped", "-", "joint speed of a tip speed of 1 m/s, times s_0"},
                   {"undamped", "-", "the same without damping"}},
       .estimate = damped_speed},
      {.name = "clamping_velocity",
       .what = "What the hybrid scheme makes of a clamping velocity while weights hold joints",
       .arguments = {samples, {"weight", ArgumentKind::kNumber, "1e4", "of a clamped joint"}},
       .figures = {{"self_motion_lost", "-", "largest relative change of a self-motion"},
                   {"task_disturbed", "m/s", "largest change of the tip's velocity, of 1 m/s"},
                   {"clamped_motion_left", "-",
                    "median part of their motion that weights alone leave to clamped joints"}},
       .estimate = clamping_velocity},
  };
}

}  // namespace bqsa::harness::claims
