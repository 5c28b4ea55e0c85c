/// @file
/// The search behind least_ellipsoid.hpp, for points that fill all dimensions about equally.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bqsa/envelope/least_ellipsoid.hpp"

namespace bqsa {

/// The ellipsoid {c + B x : |x| <= 1}.
template <int Dim>
struct AffineBall {
  Eigen::Matrix<double, Dim, 1> center;
  Eigen::Matrix<double, Dim, Dim> axes;  ///< B
  std::vector<Contact> contacts;
};

/// The ellipsoid of least volume around points (columns, any number), to the volume gap and to
/// rounding; the weights of its contacts prove that.
///
/// For weights u let c = sum u_i p_i, S = sum u_i (p_i - c)(p_i - c)ᵀ and k_i = (p_i - c)ᵀ S⁻¹ (p_i
/// - c). The ellipsoid k <= d is the least one for the u that make det S greatest, and no k_i
/// exceeds d then. Sought are, on a core of few points, the weights that maximise log det S + mu
/// sum log u_i with sum u_i = 1, by Newton's method (the function is self-concordant); for them k_i
/// = d + m mu - mu / u_i, so that m mu bounds the excess. Then all points are looked at once; the
/// furthest in each orthant join the core, those well inside leave it, and mu falls. Twenty passes
/// are usual, where Khachiyan's steps take thousands if many points nearly touch.
///
/// @param start  points that span all dimensions; duplicates are allowed
template <int Dim>
AffineBall<Dim> core_search(const Eigen::Matrix<double, Dim, Eigen::Dynamic>& points,
                            const std::vector<Eigen::Index>& start, double volume_gap);

}  // namespace bqsa
