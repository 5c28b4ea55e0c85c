// Every bad input is refused by an InputError that says where, what was expected and what was
// found.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "harness/scenario/scenario_files.hpp"

namespace bqsa::harness {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

YAML::Node table() {
  return YAML::LoadFile(BQSA_SOURCE_DIR "/tests/harness/scenario/bad_scenarios.yaml");
}

std::string refusal(const TestDirectory& directory, const std::string& text) {
  return message_of(directory, [&] { directory.load(text); });
}

TEST(BadScenarios, TheirOriginalsAreGood) {
  const TestDirectory directory;
  const YAML::Node bases = table();
  EXPECT_EQ(refusal(directory, bases["planar"].as<std::string>()), "no error");
  EXPECT_EQ(refusal(directory, bases["spatial"].as<std::string>()), "no error");
}

TEST(BadScenarios, AreRefusedWithLineKeyExpectedAndFound) {
  const TestDirectory directory;
  const YAML::Node bases = table();
  int cases = 0;
  for (const YAML::Node& bad : bases["cases"]) {
    SCOPED_TRACE(bad["name"].as<std::string>());
    const std::string text = with(bases[bad["base"].as<std::string>()].as<std::string>(),
                                  bad["replace"].as<std::string>(), bad["by"].as<std::string>());
    EXPECT_EQ(refusal(directory, text), "s.yaml:" + bad["expect"].as<std::string>());
    ++cases;
  }
  EXPECT_GE(cases, 90);
}

TEST(BadScenarios, EndlesslyNestedYamlIsRefused) {
  const TestDirectory directory;
  const std::string expected = "s.yaml:1: expected at most 8 levels of nesting, got more";
  EXPECT_EQ(refusal(directory, std::string(500'000, '[')), expected);
  std::string maps;
  for (int i = 0; i < 100'000; ++i) maps += "{a: ";
  EXPECT_EQ(refusal(directory, maps), expected);
  std::string items;
  for (int i = 0; i < 100'000; ++i) items += "- ";
  EXPECT_EQ(refusal(directory, items), expected);
  EXPECT_EQ(refusal(directory, "[[[[[[[[1]]]]]]]]"),
            "s.yaml:1: expected a mapping, got a list of 1");
}

TEST(BadScenarios, AliasBombsAreRefusedAtTheirFirstAnchor) {
  const TestDirectory directory;
  std::string bomb = "schema: bqsa-scenario/1\na0: &a0 [x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 30; ++i) {
    bomb += fmt::format("a{1}: &a{1} [*a{0}, *a{0}, *a{0}, *a{0}]\n", i - 1, i);
  }
  EXPECT_EQ(refusal(directory, bomb), "s.yaml:2: expected no anchors and aliases, got an anchor");
}

TEST(BadScenarios, TextThatIsNotYamlIsRefused) {
  const TestDirectory directory;
  EXPECT_EQ(refusal(directory, ""), "s.yaml:1: expected one YAML document, got an empty file");
  EXPECT_EQ(refusal(directory, "# only this\n"),
            "s.yaml:1: expected one YAML document, got an empty file");
  EXPECT_THAT(refusal(directory, "a: 1\nb: [1, 2\n"), StartsWith("s.yaml:3: expected valid YAML"));
  EXPECT_THAT(refusal(directory, "a: \"b"), HasSubstr("expected valid YAML"));
  EXPECT_EQ(refusal(directory, "a: \"\\\xc3\xa4\""),
            "s.yaml:1: expected valid YAML, got an error: unknown escape character: \\xc3");
  EXPECT_EQ(refusal(directory, "just words"), "s.yaml:1: expected a mapping, got just words");
  EXPECT_EQ(refusal(directory, "- 1\n- 2\n"), "s.yaml:1: expected a mapping, got a list of 2");
}

TEST(BadScenarios, BinaryFilesAreRefused) {
  const TestDirectory directory;
  EXPECT_EQ(refusal(directory, std::string("a: 1\nb\0c", 8)),
            "s.yaml:2: expected text, got the control character 0x00");
  EXPECT_EQ(refusal(directory,
                    "\x7f"
                    "ELF"),
            "s.yaml:1: expected text, got the control character 0x7f");
  EXPECT_EQ(refusal(directory, "\x89PNG"), "s.yaml:1: expected text in UTF-8, got the byte 0x89");
  // Overlong, surrogate, beyond U+10FFFF, cut short.
  for (const std::string bytes : {"\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80",
                                  "\xf0\x80\x80\xaf", "\xe2\x82", "\xf5\x80\x80\x80"}) {
    EXPECT_THAT(refusal(directory, "a: " + bytes), HasSubstr("expected text in UTF-8"));
  }
  EXPECT_THAT(refusal(directory, "\xc3\xa4: \xe2\x82\xac \xf0\x9f\x99\x82"), HasSubstr("schema"));
}

TEST(BadScenarios, FilesThatCannotBeReadAreRefused) {
  const TestDirectory directory;
  const auto refused = [&directory](const std::string& name) {
    return message_of(directory, [&] { load_scenario(directory.path() / name); });
  };
  EXPECT_EQ(refused("missing.yaml"), "missing.yaml: expected a file, got nothing there");
  std::filesystem::create_directory(directory.path() / "folder.yaml");
  EXPECT_EQ(refused("folder.yaml"), "folder.yaml: expected a file, got a directory");
  ASSERT_EQ(mkfifo((directory.path() / "pipe.yaml").c_str(), 0600), 0);
  EXPECT_EQ(refused("pipe.yaml"),
            "pipe.yaml: expected a file, got something else (device or pipe)");
  directory.write("large.yaml", std::string(2'000'000, '#'));
  EXPECT_EQ(refused("large.yaml"),
            "large.yaml: expected a file of at most 1048576 bytes, got 2000000 bytes");
}

TEST(BadScenarios, TooManyObstaclesAreRefused) {
  const TestDirectory directory;
  std::string obstacles = "obstacles:\n";
  for (int i = 0; i < 999; ++i) {
    obstacles +=
        fmt::format("  - {{name: o{}, kind: ellipse, center: [9, 9], semi_axes: [1, 1]}}\n", i);
  }
  const std::string base = table()["planar"].as<std::string>();
  EXPECT_EQ(refusal(directory, with(base, "obstacles:\n", obstacles)),
            "s.yaml:17: obstacles: expected at most 1000 obstacles, got 1001");
}

TEST(BadScenarios, LongValuesAreCutInMessages) {
  const TestDirectory directory;
  const std::string base = table()["planar"].as<std::string>();
  EXPECT_EQ(refusal(directory, with(base, "name: planar", "name: " + std::string(5000, 'A'))),
            "s.yaml:2: name: expected a name of 1 to 64 characters a-z, 0-9, _, got " +
                std::string(60, 'A') + "...");
}

TEST(BadScenarios, WaypointFilesAreRefusedWithTheirOwnLine) {
  const TestDirectory directory;
  const std::string scenario = with(table()["planar"].as<std::string>(),
                                    "kind: line, start_point: [1, 1.5], end_point: [0.5, 1.5]",
                                    "kind: waypoints, file: way.csv");
  const std::string text = with(scenario, "profile: quintic", "profile: linear");
  const auto refused = [&](const std::string& csv) {
    directory.write("way.csv", csv);
    return refusal(directory, text);
  };
  EXPECT_EQ(refused("t,x,y\n0,1,1.5\n2,0.5,1.5\n"), "no error");
  EXPECT_EQ(refused("t,x,y\r\n0,1,1.5\r\n2,0.5,1.5\r\n"), "no error");
  EXPECT_EQ(refused("\xef\xbb\xbft,x,y\n0,1,1.5\n2,0.5,1.5\n"), "no error");
  EXPECT_EQ(refused(""), "way.csv: expected the header t,x,y, got an empty file");
  EXPECT_EQ(refused("t,x,y,z\n"), "way.csv:1: expected the header t,x,y, got t,x,y,z");
  EXPECT_EQ(refused("t,x,y\n0,1,1.5\n"), "way.csv:3: t: expected 2 or more waypoints, got 1");
  EXPECT_EQ(refused("t,x,y\n0.1,1,1.5\n2,0.5,1.5\n"),
            "way.csv:2: t: expected 0 for the first waypoint, got 0.1");
  EXPECT_EQ(refused("t,x,y\n0,1,1.5\n1,1,1.5\n1,1,1.5\n2,0.5,1.5\n"),
            "way.csv:4: t: expected a time after 1, got 1");
  EXPECT_EQ(refused("t,x,y\n0,1,1.5\n1.9,0.5,1.5\n"),
            "way.csv:3: t: expected the task's duration 2 for the last waypoint, got 1.9");
  EXPECT_EQ(refused("t,x,y\n0,1,nan\n2,0.5,1.5\n"),
            "way.csv:2: y: expected a finite number, got nan");
  EXPECT_EQ(refused("t,x,y\n0,1,1.5\n2,1e300,1.5\n"),
            "way.csv:3: x: expected a length of at most 1e+06 m, got 1e+300 m");
  EXPECT_EQ(refused("t,x,y\n0,1,1.5\n2,0.5\n"), "way.csv:3: expected 3 numbers, got 2");
  EXPECT_EQ(refused("t,x,y\n0,1,1.5\n2,0.5,1.5"),
            "way.csv:3: expected a complete line that ends in a line break, got the end of the "
            "file: it was cut short");
  directory.write("way.csv", "t,x,y\n0,1,1.5\n2,0.5,1.5\n");
  EXPECT_EQ(refusal(directory, scenario),
            "s.yaml:15: task.timing.profile: expected linear, since waypoints carry their own "
            "times, got quintic");
  std::string many = "t,x,y\n";
  for (int i = 0; i <= 100'000; ++i) many += fmt::format("{},1,1.5\n", i * 2e-5);
  EXPECT_EQ(refused(many), "way.csv:100002: t: expected at most 100000 waypoints, got 100001");
  std::filesystem::remove(directory.path() / "way.csv");
  EXPECT_EQ(refusal(directory, text), "way.csv: expected a file, got nothing there");
  std::filesystem::create_symlink("/etc/passwd", directory.path() / "way.csv");
  EXPECT_EQ(refusal(directory, text),
            "s.yaml:14: task.path.file: expected a file in the scenario's directory (unless "
            "--allow-outside is given), got way.csv");
}

TEST(BadScenarios, WaypointFilesOfMotionsAreRefusedWithTheirOwnLine) {
  const TestDirectory directory;
  const YAML::Node bases = table();
  const std::string planar =
      with(bases["planar"].as<std::string>(), "semi_axes: [0.3, 0.2], rotation: 30}",
           "semi_axes: [0.3, 0.2], rotation: 30, motion: {kind: waypoints, file: way.csv}}");
  const auto refused = [&](const std::string& csv) {
    directory.write("way.csv", csv);
    return refusal(directory, planar);
  };
  const std::string file = "s.yaml:17: obstacles[0].motion.file: expected ";
  EXPECT_EQ(refused("t,x,y\n0,-1,1\n1,-2,1\n"), "no error");
  EXPECT_EQ(refused("t,x,y,angle\n-1,-1,1,30\n0,-1,1,30\n9,-2,1,60\n"), "no error");
  EXPECT_EQ(refused(""), "way.csv: expected the header t,x,y or t,x,y,angle, got an empty file");
  EXPECT_EQ(refused("t,x,y,z\n"),
            "way.csv:1: expected the header t,x,y or t,x,y,angle, got t,x,y,z");
  EXPECT_EQ(refused("t,x,y\n0,-1,1\n"), "way.csv:3: t: expected 2 or more waypoints, got 1");
  EXPECT_EQ(refused("t,x,y\n1,-1,1\n0,-1,1\n"), "way.csv:3: t: expected a time after 1, got 0");
  EXPECT_EQ(refused("t,x,y\n0,-1,1\n1e7,-1,1\n"),
            "way.csv:3: t: expected a time of at most 1e+06 s, got 1e+07");
  EXPECT_EQ(refused("t,x,y\n0,-1,1\nnan,-1,1\n"),
            "way.csv:3: t: expected a finite number, got nan");
  EXPECT_EQ(refused("t,x,y\n0,-1,1\n1,inf,1\n"), "way.csv:3: x: expected a finite number, got inf");
  EXPECT_EQ(refused("t,x,y\n0,-1,1\n1,-1,1e7\n"),
            "way.csv:3: y: expected a length of at most 1e+06 m, got 1e+07 m");
  EXPECT_EQ(refused("t,x,y,angle\n0,-1,1,30\n1,-1,1,-inf\n"),
            "way.csv:3: angle: expected a finite number, got -inf");
  EXPECT_EQ(refused("t,x,y,angle\n0,-1,1,30\n1,-1,1,1e6\n"),
            "way.csv:3: angle: expected an angle of at most 572958 deg, got 1e+06 deg");
  EXPECT_EQ(
      refused("t,x,y\n0,-1.000002,1\n1,-2,1\n"),
      file + "waypoints that agree with the obstacle's center (-1, 1) m at t = 0, got (-1, 1) m");
  EXPECT_EQ(refused("t,x,y\n0,-1.0000009,1\n1,-2,1\n"), "no error");
  EXPECT_EQ(refused("t,x,y,angle\n0,-1,1,31\n1,-2,1,31\n"),
            file +
                "waypoints that agree with the obstacle's rotation at t = 0, got one that is "
                "turned by 1 deg");
  EXPECT_EQ(refused("t,x,y,angle\n0,-1,1,30\n0.04,-1,1,209.99\n"), "no error");
  EXPECT_EQ(refused("t,x,y,angle\n0,-1,1,30\n0.04,-1,1,210.01\n"),
            file +
                "angles that change by less than half a turn between two ticks, all together, got "
                "180.01 deg before t = 0.04 s");

  const std::string spatial = with(bases["spatial"].as<std::string>(), "rpy: [10, 20, 30]}",
                                   "rpy: [10, 20, 30], motion: {kind: waypoints, file: way.csv}}");
  const auto refused_in_space = [&](const std::string& csv) {
    directory.write("way.csv", csv);
    return refusal(directory, spatial);
  };
  EXPECT_EQ(refused_in_space("t,x,y,z\n0,0,0,900\n1,0,0,950\n"), "no error");
  EXPECT_EQ(refused_in_space("t,x,y,z,r,p,y\n0,0,0,900,10,20,30\n1,0,0,950,0,0,0\n"), "no error");
  EXPECT_EQ(refused_in_space("t,x,y\n"),
            "way.csv:1: expected the header t,x,y,z or t,x,y,z,r,p,y, got t,x,y");
  EXPECT_EQ(
      refused_in_space("t,x,y,z,r,p,y\n0,0,0,900,10,20,30\n0.04,0,0,950,70,80,91\n"),
      "s.yaml:15: obstacles[0].motion.file: expected angles that change by less than half a turn "
      "between two ticks, all together, got 181 deg before t = 0.04 s");
  std::filesystem::remove(directory.path() / "way.csv");
  EXPECT_EQ(refusal(directory, spatial), "way.csv: expected a file, got nothing there");
}

}  // namespace
}  // namespace bqsa::harness
