// The command line itself: help, versions, bad input, and the commands that run nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/conformance.hpp"
#include "harness/methods.hpp"
#include "program_runner.hpp"

namespace bqsa::harness {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class Everywhere : public ::testing::TestWithParam<std::string> {};

std::vector<std::string> words_of(const std::string& command, const std::string& option) {
  if (command == "program") return {option};
  return {command, option};
}

TEST_P(Everywhere, HelpIsPrinted) {
  const ProgramResult result = run_bqsa_bench(words_of(GetParam(), "--help"));
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("Usage: bqsa-bench"));
  EXPECT_THAT(result.out, HasSubstr("Exit status"));
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_P(Everywhere, VersionIsPrintedWithItsCommit) {
  const ProgramResult result = run_bqsa_bench(words_of(GetParam(), "--version"));
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out,
              ::testing::MatchesRegex(
                  R"(bqsa-bench [0-9]+\.[0-9]+\.[0-9]+ \(commit [a-z0-9]+(, modified)?\)\s)"));
}

TEST_P(Everywhere, UnknownOptionsAreRefused) {
  const ProgramResult result = run_bqsa_bench(words_of(GetParam(), "--frobnicate"));
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, StartsWith("bqsa-bench: error: "));
}

INSTANTIATE_TEST_SUITE_P(Program, Everywhere,
                         ::testing::Values("program", "list", "run", "show", "step", "conform",
                                           "judge", "generate", "figures", "new-method",
                                           "inspect-robot", "validate"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

struct BadCall {
  const char* name;
  std::vector<std::string> words;
  const char* message;
};

void PrintTo(const BadCall& call, std::ostream* out) { *out << call.name; }

class BadCalls : public ::testing::TestWithParam<BadCall> {};

TEST_P(BadCalls, EndWithStatusTwoAndAMessageAndRunNothing) {
  const TemporaryDirectory directory;
  const std::filesystem::path out = directory.path() / "results";
  std::vector<std::string> words = GetParam().words;
  if (words.size() > 0 && words[0] == "run") words.insert(words.end(), {"--out", out.string()});
  const ProgramResult result = run_bqsa_bench(words);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, StartsWith("bqsa-bench: error: "));
  EXPECT_THAT(result.err, HasSubstr(GetParam().message));
  EXPECT_FALSE(std::filesystem::exists(out));
}

INSTANTIATE_TEST_SUITE_P(
    Program, BadCalls,
    ::testing::Values(
        BadCall{"NoCommand", {}, "subcommand"},
        BadCall{"UnknownCommand", {"frobnicate"}, "unknown command or option 'frobnicate'"},
        BadCall{"RunNothing", {"run"}, "SCENARIO"},
        BadCall{"UnknownMethod",
                {"run", kPlanar, "--method", "magic"},
                "unknown method 'magic': expected one of none, bqsa"},
        BadCall{"UnknownMethodAfterAGoodOne",
                {"run", kPlanar, "--method", "none", "--method", "magic"},
                "unknown method 'magic'"},
        BadCall{"UnknownParameter",
                {"run", kPlanar, "--method", "bqsa:gian=1"},
                "method 'bqsa:gian=1': unknown parameter 'gian'"},
        BadCall{"ParameterOfAMethodWithoutAny",
                {"run", kPlanar, "--method", "none:gain=1"},
                "unknown parameter 'gain'"},
        BadCall{"ParameterOutOfRange",
                {"run", kPlanar, "--method", "bqsa:increment=-1"},
                "parameter 'increment': expected a number from"},
        BadCall{
            "ParameterNotANumber", {"run", kPlanar, "--method", "bqsa:increment=abc"}, "got 'abc'"},
        BadCall{"NoValue",
                {"run", kPlanar, "--method", "bqsa:x"},
                "method 'bqsa:x': expected key=value, got 'x'"},
        BadCall{"MethodTwice",
                {"run", kPlanar, "--method", "none", "--method", "none"},
                "method 'none' is given twice"},
        BadCall{"SameScenarioTwice",
                {"run", kPlanar, kPlanar, "--method", "none"},
                "have the same scenario name 'planar_7r'; nothing was run"},
        BadCall{"AMethodAsScenario",
                {"run", "-m", "none", "bqsa"},
                "bqsa: expected a file, got nothing there; did you mean --method bqsa?"},
        BadCall{"ADirectoryWithoutScenarios",
                {"run", BQSA_SOURCE_DIR "/cmake"},
                "/cmake: expected scenario files *.yaml, found none"},
        BadCall{"NoiseThatIsNoNumber",
                {"run", kPlanar, "--joint-noise", "nan"},
                "--joint-noise: expected a standard deviation [rad], got no finite number"},
        BadCall{"NegativeNoise", {"run", kPlanar, "--joint-noise", "-1"}, "--joint-noise"},
        BadCall{"NegativeSeed", {"run", kPlanar, "--seed", "-1"}, "--seed"},
        BadCall{"TableAndSummary", {"run", kPlanar, "--table", "--summary"}, "excludes"},
        BadCall{"StepOfNothing",
                {"step", kPlanar, "-m", "bqsa"},
                "expected --slowest DIR, or --tick from 1 to 400 with --state"},
        BadCall{"StepBeyondTheEnd",
                {"step", kPlanar, "-m", "bqsa", "--tick", "401", "--state", "0,0,0,0,0,0,0"},
                "--tick from 1 to 400"},
        BadCall{"StepWithoutState", {"step", kPlanar, "-m", "bqsa", "--tick", "3"}, "--state"},
        BadCall{"StepWithTooFewAngles",
                {"step", kPlanar, "-m", "bqsa", "--tick", "3", "--state", "1,2"},
                "--state: expected 7 joint angles, got 2"},
        BadCall{"StepWithoutNumbers",
                {"step", kPlanar, "-m", "bqsa", "--tick", "3", "--state", "1,x"},
                "--state: expected q1,...,qn [rad] or a trajectory file, got 'x'"},
        BadCall{"StepThatDoesNotApply",
                {"step", kPuma, "-m", "bqsa_paper", "--tick", "3", "--state", "1"},
                "bqsa_paper: spatial problems not supported yet"},
        BadCall{"ConformWithoutMethod", {"conform", kPlanar}, "--method"},
        BadCall{"ConformOfAnUnknownMethod", {"conform", kPlanar, "-m", "magic"}, "unknown method"},
        BadCall{"ConformWithoutScenario", {"conform", "-m", "bqsa"}, "SCENARIO"},
        BadCall{"ShowWhatIsNotThere", {"show", "/nonexistent"}, "/nonexistent/runs.jsonl"},
        BadCall{"ListWhatIsNotThere", {"list", "--scenarios", "/nonexistent"}, "/nonexistent"},
        BadCall{"ValidateWhatIsNotThere", {"validate", "/nonexistent.yaml"}, "/nonexistent.yaml"},
        BadCall{"JudgeWithoutTrajectory", {"judge", kPlanar}, "TRAJECTORY"},
        BadCall{
            "JudgeAMissingTrajectory", {"judge", kPlanar, "/nonexistent.csv"}, "/nonexistent.csv"}),
    [](const auto& tested) { return tested.param.name; });

TEST(Program, RunNeedsAResultsDirectory) {
  const ProgramResult result = run_bqsa_bench({"run", kPlanar});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("--out"));
}

TEST(Program, ListShowsMethodsParametersAndScenarios) {
  const ProgramResult result =
      run_bqsa_bench({"list", "--scenarios", BQSA_SOURCE_DIR "/scenarios"});
  EXPECT_EQ(result.status, 0);
  for (const char* expected : {"none", "bqsa", "planar, spatial", "increment", "planar_7r",
                               "puma560_ellipsoid", "puma560_wall"}) {
    EXPECT_THAT(result.out, HasSubstr(expected));
  }
}

TEST(Program, ListKeepsNamesApartFromWhatTheyStandFor) {
  const ProgramResult result =
      run_bqsa_bench({"list", "--scenarios", BQSA_SOURCE_DIR "/scenarios"});
  int names = 0;
  for (const MethodEntry& method : methods()) {
    EXPECT_THAT(result.out, ContainsRegex("\n  " + method.name + " +" + method.summary + "\n"));
    ++names;
  }
  EXPECT_GT(names, 5);
  EXPECT_THAT(result.out, HasSubstr("for planar, spatial, link radius, margin, moving obstacles, "
                                    "prismatic joints\n"));
}

TEST(Program, ListLooksForScenariosWhereItIsCalled) {
  const ProgramResult here = run_bqsa_bench({"list"}, {}, BQSA_SOURCE_DIR);
  EXPECT_EQ(here.status, 0);
  EXPECT_THAT(here.out, HasSubstr("planar_7r"));
  const ProgramResult elsewhere = run_bqsa_bench({"list"}, {}, "/");
  EXPECT_EQ(elsewhere.status, 0);
  EXPECT_THAT(elsewhere.out, HasSubstr("no ./scenarios here"));
}

TEST(Program, ValidateSpeaksOfEveryFile) {
  const TemporaryDirectory directory;
  const std::string broken = (directory.path() / "broken.yaml").string();
  write_file(broken, "schema: [");
  const ProgramResult result = run_bqsa_bench({"validate", kPlanar, broken, kPuma});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.out, HasSubstr("planar_7r.yaml: valid"));
  EXPECT_THAT(result.out, HasSubstr("puma560_ellipsoid.yaml: valid"));
  EXPECT_THAT(result.err, HasSubstr("broken.yaml"));
  EXPECT_EQ(run_bqsa_bench({"validate", kPlanar, kPuma}).status, 0);
}

TEST(Program, FilesOutsideOfAScenariosDirectoryAreReadOnlyIfThatIsAllowed) {
  const TemporaryDirectory directory;
  const std::filesystem::path inner = directory.path() / "inner";
  std::filesystem::create_directory(inner);
  write_file(directory.path() / "way.csv", "t,x,y\n0,1,0.8\n2,0.6,0.9\n");
  const std::string scenario = (inner / "scenario.yaml").string();
  write_file(scenario,
             "schema: bqsa-scenario/1\nname: outside\nunits: {length: m, angle: deg}\n"
             "robot: {kind: planar, links: [1, 0.8]}\nstart: [0, 90]\ntask:\n"
             "  path: {kind: waypoints, file: ../way.csv}\n  timing: {duration: 2, ticks: 20}\n");
  const std::string out = (directory.path() / "out").string();
  const std::string trajectory = out + "/trajectories/outside/none.csv";
  const std::vector<std::vector<std::string>> commands = {
      {"validate", scenario},
      {"run", scenario, "--method", "none", "--out", out},
      {"judge", scenario, trajectory},
      {"step", scenario, "--method", "none", "--slowest", out},
      {"conform", scenario, "--method", "none"}};
  for (std::vector<std::string> command : commands) {
    SCOPED_TRACE(command.front());
    const ProgramResult refused = run_bqsa_bench(command);
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr("scenario.yaml:7: task.path.file: expected a file in the "
                                       "scenario's directory (unless --allow-outside is given), "
                                       "got ../way.csv"));
    command.push_back("--allow-outside");
    const ProgramResult allowed = run_bqsa_bench(command);
    EXPECT_EQ(allowed.status, 0) << allowed.err;
  }
}

TEST(Program, ValidateTakesDirectories) {
  const ProgramResult result = run_bqsa_bench({"validate", BQSA_SOURCE_DIR "/scenarios"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("planar_7r.yaml: valid"));
  EXPECT_THAT(result.out, HasSubstr("puma560_wall.yaml: valid"));
  const TemporaryDirectory empty;
  const ProgramResult nothing = run_bqsa_bench({"validate", empty.path().string()});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_THAT(nothing.err, HasSubstr("expected scenario files *.yaml, found none"));
}

TEST(Program, InspectRobotShowsTheChain) {
  const ProgramResult puma = run_bqsa_bench({"inspect-robot", kPuma});
  EXPECT_EQ(puma.status, 0) << puma.err;
  EXPECT_THAT(puma.out, StartsWith("robot: 6 joints, 5 links, in space\n"));
  const ProgramResult rail =
      run_bqsa_bench({"inspect-robot", BQSA_SOURCE_DIR "/tests/harness/program/rail_arm.yaml"});
  EXPECT_EQ(rail.status, 0) << rail.err;
  EXPECT_THAT(rail.out, StartsWith("robot: 6 joints, 7 links, in space\n"));
  EXPECT_THAT(rail.out, ContainsRegex("4 +reach +prismatic +0 mm +500 mm +2000 mm/s\n"));
  EXPECT_THAT(rail.out,
              ContainsRegex("5 +bend +revolute +-114.592 deg +114.592 deg +229.183 deg/s"));
  EXPECT_THAT(rail.out, ContainsRegex("4 +400.0000[*] +20.0000\n"));
  EXPECT_THAT(rail.out, HasSubstr("reach from the base, at most [mm]: 2850.0000\n"));
  const std::string urdf = BQSA_SOURCE_DIR "/tests/harness/program/rail_arm.urdf";
  const ProgramResult file =
      run_bqsa_bench({"inspect-robot", urdf, "--base-link", "turret", "--tip-link", "tool"});
  EXPECT_EQ(file.status, 0) << file.err;
  EXPECT_THAT(file.out, StartsWith("robot: 4 joints, 5 links, in space\n"));
  const ProgramResult no_links = run_bqsa_bench({"inspect-robot", urdf});
  EXPECT_EQ(no_links.status, 2);
  EXPECT_THAT(no_links.err, HasSubstr("expected --base-link and --tip-link for a robot in URDF"));
  const ProgramResult bare = run_bqsa_bench(
      {"inspect-robot", urdf, "--base-link", "rail", "--tip-link", "tool", "--capsules"});
  EXPECT_EQ(bare.status, 2);
  EXPECT_THAT(bare.err,
              HasSubstr("expected collision geometry of the links from 'rail' to 'tool'"));
}

TEST(Program, ConformSaysALineALaw) {
  const ProgramResult result = run_bqsa_bench({"conform", kPlanar, kPuma, "-m", "bqsa_paper"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("bqsa_paper: applies to 1 of 2 scenarios\n"));
  for (const Law& law : laws()) {
    EXPECT_THAT(result.out, ContainsRegex("\n  (passed|not asked) +" + law.name + " "));
  }
  EXPECT_THAT(result.out, Not(HasSubstr("BROKEN")));
}

TEST(Program, ConformEndsWithOneWhereALawIsBroken) {
  const ProgramResult result = run_bqsa_bench({"conform", kPuma, "-m", "bqsa_paper"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out,
              HasSubstr("BROKEN     declaration    capabilities: expected that it applies to "
                        "a problem at hand, found spatial problems not supported yet\n"));
}

/// `show` notices while it prints, `list` at its end.
const std::vector<std::vector<std::string>> kPrinting = {{"list"},
                                                         {"show", "results/paper_scenarios"}};

TEST(Program, OutputThatCannotBeWrittenIsAnError) {
  for (const std::vector<std::string>& words : kPrinting) {
    const ProgramResult result = run_bqsa_bench(words, "/dev/full", BQSA_SOURCE_DIR);
    EXPECT_EQ(result.status, 2) << words[0];
    EXPECT_THAT(result.err, HasSubstr("cannot write to standard output")) << words[0];
  }
}

TEST(Program, AReaderThatGoesAwayIsNotAnError) {
  for (const std::vector<std::string>& words : kPrinting) {
    int ends[2];
    ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
    close(ends[0]);
    const ProgramResult result = run_bqsa_bench_into(ends[1], words, BQSA_SOURCE_DIR);
    close(ends[1]);
    EXPECT_EQ(result.status, 0) << words[0];
    EXPECT_EQ(result.err, "") << words[0];
  }
}

}  // namespace
}  // namespace bqsa::harness
