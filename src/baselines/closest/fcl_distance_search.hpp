/// @file
/// The closest points of links and obstacles by FCL, the Flexible Collision Library.
#pragma once

#include <memory>
#include <vector>

#include "baselines/closest/closest_point_search.hpp"

namespace bqsa::baselines {

/// How FCL is asked.
enum class FclSolver {
  kIndepMillimetres,   ///< its own GJK to 1e-9 mm, in millimetres: its best
  kLibccdMillimetres,  ///< as shipped, in millimetres
  kLibccdMetres,       ///< as shipped, in metres: its tolerances are absolute, and suit no arm
};

/// Links are capsules of the problem's link radius, obstacles ellipsoids; all objects are made once
/// and only moved. The distances are FCL's plus the radius. Pairs that touch or overlap, of which FCL
/// tells no nearest points, count as touching, distance = radius, and are pushed along the outward
/// normal at the point of the axis that is deepest in the ellipsoid's own metric.
///
/// FCL itself may allocate in every query.
class FclDistanceSearch final : public ClosestPointSearch {
 public:
  /// @param broadphase  leave pairs out by FCL's tree of bounding boxes over the obstacles; else
  ///                    every pair is asked
  FclDistanceSearch(FclSolver solver, bool broadphase);
  ~FclDistanceSearch() override;

  void assign(const Problem& problem, double exempt_length, WorkCounters& counters) override;
  void go_to(int tick) override;
  void search(const ChainPose& pose, double reach, std::vector<ClosestPoint>& found) override;

 private:
  struct Scene;

  FclSolver solver_;
  bool broadphase_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace bqsa::baselines
