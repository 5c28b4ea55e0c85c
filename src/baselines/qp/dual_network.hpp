/// @file
/// The dual neural network of Zhang and Wang (2004; with Xia, 2003) for small dense programs.
#pragma once

#include "baselines/qp/quadratic_program.hpp"

namespace bqsa::baselines {

struct DualNetworkSettings {
  double tolerance = 1e-7;  ///< largest residual of a row, in the row's unit
  int max_iterations = 20000;
};

/// The network's state is u, a neuron a row, and with x = G^-1 (Eᵀu - c) it obeys
///
///     u' = (g(E x - u) - E x) / eps,   g: projection onto [lower, upper],
///
/// whose rest points are the solutions. Here it takes explicit steps u += h r, r = g(E x - u) - E x.
///
/// Step length. Let F(u) = E x = M u - E G^-1 c, M = E G^-1 Eᵀ, and L its largest eigenvalue. By
/// Moreau's decomposition u + r = prox(u - F(u)), prox being that of the support function of -[lower,
/// upper]: a step h = 1 is one step of the proximal gradient method on the dual program. For L < 2 the
/// map u - F(u) is L/2-averaged and prox 1/2-averaged, hence T(u) = u + r is a-averaged with a =
/// 2 / (4 - L), and the relaxed iteration u + h (T(u) - u) converges for 0 < h < 1 / a = 2 - L/2
/// (Krasnoselskii and Mann), |r| never growing. To make L <= 1, row i is divided by sqrt(sum_j |M_ij|):
/// the scaled M is similar to a matrix whose rows have absolute sums of 1. That is a choice of units for
/// the neurons; the step below lies under the bound 3/2.
///
/// Without solution u grows for ever along some v, and v tells: if every z in [lower, upper] has
/// vᵀz >= gap > 0, no x with |x|_G < gap / |Eᵀv|_{G^-1} keeps the rows. It is infeasible once this
/// excludes all |x|_G below `kLargestSolution`.
///
/// Y. Zhang, J. Wang: Obstacle Avoidance for Kinematically Redundant Manipulators Using a Dual Neural
/// Network. IEEE Trans. Systems, Man, and Cybernetics B 34(1), 2004. Y. Zhang, J. Wang, Y. Xia: A Dual
/// Neural Network for Redundancy Resolution of Kinematically Redundant Manipulators Subject to Joint
/// Limits and Joint Velocity Limits. IEEE Trans. Neural Networks 14(3), 2003.
class DualNetwork {
 public:
  static constexpr double kStep = 1.4;  ///< h
  static constexpr double kLargestSolution = 1e4;

  explicit DualNetwork(const DualNetworkSettings& settings) : settings_(settings) {}

  /// Does not allocate.
  /// @param solution  its u, if there is one a row, is where the network starts, else at 0
  void solve(const QuadraticProgram& program, QpSolution& solution);

 private:
  void connect(const QuadraticProgram& program);
  void respond();
  bool settled() const;
  bool certifies_infeasible();

  DualNetworkSettings settings_;
  QpMatrix factor_;  // Lᵀ of G = L Lᵀ
  QpVector offset_;  // L^-1 c
  // Of the scaled rows:
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxQpVariables, kMaxQpRows>
      rows_;  // L^-1 Eᵀ, so that M = Yᵀ Y
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxQpRows, kMaxQpRows> coupling_;
  QpRowVector scale_, lower_, upper_;
  QpRowVector shift_;           // E G^-1 c
  QpRowVector u_, output_, r_;  // state, F(u) and what is missing to rest
  QpRowVector v_;
};

}  // namespace bqsa::baselines
