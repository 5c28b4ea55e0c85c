/// @file
/// What every search for closest points answers, so that finding them is measured apart from their
/// use.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bqsa/problem.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa::baselines {

/// The closest points of one link's axis and one obstacle.
struct ClosestPoint {
  int link = 0;         ///< index into SerialChain::links
  int obstacle = 0;     ///< index into Problem::obstacles
  double s = 0;         ///< on the link: 0 start, 1 end
  double distance = 0;  ///< of the link's axis; at most 0, or that link's radius, if they meet [m]
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();   ///< unit, in which the link gets away
  Eigen::Vector3d p_obstacle = Eigen::Vector3d::Zero();  ///< the obstacle's point, in W [m]
};

/// Finds the pairs of links and obstacles that are near each other. One virtual call a tick, none a
/// pair. Nothing but `assign` allocates.
class ClosestPointSearch {
 public:
  virtual ~ClosestPointSearch() = default;

  /// Problem and counters must outlive the search. Obstacles are where they are at tick 0.
  /// @param exempt_length  part of the last link, from the tip, that is left out: the tip may work
  ///                       near a surface [m]
  virtual void assign(const Problem& problem, double exempt_length, WorkCounters& counters) = 0;

  /// From now on the obstacles are where they are at this tick.
  virtual void go_to(int tick) = 0;

  /// Replaces `found` by all pairs whose distance is below `reach` [m], obstacle by obstacle and
  /// from base to tip. Its capacity must suffice for all pairs.
  virtual void search(const ChainPose& pose, double reach, std::vector<ClosestPoint>& found) = 0;
};

/// A link's axis, without the exempt part of the last link.
struct LinkAxis {
  Eigen::Vector3d a, b;  ///< in W [m]
  double s_end;          ///< b on the whole link; negative if nothing is left of it
};

inline LinkAxis link_axis(const SerialChain& chain, const ChainPose& pose, std::size_t link,
                          double exempt_length) {
  const std::span<const Link> links = chain.links();
  LinkAxis axis{pose.p_WO.col(links[link].start), pose.p_WO.col(links[link].end), 1};
  if (link + 1 == links.size() && exempt_length > 0) {
    axis.s_end = 1 - exempt_length / (axis.b - axis.a).norm();
    axis.b = axis.a + axis.s_end * (axis.b - axis.a);
  }
  return axis;
}

}  // namespace bqsa::baselines
