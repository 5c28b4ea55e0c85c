#include "harness/judge/fcl_links.hpp"

#include <fcl/geometry/shape/capsule.h>
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

struct Placed {
  fcl::Capsuled shape;
  fcl::Transform3d pose;
};

/// In FCL's units. A capsule's axis is z; it has no direction, and the turn from z is well conditioned
/// only for a direction in the upper half space.
Placed placed(const LinkCapsule& link) {
  const Vector3d along = kMillimetres * (link.end - link.start);
  const double length = along.norm();
  fcl::Transform3d X = fcl::Transform3d::Identity();
  if (length > 0) {
    const Vector3d axis = (along.z() < 0 ? -1 : 1) / length * along;
    X.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix();
  }
  X.translation() = kMillimetres * link.start + 0.5 * along;
  return {fcl::Capsuled(kMillimetres * link.radius, length), X};
}

void expect(bool answer, const char* question) {
  if (!answer) throw std::runtime_error(std::string("FCL failed its self-test: ") + question);
}

}  // namespace

bool fcl_links_collide(const LinkCapsule& a, const LinkCapsule& b) {
  const Placed first = placed(a), second = placed(b);
  fcl::CollisionRequestd request(1, false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  return fcl::collide(&first.shape, first.pose, &second.shape, second.pose, request, result) > 0;
}

double fcl_links_distance(const LinkCapsule& a, const LinkCapsule& b) {
  const Placed first = placed(a), second = placed(b);
  const fcl::DistanceRequestd request(false, false, 0, 0, kDistanceTolerance, fcl::GST_INDEP);
  fcl::DistanceResultd result;
  fcl::distance(&first.shape, first.pose, &second.shape, second.pose, request, result);
  return result.min_distance / kMillimetres;
}

void fcl_links_self_test() {
  constexpr double kExpected = 1e-6;  // [m], far above the error measured
  const LinkCapsule along_x{{-1, 0, 0}, {1, 0, 0}, 0.02};
  const LinkCapsule across{{0.3, -1, 0.06}, {0.3, 1, 0.06}, 0.03};
  const LinkCapsule beside{{-0.5, 0.06, 0}, {0.7, 0.06, 0}, 0.03};
  const LinkCapsule crossing{{0, -1, 0.04}, {0.2, 1, 0.04}, 0.03};
  const LinkCapsule within{{-0.1, 0, 0}, {0.1, 0, 0}, 0.01};
  expect(fcl_links_collide(along_x, crossing), "links that cross");
  expect(fcl_links_collide(along_x, within), "a link inside another");
  for (const LinkCapsule& other : {across, beside}) {
    expect(!fcl_links_collide(along_x, other), "links beside each other");
    expect(std::abs(fcl_links_distance(along_x, other) - 0.01) < kExpected,
           "the distance of links beside each other");
  }
}

}  // namespace bqsa::harness
