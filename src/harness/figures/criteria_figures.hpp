/// @file
/// Figs. 9 and 16 of the paper: the quadratic criteria of collision over time, and the category that
/// they give.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "bqsa/geometry/segment_test.hpp"
#include "bqsa/shadow_field.hpp"
#include "harness/figures/figure.hpp"
#include "harness/figures/judged_run.hpp"

namespace bqsa::harness {

/// The paper's criteria of a link and an obstacle, divided by (x_max - x_min)², which leaves all signs as
/// they are and makes them free of units: those of the same quadratic over the link's parameter t in
/// [0, 1]. Of a vertical link, to which the paper's form in x is blind, the division leaves noise or
/// nothing.
struct Criteria {
  double delta;          ///< Delta, Eq. (21)
  double f_min;          ///< f(x_min)
  double f_max;          ///< f(x_max)
  double slope_product;  ///< f'(x_min) f'(x_max)
  Category category;     ///< by the same quadratic
};

/// From the paper's own quadratic in x, paper_form.hpp.
Criteria paper_criteria(const Ellipse& ellipse, const Eigen::Vector2d& p1,
                        const Eigen::Vector2d& p2);

/// The same criteria of a link in space, from the quadratic over its parameter; end 1 is the inner one.
Criteria space_criteria(const Ellipsoid& ellipsoid, const Eigen::Vector3d& p1,
                        const Eigen::Vector3d& p2);

/// Fig. 9: the paper's criteria of the pairs that the method moved away, one panel a pair.
/// @param name  of the figure, different for each method
Figure planar_criteria(const JudgedRun& run, const std::string& name);

/// Fig. 16: of the pairs moved away, the paper's criteria of the projection on XOZ of the first run, and
/// whether any of the three projections is free; the criteria in space of the second run.
Figure spatial_criteria(const JudgedRun& projection, const JudgedRun& exact);

}  // namespace bqsa::harness
