#include "harness/judge/fcl_check.hpp"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "bqsa/envelope/overloaded.hpp"

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

/// Of its corners [m].
Vector3d center_of(const ConvexHull& hull) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& corner : hull.vertices) sum += corner;
  return sum / static_cast<double>(hull.vertices.size());
}

/// Around its centre, in millimetres. A flat one has its triangles on both sides.
std::unique_ptr<const fcl::CollisionGeometryd> convex_of(const ConvexHull& hull) {
  auto corners = std::make_shared<std::vector<Vector3d>>();
  for (const Vector3d& corner : hull.vertices) {
    corners->emplace_back(kMillimetres * (corner - center_of(hull)));
  }
  auto faces = std::make_shared<std::vector<int>>();
  const auto add_face = [&faces](int a, int b, int c) {
    faces->insert(faces->end(), {3, a, b, c});
  };
  for (const std::array<int, 3>& triangle : hull.triangles) {
    add_face(triangle[0], triangle[1], triangle[2]);
    if (hull.span < 3) add_face(triangle[0], triangle[2], triangle[1]);
  }
  const int count = static_cast<int>(faces->size() / 4);
  return std::make_unique<fcl::Convexd>(corners, count, faces);
}

void expect(bool answer, const char* question) {
  if (!answer) throw std::runtime_error(std::string("FCL failed its self-test: ") + question);
}

}  // namespace

struct FclCheck::Shapes {
  struct Placed {
    std::unique_ptr<const fcl::CollisionGeometryd> shape;
    fcl::Transform3d pose;
    Vector3d semi_axes;  ///< of an ellipsoid; else zero
  };
  std::vector<Placed> obstacles;
  double radius;

  void add(const Solid& solid);

 private:
  void add(std::unique_ptr<const fcl::CollisionGeometryd> shape, const fcl::Transform3d& pose) {
    obstacles.push_back({std::move(shape), pose, Vector3d::Zero()});
  }
};

void FclCheck::Shapes::add(const Solid& solid) {
  std::visit(
      Overloaded{
          [this](const Ball& ball) {
            fcl::Transform3d X = fcl::Transform3d::Identity();
            X.translation() = kMillimetres * ball.center;
            add(std::make_unique<fcl::Sphered>(kMillimetres * ball.radius), X);
          },
          [this](const Box& box) {
            fcl::Transform3d X = fcl::Transform3d::Identity();
            X.linear() = box.rotation;
            X.translation() = kMillimetres * box.center;
            add(std::make_unique<fcl::Boxd>(2 * kMillimetres * box.half_lengths), X);
          },
          [this](const Cylinder& cylinder) {
            const Vector3d a = kMillimetres * cylinder.a, b = kMillimetres * cylinder.b;
            add(std::make_unique<fcl::Cylinderd>(kMillimetres * cylinder.radius, (b - a).norm()),
                capsule_pose(a, b));
          },
          [this](const Capsule& capsule) {
            const Vector3d a = kMillimetres * capsule.a, b = kMillimetres * capsule.b;
            add(std::make_unique<fcl::Capsuled>(kMillimetres * capsule.radius, (b - a).norm()),
                capsule_pose(a, b));
          },
          [this](const ConvexHull& hull) {
            fcl::Transform3d X = fcl::Transform3d::Identity();
            X.translation() = kMillimetres * center_of(hull);
            add(convex_of(hull), X);
          }},
      solid);
}

FclCheck::FclCheck(const std::vector<Ellipsoid>& obstacles, double radius,
                   const std::vector<Solid>& solids) {
  auto shapes = std::make_unique<Shapes>();
  shapes->radius = kMillimetres * radius;
  for (const Ellipsoid& ellipsoid : obstacles) {
    const Vector3d semi_axes = kMillimetres * ellipsoid.semi_axes();
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear() = ellipsoid.rotation();
    X.translation() = kMillimetres * ellipsoid.center();
    shapes->obstacles.push_back({std::make_unique<fcl::Ellipsoidd>(semi_axes), X, semi_axes});
  }
  for (const Solid& solid : solids) shapes->add(solid);
  shapes_ = std::move(shapes);
}

FclCheck::~FclCheck() = default;

bool FclCheck::collides(const Vector3d& a, const Vector3d& b, int obstacle) const {
  const Shapes::Placed& placed = shapes_->obstacles[static_cast<std::size_t>(obstacle)];
  const Vector3d start = kMillimetres * a;
  const Vector3d end = kMillimetres * b;
  if (shapes_->radius == 0 && placed.semi_axes.x() > 0) {
    const Eigen::Matrix3d to_axes = placed.pose.linear().transpose();
    const Vector3d center = placed.pose.translation();
    return meets_unit_sphere((to_axes * (start - center)).cwiseQuotient(placed.semi_axes),
                             (to_axes * (end - center)).cwiseQuotient(placed.semi_axes));
  }
  return capsule_collides(start, end, shapes_->radius, obstacle);
}

/// All in millimetres.
bool FclCheck::capsule_collides(const Vector3d& start, const Vector3d& end, double radius,
                                int obstacle) const {
  const Shapes::Placed& placed = shapes_->obstacles[static_cast<std::size_t>(obstacle)];
  const fcl::Capsuled capsule(radius, (end - start).norm());
  fcl::CollisionRequestd request(1, false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  return fcl::collide(&capsule, capsule_pose(start, end), placed.shape.get(), placed.pose, request,
                      result) > 0;
}

double FclCheck::distance(const Vector3d& a, const Vector3d& b, int obstacle) const {
  const Shapes::Placed& placed = shapes_->obstacles[static_cast<std::size_t>(obstacle)];
  const Vector3d start = kMillimetres * a;
  const Vector3d end = kMillimetres * b;
  const fcl::Capsuled capsule(shapes_->radius, (end - start).norm());
  const fcl::DistanceRequestd request(false, false, 0, 0, kDistanceTolerance, fcl::GST_INDEP);
  fcl::DistanceResultd result;
  fcl::distance(&capsule, capsule_pose(start, end), placed.shape.get(), placed.pose, request,
                result);
  return result.min_distance / kMillimetres;
}

bool FclCheck::confirms(const Vector3d& a, const Vector3d& b, int obstacle, double distance,
                        double tolerance) const {
  const Vector3d start = kMillimetres * a;
  const Vector3d end = kMillimetres * b;
  const double least = kMillimetres * (distance - tolerance);
  const double most = kMillimetres * (distance + tolerance);
  const double radius = shapes_->radius;
  return (least <= 0 || !capsule_collides(start, end, radius + least, obstacle)) &&
         capsule_collides(start, end, radius + most, obstacle);
}

namespace {

/// Half as thick as a hand, with the origin inside and its upper side at z = 0.1.
std::vector<Solid> solids_with_known_answers() {
  const Vector3d below(0, 0, -0.1), above(0, 0, 0.1);
  std::vector<Vector3d> corners;
  for (const double x : {-0.3, 0.3}) {
    for (const double y : {-0.2, 0.2}) {
      for (const double z : {-0.1, 0.1}) corners.emplace_back(x, y, z);
    }
  }
  return {Ball{Vector3d::Zero(), 0.1}, Box{Vector3d::Zero(), {0.3, 0.2, 0.1}},
          Cylinder{below, above, 0.3}, Capsule{Vector3d(-0.2, 0, 0), Vector3d(0.2, 0, 0), 0.1},
          convex_hull(corners)};
}

}  // namespace

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

    const std::vector<Solid> solids = solids_with_known_answers();
    const FclCheck of_solids({}, radius, solids);
    for (int k = 0; k < static_cast<int>(solids.size()); ++k) {
      expect(of_solids.collides({0.5, 0, 0.05}, {-0.5, 0, 0.05}, k), "a link through a solid");
      expect(!of_solids.collides(outside, beside, k), "a link beside a solid");
      expect(of_solids.confirms(outside, beside, k, 0.05 - radius, kExpected),
             "the distance of a link beside a solid");
      expect(!of_solids.confirms(outside, beside, k, 0.05 - radius + 2 * kExpected, kExpected) &&
                 !of_solids.confirms(outside, beside, k, 0.05 - radius - 2 * kExpected, kExpected),
             "that a link beside a solid is no further from it and no nearer to it");
      expect(of_solids.collides({-0.05, 0, 0}, {0.05, 0.01, 0}, k), "a link inside a solid");
    }
    const std::vector<Vector3d> triangle = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    const FclCheck of_triangle({}, radius, {convex_hull(triangle)});
    expect(of_triangle.collides({0, 0, -1}, {0.1, 0, 1}, 0), "a link through a triangle");
    expect(!of_triangle.collides({0, 0, 0.021}, {0.4, 0, 0.4}, 0), "a link beside a triangle");
  }
}

}  // namespace bqsa::harness
