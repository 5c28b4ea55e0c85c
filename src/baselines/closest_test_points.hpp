/// @file
/// The search that the paper's complexity argument is about: the closest pair of test points.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bqsa/problem.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa::baselines {

/// The closest pair between all links and one obstacle.
struct ClosestPair {
  int link = -1;        ///< index into SerialChain::links; -1 if every test point is exempt
  double s = 0;         ///< parameter of the test point on the link: 0 start, 1 end
  double distance = 0;  ///< between the two test points; negative if the link's is inside [m]
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit vector in which the link gets away
};

/// N evenly spaced points on every link, both ends included, and M points on every obstacle's
/// surface: on an ellipse at even steps of its parameter, on an ellipsoid a spiral of even steps in
/// the unit ball's area (Fibonacci), both mapped by the semi-axes.
class ClosestTestPoints {
 public:
  /// @param link_points      N, at least 2
  /// @param obstacle_points  M
  /// @param exempt_length    test points of the last link closer than this to the tip are left out,
  ///                         for a tip that works near a surface [m]
  /// Problem and counters must outlive this. May allocate.
  void assign(const Problem& problem, int link_points, int obstacle_points, double exempt_length,
              WorkCounters& counters);

  /// From now on the obstacles are where they are at this tick. Does not allocate.
  void go_to(int tick);

  /// Brute force over all pairs of test points of all links with obstacle j, at tick 0 or where
  /// `go_to` put it. Does not allocate.
  ClosestPair search(const ChainPose& pose, int obstacle) const;

 private:
  const Problem* problem_ = nullptr;
  int link_points_ = 0;
  double exempt_length_ = 0;
  WorkCounters* counters_ = nullptr;
  int tick_ = 0;
  Eigen::Matrix3Xd unit_;                  ///< test points of the unit circle or sphere
  std::vector<Eigen::Matrix3Xd> surface_;  ///< an obstacle's test points a matrix, in W [m]
};

}  // namespace bqsa::baselines
