// Heap allocations of warm queries and control steps, as JSON; where several are counted, their sum.

#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fmt/format.h>

#include <cstdlib>

#include "bqsa/batch/batched_test.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "harness/measuring/bystanders.hpp"
#include "harness/measuring/workload.hpp"
#include "harness/methods.hpp"
#include "support/allocation_guard.hpp"

namespace bqsa::harness {
namespace {

std::uint64_t bits = 0;  // so that answers are consumed

/// Of the second time: the first may take memory that is kept.
template <typename Work>
std::uint64_t allocations_of(const Work& work) {
  work();
  const test_support::AllocationGuard guard;
  work();
  return guard.allocations();
}

template <typename Real>
std::uint64_t of_batch(const Workload& workload) {
  const ObstacleBatch<3, Real> obstacles(workload.obstacles, {.reach = 2, .link_length = 1});
  const int links = workload.size.links;
  std::vector<Real> points;
  for (const double x : workload.poses.front().reshaped()) points.push_back(static_cast<Real>(x));
  std::vector<HitMask> masks(masks_needed(obstacles, links));
  std::vector<CategoryMasks> categories(masks.size());
  return allocations_of([&] {
    hit_masks<3, Real>(obstacles, points, masks);
    category_masks<3, Real>(obstacles, points, categories);
    bits += masks.back() + categories.back().hits() + any_hit<3, Real>(obstacles, points);
  });
}

std::uint64_t of_single_test(const Workload& workload) {
  const Eigen::Vector3d a = workload.poses.front().col(0), b = workload.poses.front().col(1);
  return allocations_of([&] {
    for (const Ellipsoid& shape : workload.obstacles) bits += hits(polar_form<3>(shape, a, b));
  });
}

/// Free steps among obstacles, in the plane and in space.
std::uint64_t of_free_steps() {
  constexpr int kSteps = 200, kObstacles = 64;
  std::uint64_t sum = 0;
  for (const int dimension : {2, 3}) {
    Problem problem = lonely_problem(dimension);
    problem.obstacles = draw_bystanders(problem, kObstacles);
    ControlLoop loop(parse_method_spec("bqsa", methods()), problem);
    sum += allocations_of([&loop] { loop.run(kSteps); });
  }
  return sum;
}

/// A link and an obstacle that meet; request and result are kept from query to query.
std::uint64_t of_fcl() {
  const fcl::CollisionObjectd link(std::make_shared<fcl::Capsuled>(0.0, 300.0));
  const fcl::CollisionObjectd obstacle(std::make_shared<fcl::Ellipsoidd>(200.0, 100.0, 50.0));
  fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd result;
  return allocations_of([&] {
    result.clear();
    bits += fcl::collide(&link, &obstacle, request, result);
  });
}

void print_allocations() {
  const Workload workload = make_workload({.dimension = 3, .links = 7, .obstacles = 64}, 1);
  fmt::print("{{\"batch\": {}, \"single\": {}, \"step\": {}, \"fcl_collide\": {}}}\n",
             of_batch<double>(workload) + of_batch<float>(workload), of_single_test(workload),
             of_free_steps(), of_fcl());
}

}  // namespace
}  // namespace bqsa::harness

int main() {
  bqsa::harness::print_allocations();
  return bqsa::harness::bits > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
