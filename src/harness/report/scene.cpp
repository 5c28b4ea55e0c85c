#include "harness/report/scene.hpp"

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "harness/judge/judge_kinematics.hpp"
#include "harness/report/bulk_data.hpp"
#include "harness/report/solid_mesh.hpp"

namespace bqsa::harness::report {
namespace {

constexpr std::size_t kPoseNumbers = 12;

/// The upper 3x4 of the pose, row by row.
std::vector<double> pose_of(const Ellipsoid& ellipsoid) {
  std::vector<double> pose;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      pose.push_back(ellipsoid.rotation()(row, column));
    }
    pose.push_back(ellipsoid.center()(row));
  }
  return pose;
}

std::string motion_text(const Obstacle& obstacle) {
  std::vector<float> numbers;
  for (const Ellipsoid& shape : obstacle.motion) {
    for (const double number : pose_of(shape)) numbers.push_back(static_cast<float>(number));
  }
  return bulk_text(numbers);
}

/// @param shape  index of the solid that it is around; null if it is an obstacle itself
Json obstacle_json(const Obstacle& obstacle, const Json& shape) {
  const Eigen::Vector3d& axes = obstacle.shape.semi_axes();
  return {{"name", obstacle.name},
          {"semi_axes_m", {axes.x(), axes.y(), axes.z()}},
          {"pose", pose_of(obstacle.shape)},
          {"motion", obstacle.moves() ? Json(motion_text(obstacle)) : Json()},
          {"shape", shape}};
}

Json solid_json(const TrueObstacle& obstacle) {
  std::vector<float> vertices;
  std::vector<std::uint16_t> triangles;
  for (const Solid& part : obstacle.parts) {
    const SolidMesh mesh = mesh_of(part);
    const auto first = static_cast<int>(vertices.size() / 3);
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      for (const double number : vertex) vertices.push_back(static_cast<float>(number));
    }
    for (const std::array<int, 3>& triangle : mesh.triangles) {
      for (const int corner : triangle) {
        triangles.push_back(static_cast<std::uint16_t>(first + corner));
      }
    }
  }
  return {{"name", obstacle.name},
          {"obstacle", obstacle.first},
          {"vertices", bulk_text(vertices)},
          {"triangles", bulk_text(triangles)}};
}

std::string path_text(const Problem& problem) {
  std::vector<float> numbers;
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    const Eigen::Vector3d point = problem.desired_tip(problem.time(tick));
    for (const double number : point) numbers.push_back(static_cast<float>(number));
  }
  return bulk_text(numbers);
}

std::string start_text(const JudgeKinematics& kinematics, const Problem& problem) {
  PointPositions positions;
  kinematics.place(problem.start, positions);
  std::vector<float> numbers;
  for (const Eigen::Vector3d& point : positions.points) {
    for (const double number : point) numbers.push_back(static_cast<float>(number));
  }
  return bulk_text(numbers);
}

Json limits_json(const JointVector& limits) {
  if (limits.size() == 0) return {};
  Json list = Json::array();
  for (const double limit : limits) list.push_back(number_or_null(limit));
  return list;
}

}  // namespace

Json scene_json(const Scenario& scenario) {
  const Problem& problem = scenario.problem;
  const JudgeKinematics kinematics(problem.chain.description());
  Json links = Json::array();
  for (std::size_t i = 0; i < kinematics.links().size(); ++i) {
    const LinkSegment& link = kinematics.links()[i];
    links.push_back({{"number", link.number},
                     {"start", link.start},
                     {"end", link.end},
                     {"radius_m", problem.radius_of(i)}});
  }
  Json obstacles = Json::array();
  Json solids = Json::array();
  for (const TrueObstacle& obstacle : scenario.truth) {
    const Json shape = obstacle.is_ellipsoid() ? Json() : Json(solids.size());
    for (int k = obstacle.first; k < obstacle.first + obstacle.count; ++k) {
      obstacles.push_back(obstacle_json(problem.obstacles[static_cast<std::size_t>(k)], shape));
    }
    if (!obstacle.is_ellipsoid()) solids.push_back(solid_json(obstacle));
  }
  Json steps = Json::array(), prismatic = Json::array();
  for (int joint = 0; joint < kinematics.joints(); ++joint) {
    steps.push_back(problem.max_step(joint));
    prismatic.push_back(kinematics.is_prismatic(joint));
  }
  return {{"points", kinematics.points()},
          {"links", std::move(links)},
          {"obstacles", std::move(obstacles)},
          {"solids", std::move(solids)},
          {"path", path_text(problem)},
          {"start_points", start_text(kinematics, problem)},
          {"prismatic", std::move(prismatic)},
          {"lower_rad", limits_json(problem.limits.lower)},
          {"upper_rad", limits_json(problem.limits.upper)},
          {"max_joint_step_rad", std::move(steps)}};
}

std::size_t scene_size(const Scenario& scenario) {
  const Problem& problem = scenario.problem;
  const auto instants = static_cast<std::size_t>(problem.ticks) + 1;
  constexpr std::size_t kObstacleText = 600;
  std::size_t size = bulk_size(instants * 3, sizeof(float));
  for (const Obstacle& obstacle : problem.obstacles) {
    size += kObstacleText + obstacle.name.size();
    if (obstacle.moves()) size += bulk_size(instants * kPoseNumbers, sizeof(float));
  }
  for (const TrueObstacle& obstacle : scenario.truth) {
    constexpr std::size_t kOfRound = 16384;  // the text of a capsule or cylinder, at most
    constexpr std::size_t kOfCorner = 32;    // with its two triangles
    for (const Solid& part : obstacle.parts) {
      const ConvexHull* hull = std::get_if<ConvexHull>(&part);
      size += hull != nullptr ? kOfCorner * hull->vertices.size() : kOfRound;
    }
  }
  return size;
}

}  // namespace bqsa::harness::report
