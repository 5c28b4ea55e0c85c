/// @file
/// The search over all pairs of test points at the speed of the machine's vector unit.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "baselines/closest/closest_point_search.hpp"
#include "baselines/closest/test_point_layout.hpp"

namespace bqsa::baselines {

/// The answers of TestPointSearch, from loops that the compiler vectorises: coordinates in separate
/// arrays, the least squared distance first and which pair it was afterwards, in the plane without z.
class VectorizedTestPointSearch final : public ClosestPointSearch {
 public:
  explicit VectorizedTestPointSearch(const TestPointCounts& counts) : counts_(counts) {}

  void assign(const Problem& problem, double exempt_length, WorkCounters& counters) override;
  void go_to(int tick) override;
  void search(const ChainPose& pose, double reach, std::vector<ClosestPoint>& found) override;

 private:
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // a column a coordinate, in W [m]

  void place(const Ellipsoid& shape, Points& surface) const;

  TestPointCounts counts_;
  const Problem* problem_ = nullptr;
  double exempt_length_ = 0;
  WorkCounters* counters_ = nullptr;
  int tick_ = 0;
  Points unit_;
  std::vector<Points> surface_;
  Points link_;                    // test points of the link at hand
  Eigen::VectorXd least_squared_;  // of each of them
};

}  // namespace bqsa::baselines
