/// @file
/// Campaigns in directories of their own, run by the real program, and what is recorded of them.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "harness/process_state.hpp"
#include "harness/temporary_directory.hpp"
#include "program_runner.hpp"

namespace bqsa::harness {

/// Verdict, claim, work and conduct of each run, by its key: all that must not depend on how a campaign
/// was run.
using Findings = std::map<std::string, std::string>;

inline std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::istringstream text(content_of(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Of all the records in one file, each key once.
inline Findings findings_of(const std::filesystem::path& file) {
  Findings findings;
  for (const std::string& line : lines_of(file)) {
    const auto record = nlohmann::json::parse(line, nullptr, false);
    if (record.is_discarded()) continue;
    nlohmann::json kept = {{"judged", record["judged"]},
                           {"claimed", record["claimed"]},
                           {"counters", record.value("counters", nlohmann::json())}};
    const bool first = findings.emplace(record["campaign"]["key"], kept.dump()).second;
    EXPECT_TRUE(first) << "a run is recorded twice";
  }
  return findings;
}

/// The program at work.
class RunningProgram {
 public:
  explicit RunningProgram(std::vector<std::string> words) {
    words.insert(words.begin(), BQSA_BENCH);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
      setpgid(0, 0);
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDOUT_FILENO);
      dup2(nowhere, STDERR_FILENO);
      execv(BQSA_BENCH, arguments.data());
      _exit(127);
    }
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram() {
    if (process_ > 0) end_by(SIGKILL);
  }

  pid_t process() const { return process_; }

  /// Whether it has not ended by itself.
  bool runs() {
    if (process_ < 0) return false;
    if (waitpid(process_, &status_, WNOHANG) == 0) return true;
    process_ = -1;
    return false;
  }

  /// @return status of wait()
  int end_by(int signal) {
    kill(process_, signal);
    return wait();
  }

  int wait() {
    if (process_ > 0) waitpid(std::exchange(process_, -1), &status_, 0);
    return status_;
  }

 private:
  pid_t process_;
  int status_ = 0;
};

/// 12 runs of two methods on six generated problems, about a second of work.
class CampaignTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kRuns = 12;

  CampaignTest() { write_campaign(); }

  void write_campaign(const std::string& methods = "[bqsa, maciejewski_klein]",
                      const std::string& more = "") {
    write_file(campaign_,
               "schema: bqsa-campaign/1\nname: small\n"
               "scenarios: [{generate: {family: planar, seed: 5, count: 6}}]\n"
               "methods: " +
                   methods + "\n" + more);
  }

  std::vector<std::string> words(const std::string& directory,
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"run", campaign_, "--out", path(directory)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  ProgramResult run(const std::string& directory, const std::vector<std::string>& more = {}) const {
    return run_bqsa_bench(words(directory, more));
  }

  std::string path(const std::string& name) const { return place_.path() / name; }

  std::filesystem::path runs_of(const std::string& directory) const {
    return place_.path() / directory / "runs.jsonl";
  }

  /// What is recorded if nothing disturbs.
  Findings undisturbed() const {
    EXPECT_EQ(run("undisturbed", {"--jobs", "1"}).status, 0);
    return findings_of(runs_of("undisturbed"));
  }

  TemporaryDirectory place_;
  std::string campaign_ = place_.path() / "campaign.yaml";
};

}  // namespace bqsa::harness
