#include "harness/generator/robot_file.hpp"

#include <yaml-cpp/yaml.h>

#include <initializer_list>

#include "harness/scenario/units.hpp"
#include "harness/scenario/yaml_value.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

/// Some keys of a mapping with their values, numbers as they are written.
std::string keys_of(const std::string& text, std::initializer_list<const char*> keys) {
  const YAML::Node top = YAML::Load(text);
  YAML::Node some;
  for (const char* key : keys) some[key] = top[key];
  return YAML::Dump(some) + "\n";
}

}  // namespace

RobotFile load_robot(const std::filesystem::path& file) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 16;
  const std::string text = read_text_file(file, kMaxBytes);
  const YamlValue top = YamlValue::parse(file.string(), text);
  top.get("schema", "bqsa-robot/1").choice({"bqsa-robot/1"});
  top.expect_keys({"schema", "name", "description", "source", "units", "robot"});
  const Units units = Units::read(top.get("units", "a mapping of length, angle"));
  NamedFiles files(file.parent_path());
  RobotFile robot{.name = top.get("name", "the robot's name").name(),
                  .description = top.get("description", "one line").text(),
                  .source = top.get("source", "the publication of the figures").text(),
                  .robot = read_robot(top.get("robot", "a mapping with a kind"), units, files),
                  .units = units,
                  .yaml = keys_of(text, {"units", "robot"}),
                  .named = files.names()};
  return robot;
}

}  // namespace bqsa::harness
