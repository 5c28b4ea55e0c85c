#include "harness/scenario/urdf_capsules.hpp"

#include <fmt/format.h>
#include <urdf_model/link.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "harness/scenario/units.hpp"
#include "harness/scenario/urdf_model.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// The convex hull of the points, and all within the radius of it.
struct Shape {
  std::vector<Vector3d> points;
  double radius = 0;  // [m]
};

/// What rests in one frame of the chain, and in its coordinates.
using Body = std::vector<Shape>;

void check_size(const urdf::Link& link, std::initializer_list<double> lengths) {
  for (const double length : lengths) {
    if (std::isfinite(length) && length > 0) continue;
    throw InputError(
        fmt::format("link '{}': expected collision geometry of positive size, got a length of {}",
                    excerpt(link.name), length));
  }
}

std::vector<Vector3d> corners_of_box(const Vector3d& lengths) {
  std::vector<Vector3d> corners;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {-0.5, 0.5}) corners.push_back(lengths.cwiseProduct(Vector3d(x, y, z)));
    }
  }
  return corners;
}

/// Of a prism around a cylinder along z.
std::vector<Vector3d> corners_around_cylinder(double radius, double length) {
  constexpr int kSides = 720;
  const double outer = radius / std::cos(std::numbers::pi / kSides);
  std::vector<Vector3d> corners;
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    for (const double z : {-length / 2, length / 2}) {
      corners.emplace_back(outer * std::cos(angle), outer * std::sin(angle), z);
    }
  }
  return corners;
}

/// A piece of collision geometry in its own frame.
Shape shape_of(const urdf::Link& link, const urdf::Geometry& geometry, const MeshPoints& mesh) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE: {
      const auto& sphere = dynamic_cast<const urdf::Sphere&>(geometry);
      check_size(link, {sphere.radius});
      return {{Vector3d::Zero()}, sphere.radius};
    }
    case urdf::Geometry::BOX: {
      const auto& box = dynamic_cast<const urdf::Box&>(geometry);
      check_size(link, {box.dim.x, box.dim.y, box.dim.z});
      return {corners_of_box({box.dim.x, box.dim.y, box.dim.z})};
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = dynamic_cast<const urdf::Cylinder&>(geometry);
      check_size(link, {cylinder.radius, cylinder.length});
      return {corners_around_cylinder(cylinder.radius, cylinder.length)};
    }
    case urdf::Geometry::MESH:
      break;
  }
  const auto& file = dynamic_cast<const urdf::Mesh&>(geometry);
  check_size(link, {std::abs(file.scale.x), std::abs(file.scale.y), std::abs(file.scale.z)});
  Shape shape{mesh(file.filename)};
  const Vector3d scale(file.scale.x, file.scale.y, file.scale.z);
  for (Vector3d& point : shape.points) point = point.cwiseProduct(scale).eval();
  return shape;
}

/// The geometry of a link and of all that hang from it by fixed joints.
/// @param X_FL  the link in the frame F of the chain
Body body_of(const UrdfModel& model, const std::string& name, const JointPlacement& X_FL,
             const MeshPoints& mesh) {
  Body body;
  std::set<std::string> seen;
  std::vector<std::pair<std::string, JointPlacement>> open{{name, X_FL}};
  while (!open.empty()) {
    const auto [link_name, X] = open.back();
    open.pop_back();
    if (!seen.insert(link_name).second) continue;  // a circle of links
    const urdf::Link& link = model.link(link_name);
    for (const urdf::CollisionSharedPtr& collision : link.collision_array) {
      if (!collision->geometry) {
        throw InputError(
            fmt::format("link '{}': expected collision geometry, got none", excerpt(link.name)));
      }
      Shape shape = shape_of(link, *collision->geometry, mesh);
      const JointPlacement X_FS = composed(X, placement(collision->origin));
      for (Vector3d& point : shape.points) {
        point = (X_FS.p_PJ + X_FS.R_PJ * point).eval();
        if (point.cwiseAbs().maxCoeff() + shape.radius <= kMaxLength) continue;
        throw InputError(fmt::format(
            "link '{}': expected collision geometry within {} m of the joint before it, got some "
            "beyond",
            excerpt(link.name), kMaxLength));
      }
      body.push_back(std::move(shape));
    }
    for (const urdf::JointSharedPtr& joint : link.child_joints) {
      if (joint->type != urdf::Joint::FIXED) continue;
      open.emplace_back(joint->child_link_name,
                        composed(X, placement(joint->parent_to_joint_origin_transform)));
    }
  }
  return body;
}

/// One for each frame of the chain: that of the base link, then those after each joint.
std::vector<Body> bodies(const UrdfModel& model, const std::string& base, const std::string& tip,
                         const MeshPoints& mesh) {
  std::vector<Body> bodies{body_of(model, base, {}, mesh)};
  for (const urdf::JointSharedPtr& joint : model.joints_between(base, tip)) {
    if (joint->type == urdf::Joint::FIXED) continue;
    const JointPlacement X_FL{.R_PJ = along_axis(*joint).transpose()};
    bodies.push_back(body_of(model, joint->child_link_name, X_FL, mesh));
  }
  return bodies;
}

/// Largest distance of a body from the segment from the origin to `end`.
double furthest(const Body& body, const Vector3d& end) {
  double furthest = 0;
  const double squared_length = end.squaredNorm();
  for (const Shape& shape : body) {
    for (const Vector3d& p : shape.points) {
      const double s = squared_length > 0 ? std::clamp(p.dot(end) / squared_length, 0.0, 1.0) : 0;
      furthest = std::max(furthest, (p - s * end).norm() + shape.radius);
    }
  }
  return furthest;
}

/// Where a link ends, seen from the frame in which it starts and rests: one place, or if a prismatic
/// joint moves it, those at both ends of the joint's range.
std::vector<Vector3d> ends_of(const Link& link, const ChainDescription& chain,
                              const JointLimits& limits) {
  const int joint = link.number - 1;
  if (joint == chain.joints()) return {chain.p_LT};
  const JointPlacement& placement = chain.placements[static_cast<std::size_t>(joint)];
  if (!chain.is_prismatic(joint)) return {placement.p_PJ};
  const Vector3d along = placement.R_PJ.col(2);
  return {placement.p_PJ + limits.lower(joint) * along,
          placement.p_PJ + limits.upper(joint) * along};
}

/// The segment from the origin that a neighbouring link, which starts or ends there, is seen as from
/// a frame without a link of its own, however the joint between them turns: the link itself if it lies
/// on that joint's axis, else nothing but the shared point.
Vector3d seen_from(int frame, const Link& link, const ChainDescription& chain) {
  constexpr double kParallel = 1e-9;  // sine
  const bool before = link.start < frame;
  const int joint = before ? frame - 1 : frame;
  const bool adjacent = before ? link.start == frame - 1 : link.start == frame + 1;
  if (!adjacent || joint >= chain.joints() || chain.is_prismatic(joint)) return Vector3d::Zero();
  const JointPlacement& placement = chain.placements[static_cast<std::size_t>(joint)];
  const Vector3d axis = placement.R_PJ.col(2);  // in the frame before the joint
  if (before) {
    // From the joint's frame the link leads back along its own axis, z.
    const Vector3d& way = placement.p_PJ;
    if (axis.cross(way).norm() > kParallel * way.norm()) return Vector3d::Zero();
    return -axis.dot(way) * Vector3d::UnitZ();
  }
  const int last = link.number - 1;
  if (last < chain.joints() && chain.is_prismatic(last)) return Vector3d::Zero();
  const Vector3d way =
      last == chain.joints() ? chain.p_LT : chain.placements[static_cast<std::size_t>(last)].p_PJ;
  if (Vector3d::UnitZ().cross(way).norm() > kParallel * way.norm()) return Vector3d::Zero();
  return way.z() * axis;
}

}  // namespace

std::vector<double> least_link_radii(const std::string& urdf, const std::string& base,
                                     const std::string& tip, const ChainDescription& chain,
                                     const JointLimits& limits, const MeshPoints& mesh) {
  const std::vector<Body> all = bodies(UrdfModel(urdf), base, tip, mesh);
  if (std::ranges::all_of(all, [](const Body& body) { return body.empty(); })) {
    throw InputError(
        fmt::format("expected collision geometry of the links from '{}' to '{}', got none",
                    excerpt(base), excerpt(tip)));
  }
  const SerialChain arm(chain);
  const std::span<const Link> links = arm.links();
  if (links.empty()) return {};
  std::vector<double> radii(links.size(), 0);
  std::vector<int> without_link;  // frames
  for (int frame = 0; frame < static_cast<int>(all.size()); ++frame) {
    const Body& body = all[static_cast<std::size_t>(frame)];
    const auto own = std::ranges::find(links, frame, &Link::start);
    if (own == links.end()) {
      if (!body.empty()) without_link.push_back(frame);
      continue;
    }
    double& radius = radii[static_cast<std::size_t>(own - links.begin())];
    for (const Vector3d& end : ends_of(*own, chain, limits)) {
      radius = std::max(radius, furthest(body, end));
    }
  }
  for (const int frame : without_link) {
    const Body& body = all[static_cast<std::size_t>(frame)];
    const auto after = std::ranges::upper_bound(links, frame, {}, &Link::start) - links.begin();
    // The neighbours both end in the frame's origin; the one that has to grow least takes the body.
    const auto first = std::max<std::ptrdiff_t>(after - 1, 0);
    auto taker = static_cast<std::size_t>(first);
    double taken = radii[taker];
    double least = std::numeric_limits<double>::infinity();
    for (auto k = first; k < std::min(after + 1, std::ssize(links)); ++k) {
      const auto link = static_cast<std::size_t>(k);
      const double needed =
          std::max(radii[link], furthest(body, seen_from(frame, links[link], chain)));
      if (needed - radii[link] >= least) continue;
      least = needed - radii[link];
      taker = link;
      taken = needed;
    }
    radii[taker] = taken;
  }
  for (double& radius : radii) {
    if (radius > 0) radius = std::max(radius, kMinLength);
  }
  return radii;
}

}  // namespace bqsa::harness
