/// @file
/// The search over all pairs of test points at the speed of the machine's vector unit.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "baselines/closest/batched_test_points.hpp"
#include "baselines/closest/closest_point_search.hpp"
#include "baselines/closest/test_point_layout.hpp"

namespace bqsa::baselines {

/// The answers of TestPointSearch by vector instructions: first the least squared distance of every test
/// point of the links, then, for links within reach, which point of the obstacle it was.
class VectorizedTestPointSearch final : public ClosestPointSearch {
 public:
  explicit VectorizedTestPointSearch(const TestPointCounts& counts) : counts_(counts) {}

  void assign(const Problem& problem, double exempt_length, WorkCounters& counters) override;
  void go_to(int tick) override;
  void search(const ChainPose& pose, double reach, std::vector<ClosestPoint>& found) override;

 private:
  using Points = Eigen::MatrixX3d;  // by rows, in W [m]

  void place(std::size_t obstacle, const Ellipsoid& shape);
  int put_link_points(const ChainPose& pose);

  TestPointCounts counts_;
  const Problem* problem_ = nullptr;
  double exempt_length_ = 0;
  WorkCounters* counters_ = nullptr;
  int tick_ = 0;
  Points unit_;                        // test points of the unit circle or sphere
  std::vector<Points> surface_;        // of each obstacle
  std::optional<PointBlocks> blocks_;  // the same, for vectors; made by assign
  Points links_;                       // test points of all links
  std::vector<double> least_squared_;  // of each of them, obstacle by obstacle [m²]
};

}  // namespace bqsa::baselines
