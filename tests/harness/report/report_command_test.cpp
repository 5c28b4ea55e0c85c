// The commands report, run and show of the real program, as far as pages and terminals go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>

#include <cstdlib>
#include <optional>

#include "harness/results/result_store.hpp"
#include "program_runner.hpp"
#include "schema_check.hpp"

namespace bqsa::harness::report {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class ReportCommand : public ::testing::Test {
 protected:
  ProgramResult run(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"run",      kPlanar, "--out",    out_.string(),
                                   "--method", "bqsa",  "--method", "none"};
    words.insert(words.end(), more.begin(), more.end());
    return run_bqsa_bench(words);
  }

  ProgramResult report(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"report", out_.string()};
    words.insert(words.end(), more.begin(), more.end());
    return run_bqsa_bench(words);
  }

  nlohmann::json page() const { return data_in(content_of(out_ / "report.html")); }

  std::vector<std::string> files_in(const fs::path& directory) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory)) {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  TemporaryDirectory place_;
  fs::path out_ = place_.path() / "results";
};

TEST_F(ReportCommand, WritesThePageAndPrintsItsName) {
  ASSERT_EQ(run({"--no-report", "--quiet"}).status, 0);
  EXPECT_THAT(files_in(out_), testing::ElementsAre("runs.jsonl", "trajectories"));
  const ProgramResult result = report();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, (out_ / "report.html").string() + "\n");
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(files_in(out_), testing::ElementsAre("report.html", "runs.jsonl", "trajectories"));
  EXPECT_EQ(schema_errors(page()), "");
  EXPECT_EQ(page()["runs"].size(), 2U);
  EXPECT_EQ(page()["replays"].size(), 2U);
  EXPECT_EQ(page()["title"], "results");
}

TEST_F(ReportCommand, IsRunAtTheEndOfRuns) {
  const ProgramResult result = run();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, EndsWith("report: " + (out_ / "report.html").string() + "\n"));
  EXPECT_EQ(page()["runs"].size(), 2U);
}

TEST_F(ReportCommand, IsRunAtTheEndOfCampaigns) {
  const fs::path campaign = place_.path() / "campaign.yaml";
  write_file(campaign,
             "schema: bqsa-campaign/1\nname: small\n"
             "scenarios: [{generate: {family: planar, seed: 5, count: 3}}]\n"
             "methods: [bqsa, bqsa_projection]\ntrajectories: all\n");
  const ProgramResult result = run_bqsa_bench({"run", campaign, "--out", out_});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, EndsWith("report: " + (out_ / "report.html").string() + "\n"));
  const nlohmann::json data = page();
  EXPECT_EQ(schema_errors(data), "");
  EXPECT_EQ(data["title"], "small");
  EXPECT_EQ(data["source"]["campaign"], "small");
  EXPECT_EQ(data["source"]["planned"], 6);
  EXPECT_EQ(data["source"]["runs"], 3);
  EXPECT_EQ(data["source"]["not_applicable"], 3);
  EXPECT_EQ(data["replays"].size(), 3U);
  for (const nlohmann::json& scenario : data["scenarios"]) {
    EXPECT_EQ(scenario["family"], "planar");
    EXPECT_FALSE(scenario["scene"].is_null()) << scenario["scene_missing"];
  }
  // The directory may go elsewhere, and be looked at from anywhere.
  fs::rename(out_, place_.path() / "moved");
  out_ = place_.path() / "moved";
  ASSERT_EQ(report().status, 0);
  EXPECT_EQ(page()["replays"].size(), 3U);
}

TEST_F(ReportCommand, NeverTakesResultsWithIt) {
  fs::create_directories(out_ / "report.html");
  const ProgramResult result = run({});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("no report: "));
  EXPECT_THAT(result.err, HasSubstr("report.html"));
  EXPECT_THAT(result.out, HasSubstr("planar_7r: 7 joints"));
  EXPECT_EQ(read_lines(runs_file(out_)).size(), 2U);
  EXPECT_EQ(run({"--strict"}).status, 1) << "what became of the runs comes first";
}

TEST_F(ReportCommand, RefusesWhatIsNoResultsDirectory) {
  const ProgramResult missing = report();
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr(out_.string()));
  EXPECT_FALSE(fs::exists(out_));
  fs::create_directories(out_);
  EXPECT_EQ(report().status, 2);
  write_file(runs_file(out_), "no record\n");
  const ProgramResult bad = report();
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr("expected records of runs, got none"));
  EXPECT_FALSE(fs::exists(out_ / "report.html"));
}

TEST_F(ReportCommand, ReportsBadLinesAndLeavesThemOut) {
  ASSERT_EQ(run({"--no-report", "--quiet"}).status, 0);
  const std::string records = content_of(runs_file(out_));
  write_file(runs_file(out_), records + records.substr(0, 700));
  const ProgramResult result = report();
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("runs.jsonl:3: cut short"));
  EXPECT_EQ(page()["runs"].size(), 2U);
  EXPECT_EQ(page()["source"]["bad_lines"].size(), 1U);
}

TEST_F(ReportCommand, WritesWholePagesOnlyAndOverNoOtherFile) {
  ASSERT_EQ(run({"--no-report", "--quiet"}).status, 0);
  std::vector<fs::path> others{runs_file(out_)};
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(out_ / "trajectories")) {
    if (entry.is_regular_file()) others.push_back(entry.path());
  }
  EXPECT_EQ(others.size(), 3U);
  for (const fs::path& file : others) {
    const std::string before = content_of(file);
    const ProgramResult over = report({"--out", file.string()});
    EXPECT_EQ(over.status, 2);
    EXPECT_THAT(over.err, HasSubstr("expected a new file or an older report, got another file"));
    EXPECT_EQ(content_of(file), before);
  }
  const ProgramResult nowhere = report({"--out", (place_.path() / "none/page.html").string()});
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("none/page.html"));
  EXPECT_THAT(files_in(place_.path()), testing::ElementsAre("results"));
}

TEST_F(ReportCommand, RefusesFilesThatWereNamedAndCannotBeRead) {
  ASSERT_EQ(run({"--no-report", "--quiet"}).status, 0);
  for (const char* option : {"--measurements", "--claims", "--figures"}) {
    const ProgramResult result = report({option, (place_.path() / "none").string()});
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_THAT(result.err, HasSubstr("none")) << option;
    EXPECT_FALSE(fs::exists(out_ / "report.html"));
  }
}

TEST_F(ReportCommand, TakesFiguresWithIt) {
  ASSERT_EQ(run({"--no-report", "--quiet"}).status, 0);
  ASSERT_EQ(run_bqsa_bench({"figures", "--without-times", "--scenarios",
                            BQSA_SOURCE_DIR "/scenarios", "--out", out_ / "figures"})
                .status,
            0);
  ASSERT_EQ(report().status, 0);
  const nlohmann::json data = page();
  EXPECT_EQ(schema_errors(data), "");
  ASSERT_GT(data["figures"].size(), 5U);
  for (const nlohmann::json& figure : data["figures"]) {
    for (const nlohmann::json& file : figure["files"]) {
      EXPECT_TRUE(fs::exists(out_ / file["href"].get<std::string>())) << file;
    }
  }
}

/// What the program prints on a terminal of its own.
std::string on_terminal(
    std::vector<std::string> words,
    const std::vector<std::pair<std::string, std::optional<std::string>>>& environment = {}) {
  int master = -1;
  const pid_t child = forkpty(&master, nullptr, nullptr, nullptr);
  if (child < 0) throw std::runtime_error("no terminal");
  if (child == 0) {
    setenv("TERM", "xterm", 1);
    setenv("LC_ALL", "C.UTF-8", 1);
    unsetenv("NO_COLOR");
    for (const auto& [name, value] : environment) {
      value ? setenv(name.c_str(), value->c_str(), 1) : unsetenv(name.c_str());
    }
    words.insert(words.begin(), BQSA_BENCH);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(BQSA_BENCH, arguments.data());
    _exit(127);
  }
  std::string text;
  char buffer[4096];
  for (ssize_t size = 0; (size = read(master, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(size));
  }
  close(master);
  waitpid(child, nullptr, 0);
  text.erase(std::remove(text.begin(), text.end(), '\r'), text.end());
  return text;
}

std::string without_colours(const std::string& text) {
  std::string plain;
  for (std::size_t at = 0; at < text.size();) {
    if (text.compare(at, 2, "\033[") == 0) {
      at = text.find('m', at) + 1;
    } else {
      plain += text[at++];
    }
  }
  return plain;
}

TEST_F(ReportCommand, ShowColoursVerdictsOnATerminalOnly) {
  ASSERT_EQ(run({"--no-report", "--quiet"}).status, 0);
  const std::string plain = run_bqsa_bench({"show", out_}).out;
  EXPECT_THAT(plain, Not(HasSubstr("\033")));
  EXPECT_THAT(plain, Not(HasSubstr("▁")));
  const std::string coloured = on_terminal({"show", out_});
  EXPECT_THAT(coloured, HasSubstr("\033[32msuccess"));
  EXPECT_THAT(coloured, HasSubstr("\033[31mcollides"));
  EXPECT_THAT(coloured, HasSubstr("▁"));
  EXPECT_EQ(on_terminal({"show", out_}, {{"LC_ALL", "C"}, {"NO_COLOR", "1"}}), plain);
  EXPECT_EQ(without_colours(on_terminal({"show", out_}, {{"LC_ALL", "C"}})), plain);
  EXPECT_EQ(on_terminal({"show", out_}, {{"TERM", "dumb"}}), plain);
}

TEST_F(ReportCommand, ShowDrawsWhatTheReplayHas) {
  ASSERT_EQ(run({"--quiet"}).status, 0);
  setenv("LC_ALL", "C.UTF-8", 1);
  const std::string shown = run_bqsa_bench({"show", out_, "--sparklines"}).out;
  unsetenv("LC_ALL");
  EXPECT_THAT(shown, Not(HasSubstr("\033")));
  // As the table has them: the largest tip error of `none`, and its clearance.
  EXPECT_THAT(shown, HasSubstr("max 0.0109 mm at tick 153\n"));
  EXPECT_THAT(shown, HasSubstr("min -84.3 mm at tick"));
  EXPECT_THAT(shown, HasSubstr("      tip error "));
  std::string plain;
  std::istringstream lines(shown);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("▁") == std::string::npos && line.find("█") == std::string::npos) {
      plain += line + '\n';
    }
  }
  EXPECT_EQ(plain, run_bqsa_bench({"show", out_}).out);
}

TEST_F(ReportCommand, ShowDrawsNothingWithoutTrajectories) {
  ASSERT_EQ(run({"--quiet", "--no-trajectories"}).status, 0);
  setenv("LC_ALL", "C.UTF-8", 1);
  EXPECT_EQ(run_bqsa_bench({"show", out_, "--sparklines"}).out, run_bqsa_bench({"show", out_}).out);
  unsetenv("LC_ALL");
}

}  // namespace
}  // namespace bqsa::harness::report
