// Bullet, the physics library, whose GJK stops as soon as it sees that two shapes are apart. As packaged
// it computes in single precision. In millimetres, like FCL: some of its tolerances are absolute.
//
// The other way to ask Bullet is for the distance, with its EPA where the shapes meet: six times slower
// and no better next to touching.

#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <cassert>
#include <vector>

#include "harness/measuring/detector_lists.hpp"

namespace bqsa::harness {
namespace {

constexpr double kMillimetres = 1000;

/// What Bullet wants to know of a shape of one's own, without a margin around it.
template <typename Shape>
class OwnShape : public btConvexInternalShape {
 public:
  OwnShape() {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    m_collisionMargin = 0;
  }

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const final {
    return static_cast<const Shape*>(this)->support(direction);
  }
  btVector3 localGetSupportingVertex(const btVector3& direction) const final {
    return static_cast<const Shape*>(this)->support(direction);
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions,
                                                         btVector3* supports,
                                                         int count) const final {
    for (int i = 0; i < count; ++i) {
      supports[i] = static_cast<const Shape*>(this)->support(directions[i]);
    }
  }
  void calculateLocalInertia(btScalar, btVector3& inertia) const final { inertia.setZero(); }
};

/// From -half to half: no rotation, which a capsule of radius 0 would need.
class SegmentShape final : public OwnShape<SegmentShape> {
 public:
  explicit SegmentShape(const btVector3& half) : half_(half) {}
  btVector3 support(const btVector3& direction) const {
    return direction.dot(half_) > 0 ? half_ : -half_;
  }
  const char* getName() const override { return "segment"; }

 private:
  btVector3 half_;
};

/// In its own axes. (Bullet's sphere cannot be scaled along its axes, and its multi-sphere, which can,
/// has the support function of something else.)
class EllipsoidShape final : public OwnShape<EllipsoidShape> {
 public:
  explicit EllipsoidShape(const btVector3& semi_axes) : semi_axes_(semi_axes) {}
  btVector3 support(const btVector3& direction) const {
    const btVector3 scaled = semi_axes_ * direction;
    const btScalar squared = scaled.length2();
    return squared > 0 ? semi_axes_ * scaled / btSqrt(squared) : btVector3(semi_axes_.x(), 0, 0);
  }
  const char* getName() const override { return "ellipsoid"; }

 private:
  btVector3 semi_axes_;
};

btVector3 in_millimetres(const Eigen::Vector3d& v) {
  const Eigen::Matrix<btScalar, 3, 1> scaled = (kMillimetres * v).cast<btScalar>();
  return {scaled.x(), scaled.y(), scaled.z()};
}

btMatrix3x3 rotation(const Eigen::Matrix3d& m) {
  const Eigen::Matrix<btScalar, 3, 3> R = m.cast<btScalar>();
  return {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)};
}

template <typename Shape>
struct Placed {
  Shape shape;
  btTransform pose;
};

class BulletDetection final : public Detection {
 public:
  explicit BulletDetection(const Workload& workload)
      : links_a_pose_(static_cast<std::size_t>(workload.size.links)) {
    for (const Eigen::Matrix3Xd& pose : workload.poses) {
      for (Eigen::Index i = 0; i + 1 < pose.cols(); ++i) {
        const Eigen::Vector3d half = 0.5 * (pose.col(i + 1) - pose.col(i));
        const Eigen::Vector3d middle = pose.col(i) + half;
        links_.push_back({SegmentShape(in_millimetres(half)),
                          btTransform(btMatrix3x3::getIdentity(), in_millimetres(middle))});
      }
    }
    for (const Ellipsoid& shape : workload.obstacles) {
      obstacles_.push_back(
          {EllipsoidShape(in_millimetres(shape.semi_axes())),
           btTransform(rotation(shape.rotation()), in_millimetres(shape.center()))});
    }
    query_.m_maximumDistanceSquared = 0;  // stop where the shapes are seen to be apart
  }

  void detect(int pose, std::span<std::uint8_t> hit) override {
    assert(hit.size() == obstacles_.size() * links_a_pose_);
    const auto* const links = &links_[static_cast<std::size_t>(pose) * links_a_pose_];
    btGjkPairDetector gjk(&links->shape, &obstacles_.front().shape, &simplex_, nullptr);
    btPointCollector contact;
    std::uint8_t* answer = hit.data();
    for (const Placed<EllipsoidShape>& obstacle : obstacles_) {
      gjk.setMinkowskiB(&obstacle.shape);
      query_.m_transformB = obstacle.pose;
      for (std::size_t i = 0; i < links_a_pose_; ++i) {
        gjk.setMinkowskiA(&links[i].shape);
        query_.m_transformA = links[i].pose;
        gjk.getClosestPointsNonVirtual(query_, contact, nullptr);
        *answer++ = gjk.m_degenerateSimplex != kStoppedApart;
      }
    }
  }

 private:
  static constexpr int kStoppedApart = 10;  // Bullet's number for that reason to stop

  std::size_t links_a_pose_;
  std::vector<Placed<SegmentShape>> links_;
  std::vector<Placed<EllipsoidShape>> obstacles_;
  btVoronoiSimplexSolver simplex_;
  btGjkPairDetector::ClosestPointInput query_;
};

}  // namespace

std::vector<Detector> bullet_detectors() {
  return {{.name = "bullet_gjk",
           .label = "Bullet GJK, early-out",
           .what =
               "Bullet's GJK with support functions of segment and ellipsoid, stopped where they "
               "are seen apart",
           .accuracy = Accuracy::kSinglePrecision,
           .in_plane = true,
           .in_space = true,
           .multiplications = not_counted,
           .prepare = [](const Workload& workload) -> std::unique_ptr<Detection> {
             return std::make_unique<BulletDetection>(workload);
           }}};
}

}  // namespace bqsa::harness
