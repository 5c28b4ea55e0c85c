/// @file
/// A trajectory as the judge sees it, tick by tick: what a page replays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/judge/true_obstacle.hpp"
#include "harness/report/json.hpp"

namespace bqsa::harness::report {

/// Series of R rows, row 0 being the start; P points, L links of positive length and J joints. Rows with
/// joint angles that are not finite have numbers that are not finite, and no link, obstacle or category.
struct ReplaySeries {
  static constexpr std::uint8_t kNoLink = 255;  ///< or category
  static constexpr std::uint16_t kNoObstacle = 65535;

  std::size_t rows = 0;
  std::vector<float> points;     ///< [R][P][3], by the judge's kinematics [m]
  std::vector<float> q;          ///< [R][J] [rad]
  std::vector<float> tip_error;  ///< [R] distance of the tip from x_d [m]
  /// [R] exact distance to obstacles as they are, less the link radius, negative inside [m]
  std::vector<float> clearance;
  std::vector<std::uint8_t> near_link;  ///< [R] number of the link that it belongs to
  /// [R] index of its obstacle; of a solid, the one of its ellipsoids that is nearest to the link
  std::vector<std::uint16_t> near_obstacle;
  std::vector<std::uint8_t> hit;  ///< [R][L] 1 for a link in an obstacle as it is, else 0
  std::vector<std::uint8_t>
      category;  ///< [R][L] of each link with the obstacle nearest to it, 1 to 5
  std::vector<std::uint16_t> category_obstacle;  ///< [R][L] that obstacle
};

/// Rows beyond the problem's last tick are left out.
/// @param truth       of the problem's obstacles
/// @param trajectory  with as many joints as the problem
ReplaySeries replay_series(const Problem& problem, const std::vector<TrueObstacle>& truth,
                           const Trajectory& trajectory);

/// Of obstacles that are the ellipsoids that methods are told of.
ReplaySeries replay_series(const Problem& problem, const Trajectory& trajectory);

/// A `Replay` of the schema.
/// @param run  index into the runs of the page
Json replay_json(const ReplaySeries& series, std::size_t run);

/// About how long that is as text, of a trajectory with all its rows [byte].
std::size_t replay_size(const Problem& problem);

}  // namespace bqsa::harness::report
