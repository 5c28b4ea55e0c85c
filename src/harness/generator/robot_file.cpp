#include "harness/generator/robot_file.hpp"

#include "harness/scenario/units.hpp"
#include "harness/scenario/yaml_value.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {

RobotFile load_robot(const std::filesystem::path& file) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 16;
  const YamlValue top = YamlValue::parse(file.string(), read_text_file(file, kMaxBytes));
  top.get("schema", "bqsa-robot/1").choice({"bqsa-robot/1"});
  top.expect_keys({"schema", "name", "description", "source", "units", "robot"});
  const Units units = Units::read(top.get("units", "a mapping of length, angle"));
  return {.name = top.get("name", "the robot's name").name(),
          .description = top.get("description", "one line").text(),
          .source = top.get("source", "the publication of the figures").text(),
          .robot = read_robot(top.get("robot", "a mapping with a kind"), units)};
}

}  // namespace bqsa::harness
