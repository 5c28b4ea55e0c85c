#include "baselines/closest/fcl_distance_search.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace bqsa::baselines {
namespace {

using Eigen::Vector3d;

fcl::DistanceRequestd request_of(FclSolver solver) {
  constexpr bool kNearestPoints = true, kSigned = false;  // signed distances abort or err by far
  if (solver != FclSolver::kIndepMillimetres) return fcl::DistanceRequestd(kNearestPoints, kSigned);
  constexpr double kTolerance = 1e-9;
  return fcl::DistanceRequestd(kNearestPoints, kSigned, 0, 0, kTolerance, fcl::GST_INDEP);
}

/// Turns the z axis, a capsule's, into the direction of d. A capsule has no sense of direction, and
/// the turn is well conditioned only for the upper half space.
Eigen::Matrix3d turn_from_z(const Vector3d& d) {
  const Vector3d axis = d.z() < 0 ? Vector3d(-d) : d;
  if (axis.isZero(0)) return Eigen::Matrix3d::Identity();
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix();
}

/// Parameter of the point of a + s (b - a) nearest to p.
double nearest_parameter(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const double whole = (b - a).squaredNorm();
  return whole > 0 ? std::clamp((p - a).dot(b - a) / whole, 0.0, 1.0) : 0;
}

/// Parameter of the axis's point with the least level.
double deepest_parameter(const LinkAxis& axis, const Ellipsoid& shape) {
  const Eigen::Matrix3d& T = shape.unit_map();
  return nearest_parameter(T * (axis.a - shape.center()), T * (axis.b - shape.center()),
                           Vector3d::Zero());
}

}  // namespace

struct FclDistanceSearch::Scene {
  const Problem* problem;
  double exempt_length;
  WorkCounters* counters;
  fcl::DistanceRequestd request;
  double unit;  ///< FCL's lengths in one metre
  int tick = 0;
  std::vector<std::shared_ptr<fcl::Capsuled>> capsules;  ///< of the links
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> links;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> obstacles;
  std::vector<std::size_t> numbers;  ///< 0, 1, ...: what the obstacles' user data point to
  fcl::DynamicAABBTreeCollisionManagerd manager;

  // The search in progress.
  std::size_t link = 0;
  LinkAxis axis{};
  double reach = 0;
  std::vector<ClosestPoint>* found = nullptr;

  void place(std::size_t j);
  void place_link();
  void query(std::size_t j);
};

/// The obstacle is where it is at the tick.
void FclDistanceSearch::Scene::place(std::size_t j) {
  const Ellipsoid& shape = problem->obstacles[j].at(tick);
  obstacles[j]->setTransform(shape.rotation(), unit * shape.center());
  obstacles[j]->computeAABB();
}

/// The link in progress is where its axis is, and as long.
void FclDistanceSearch::Scene::place_link() {
  fcl::CollisionObjectd& object = *links[link];
  if (problem->chain.has_prismatic_joints()) {
    capsules[link]->lz = unit * (axis.b - axis.a).norm();
    capsules[link]->computeLocalAABB();
  }
  object.setTransform(turn_from_z(axis.b - axis.a), 0.5 * unit * (axis.a + axis.b));
}

/// One narrow-phase query of the link in progress.
void FclDistanceSearch::Scene::query(std::size_t j) {
  fcl::DistanceResultd result;  // fresh: results accumulate
  fcl::distance(links[link].get(), obstacles[j].get(), request, result);
  ++counters->distance_queries;
  const double radius = problem->radius_of(link);
  const double gap = result.min_distance / unit;
  if (gap + radius >= reach) return;

  const Ellipsoid& shape = problem->obstacles[j].at(tick);
  ClosestPoint point{.link = static_cast<int>(link), .obstacle = static_cast<int>(j)};
  const Vector3d apart = (result.nearest_points[0] - result.nearest_points[1]) / unit;
  const double length = apart.norm();
  if (gap > 0 && length > 0) {
    point.s = nearest_parameter(axis.a, axis.b, result.nearest_points[0] / unit);
    point.distance = gap + radius;
    point.direction = apart / length;
    point.p_obstacle = result.nearest_points[1] / unit;
  } else {
    point.s = deepest_parameter(axis, shape);
    point.distance = radius;
    const Vector3d deepest = axis.a + point.s * (axis.b - axis.a);
    point.direction = (shape.quadratic_form() * (deepest - shape.center())).stableNormalized();
    point.p_obstacle = deepest;
  }
  point.s *= axis.s_end;
  found->push_back(point);
}

FclDistanceSearch::FclDistanceSearch(FclSolver solver, bool broadphase)
    : solver_(solver), broadphase_(broadphase) {}

FclDistanceSearch::~FclDistanceSearch() = default;

void FclDistanceSearch::assign(const Problem& problem, double exempt_length,
                               WorkCounters& counters) {
  scene_ = std::make_unique<Scene>();
  Scene& scene = *scene_;
  scene.problem = &problem;
  scene.exempt_length = exempt_length;
  scene.counters = &counters;
  scene.request = request_of(solver_);
  scene.unit = solver_ == FclSolver::kLibccdMetres ? 1 : 1000;

  const SerialChain& chain = problem.chain;
  ChainPose pose;
  chain.forward(problem.start, pose);
  for (std::size_t i = 0; i < chain.links().size(); ++i) {
    const LinkAxis axis = link_axis(chain, pose, i, exempt_length);
    const double length = axis.s_end < 0 ? 0 : (axis.b - axis.a).norm();
    scene.capsules.push_back(
        std::make_shared<fcl::Capsuled>(scene.unit * problem.radius_of(i), scene.unit * length));
    scene.links.push_back(std::make_unique<fcl::CollisionObjectd>(scene.capsules.back()));
  }
  scene.numbers.resize(problem.obstacles.size());
  std::iota(scene.numbers.begin(), scene.numbers.end(), std::size_t{0});
  for (std::size_t j = 0; j < problem.obstacles.size(); ++j) {
    const Vector3d semi_axes = scene.unit * problem.obstacles[j].shape.semi_axes();
    scene.obstacles.push_back(
        std::make_unique<fcl::CollisionObjectd>(std::make_shared<fcl::Ellipsoidd>(semi_axes)));
    scene.obstacles.back()->setUserData(&scene.numbers[j]);
    scene.place(j);
    scene.manager.registerObject(scene.obstacles.back().get());
  }
  scene.manager.setup();
}

void FclDistanceSearch::go_to(int tick) {
  Scene& scene = *scene_;
  scene.tick = tick;
  bool moved = false;
  for (std::size_t j = 0; j < scene.obstacles.size(); ++j) {
    if (!scene.problem->obstacles[j].moves()) continue;
    scene.place(j);
    moved = true;
  }
  if (moved && broadphase_) scene.manager.update();
}

void FclDistanceSearch::search(const ChainPose& pose, double reach,
                               std::vector<ClosestPoint>& found) {
  Scene& scene = *scene_;
  found.clear();
  scene.reach = reach;
  scene.found = &found;
  for (scene.link = 0; scene.link < scene.links.size(); ++scene.link) {
    scene.axis = link_axis(scene.problem->chain, pose, scene.link, scene.exempt_length);
    if (scene.axis.s_end < 0) continue;
    fcl::CollisionObjectd& link = *scene.links[scene.link];
    scene.place_link();
    if (!broadphase_) {
      for (std::size_t j = 0; j < scene.obstacles.size(); ++j) scene.query(j);
      continue;
    }
    link.computeAABB();
    // The bound is what the tree prunes with: the sphere of influence, whatever has been found.
    const auto visit = [](fcl::CollisionObjectd* one, fcl::CollisionObjectd* other, void* data,
                          double& bound) {
      Scene& at = *static_cast<Scene*>(data);
      const fcl::CollisionObjectd* obstacle = one == at.links[at.link].get() ? other : one;
      at.query(*static_cast<const std::size_t*>(obstacle->getUserData()));
      bound = at.unit * (at.reach - at.problem->radius_of(at.link));
      return false;
    };
    scene.manager.distance(&link, &scene, visit);
  }
  std::sort(found.begin(), found.end(), [](const ClosestPoint& p, const ClosestPoint& q) {
    return p.obstacle != q.obstacle ? p.obstacle < q.obstacle : p.link < q.link;
  });
}

}  // namespace bqsa::baselines
