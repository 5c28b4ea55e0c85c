#include "harness/judge/fcl_check.hpp"

#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

constexpr double kMillimetres = 1000;        // FCL's tolerances are absolute and suit millimetres
constexpr double kDistanceTolerance = 1e-9;  // of FCL's own GJK, in the units above

/// The pose of a capsule, whose axis is z, on the segment from a to b. A capsule has no direction,
/// and the turn from z is well conditioned only for a direction in the upper half space.
fcl::Transform3d capsule_pose(const Vector3d& a, const Vector3d& b) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  const Vector3d d = b - a;
  const double length = d.norm();
  if (length > 0) {
    const Vector3d axis = (d.z() < 0 ? -1 : 1) / length * d;
    X.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix();
  }
  X.translation() = a + 0.5 * d;
  return X;
}

/// FCL's closed form for a sphere and a capsule: the radius-0 capsule against the unit sphere.
bool meets_unit_sphere(const Vector3d& a, const Vector3d& b) {
  const fcl::Capsuled segment(0.0, (b - a).norm());
  const fcl::Sphered sphere(1.0);
  const fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd result;
  return fcl::collide(&segment, capsule_pose(a, b), &sphere, fcl::Transform3d::Identity(), request,
                      result) > 0;
}

void expect(bool answer, const char* question) {
  if (!answer) throw std::runtime_error(std::string("FCL failed its self-test: ") + question);
}

}  // namespace

struct FclCheck::Shapes {
  struct Placed {
    fcl::Ellipsoidd shape;
    fcl::Transform3d pose;
    Vector3d semi_axes;
  };
  std::vector<Placed> obstacles;
  double radius;
};

FclCheck::FclCheck(const std::vector<Ellipsoid>& obstacles, double radius) {
  auto shapes = std::make_unique<Shapes>();
  shapes->radius = kMillimetres * radius;
  for (const Ellipsoid& ellipsoid : obstacles) {
    const Vector3d semi_axes = kMillimetres * ellipsoid.semi_axes();
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear() = ellipsoid.rotation();
    X.translation() = kMillimetres * ellipsoid.center();
    shapes->obstacles.push_back({fcl::Ellipsoidd(semi_axes), X, semi_axes});
  }
  shapes_ = std::move(shapes);
}

FclCheck::~FclCheck() = default;

bool FclCheck::collides(const Vector3d& a, const Vector3d& b, int obstacle) const {
  const Shapes::Placed& placed = shapes_->obstacles[static_cast<std::size_t>(obstacle)];
  const Vector3d start = kMillimetres * a;
  const Vector3d end = kMillimetres * b;
  if (shapes_->radius == 0) {
    const Eigen::Matrix3d to_axes = placed.pose.linear().transpose();
    const Vector3d center = placed.pose.translation();
    return meets_unit_sphere((to_axes * (start - center)).cwiseQuotient(placed.semi_axes),
                             (to_axes * (end - center)).cwiseQuotient(placed.semi_axes));
  }
  const fcl::Capsuled capsule(shapes_->radius, (end - start).norm());
  fcl::CollisionRequestd request(1, false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  return fcl::collide(&capsule, capsule_pose(start, end), &placed.shape, placed.pose, request,
                      result) > 0;
}

double FclCheck::distance(const Vector3d& a, const Vector3d& b, int obstacle) const {
  const Shapes::Placed& placed = shapes_->obstacles[static_cast<std::size_t>(obstacle)];
  const Vector3d start = kMillimetres * a;
  const Vector3d end = kMillimetres * b;
  const fcl::Capsuled capsule(shapes_->radius, (end - start).norm());
  const fcl::DistanceRequestd request(false, false, 0, 0, kDistanceTolerance, fcl::GST_INDEP);
  fcl::DistanceResultd result;
  fcl::distance(&capsule, capsule_pose(start, end), &placed.shape, placed.pose, request, result);
  return result.min_distance / kMillimetres;
}

void FclCheck::self_test() {
  constexpr double kExpected = 1e-6;  // [m], far above the error measured for these shapes
  const Ellipsoid egg(Vector3d::Zero(), Vector3d(0.3, 0.2, 0.1));
  const Ellipsoid sheet(Vector3d::Zero(), Vector3d(10, 10, 1e-4));
  for (const double radius : {0.0, 0.02}) {
    const FclCheck check({egg, sheet}, radius);
    const Vector3d outside(0.5, 0, 0.15), beside(-0.5, 0, 0.15);
    const Vector3d inside_a(-0.1, 0, 0), inside_b(0.1, 0.05, 0);
    expect(check.collides({0.5, 0, 0.05}, {-0.5, 0, 0.05}, 0), "a link through an ellipsoid");
    expect(!check.collides(outside, beside, 0), "a link beside an ellipsoid");
    expect(std::abs(check.distance(outside, beside, 0) - (0.05 - radius)) < kExpected,
           "the distance of a link beside an ellipsoid");
    expect(check.collides(inside_a, inside_b, 0), "a link inside an ellipsoid");
    expect(check.collides({0, 0, -1}, {0.1, 0, 1}, 1), "a link through a sheet");
    expect(!check.collides({0, 0, 0.021}, {0.4, 0, 0.4}, 1), "a link beside a sheet");
  }
}

}  // namespace bqsa::harness
