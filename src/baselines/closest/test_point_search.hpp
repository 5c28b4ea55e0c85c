/// @file
/// The search that the paper's complexity argument is about: all pairs of test points, one by one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "baselines/closest/closest_point_search.hpp"
#include "baselines/closest/test_point_layout.hpp"

namespace bqsa::baselines {

/// Brute force over the test points of every link and every obstacle, in scalar arithmetic. A link
/// whose closest test point is inside the obstacle has a negative distance. Of the last link the test
/// points closer than the exempt length to the tip are left out.
class TestPointSearch final : public ClosestPointSearch {
 public:
  explicit TestPointSearch(const TestPointCounts& counts) : counts_(counts) {}

  void assign(const Problem& problem, double exempt_length, WorkCounters& counters) override;
  void go_to(int tick) override;
  void search(const ChainPose& pose, double reach, std::vector<ClosestPoint>& found) override;

 private:
  TestPointCounts counts_;
  const Problem* problem_ = nullptr;
  double exempt_length_ = 0;
  WorkCounters* counters_ = nullptr;
  int tick_ = 0;
  Eigen::Matrix3Xd unit_;                  ///< test points of the unit circle or sphere
  std::vector<Eigen::Matrix3Xd> surface_;  ///< an obstacle's test points a matrix, in W [m]
};

}  // namespace bqsa::baselines
