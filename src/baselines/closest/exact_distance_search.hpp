/// @file
/// The closest points of links and obstacles by the exact distance.
#pragma once

#include <vector>

#include "baselines/closest/closest_point_search.hpp"

namespace bqsa::baselines {

/// One exact distance for every pair of link and obstacle whose bounding sphere comes within reach.
/// Links that meet the obstacle have the distance 0 and are pushed along the outward normal at their
/// deepest point.
class ExactDistanceSearch final : public ClosestPointSearch {
 public:
  void assign(const Problem& problem, double exempt_length, WorkCounters& counters) override;
  void go_to(int tick) override { tick_ = tick; }
  void search(const ChainPose& pose, double reach, std::vector<ClosestPoint>& found) override;

 private:
  const Problem* problem_ = nullptr;
  double exempt_length_ = 0;
  WorkCounters* counters_ = nullptr;
  int tick_ = 0;
  std::vector<double> bounding_radius_;  // of each obstacle [m]
};

}  // namespace bqsa::baselines
