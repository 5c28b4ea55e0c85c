// The option --external of the commands, and the example, with the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "harness/program/program_runner.hpp"
#include "harness/results/result_store.hpp"
#include "running_process.hpp"

namespace bqsa::harness {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kExample = "/usr/bin/python3 " BQSA_SOURCE_DIR "/examples/external_method.py";
const std::string kFaulty =
    "/usr/bin/python3 " BQSA_SOURCE_DIR "/tests/harness/external/faulty_method.py";

class ExternalProgram : public ::testing::Test {
 protected:
  ProgramResult run(std::vector<std::string> words) {
    words.insert(words.begin(), "run");
    words.insert(words.end(), {"--out", out_});
    return run_bqsa_bench(words);
  }

  std::vector<nlohmann::json> records() const {
    std::vector<nlohmann::json> list;
    for (const StoredLine& line : read_lines(runs_file(out_))) {
      list.push_back(nlohmann::json::parse(line.text));
    }
    return list;
  }

  TemporaryDirectory directory_;
  const std::string out_ = (directory_.path() / "results").string();
};

TEST_F(ExternalProgram, TheExampleAvoidsTheObstaclesOnItsPath) {
  const ProgramResult result =
      run({kPlanar, "--external", "mine=" + kExample, "--method", "mine", "--strict"});
  ASSERT_EQ(result.status, 0) << result.err << result.out;
  ASSERT_EQ(records().size(), 1u);
  const nlohmann::json record = records()[0];
  EXPECT_EQ(record["judged"]["success"], true);
  EXPECT_LT(record["judged"]["tip_error_at_ticks"]["max_m"], 1e-3);
  EXPECT_GT(record["judged"]["clearance_m"], 1e-3);
  EXPECT_EQ(record["claimed"]["status"], "nothing");
  EXPECT_EQ(record["times"]["includes_pipe"], true);
  EXPECT_EQ(record["provenance"]["external"], kExample);
  EXPECT_THAT(result.out, HasSubstr("^ of a program of its own"));
  EXPECT_THAT(result.out, ContainsRegex("mine +success .* [\\^]~? *[0-9.]+ +[0-9.]+  no claim"));
  const ProgramResult summary = run_bqsa_bench({"show", out_, "--summary"});
  EXPECT_THAT(summary.out, HasSubstr("^ of a program of its own"));
  EXPECT_THAT(summary.out, ContainsRegex("mine +399 +[\\^]"));
}

TEST_F(ExternalProgram, TheExampleWorksInSpaceToo) {
  const ProgramResult result =
      run({kPuma, "--external", "mine=" + kExample, "--method", "mine", "--strict"});
  EXPECT_EQ(result.status, 0) << result.err << result.out;
}

TEST_F(ExternalProgram, TakesPartBesideTheOthers) {
  const ProgramResult result =
      run({kPlanar, "-q", "--method", "none", "--method", "mine:gain=0", "--external",
           "mine=" + kExample, "--external", "other=" + kExample});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::vector<nlohmann::json> all = records();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0]["method"]["name"], "none");
  EXPECT_EQ(all[0]["times"]["includes_pipe"], false);
  EXPECT_TRUE(all[0]["provenance"]["external"].is_null());
  EXPECT_EQ(all[1]["method"]["changed"], "gain=0");
  EXPECT_EQ(all[2]["method"]["variant"], "other")
      << "with its defaults, though no --method names it";

  // Without a push the example only tracks its path: like `none`, which is another program.
  EXPECT_EQ(all[1]["judged"]["success"], false);
  EXPECT_EQ(all[1]["judged"]["contacts"], all[0]["judged"]["contacts"]);
  EXPECT_NEAR(all[1]["judged"]["clearance_m"], all[0]["judged"]["clearance_m"], 1e-4);
  EXPECT_EQ(all[2]["judged"]["success"], true);
}

TEST_F(ExternalProgram, RowsWithoutOneHaveNoMark) {
  const ProgramResult result = run({kPlanar, "--method", "bqsa"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("^")));
}

TEST_F(ExternalProgram, ListAndStepKnowIt) {
  const ProgramResult list = run_bqsa_bench({"list", "--external", "mine=" + kExample});
  ASSERT_EQ(list.status, 0) << list.err;
  EXPECT_THAT(list.out, HasSubstr("  mine              damped least squares"));
  EXPECT_THAT(list.out, ContainsRegex("    gain +1000 rad"));

  const std::string start = "1.3,-0.4,-0.6,-0.2,-0.7,-0.8,-0.6";
  const ProgramResult step =
      run_bqsa_bench({"step", kPlanar, "--external", "mine=" + kExample, "--method",
                      "mine:gain=500", "--tick", "3", "--state", start});
  ASSERT_EQ(step.status, 0) << step.err;
  EXPECT_THAT(step.out, HasSubstr("state: unclaimed"));
  EXPECT_THAT(step.out, HasSubstr("time of "));
}

TEST_F(ExternalProgram, NothingRunsIfOneCannotBeUsed) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"mine=/no/such/program", "--external mine: '/no/such/program': cannot start"},
      {"bqsa=" + kExample, "--external: expected the name of no other method, got 'bqsa'"},
      {"mine=" + kFaulty + " other_protocol describe",
       "expected \"bqsa-method/1\", got \"bqsa-method/2\""},
      {kExample, "--external: expected NAME=COMMAND"}};
  for (const auto& [external, message] : faults) {
    const ProgramResult result = run({kPlanar, "--external", external});
    EXPECT_EQ(result.status, 2) << external;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(runs_file(out_)));
  }
  const ProgramResult twice =
      run({kPlanar, "--external", "mine=" + kExample, "--external", "mine=" + kExample});
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("got 'mine'"));
}

TEST_F(ExternalProgram, AProgramNamedInAScenarioFileIsNotStarted) {
  const std::string file = (directory_.path() / "inviting.yaml").string();
  const std::string mark = (directory_.path() / "mark").string();
  write_file(file, content_of(kPlanar) + "external: x=touch " + mark + "\n");
  const ProgramResult result = run({file, "--method", "none"});
  EXPECT_EQ(result.status, 2) << "an unknown key";
  EXPECT_FALSE(std::filesystem::exists(mark));
}

TEST_F(ExternalProgram, EndsWithTheHarness) {
  const std::string mark = (directory_.path() / "mark").string();
  const pid_t bench = fork();
  if (bench == 0) {
    const std::string external = "mine=" + kFaulty + " hangs prepare " + mark;
    execl(BQSA_BENCH, BQSA_BENCH, "run", kPlanar.c_str(), "-q", "--external", external.c_str(),
          "-m", "mine", "--out", out_.c_str(), nullptr);
    _exit(EXIT_FAILURE);
  }
  std::vector<pid_t> started;
  ASSERT_TRUE(within_a_minute([&] {
    started.clear();
    std::istringstream text(content_of(mark));
    for (pid_t process = 0; text >> process;) started.push_back(process);
    return started.size() == 2;
  }));
  EXPECT_TRUE(runs(started[1])) << "hangs";
  kill(bench, SIGKILL);
  waitpid(bench, nullptr, 0);
  EXPECT_TRUE(within_a_minute([&] { return !runs(started[1]); }));
}

}  // namespace
}  // namespace bqsa::harness
