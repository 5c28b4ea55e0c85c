#include "harness/problem_sets/problem_set.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <utility>

#include "harness/scenario/units.hpp"
#include "harness/scenario/yaml_value.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
constexpr double kAgreement = 1e-3;  // of two ways to write one rotation

double positive(const YamlValue& value) {
  const double number = value.number();
  if (!(number > 0)) value.fail("a positive length");
  return number;
}

template <int Size>
Eigen::Matrix<double, Size, 1> numbers(const YamlValue& value) {
  Eigen::Matrix<double, Size, 1> result;
  int i = 0;
  for (const YamlValue& element :
       value.list(fmt::format("a list of {} numbers", Size), static_cast<std::size_t>(Size))) {
    result(i++) = element.number();
  }
  return result;
}

Vector3d positive_numbers(const YamlValue& value) {
  Vector3d result = numbers<3>(value);
  if (!(result.minCoeff() > 0)) value.fail("three positive lengths");
  return result;
}

Vector4d unit_quaternion(const YamlValue& value, const Vector4d& wxyz) {
  const double length = wxyz.norm();
  if (!(std::abs(length - 1) <= kUnitTolerance)) {
    value.fail("a quaternion of length 1", fmt::format("one of length {:g}", length));
  }
  return wxyz / length;
}

JointVector joint_values(const YamlValue& value) {
  const std::vector<YamlValue> list = value.list("a list of joint values");
  if (list.empty() || list.size() > static_cast<std::size_t>(kMaxJoints)) {
    value.fail(fmt::format("1 to {} joint values", kMaxJoints));
  }
  JointVector q(static_cast<Eigen::Index>(list.size()));
  for (std::size_t j = 0; j < list.size(); ++j) q(static_cast<Eigen::Index>(j)) = list[j].number();
  return q;
}

std::vector<JointVector> goals_of(const YamlValue& value, const JointVector& start) {
  std::vector<JointVector> goals;
  for (const YamlValue& goal : value.list("a list of configurations")) {
    // Robometrics has lists of lists of configurations, most of one.
    const std::vector<YamlValue> inner = goal.list("a configuration");
    const bool nested = !inner.empty() && inner.front().is_list();
    for (const YamlValue& configuration : nested ? inner : std::vector<YamlValue>{goal}) {
      goals.push_back(joint_values(configuration));
      if (goals.back().size() != start.size()) {
        configuration.fail(fmt::format("{} joint values, as in start", start.size()));
      }
    }
  }
  if (goals.empty()) value.fail("at least one configuration");
  return goals;
}

// VAMP.

/// A quaternion (x, y, z, w), or angles about the fixed axes x, y, z; if both are there they agree.
Vector4d vamp_rotation(const YamlValue& obstacle) {
  const std::optional<YamlValue> xyzw = obstacle.find("orientation_quat_xyzw");
  const std::optional<YamlValue> xyz = obstacle.find("orientation_euler_xyz");
  if (!xyzw && !xyz) return {1, 0, 0, 0};
  Eigen::Quaterniond from_angles;
  if (xyz) {
    const Vector3d angles = numbers<3>(*xyz);
    from_angles = Eigen::Quaterniond(rotation_of_rpy(angles(0), angles(1), angles(2)));
    if (!xyzw) return {from_angles.w(), from_angles.x(), from_angles.y(), from_angles.z()};
  }
  const Vector4d q = numbers<4>(*xyzw);
  Vector4d wxyz = unit_quaternion(*xyzw, {q(3), q(0), q(1), q(2)});
  const Eigen::Quaterniond given(wxyz(0), wxyz(1), wxyz(2), wxyz(3));
  if (xyz && given.angularDistance(from_angles) > kAgreement) {
    xyzw->fail("the rotation of orientation_euler_xyz",
               fmt::format("one that is {:.3g} rad from it", given.angularDistance(from_angles)));
  }
  return wxyz;
}

SetObstacle vamp_obstacle(const YamlValue& value, SetObstacle::Kind kind, std::size_t number) {
  const std::optional<YamlValue> name = value.find("name");
  SetObstacle obstacle{.name = name ? name->text() : fmt::format("obstacle_{}", number),
                       .kind = kind,
                       .center = numbers<3>(value.get("position", "three coordinates"))};
  if (kind != SetObstacle::Kind::kSphere) obstacle.rotation = vamp_rotation(value);
  if (kind == SetObstacle::Kind::kBox) {
    obstacle.size = 2 * positive_numbers(value.get("half_extents", "three positive lengths"));
  } else {
    obstacle.radius = positive(value.get("radius", "a positive length"));
  }
  if (kind == SetObstacle::Kind::kCylinder) {
    obstacle.length = positive(value.get("length", "a positive length"));
  }
  return obstacle;
}

PlanningProblem vamp_problem(const YamlValue& value, const std::string& group, int place) {
  PlanningProblem problem{.group = group, .index = place};
  if (const std::optional<YamlValue> index = value.find("index")) {
    problem.index = index->whole_number(0, 1'000'000'000);
  }
  for (const auto& [key, member] : value.members()) {
    if (key == "capsule" || key == "heightfield" || key == "pointcloud" || key == "mesh") {
      if (!member.list("a list of obstacles").empty()) {
        member.fail("obstacles of box, cylinder and sphere alone");
      }
    }
  }
  for (const auto& [key, kind] : {std::pair("box", SetObstacle::Kind::kBox),
                                  std::pair("cylinder", SetObstacle::Kind::kCylinder),
                                  std::pair("sphere", SetObstacle::Kind::kSphere)}) {
    const std::optional<YamlValue> list = value.find(key);
    if (!list) continue;
    for (const YamlValue& obstacle : list->list("a list of obstacles")) {
      problem.obstacles.push_back(vamp_obstacle(obstacle, kind, problem.obstacles.size() + 1));
    }
  }
  problem.start = joint_values(value.get("start", "a list of joint values"));
  problem.goals = goals_of(value.get("goals", "a list of configurations"), problem.start);
  return problem;
}

// Robometrics.

SetObstacle robometrics_obstacle(const std::string& name, const YamlValue& value,
                                 SetObstacle::Kind kind) {
  SetObstacle obstacle{.name = name, .kind = kind};
  const std::optional<YamlValue> position = value.find("position");
  if (kind == SetObstacle::Kind::kSphere && position) {
    obstacle.center = numbers<3>(*position);
  } else {
    const YamlValue pose = value.get("pose", "a list of x, y, z, qw, qx, qy, qz");
    const Eigen::Matrix<double, 7, 1> given = numbers<7>(pose);
    obstacle.center = given.head<3>();
    obstacle.rotation = unit_quaternion(pose, given.tail<4>());
  }
  if (kind == SetObstacle::Kind::kBox) {
    obstacle.size = positive_numbers(value.get("dims", "three positive lengths"));
  } else {
    obstacle.radius = positive(value.get("radius", "a positive length"));
  }
  if (kind == SetObstacle::Kind::kCylinder) {
    obstacle.length = positive(value.get("height", "a positive length"));
  }
  return obstacle;
}

PlanningProblem robometrics_problem(const YamlValue& value, const std::string& group, int place) {
  PlanningProblem problem{.group = group, .index = place};
  const YamlValue obstacles = value.get("obstacles", "a mapping of cuboid, cylinder, sphere");
  for (const auto& [kind, members] : obstacles.members({"cuboid", "cylinder", "sphere"})) {
    const SetObstacle::Kind meant = kind == "cuboid"     ? SetObstacle::Kind::kBox
                                    : kind == "cylinder" ? SetObstacle::Kind::kCylinder
                                                         : SetObstacle::Kind::kSphere;
    for (const auto& [name, obstacle] : members.members()) {
      problem.obstacles.push_back(robometrics_obstacle(name, obstacle, meant));
    }
  }
  problem.start = joint_values(value.get("start", "a list of joint values"));
  problem.goals = goals_of(value.get("goal_ik", "a list of configurations"), problem.start);
  return problem;
}

}  // namespace

std::vector<PlanningProblem> read_problem_set(const std::filesystem::path& file) {
  const YamlValue top = YamlValue::parse(file.string(), read_text_file(file, kMaxBytes));
  const bool vamp = top.has("problems");
  const YamlValue groups = vamp ? top.get("problems", "groups of problems") : top;
  std::vector<PlanningProblem> problems;
  for (const auto& [group, list] : groups.members()) {
    int place = 0;
    for (const YamlValue& problem : list.list("a list of problems")) {
      problems.push_back(vamp ? vamp_problem(problem, group, place)
                              : robometrics_problem(problem, group, place));
      ++place;
    }
  }
  if (problems.empty()) groups.fail("at least one problem");
  return problems;
}

}  // namespace bqsa::harness
