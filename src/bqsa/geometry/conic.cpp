#include "bqsa/geometry/conic.hpp"

#include <Eigen/Eigenvalues>
#include <stdexcept>

namespace bqsa {

Conic<double> conic_from_ellipse(const Ellipse& ellipse) {
  const Eigen::Matrix2d Q = ellipse.quadratic_form();
  const Eigen::Vector2d& c = ellipse.center();
  const double A = Q(0, 0);
  const double B = 2 * Q(0, 1);
  const double C = Q(1, 1);
  const double D = -(2 * A * c.x() + B * c.y());
  const double E = -(B * c.x() + 2 * C * c.y());
  const double F = c.dot(Q * c) - 1;
  return {A, B, C, D, E, F};
}

Ellipse ellipse_from_conic(const Conic<double>& conic) {
  const auto& [A, B, C, D, E, F] = conic;
  if (!(A > 0 && C > 0 && 4 * A * C > B * B)) {
    throw std::invalid_argument("conic: an ellipse needs A > 0, C > 0 and 4AC > B^2");
  }
  Eigen::Matrix2d Q;
  Q << A, B / 2, B / 2, C;
  const Eigen::Vector2d center = -0.5 * Q.inverse() * Eigen::Vector2d(D, E);
  const double level_of_center = center.dot(Q * center) + Eigen::Vector2d(D, E).dot(center) + F;
  if (!(level_of_center < 0)) {
    throw std::invalid_argument("conic: the curve has no inside (G >= 0 everywhere)");
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(Q / -level_of_center);
  Eigen::Matrix2d rotation = eigen.eigenvectors();
  if (rotation.determinant() < 0) rotation.col(1) = -rotation.col(1);
  return {center, eigen.eigenvalues().cwiseInverse().cwiseSqrt(), rotation};
}

}  // namespace bqsa
