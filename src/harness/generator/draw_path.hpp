/// @file
/// Random paths from where the tip of an arm is.
#pragma once

#include <optional>

#include "harness/generator/arm.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/generator/scenario_draft.hpp"

namespace bqsa::harness {

/// A straight line of any direction, or part of a circle: planar arcs of the same lengths as lines,
/// full circles of any plane in space.
/// @param around_solids  in space longer ones, for arms with thick links
PathDraft draw_line_or_arc(const Eigen::Vector3d& tip, int dimension, bool around_solids,
                           RandomStream& random);

/// A line of 0.2 to 0.4 m outwards from the axis through `center`, turned to the side by up to 0.5 and
/// up or down by up to 0.2 rad.
PathDraft draw_reaching_line(const Eigen::Vector3d& tip, const Eigen::Vector3d& center,
                             RandomStream& random);

/// An arc that is in its middle as far from the arm's centre as it comes, 97 to 99.5 % of the reach.
/// None if there is no such circle of allowed radius, or the arc would be short.
std::optional<PathDraft> draw_stretching_arc(const Eigen::Vector3d& tip, const Arm& arm,
                                             RandomStream& random);

}  // namespace bqsa::harness
