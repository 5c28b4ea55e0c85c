#include "bqsa/envelope/core_search.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace bqsa {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Looks at all points; needed are about twenty.
constexpr int kMaxPasses = 100;

/// Newton steps for one mu; needed are about five.
constexpr int kMaxSteps = 100;

/// Of a Newton step; a gain that shows only below is rounding.
constexpr int kMaxHalvings = 20;

constexpr double kFirstMu = 0.1;

/// Part of the level d below which a point is well inside. With weights as small the points that
/// leave carry a small part of S, so that those that stay still span all dimensions.
constexpr double kInside = 0.9;
constexpr double kHardlyWeighs = 1e-3;

template <int Dim>
using Columns = Eigen::Matrix<double, Dim, Eigen::Dynamic>;

/// Mean and spread of weighted points, as the metric that they make.
template <int Dim>
struct Metric {
  Eigen::Matrix<double, Dim, 1> center;
  Eigen::Matrix<double, Dim, Dim> factor;   ///< L of S = L Lᵀ
  Eigen::Matrix<double, Dim, Dim> inverse;  ///< of L

  Metric(const Columns<Dim>& points, const VectorXd& weights) {
    using Matrix = Eigen::Matrix<double, Dim, Dim>;
    center = points * weights;
    Matrix spread = Matrix::Zero();
    for (Index i = 0; i < points.cols(); ++i) {
      const Eigen::Matrix<double, Dim, 1> w = points.col(i) - center;
      spread += weights(i) * w * w.transpose();
    }
    factor = Eigen::LLT<Matrix>(spread).matrixL();
    inverse = factor.template triangularView<Eigen::Lower>().solve(Matrix::Identity());
  }

  /// k of the file comment is its squared length.
  Eigen::Matrix<double, Dim, 1> unit(const Eigen::Matrix<double, Dim, 1>& p) const {
    return inverse.template triangularView<Eigen::Lower>() * (p - center);
  }

  double log_volume() const { return 2 * factor.diagonal().array().log().sum(); }
};

/// Few points and their weights, all positive.
template <int Dim>
class Core {
 public:
  Core(const Columns<Dim>& all, const std::vector<Index>& start) : all_(all), indices_(start) {
    std::sort(indices_.begin(), indices_.end());
    indices_.erase(std::unique(indices_.begin(), indices_.end()), indices_.end());
    points_ = all(Eigen::all, indices_);
    weights_.setConstant(points_.cols(), 1.0 / static_cast<double>(points_.cols()));
  }

  Index size() const { return points_.cols(); }
  Metric<Dim> metric() const { return {points_, weights_}; }

  /// Newton's method for the weights at this mu.
  void settle(double mu) {
    constexpr double kSettled = 1e-4;  // of mu: squared Newton decrement
    for (int step = 0; step < kMaxSteps; ++step) {
      const Metric<Dim> now = metric();
      // With u_i s_i the change of u_i, the Hessian is U (G∘G) U + mu I, G_ij = 1 + w_iᵀ S⁻¹ w_j.
      Columns<Dim> units(Dim, size());
      for (Index i = 0; i < size(); ++i) units.col(i) = now.unit(points_.col(i));
      const Eigen::MatrixXd G = (units.transpose() * units).array() + 1;
      Eigen::MatrixXd hessian = weights_.asDiagonal() * G.cwiseAbs2() * weights_.asDiagonal();
      hessian.diagonal().array() += mu;
      const VectorXd gradient = weights_.cwiseProduct(G.diagonal()).array() + mu;
      const Eigen::LLT<Eigen::MatrixXd> solver(hessian);
      const VectorXd uphill = solver.solve(gradient);
      const VectorXd along = solver.solve(weights_);
      const VectorXd s = uphill - uphill.dot(weights_) / along.dot(weights_) * along;
      const double decrement = gradient.dot(s);
      if (!climb(s, decrement, mu, now) || decrement <= kSettled * mu) return;
    }
  }

  bool has(Index point) const {
    return std::find(indices_.begin(), indices_.end(), point) != indices_.end();
  }
  bool has_all(const std::vector<Index>& points) const {
    return std::all_of(points.begin(), points.end(), [this](Index point) { return has(point); });
  }

  /// Points well inside leave, candidates that are not in the core come.
  void exchange(const Metric<Dim>& metric, const std::vector<Index>& candidates) {
    std::vector<Index> kept;
    std::vector<double> weights;
    double total = 0;
    for (Index i = 0; i < size(); ++i) {
      const bool inside = metric.unit(points_.col(i)).squaredNorm() < kInside * Dim;
      if (inside && weights_(i) < kHardlyWeighs) continue;
      kept.push_back(indices_[static_cast<std::size_t>(i)]);
      weights.push_back(weights_(i));
      total += weights_(i);
    }
    for (const Index candidate : candidates) {
      if (has(candidate)) continue;
      constexpr double kShareOfNew = 0.01;
      kept.push_back(candidate);
      weights.push_back(kShareOfNew);
      total += kShareOfNew;
    }
    indices_ = std::move(kept);
    points_ = all_(Eigen::all, indices_);
    weights_ = VectorXd::Map(weights.data(), static_cast<Index>(weights.size())) / total;
  }

  std::vector<Contact> contacts() const {
    std::vector<Contact> result;
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      result.push_back({static_cast<std::size_t>(indices_[i]), weights_(static_cast<Index>(i))});
    }
    return result;
  }

 private:
  /// Steps along s as far as the weights stay positive and the value grows.
  /// @return whether it does, beyond rounding
  bool climb(const VectorXd& s, double decrement, double mu, const Metric<Dim>& now) {
    const double value = now.log_volume() + mu * weights_.array().log().sum();
    double t = std::min(1.0, 0.9 / std::max(-s.minCoeff(), 1e-9));
    for (int halving = 0; halving < kMaxHalvings; ++halving, t /= 2) {
      VectorXd next = weights_.array() * (1 + t * s.array());
      next /= next.sum();
      const double gain =
          Metric<Dim>(points_, next).log_volume() + mu * next.array().log().sum() - value;
      if (!(gain > 0.1 * t * decrement)) continue;
      weights_ = next;
      return true;
    }
    return false;
  }

  const Columns<Dim>& all_;
  std::vector<Index> indices_;
  Columns<Dim> points_;
  VectorXd weights_;
};

/// The points furthest from the centre in each orthant of the metric.
template <int Dim>
struct Furthest {
  std::array<Index, 1 << Dim> index;
  std::array<double, 1 << Dim> level;

  Furthest(const Columns<Dim>& points, const Metric<Dim>& metric) {
    index.fill(-1);
    level.fill(-1);
    for (Index i = 0; i < points.cols(); ++i) {
      const Eigen::Matrix<double, Dim, 1> u = metric.unit(points.col(i));
      std::size_t orthant = 0;
      for (int k = 0; k < Dim; ++k) orthant |= static_cast<std::size_t>(u(k) > 0) << k;
      const double squared = u.squaredNorm();
      if (squared <= level[orthant]) continue;
      level[orthant] = squared;
      index[orthant] = i;
    }
  }

  double most() const { return *std::max_element(level.begin(), level.end()); }

  std::vector<Index> beyond(double enough) const {
    std::vector<Index> result;
    for (std::size_t k = 0; k < index.size(); ++k) {
      if (level[k] > enough) result.push_back(index[k]);
    }
    return result;
  }
};

}  // namespace

template <int Dim>
AffineBall<Dim> core_search(const Columns<Dim>& points, const std::vector<Index>& start,
                            double volume_gap) {
  // The product of the semi-axes grows with the power d/2 of the level of the furthest point.
  const double enough = Dim * std::pow(1 + volume_gap, 2.0 / Dim);
  Core<Dim> core(points, start);
  double mu = kFirstMu;
  for (int pass = 0;; ++pass) {
    core.settle(mu);
    const Metric<Dim> metric = core.metric();
    const Furthest<Dim> furthest(points, metric);
    const double least_mu = 0.3 * (enough - Dim) / static_cast<double>(core.size());
    const bool found = furthest.most() <= enough;
    const bool stuck = mu <= least_mu && core.has_all(furthest.beyond(enough));
    if (found || stuck || pass == kMaxPasses) {
      return {metric.center, std::sqrt(furthest.most()) * metric.factor, core.contacts()};
    }
    core.exchange(metric, furthest.beyond(Dim));
    mu = std::max(mu / 10, least_mu);
  }
}

template AffineBall<1> core_search<1>(const Columns<1>&, const std::vector<Index>&, double);
template AffineBall<2> core_search<2>(const Columns<2>&, const std::vector<Index>&, double);
template AffineBall<3> core_search<3>(const Columns<3>&, const std::vector<Index>&, double);

}  // namespace bqsa
