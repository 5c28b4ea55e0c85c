// FCL, the Flexible Collision Library, in millimetres, which its absolute tolerances suit. Links are
// capsules of radius 0. All shapes, their poses and boxes are made beforehand, since the other
// detectors too know all positions: a pass is queries and nothing else.

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <limits>

#include "harness/measuring/detector_lists.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

constexpr double kMillimetres = 1000;
constexpr double kDistanceTolerance = 1e-9;  // of FCL's own GJK: its best (in millimetres)

/// Turns the z axis, a capsule's, into the direction of d. A capsule has no sense of direction, and the
/// turn is well conditioned only for the upper half space.
Eigen::Matrix3d turn_from_z(const Vector3d& d) {
  const Vector3d axis = d.z() < 0 ? Vector3d(-d) : d;
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix();
}

fcl::Transform3d link_pose(const Vector3d& a, const Vector3d& b) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = turn_from_z(b - a);
  X.translation() = 0.5 * kMillimetres * (a + b);
  return X;
}

fcl::Transform3d obstacle_pose(const Ellipsoid& shape) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = shape.rotation();
  X.translation() = kMillimetres * shape.center();
  return X;
}

/// All links of all poses, and all obstacles, as FCL's objects.
struct Scene {
  explicit Scene(const Workload& workload)
      : links_a_pose(static_cast<std::size_t>(workload.size.links)) {
    links.reserve(workload.poses.size() * links_a_pose);
    for (const Eigen::Matrix3Xd& pose : workload.poses) {
      for (Eigen::Index i = 0; i + 1 < pose.cols(); ++i) {
        const double length = kMillimetres * (pose.col(i + 1) - pose.col(i)).norm();
        links.emplace_back(std::make_shared<fcl::Capsuled>(0.0, length),
                           link_pose(pose.col(i), pose.col(i + 1)));
      }
    }
    obstacles.reserve(workload.obstacles.size());
    for (const Ellipsoid& shape : workload.obstacles) {
      const Vector3d semi_axes = kMillimetres * shape.semi_axes();
      obstacles.emplace_back(std::make_shared<fcl::Ellipsoidd>(semi_axes), obstacle_pose(shape));
    }
  }

  const fcl::CollisionObjectd& link(int pose, std::size_t i) const {
    return links[static_cast<std::size_t>(pose) * links_a_pose + i];
  }

  std::size_t links_a_pose;
  std::vector<fcl::CollisionObjectd> links;
  std::vector<fcl::CollisionObjectd> obstacles;
};

/// Asks whether two objects meet. The result is cleared, not made anew: it keeps its memory.
class CollideQuery {
 public:
  explicit CollideQuery(fcl::GJKSolverType solver) : request_(1, false) {
    request_.gjk_solver_type = solver;
  }

  bool hit(const fcl::CollisionObjectd& link, const fcl::CollisionObjectd& obstacle) {
    result_.clear();
    return fcl::collide(&link, &obstacle, request_, result_) > 0;
  }

 private:
  fcl::CollisionRequestd request_;
  fcl::CollisionResultd result_;
};

/// Asks for the distance, unsigned (signed ones abort or err), and takes none for a hit.
class DistanceQuery {
 public:
  explicit DistanceQuery(fcl::GJKSolverType solver)
      : request_(solver == fcl::GST_INDEP
                     ? fcl::DistanceRequestd(false, false, 0, 0, kDistanceTolerance, solver)
                     : fcl::DistanceRequestd()) {}

  bool hit(const fcl::CollisionObjectd& link, const fcl::CollisionObjectd& obstacle) {
    result_.clear();
    return fcl::distance(&link, &obstacle, request_, result_) <= 0;
  }

 private:
  fcl::DistanceRequestd request_;
  fcl::DistanceResultd result_;
};

/// Every pair is asked.
template <typename Query>
class PairwiseDetection final : public Detection {
 public:
  PairwiseDetection(const Workload& workload, fcl::GJKSolverType solver)
      : scene_(workload), query_(solver) {}

  void detect(int pose, std::span<std::uint8_t> hit) override {
    const std::size_t n = scene_.links_a_pose;
    assert(hit.size() == scene_.obstacles.size() * n);
    for (std::size_t j = 0; j < scene_.obstacles.size(); ++j) {
      for (std::size_t i = 0; i < n; ++i) {
        hit[j * n + i] = query_.hit(scene_.link(pose, i), scene_.obstacles[j]);
      }
    }
  }

 private:
  Scene scene_;
  Query query_;
};

/// Pairs are asked whose boxes meet, found by FCL's tree of boxes over the obstacles. The box of a turned
/// object is to FCL a cube around its bounding sphere.
template <typename Query>
class BroadphaseDetection final : public Detection {
 public:
  BroadphaseDetection(const Workload& workload, fcl::GJKSolverType solver)
      : scene_(workload), query_(solver) {
    for (fcl::CollisionObjectd& obstacle : scene_.obstacles) tree_.registerObject(&obstacle);
    tree_.setup();
  }

  void detect(int pose, std::span<std::uint8_t> hit) override;

 private:
  /// A link's search in the tree.
  struct Search {
    BroadphaseDetection* at;
    const fcl::CollisionObjectd* link;
    std::uint8_t* hit;  ///< that of the first obstacle

    void ask(const fcl::CollisionObjectd* one, const fcl::CollisionObjectd* other) const {
      const fcl::CollisionObjectd* obstacle = one == link ? other : one;
      const auto j = static_cast<std::size_t>(obstacle - at->scene_.obstacles.data());
      hit[j * at->scene_.links_a_pose] = at->query_.hit(*link, *obstacle);
    }
  };

  Scene scene_;
  Query query_;
  fcl::DynamicAABBTreeCollisionManagerd tree_;
};

template <>
void BroadphaseDetection<CollideQuery>::detect(int pose, std::span<std::uint8_t> hit) {
  assert(hit.size() == scene_.obstacles.size() * scene_.links_a_pose);
  std::fill(hit.begin(), hit.end(), std::uint8_t{0});
  const auto visit = [](fcl::CollisionObjectd* one, fcl::CollisionObjectd* other, void* data) {
    static_cast<const Search*>(data)->ask(one, other);
    return false;  // go on: all hits are wanted
  };
  for (std::size_t i = 0; i < scene_.links_a_pose; ++i) {
    fcl::CollisionObjectd& link =
        scene_.links[static_cast<std::size_t>(pose) * scene_.links_a_pose + i];
    Search search{this, &link, &hit[i]};
    tree_.collide(&link, &search, visit);
  }
}

template <>
void BroadphaseDetection<DistanceQuery>::detect(int pose, std::span<std::uint8_t> hit) {
  assert(hit.size() == scene_.obstacles.size() * scene_.links_a_pose);
  std::fill(hit.begin(), hit.end(), std::uint8_t{0});
  const auto visit = [](fcl::CollisionObjectd* one, fcl::CollisionObjectd* other, void* data,
                        double& bound) {
    static_cast<const Search*>(data)->ask(one, other);
    bound = std::numeric_limits<double>::min();  // whatever is further away is left out
    return false;
  };
  for (std::size_t i = 0; i < scene_.links_a_pose; ++i) {
    fcl::CollisionObjectd& link =
        scene_.links[static_cast<std::size_t>(pose) * scene_.links_a_pose + i];
    Search search{this, &link, &hit[i]};
    tree_.distance(&link, &search, visit);
  }
}

template <typename Detection, fcl::GJKSolverType Solver>
std::unique_ptr<bqsa::harness::Detection> prepare(const Workload& workload) {
  return std::make_unique<Detection>(workload, Solver);
}

}  // namespace

std::vector<Detector> fcl_detectors() {
  using fcl::GST_INDEP;
  using fcl::GST_LIBCCD;
  return {
      library_detector("fcl_collide_libccd", "FCL collide, libccd",
                       "fcl::collide of every pair by libccd's GJK, contacts off",
                       prepare<PairwiseDetection<CollideQuery>, GST_LIBCCD>),
      library_detector("fcl_collide_indep", "FCL collide, own GJK",
                       "fcl::collide of every pair by FCL's own GJK, contacts off",
                       prepare<PairwiseDetection<CollideQuery>, GST_INDEP>),
      library_detector("fcl_collide_broadphase", "FCL collide, broadphase",
                       "fcl::collide by libccd's GJK of the pairs that FCL's tree of boxes leaves",
                       prepare<BroadphaseDetection<CollideQuery>, GST_LIBCCD>),
      library_detector("fcl_distance_libccd", "FCL distance, libccd",
                       "fcl::distance of every pair by libccd, as shipped",
                       prepare<PairwiseDetection<DistanceQuery>, GST_LIBCCD>),
      library_detector("fcl_distance_indep", "FCL distance, own GJK",
                       "fcl::distance of every pair by FCL's own GJK to 1e-9 mm",
                       prepare<PairwiseDetection<DistanceQuery>, GST_INDEP>),
      library_detector(
          "fcl_distance_broadphase", "FCL distance, broadphase",
          "fcl::distance by FCL's own GJK of the pairs that FCL's tree of boxes leaves",
          prepare<BroadphaseDetection<DistanceQuery>, GST_INDEP>),
  };
}

}  // namespace bqsa::harness
