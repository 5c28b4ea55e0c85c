// What ends a campaign loses at most the runs under way, and leaves nothing wrong behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>

#include "campaign_runs.hpp"

namespace bqsa::harness {
namespace {

using ::testing::HasSubstr;

/// No record of a run that only a signal to the campaign ended.
void expect_no_crashes(const std::filesystem::path& runs) {
  EXPECT_THAT(content_of(runs), ::testing::Not(HasSubstr("\"crashed\"")));
}

TEST_F(CampaignTest, KilledAtRandomMomentsItLosesNothing) {
  const Findings alone = undisturbed();
  std::mt19937 generator(8);
  std::uniform_int_distribution<int> pause(10, 250);  // [ms]
  int killed = 0;
  for (int i = 0; i < 20; ++i) {
    RunningProgram program(words("out", {"--jobs", "2"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(pause(generator)));
    killed += program.runs();
    program.end_by(SIGKILL);
  }
  EXPECT_GT(killed, 3);
  EXPECT_EQ(run("out", {"--jobs", "2"}).status, 0);
  EXPECT_EQ(findings_of(runs_of("out")), alone);
  EXPECT_THAT(run_bqsa_bench({"status", path("out")}).out, HasSubstr("not whole  0"));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("out"))) {
    EXPECT_NE(entry.path().extension(), ".tmp") << entry.path() << " is left over";
  }
}

TEST_F(CampaignTest, SignalsEndItAndTheSameCommandGoesOn) {
  const Findings alone = undisturbed();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    RunningProgram program(words("out", {"--jobs", "2"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (!program.runs()) continue;
    const int status = program.end_by(signal);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
  }
  expect_no_crashes(runs_of("out"));
  EXPECT_EQ(run("out").status, 0);
  EXPECT_EQ(findings_of(runs_of("out")), alone);
}

TEST_F(CampaignTest, ASignalToAllItsProcessesIsNoCrashOfAMethod) {
  const Findings alone = undisturbed();
  // As a scheduler does it when the time of a job is over; the methods' processes first.
  for (int i = 0; i < 5; ++i) {
    RunningProgram program(words("out", {"--jobs", "2"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(60 + 40 * i));
    std::vector<pid_t> processes = descendants_of(program.process());
    for (auto process = processes.rbegin(); process != processes.rend(); ++process) {
      kill(*process, SIGTERM);
    }
    program.end_by(SIGTERM);
  }
  expect_no_crashes(runs_of("out"));
  EXPECT_EQ(run("out").status, 0);
  EXPECT_EQ(findings_of(runs_of("out")), alone);
}

TEST_F(CampaignTest, AWorkerThatDiesCostsItsRunOnly) {
  const Findings alone = undisturbed();
  RunningProgram program(words("out", {"--jobs", "1"}));
  std::vector<pid_t> workers;
  while (program.runs() && (workers = children_of(program.process())).empty()) {
  }
  ASSERT_FALSE(workers.empty());
  kill(workers.front(), SIGKILL);
  const int status = program.wait();
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(findings_of(runs_of("out")).size(), kRuns - 1);
  EXPECT_EQ(run("out").status, 0);
  EXPECT_EQ(findings_of(runs_of("out")), alone);
}

TEST_F(CampaignTest, AFullDiskStopsItAndKeepsWhatThereIs) {
  const Findings alone = undisturbed();
  std::filesystem::create_directory(path("disk"));
  constexpr const char* kSize = "size=160k";
  if (mount("none", path("disk").c_str(), "tmpfs", 0, kSize) != 0) {
    GTEST_SKIP() << "a small disk cannot be made here";
  }
  const ProgramResult full = run("disk/out");
  EXPECT_EQ(full.status, 2);
  EXPECT_THAT(full.err, HasSubstr("No space left on device"));
  EXPECT_THAT(full.err, ::testing::Not(HasSubstr("lost"))) << "it goes on to run in vain";
  const Findings kept = findings_of(runs_of("disk/out"));
  EXPECT_GT(kept.size(), 0U);
  EXPECT_LT(kept.size(), kRuns);
  for (const std::string& line : lines_of(runs_of("disk/out"))) {
    EXPECT_FALSE(nlohmann::json::parse(line, nullptr, false).is_discarded());
  }
  EXPECT_EQ(mount("none", path("disk").c_str(), "tmpfs", MS_REMOUNT, "size=16m"), 0);
  EXPECT_EQ(run("disk/out").status, 0);
  EXPECT_EQ(findings_of(runs_of("disk/out")), alone);
  umount(path("disk").c_str());
}

TEST_F(CampaignTest, BadMethodsAreOutcomesOfTheirRuns) {
  const std::string faulty =
      "=/usr/bin/python3 " BQSA_SOURCE_DIR "/tests/harness/external/faulty_method.py ";
  write_file(campaign_,
             "schema: bqsa-campaign/1\nname: bad\n"
             "scenarios: [{generate: {family: planar, seed: 5, count: 2}}]\n"
             "methods: [bqsa, crashes, hangs, grows]\n"
             "limits: {time: 2, memory: 256}\n");
  const ProgramResult result =
      run("out",
          {"--jobs", "2", "--external", "crashes" + faulty + "killed prepare", "--external",
           "hangs" + faulty + "hangs prepare", "--external", "grows" + faulty + "grows prepare"});
  EXPECT_EQ(result.status, 0) << result.err;
  std::map<std::string, std::multiset<std::string>> claims;
  for (const std::string& line : lines_of(runs_of("out"))) {
    const auto record = nlohmann::json::parse(line);
    claims[record["method"]["name"]].insert(record["claimed"]["status"]);
  }
  EXPECT_EQ(claims["bqsa"], (std::multiset<std::string>{"infeasible", "success"}));
  EXPECT_EQ(claims["crashes"], (std::multiset<std::string>{"crashed", "crashed"}));
  EXPECT_EQ(claims["hangs"], (std::multiset<std::string>{"timed out", "timed out"}));
  EXPECT_EQ(claims["grows"], (std::multiset<std::string>{"out of memory", "out of memory"}));
}

TEST_F(CampaignTest, OneProcessADirectoryAndShard) {
  RunningProgram first(words("out", {"--jobs", "1"}));
  while (first.runs() && !std::filesystem::exists(runs_of("out"))) {
  }
  const ProgramResult second = run("out");
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.err, HasSubstr("process " + std::to_string(first.process()) + " is at work"));
  EXPECT_THAT(run_bqsa_bench({"status", path("out")}).out,
              HasSubstr("process " + std::to_string(first.process()) + " at all of it"));
  EXPECT_EQ(run("out", {"--shard", "1/2"}).status, 2) << "a shard beside the whole";
  first.wait();
  EXPECT_EQ(findings_of(runs_of("out")).size(), kRuns);
}

TEST_F(CampaignTest, ShardsRunSideBySide) {
  const Findings alone = undisturbed();
  {
    RunningProgram first(words("out", {"--shard", "1/2", "--jobs", "1"}));
    RunningProgram second(words("out", {"--shard", "2/2", "--jobs", "1"}));
    EXPECT_EQ(first.wait(), 0);
    EXPECT_EQ(second.wait(), 0);
  }
  EXPECT_EQ(run_bqsa_bench({"merge", path("out"), "--out", path("out")}).status, 0);
  EXPECT_EQ(findings_of(runs_of("out")), alone);
}

TEST_F(CampaignTest, DamagedAndForeignLinesAreToldAndLeftAlone) {
  const Findings alone = undisturbed();
  std::vector<std::string> lines = lines_of(runs_of("undisturbed"));
  std::string text = "{\"schema\":\"something else\"}\n\n" + lines[0] + "\n" + lines[1] + "\n" +
                     lines[1] + "\nnot JSON at all\n" + lines[2] + "\n" +
                     lines[3].substr(0, lines[3].size() / 2);
  std::filesystem::create_directory(path("out"));
  write_file(runs_of("out"), text);
  write_file(path("out/notes.txt"), "mine");
  std::filesystem::create_directory(path("out/shards"));
  write_file(path("out/shards/notes.txt"), "mine");

  const ProgramResult result = run("out");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("runs.jsonl:1: "));
  EXPECT_THAT(result.err, HasSubstr("runs.jsonl:6: cut short or damaged"));
  EXPECT_THAT(result.err, ::testing::Not(HasSubstr("runs.jsonl:8"))) << "is dropped";
  EXPECT_THAT(result.err, HasSubstr("3 recorded, 9 to do"));
  EXPECT_EQ(content_of(path("out/notes.txt")), "mine");

  const ProgramResult merged = run_bqsa_bench({"merge", path("out"), "--out", path("out")});
  EXPECT_EQ(merged.status, 0);
  EXPECT_THAT(merged.err, HasSubstr("runs.jsonl:6: cut short or damaged"));
  EXPECT_EQ(findings_of(runs_of("out")), alone);
  EXPECT_THAT(content_of(path("out/runs.damaged.jsonl")), HasSubstr("not JSON at all"));
}

/// Whether it is the process of the run that is killed, or the external program below it.
class KilledRun : public CampaignTest, public testing::WithParamInterface<bool> {};

INSTANTIATE_TEST_SUITE_P(OfEither, KilledRun, testing::Bool(), [](const auto& of_program) {
  return of_program.param ? "program" : "process";
});

TEST_P(KilledRun, IsNoCrashOfItsMethod) {
  const std::string hangs = "hangs=/usr/bin/python3 " BQSA_SOURCE_DIR
                            "/tests/harness/external/faulty_method.py hangs prepare";
  write_campaign("[bqsa, hangs]", "limits: {time: 60}\n");
  RunningProgram program(words("out", {"--jobs", "1", "--external", hangs}));
  const auto run_process = [&]() -> pid_t {
    for (const pid_t worker : children_of(program.process())) {
      for (const pid_t of_run : children_of(worker)) {
        if (!children_of(of_run).empty()) return of_run;  // the external method
      }
    }
    return 0;
  };
  pid_t process = 0;
  while (program.runs() && (process = run_process()) == 0) {
  }
  ASSERT_GT(process, 0);
  const std::vector<pid_t> external = children_of(process);
  ASSERT_EQ(external.size(), 1U);
  kill(GetParam() ? external[0] : process, SIGKILL);
  // The next one hangs only after what became of this one was dealt with.
  pid_t next = process;
  while (program.runs() && (next == process || next == 0)) next = run_process();
  ASSERT_TRUE(program.runs());
  program.end_by(SIGKILL);
  EXPECT_GE(lines_of(runs_of("out")).size(), 2U) << "bqsa before and after it";
  for (const std::string& line : lines_of(runs_of("out"))) {
    EXPECT_EQ(nlohmann::json::parse(line)["method"]["name"], "bqsa");
  }
}

TEST_F(CampaignTest, AForcedRunThatWouldNotCountIsRefused) {
  run("out", {"--shard", "1/2"});
  const ProgramResult refused = run("out", {"--force"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("merge first"));
  EXPECT_EQ(run("out", {"--shard", "1/2", "--force"}).status, 0);
  EXPECT_EQ(run("out", {"--shard", "2/2"}).status, 0);
  EXPECT_EQ(run_bqsa_bench({"merge", path("out"), "--out", path("out")}).status, 0);
  EXPECT_EQ(run("out", {"--force"}).status, 0);
}

TEST_F(CampaignTest, TwoFilesOfOneShardAreNotWrittenOver) {
  run("out", {"--shard", "1/2"});
  const std::string complete = path("out/shards/1-of-2.jsonl");
  const std::string before = content_of(complete);
  write_file(path("out/shards/1-of-2.part.jsonl"), lines_of(complete)[0] + "\n");
  const ProgramResult refused = run("out", {"--shard", "1/2"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("got both"));
  EXPECT_EQ(content_of(complete), before);
}

TEST_F(CampaignTest, ShardsOnOneMachineHaveProcessorsOfTheirOwn) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor only";
  // Where processors are claimed; other tests have some of this machine's, too.
  const char* const before = std::getenv("TMPDIR");
  const std::string usual = before != nullptr ? before : "/tmp";
  setenv("TMPDIR", place_.path().c_str(), 1);
  RunningProgram first(words("out", {"--shard", "1/2", "--jobs", "1"}));
  RunningProgram second(words("out", {"--shard", "2/2", "--jobs", "1"}));
  const auto processors_of = [](RunningProgram& program) {
    std::vector<pid_t> workers;
    while (program.runs() && (workers = children_of(program.process())).empty()) {
    }
    std::string allowed = "none";
    for (int i = 0; i < 100 && !workers.empty() && program.runs(); ++i) {
      std::istringstream status(content_of("/proc/" + std::to_string(workers[0]) + "/status"));
      for (std::string line; std::getline(status, line);) {
        if (line.starts_with("Cpus_allowed_list:")) allowed = line.substr(19);
      }
      if (allowed.find_first_of("-,") == std::string::npos) break;  // it is pinned
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return allowed;
  };
  EXPECT_NE(processors_of(first), processors_of(second));
  setenv("TMPDIR", usual.c_str(), 1);
}

TEST_F(CampaignTest, MergeTakesNothingButTrajectoriesAlong) {
  run("one");
  std::string text;
  for (const std::string& line : lines_of(runs_of("one"))) {
    auto record = nlohmann::ordered_json::parse(line);
    const std::size_t n = text.size() % 4;
    record["trajectory"] = n == 0   ? "../../etc/passwd"
                           : n == 1 ? "plan.jsonl"
                           : n == 2 ? "trajectories/../plan.jsonl"
                                    : "/etc/passwd";
    text += record.dump() + "\n";
  }
  write_file(runs_of("one"), text);
  const ProgramResult merged = run_bqsa_bench({"merge", path("one"), "--out", path("merged")});
  EXPECT_EQ(merged.status, 0);
  EXPECT_THAT(merged.err, HasSubstr("expected a trajectory in"));
  EXPECT_EQ(findings_of(runs_of("merged")).size(), kRuns);
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path("merged"))) {
    names.insert(entry.path().filename());
  }
  EXPECT_EQ(names, (std::set<std::string>{"lock", "plan.jsonl", "runs.jsonl"}));
}

}  // namespace
}  // namespace bqsa::harness
