// Whatever the bytes, loading gives a scenario or an InputError.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "harness/scenario/scenario_files.hpp"

namespace bqsa::harness {
namespace {

std::string content_of(const std::string& name) {
  std::ifstream stream(BQSA_SOURCE_DIR "/scenarios/" + name, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Replaces, inserts, removes or repeats a few bytes, more often than not with ones that YAML
/// minds.
std::string mutated(std::string text, std::mt19937& random) {
  const std::string special = "[]{}:,-?&*!|>'\"%@`#~\n\t 0123456789.eE+_infaN\\\r\x80\xff";
  const int edits = std::uniform_int_distribution(1, 4)(random);
  for (int edit = 0; edit < edits; ++edit) {
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, text.size() - 1)(random);
    const std::size_t pick =
        std::uniform_int_distribution<std::size_t>(0, special.size() - 1)(random);
    const auto any = static_cast<char>(std::uniform_int_distribution(0, 255)(random));
    switch (std::uniform_int_distribution(0, 5)(random)) {
      case 0:
        text[at] = any;
        break;
      case 1:
        text[at] = special[pick];
        break;
      case 2:
        text.insert(at, 1, special[pick]);
        break;
      case 3:
        text.erase(at, pick);
        break;
      case 4:
        text.insert(at, text.substr(at / 2, pick));
        break;
      default:
        text[at] = static_cast<char>(text[at] ^ (1 << (pick % 8)));
        break;
    }
    if (text.empty()) text.assign(1, ' ');
  }
  return text;
}

constexpr const char* kWaypoints =
    "t,x,y,angle\n0,-0.9,0.05,10\n1,-0.8,0.05,40\n1.7,-0.8,0.25,-5\n";

constexpr const char* kMoving = R"(schema: bqsa-scenario/1
name: moving
units: {length: m, angle: deg}
robot: {kind: planar, links: [1, 1]}
start: [0, 90]
task:
  path: {kind: line, start_point: [1, 1], end_point: [0.5, 1]}
  timing: {duration: 2, ticks: 10}
obstacles:
  - name: a
    kind: ellipse
    center: [-0.9, 0.05]
    semi_axes: [0.3, 0.02]
    motion: {kind: waypoints, file: way.csv}
  - name: b
    kind: ellipse
    center: [0.7, 0.4]
    semi_axes: [0.1, 0.02]
    rotation: 20
    motion: {kind: linear, velocity: [0.1, 0.2], angular_velocity: -40}
)";

TEST(ScenarioFuzz, AMutatedFileGivesAScenarioOrAnInputError) {
  const TestDirectory directory;
  directory.write("way.csv", kWaypoints);
  const std::string originals[] = {content_of("planar_7r.yaml"),
                                   content_of("puma560_ellipsoid.yaml"),
                                   content_of("puma560_wall.yaml"), kMoving};
  std::mt19937 random(20160209);
  int loaded = 0;
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string text = mutated(originals[i % 4], random);
    try {
      const Scenario scenario = directory.load(text);
      ASSERT_TRUE(scenario.problem.desired_tip(0.3).allFinite()) << "case " << i << '\n' << text;
      ++loaded;
    } catch (const InputError&) {
      ++refused;
    } catch (...) {
      FAIL() << "another exception in case " << i << '\n' << text;
    }
  }
  RecordProperty("loaded", loaded);
  EXPECT_GT(loaded, 500);
  EXPECT_GT(refused, 10'000);
}

TEST(ScenarioFuzz, AMutatedWaypointFileGivesAScenarioOrAnInputError) {
  const TestDirectory directory;
  std::mt19937 random(20160210);
  int loaded = 0;
  int refused = 0;
  for (int i = 0; i < 2'000; ++i) {
    const std::string text = mutated(kWaypoints, random);
    directory.write("way.csv", text);
    try {
      const Obstacle obstacle = directory.load(kMoving).problem.obstacles[0];
      ASSERT_EQ(obstacle.motion.size(), 11U) << "case " << i << '\n' << text;
      ASSERT_TRUE(obstacle.at(10).center().allFinite()) << "case " << i << '\n' << text;
      ++loaded;
    } catch (const InputError&) {
      ++refused;
    } catch (...) {
      FAIL() << "another exception in case " << i << '\n' << text;
    }
  }
  EXPECT_GT(loaded, 20);
  EXPECT_GT(refused, 1'000);
}

}  // namespace
}  // namespace bqsa::harness
