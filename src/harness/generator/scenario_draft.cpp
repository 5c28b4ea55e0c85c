#include "harness/generator/scenario_draft.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "bqsa/envelope/least_ellipsoid_around.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

Path to_path(const LineDraft& line) { return constant_speed({line.from, line.to}); }

Path to_path(const CircleDraft& circle) {
  const Vector3d u = circle.axis_u.normalized();
  const Vector3d v = circle.axis_v.normalized();
  return Arc{.center = circle.center,
             .u = circle.radius * u,
             .v = circle.radius * (v - u.dot(v) * u).normalized(),
             .from = 0,
             .to = circle.turn};
}

/// Numbers as a list in brackets, each with as many digits as bring it back.
template <typename Numbers>
std::string list(const Numbers& numbers) {
  return fmt::format("[{}]", fmt::join(numbers.begin(), numbers.end(), ", "));
}

std::string point(const Vector3d& p, int dimension) { return list(p.head(dimension)); }

std::string to_yaml(const LineDraft& line, int dimension) {
  return fmt::format("{{kind: line, start_point: {}, end_point: {}}}", point(line.from, dimension),
                     point(line.to, dimension));
}

std::string to_yaml(const CircleDraft& circle, int dimension) {
  return fmt::format(
      "{{kind: circle, center: {}, radius: {}, axis_u: {}, axis_v: {}, from: 0, to: {}}}",
      point(circle.center, dimension), circle.radius, point(circle.axis_u, dimension),
      point(circle.axis_v, dimension), circle.turn);
}

std::string to_yaml(const MotionDraft& motion, int dimension) {
  return fmt::format(", motion: {{kind: linear, velocity: {}, angular_velocity: {}}}",
                     point(motion.velocity, dimension),
                     dimension == 2 ? fmt::format("{}", motion.angular_velocity.z())
                                    : list(motion.angular_velocity));
}

/// The keys of a spatial shape other than an ellipsoid.
std::string shape_keys(const ObstacleDraft& obstacle) {
  const Vector3d& half = obstacle.semi_axes;
  switch (obstacle.kind) {
    case ShapeKind::kEllipsoid:
      break;
    case ShapeKind::kSphere:
      return fmt::format("kind: sphere, center: {}, radius: {}", list(obstacle.center), half.x());
    case ShapeKind::kBox:
      return fmt::format("kind: box, center: {}, size: {}", list(obstacle.center),
                         list(rounded(Vector3d(2 * half))));
    case ShapeKind::kCylinder:
      return fmt::format("kind: cylinder, center: {}, radius: {}, length: {}",
                         list(obstacle.center), half.x(), rounded(2 * half.z()));
    case ShapeKind::kCapsule:
      return fmt::format("kind: capsule, center: {}, radius: {}, length: {}", list(obstacle.center),
                         half.x(), rounded(2 * (half.z() - half.x())));
  }
  return fmt::format("kind: ellipsoid, center: {}, semi_axes: {}", list(obstacle.center),
                     list(half));
}

std::string to_yaml(const ObstacleDraft& obstacle, int dimension) {
  if (obstacle.kind != ShapeKind::kEllipsoid) {
    return fmt::format("  - {{name: {}, {}{}{}}}\n", obstacle.name, shape_keys(obstacle),
                       obstacle.kind == ShapeKind::kSphere
                           ? ""
                           : fmt::format(", quaternion: {}", list(obstacle.rotation)),
                       obstacle.motion ? to_yaml(*obstacle.motion, dimension) : "");
  }
  const std::string rotation = dimension == 2
                                   ? fmt::format("rotation: {}", obstacle.rotation(0))
                                   : fmt::format("quaternion: {}", list(obstacle.rotation));
  return fmt::format("  - {{name: {}, kind: {}, center: {}, semi_axes: {}, {}{}}}\n", obstacle.name,
                     dimension == 2 ? "ellipse" : "ellipsoid", point(obstacle.center, dimension),
                     point(obstacle.semi_axes, dimension), rotation,
                     obstacle.motion ? to_yaml(*obstacle.motion, dimension) : "");
}

/// The key `limits` of a planar robot; nothing if there are none.
std::string to_yaml(const JointLimits& limits) {
  std::string text;
  for (const auto& [key, numbers] :
       {std::pair("lower", &limits.lower), std::pair("upper", &limits.upper),
        std::pair("max_velocity", &limits.max_velocity)}) {
    if (numbers->size() == 0) continue;
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", key, list(*numbers));
  }
  return text.empty() ? "" : fmt::format(", limits: {{{}}}", text);
}

/// The mapping `robot`, its numbers with as many digits as bring them back.
std::string robot_yaml(const ScenarioDraft& draft) {
  const ChainDescription& robot = draft.robot;
  const JointLimits& limits = draft.limits;
  if (robot.dimension == 2) {
    std::vector<double> lengths;
    for (const DhRow& row : robot.rows) lengths.push_back(row.a);
    return fmt::format("robot: {{kind: planar, links: {}{}}}\n", list(lengths), to_yaml(limits));
  }
  std::string text = fmt::format("robot:\n  kind: {}\n",
                                 robot.convention == DhConvention::kModified ? "mdh" : "dh");
  if (!draft.robot_name.empty()) text += fmt::format("  name: {}\n", quoted_yaml(draft.robot_name));
  text += "  joints:\n";
  for (std::size_t j = 0; j < robot.rows.size(); ++j) {
    const DhRow& row = robot.rows[j];
    const auto i = static_cast<Eigen::Index>(j);
    text += fmt::format(
        "    - {{a: {}, alpha: {}, d: {}, offset: {}, lower: {}, upper: {}, max_velocity: {}}}\n",
        row.a, row.alpha, row.d, row.offset, limits.lower(i), limits.upper(i),
        limits.max_velocity(i));
  }
  text += fmt::format("  tool: {}\n", list(robot.p_LT));
  if (!draft.link_radii.empty()) text += fmt::format("  link_radius: {}\n", list(draft.link_radii));
  return text;
}

}  // namespace

double rounded(double number) {
  const std::string text = fmt::format("{:.6f}", number);
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value + 0.0;  // no -0
}

Ellipsoid shape_at(const ObstacleDraft& obstacle, int dimension, double t) {
  Vector3d center = obstacle.center;
  Vector3d turn = Vector3d::Zero();  // since t = 0, as a rotation vector
  if (obstacle.motion) {
    center += obstacle.motion->velocity * t;
    turn = obstacle.motion->angular_velocity * t;
  }
  if (dimension == 2) {
    return embedded(rotated_ellipse(center.head<2>(), obstacle.semi_axes.head<2>(),
                                    obstacle.rotation(0) + turn.z()));
  }
  const Eigen::Vector4d wxyz = obstacle.rotation / obstacle.rotation.norm();
  const Eigen::Matrix3d R =
      Eigen::Quaterniond(wxyz(0), wxyz(1), wxyz(2), wxyz(3)).toRotationMatrix();
  if (!(turn.norm() > 0)) return {center, obstacle.semi_axes, R};
  const Eigen::AngleAxisd turned(turn.norm(), turn.normalized());
  return {center, obstacle.semi_axes, turned.toRotationMatrix() * R};
}

Obstacle to_obstacle(const ObstacleDraft& draft, int dimension, int ticks, double dt) {
  Obstacle obstacle{draft.name, shape_at(draft, dimension, 0)};
  for (int tick = 0; draft.motion && tick <= ticks; ++tick) {
    obstacle.motion.push_back(shape_at(draft, dimension, tick * dt));
  }
  return obstacle;
}

Solid to_solid(const ObstacleDraft& draft) {
  const Eigen::Vector4d wxyz = draft.rotation / draft.rotation.norm();
  const Eigen::Matrix3d R =
      Eigen::Quaterniond(wxyz(0), wxyz(1), wxyz(2), wxyz(3)).toRotationMatrix();
  const Vector3d& half = draft.semi_axes;
  if (draft.kind == ShapeKind::kBox) {
    return Box{.center = draft.center, .half_lengths = half, .rotation = R};
  }
  const bool capsule = draft.kind == ShapeKind::kCapsule;
  const Vector3d axis = (capsule ? half.z() - half.x() : half.z()) * R.col(2);
  const Vector3d a = draft.center - axis;
  const Vector3d b = draft.center + axis;
  if (capsule) return Capsule{.a = a, .b = b, .radius = half.x()};
  return Cylinder{.a = a, .b = b, .radius = half.x()};
}

Problem to_problem(const ScenarioDraft& draft) {
  const Path path = std::visit([](const auto& any) -> Path { return to_path(any); }, draft.path);
  Problem problem{.name = draft.name,
                  .chain = SerialChain(draft.robot),
                  .desired_tip = [path, duration = draft.duration](double t) -> Vector3d {
                    const double x = std::clamp(t / duration, 0.0, 1.0);
                    return point_at(path, progress(Profile::kQuintic, x));
                  },
                  .ticks = draft.ticks,
                  .dt = draft.duration / draft.ticks,
                  .start = draft.start,
                  .limits = draft.limits};
  problem.link_radii = draft.link_radii;
  for (const double radius : draft.link_radii) {
    problem.link_radius = std::max(problem.link_radius, radius);
  }
  for (const ObstacleDraft& obstacle : draft.obstacles) {
    if (is_solid(obstacle.kind)) {
      problem.obstacles.push_back({obstacle.name, least_ellipsoid_around(to_solid(obstacle))});
    } else {
      problem.obstacles.push_back(
          to_obstacle(obstacle, problem.dimension(), problem.ticks, problem.dt));
    }
  }
  return problem;
}

std::vector<TrueObstacle> to_truth(const ScenarioDraft& draft) {
  std::vector<TrueObstacle> truth;
  for (const ObstacleDraft& obstacle : draft.obstacles) {
    TrueObstacle real{.name = obstacle.name, .first = static_cast<int>(truth.size())};
    if (is_solid(obstacle.kind)) real.parts = {to_solid(obstacle)};
    truth.push_back(real);
  }
  return truth;
}

std::string to_yaml(const ScenarioDraft& draft) {
  const int dimension = draft.robot.dimension;
  std::string text = fmt::format(
      "schema: bqsa-scenario/1\nname: {}\ndescription: {}\nunits: {{length: m, angle: rad}}\n",
      draft.name, draft.description);
  text += robot_yaml(draft);
  text += fmt::format(
      "start: {}\ntask:\n  path: {}\n  timing: {{duration: {}, ticks: {}, profile: quintic}}\n",
      list(draft.start),
      std::visit([dimension](const auto& any) { return to_yaml(any, dimension); }, draft.path),
      draft.duration, draft.ticks);
  if (draft.reference_clearance) {
    text += fmt::format("reference_clearance: {}\n", *draft.reference_clearance);
  }
  text += "obstacles:\n";
  for (const ObstacleDraft& obstacle : draft.obstacles) text += to_yaml(obstacle, dimension);
  return text;
}

}  // namespace bqsa::harness
