// `bqsa-bench import` as a user calls it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../program/program_runner.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kFiles = BQSA_SOURCE_DIR "/tests/harness/problem_sets/files/";
const std::string kPanda = BQSA_SOURCE_DIR "/robots/franka_panda.yaml";

ProgramResult import(const std::string& file, const fs::path& out,
                     const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"import", file, "--robot", kPanda, "--out", out.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_bqsa_bench(arguments);
}

TEST(ImportCommand, WritesScenariosWhoseWitnessesTheJudgeCallsSuccesses) {
  for (const std::string file : {"vamp_like.json", "robometrics_like.yaml"}) {
    const TemporaryDirectory directory;
    const ProgramResult result = import(kFiles + file, directory.path(), {"--witnesses"});
    EXPECT_EQ(result.status, 0) << result.err;
    int scenarios = 0;
    for (const auto& entry : fs::directory_iterator(directory.path())) {
      if (entry.path().extension() != ".yaml") continue;
      ++scenarios;
      fs::path witness = entry.path();
      witness.replace_extension(".witness.csv");
      const ProgramResult judged =
          run_bqsa_bench({"judge", entry.path().string(), witness.string()});
      EXPECT_EQ(judged.status, 0) << judged.out << judged.err;
    }
    EXPECT_EQ(scenarios, file == "vamp_like.json" ? 2 : 1);
  }
}

TEST(ImportCommand, SaysWhatBecameOfEachProblem) {
  const TemporaryDirectory directory;
  const ProgramResult result = import(kFiles + "vamp_like.json", directory.path());
  EXPECT_THAT(result.out, HasSubstr("wrote 2 of 3 problems"));
  const std::string ledger = content_of(directory.path() / "import.csv");
  EXPECT_THAT(ledger,
              AllOf(HasSubstr("vamp_like_table_0001,table,1,written,0."),
                    HasSubstr("vamp_like_table_0002,table,2,start,,,\"vamp_like_table_0002.yaml:"),
                    HasSubstr("expected a start free of collision"),
                    HasSubstr("vamp_like_balls_0001,balls,1,written,0.")));
}

TEST(ImportCommand, WritesObstaclesAsTheyAre) {
  const TemporaryDirectory directory;
  import(kFiles + "vamp_like.json", directory.path());
  EXPECT_THAT(content_of(directory.path() / "vamp_like_table_0001.yaml"),
              AllOf(HasSubstr("{name: table_top, kind: box, size: [0.5, 1, 0.04], center: [0.6, 0, "
                              "0.08], quaternion: [0.998"),
                    HasSubstr("{name: can1, kind: cylinder, radius: 0.03, length: 0.14, center: "
                              "[0.45, 0.3, 0.17]")));
  EXPECT_THAT(
      content_of(directory.path() / "vamp_like_balls_0001.yaml"),
      AllOf(HasSubstr("{name: ball, kind: sphere"), HasSubstr("{name: ball_2, kind: sphere")));
}

TEST(ImportCommand, TheSameSeedGivesTheSameFiles) {
  const TemporaryDirectory one, other, third;
  import(kFiles + "vamp_like.json", one.path(), {"--group", "table"});
  import(kFiles + "vamp_like.json", other.path());
  import(kFiles + "vamp_like.json", third.path(), {"--seed", "2"});
  const char* path = "vamp_like_table_0001.path.csv";
  EXPECT_TRUE(content_of(one.path() / path) == content_of(other.path() / path));
  EXPECT_TRUE(content_of(one.path() / path) != content_of(third.path() / path));
}

TEST(ImportCommand, TakesTheGroupsAndTheNumberAskedFor) {
  const TemporaryDirectory directory;
  const ProgramResult result =
      import(kFiles + "vamp_like.json", directory.path(), {"--group", "table", "--count", "1"});
  EXPECT_THAT(result.out, HasSubstr("wrote 1 of 1 problems"));
  const ProgramResult refused =
      import(kFiles + "vamp_like.json", directory.path(), {"--group", "desk"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("--group: expected one of table, balls, got desk"));
}

TEST(ImportCommand, KeepsTheUnitsOfTheRobotsFile) {
  const TemporaryDirectory directory;
  const fs::path robot = directory.path() / "panda.yaml";
  std::string text = content_of(kPanda);
  text.replace(text.find("angle: rad"), 10, "angle: deg");
  const ProgramResult refused = [&] {
    write_file(robot, text);  // angles of 90 degrees are now 1.57 degrees: another robot
    return run_bqsa_bench({"import", kFiles + "vamp_like.json", "--robot", robot.string(), "--out",
                           (directory.path() / "out").string(), "--group", "balls"});
  }();
  EXPECT_THAT(content_of(directory.path() / "out" / "import.csv"), HasSubstr("start"));
  EXPECT_EQ(refused.status, 2);
}

TEST(ImportCommand, RefusesARobotThatDoesNotFit) {
  const TemporaryDirectory directory;
  const ProgramResult six =
      run_bqsa_bench({"import", kFiles + "vamp_like.json", "--robot",
                      BQSA_SOURCE_DIR "/robots/ur5e.yaml", "--out", directory.path().string()});
  EXPECT_EQ(six.status, 2);
  EXPECT_THAT(six.err, HasSubstr("vamp_like.json: table 1: expected 6 joint values, as ur5e has "
                                 "joints, got 7"));
  const ProgramResult slow =
      run_bqsa_bench({"import", kFiles + "vamp_like.json", "--robot",
                      BQSA_SOURCE_DIR "/robots/puma560.yaml", "--out", directory.path().string()});
  EXPECT_THAT(slow.err, HasSubstr("puma560.yaml: robot: expected a spatial arm with a velocity "
                                  "limit of every joint, got another one"));
}

}  // namespace
}  // namespace bqsa::harness
