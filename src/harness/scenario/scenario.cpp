#include "harness/scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/scenario/obstacle_reader.hpp"
#include "harness/scenario/path_reader.hpp"
#include "harness/scenario/problem_checks.hpp"
#include "harness/scenario/robot_reader.hpp"
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

JointVector read_start(const YamlValue& value, const Units& units, int joints) {
  const std::string expected = fmt::format("a list of {} angles, one a joint", joints);
  JointVector start(joints);
  int j = 0;
  for (const YamlValue& element : value.list(expected, static_cast<std::size_t>(joints))) {
    start(j++) = units.angle(element);
  }
  return start;
}

/// x_d(t), holding the ends of the path before 0 and after the duration.
std::function<Eigen::Vector3d(double)> timed(const Task& task) {
  return [task](double t) -> Eigen::Vector3d {
    return point_at(task.path, progress(task.profile, std::clamp(t / task.duration, 0.0, 1.0)));
  };
}

}  // namespace

Scenario load_scenario(const std::filesystem::path& file, const LoadOptions& options) {
  const std::string text = read_text_file(file, kMaxBytes);
  const YamlValue top = YamlValue::parse(file.string(), text);
  top.get("schema", "bqsa-scenario/1").choice({"bqsa-scenario/1"});
  top.expect_keys({"schema", "name", "description", "units", "robot", "start", "start_tolerance",
                   "task", "obstacles", "margin", "tolerance"});

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

  Robot robot = read_robot(top.get("robot", "a mapping with a kind"), units);
  const int dimension = robot.chain.dimension();
  const YamlValue start_value = top.get("start", "a list of joint angles");
  const JointVector start = read_start(start_value, units, robot.chain.joints());
  const YamlValue task_value = top.get("task", "a mapping of path, timing");
  NamedFiles files(file.parent_path(), options.allow_outside);
  const Task task = read_task(task_value, units, dimension, files);
  const std::optional<YamlValue> obstacles = top.find("obstacles");

  Problem problem{.name = name,
                  .chain = std::move(robot.chain),
                  .obstacles = obstacles ? read_obstacles(*obstacles, units, dimension, task, files)
                                         : std::vector<Obstacle>(),
                  .desired_tip = timed(task),
                  .ticks = task.ticks,
                  .dt = task.duration / task.ticks,
                  .start = start,
                  .limits = robot.limits,
                  .link_radius = robot.link_radius,
                  .margin = length_or("margin", 0),
                  .tolerance = tolerance};
  check_start(start_value, problem, units);
  check_path(task_value.get("path", "a path"), problem, task,
             length_or("start_tolerance", kDefaultTolerance), units);
  return {file, described, sha256_of(text + files.bytes()), std::move(problem)};
}

}  // namespace bqsa::harness
