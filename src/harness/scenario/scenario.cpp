#include "harness/scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/scenario/envelope_reader.hpp"
#include "harness/scenario/obstacle_reader.hpp"
#include "harness/scenario/path_reader.hpp"
#include "harness/scenario/problem_checks.hpp"
#include "harness/scenario/robot_reader.hpp"
#include "harness/scenario/self_collision_reader.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/waypoint_file.hpp"
#include "harness/scenario/yaml_value.hpp"
#include "harness/sha256.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

/// A thousand obstacles take a tenth of it.
constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

constexpr double kDefaultTolerance = 1e-3;  // [m]
constexpr double kLeastTolerance = 1e-9;    // [m]
constexpr double kDefaultAngleOff = 1e-2;   // [rad]
constexpr double kLeastAngleOff = 1e-9;     // [rad]

JointVector read_start(const YamlValue& value, const Units& units, const SerialChain& chain) {
  const int joints = chain.joints();
  const std::string expected =
      fmt::format("a list of {} {}, one a joint", joints,
                  chain.has_prismatic_joints() ? "angles and lengths" : "angles");
  JointVector start(joints);
  int j = 0;
  for (const YamlValue& element : value.list(expected, static_cast<std::size_t>(joints))) {
    start(j) = chain.is_prismatic(j) ? units.length(element) : units.angle(element);
    ++j;
  }
  return start;
}

/// x_d(t), holding the ends of the path before 0 and after the duration.
std::function<Eigen::Vector3d(double)> timed(const Task& task) {
  return [task](double t) -> Eigen::Vector3d {
    return point_at(task.path, progress(task.profile, std::clamp(t / task.duration, 0.0, 1.0)));
  };
}

/// R_WT(t), the same of the orientation; none if the task has none.
std::function<Eigen::Matrix3d(double)> turned(const Task& task) {
  if (task.turning.kind == TaskKind::kPosition) return {};
  return [turning = task.turning, profile = task.profile, duration = task.duration](double t) {
    return turning.at(progress(profile, std::clamp(t / duration, 0.0, 1.0)));
  };
}

/// One of the angles that only a task with an orientation has [rad].
double read_angle_off(const YamlValue& top, const std::string& key, const Units& units,
                      const Task& task) {
  const std::optional<YamlValue> value = top.find(key);
  if (!value) return kDefaultAngleOff;
  if (task.turning.kind == TaskKind::kPosition) {
    value->fail("no such key, since the task has no orientation", "one");
  }
  const double angle = units.angle(*value);
  if (!(angle >= kLeastAngleOff && angle <= std::numbers::pi)) {
    value->fail(fmt::format("an angle from {} to {}", units.show_angle(kLeastAngleOff),
                            units.show_angle(std::numbers::pi)));
  }
  return angle;
}

}  // namespace

Scenario load_scenario(const std::filesystem::path& file, const LoadOptions& options) {
  const std::string text = read_text_file(file, kMaxBytes);
  const YamlValue top = YamlValue::parse(file.string(), text);
  top.get("schema", "bqsa-scenario/1").choice({"bqsa-scenario/1"});
  top.expect_keys({"schema", "name", "description", "units", "robot", "start", "start_tolerance",
                   "start_orientation_tolerance", "task", "obstacles", "envelope", "margin",
                   "tolerance", "orientation_tolerance", "reference_clearance", "self_collision"});

  const std::string name = top.get("name", "the scenario's name").name();
  const std::optional<YamlValue> description = top.find("description");
  const std::string described = description ? description->text() : "";
  const Units units = Units::read(top.get("units", "a mapping of length, angle"));
  const auto length_or = [&top, &units](const std::string& key, double absent) {
    const std::optional<YamlValue> value = top.find(key);
    return value ? units.non_negative_length(*value) : absent;
  };

  const double tolerance = length_or("tolerance", kDefaultTolerance);
  if (!(tolerance > 0)) top.get("tolerance", "a length").fail("a positive length");
  if (tolerance < kLeastTolerance) {
    top.get("tolerance", "a length").fail("a length of at least " + units.show(kLeastTolerance));
  }

  NamedFiles files(file.parent_path(), options.allow_outside);
  Robot robot = read_robot(top.get("robot", "a mapping with a kind"), units, files);
  const int dimension = robot.chain.dimension();
  const YamlValue start_value = top.get("start", "a list of joint angles");
  const JointVector start = read_start(start_value, units, robot.chain);
  const YamlValue task_value = top.get("task", "a mapping of path, timing");
  const Task task = read_task(task_value, units, dimension, files);
  const CoverSettings envelope = read_envelope(top.find("envelope"), units, default_envelope());
  ScenarioObstacles obstacles =
      read_obstacles(top.find("obstacles"), units, dimension, task, envelope, files);

  Problem problem{
      .name = name,
      .chain = std::move(robot.chain),
      .obstacles = std::move(obstacles.told),
      .desired_tip = timed(task),
      .desired_rotation = turned(task),
      .task_kind = task.turning.kind,
      .ticks = task.ticks,
      .dt = task.duration / task.ticks,
      .start = start,
      .limits = robot.limits,
      .link_radius = robot.link_radius,
      .link_radii = robot.link_radii,
      .margin = length_or("margin", 0),
      .tolerance = tolerance,
      .orientation_tolerance = read_angle_off(top, "orientation_tolerance", units, task)};
  check_start(start_value, problem, obstacles.truth, units);
  const std::optional<YamlValue> self = top.find("self_collision");
  std::optional<SelfCollision> self_collision =
      self ? read_self_collision(*self, problem, units) : std::nullopt;
  check_path(task_value.get("path", "a path"), problem, obstacles.truth, task,
             length_or("start_tolerance", kDefaultTolerance), units);
  const double angle_off = read_angle_off(top, "start_orientation_tolerance", units, task);
  if (problem.has_orientation()) {
    check_start_orientation(task_value.get("orientation", "an orientation"), problem, angle_off,
                            units);
  }
  const std::optional<YamlValue> reference = top.find("reference_clearance");
  GeometryLedger geometry = geometry_ledger(problem, std::move(obstacles.ledger));
  return {.file = file,
          .description = described,
          .sha256 = sha256_of(text + files.bytes()),
          .problem = std::move(problem),
          .truth = std::move(obstacles.truth),
          .self_collision = std::move(self_collision),
          .geometry = std::move(geometry),
          .robot_name = std::move(robot.name),
          .reference_clearance =
              reference ? std::optional(units.non_negative_length(*reference)) : std::nullopt};
}

}  // namespace bqsa::harness
