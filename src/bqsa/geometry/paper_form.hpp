/// @file
/// The segment test exactly as the paper prints it, in the coordinate x (Eqs. 3, 19-22), kept for
/// the complexity figures. Use segment_test.hpp for anything else:
///
/// **Defect.** For a vertical link (x_i = x_{i+1}) the quadratic degenerates to Delta = 0 and the
/// link is called free even when it runs straight through the ellipse. Near a vertical link, and on
/// one where the coefficients are rounded, the sign of Delta is noise.
#pragma once

#include <Eigen/Core>

#include "bqsa/geometry/conic.hpp"
#include "bqsa/geometry/segment_test.hpp"

namespace bqsa {

/// f(x) = alpha x² + beta x + gamma along the link's line (paper, Eqs. 19-20).
template <typename Scalar>
struct PaperForm {
  Scalar alpha, beta, gamma;
};

/// Eqs. (3) and (20) term by term, as the paper counts them: 22 multiplications, products with the
/// constant 2 written as sums and not counted.
template <typename Scalar>
PaperForm<Scalar> paper_form(const Conic<Scalar>& G, const Eigen::Matrix<Scalar, 2, 1>& p1,
                             const Eigen::Matrix<Scalar, 2, 1>& p2) {
  const Scalar a = p1.y() - p2.y();
  const Scalar b = p2.x() - p1.x();
  const Scalar c = p1.x() * p2.y() - p2.x() * p1.y();  //  2
  const Scalar Cac = G.C * a * c;                      //  2
  return {
      G.A * b * b - G.B * a * b + G.C * a * a,                //  6
      (Cac + Cac) - G.B * b * c + G.D * b * b - G.E * a * b,  //  6
      G.C * c * c - G.E * b * c + G.F * b * b,                //  6
  };
}

/// The same quadratic with a², ab, b², ac and bc computed once: 18 multiplications.
template <typename Scalar>
PaperForm<Scalar> paper_form_shared(const Conic<Scalar>& G, const Eigen::Matrix<Scalar, 2, 1>& p1,
                                    const Eigen::Matrix<Scalar, 2, 1>& p2) {
  const Scalar a = p1.y() - p2.y();
  const Scalar b = p2.x() - p1.x();
  const Scalar c = p1.x() * p2.y() - p2.x() * p1.y();                       //  2
  const Scalar aa = a * a, ab = a * b, bb = b * b, ac = a * c, bc = b * c;  //  5
  const Scalar Cac = G.C * ac;                                              //  1
  return {
      G.A * bb - G.B * ab + G.C * aa,                //  3
      (Cac + Cac) - G.B * bc + G.D * bb - G.E * ab,  //  3
      G.C * (c * c) - G.E * bc + G.F * bb,           //  4
  };
}

/// Delta = beta² - 4 alpha gamma (Eq. 21): the 3 further multiplications that make the paper's 25.
template <typename Scalar>
Scalar discriminant(const PaperForm<Scalar>& f) {
  return f.beta * f.beta - Scalar(4) * (f.alpha * f.gamma);
}

/// The paper's categories (Fig. 3): Delta, and f and its derivative at x_min and x_max. Unlike
/// `category` of segment_test.hpp it calls exact touching free, and vertical links by its defect.
template <typename Scalar>
Category paper_category(const PaperForm<Scalar>& f, const Scalar& x1, const Scalar& x2) {
  const Scalar zero(0);
  if (discriminant(f) <= zero) return Category::kNoCollision1;
  const auto value = [&f](const Scalar& x) { return (f.alpha * x + f.beta) * x + f.gamma; };
  const auto slope = [&f](const Scalar& x) { return (f.alpha + f.alpha) * x + f.beta; };
  const bool inside1 = value(x1) <= zero;
  const bool inside2 = value(x2) <= zero;
  if (inside1 && inside2) return Category::kContained;
  if (inside1 || inside2) return Category::kOneEndInside;
  return slope(x1) * slope(x2) > zero ? Category::kNoCollision2 : Category::kCrossing;
}

}  // namespace bqsa
