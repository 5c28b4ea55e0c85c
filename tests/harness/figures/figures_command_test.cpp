// The command `figures`, as a user would run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <map>

#include "../program/program_runner.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kScenarios = BQSA_SOURCE_DIR "/scenarios";

constexpr const char* kNames[] = {"fig08_planar_configurations",
                                  "fig09_planar_criteria",
                                  "fig09_planar_criteria_exact",
                                  "fig10_planar_trajectory",
                                  "fig11_planar_tracking_errors",
                                  "fig12_planar_joint_angles",
                                  "fig14_puma_projected_configurations",
                                  "fig15_puma_configurations",
                                  "fig16_puma_criteria",
                                  "fig17_puma_trajectory",
                                  "fig18_puma_tracking_errors",
                                  "fig19_puma_joint_angles",
                                  "fig20_puma_wall_configurations"};

ProgramResult run_figures(const fs::path& out) {
  return run_bqsa_bench(
      {"figures", "--without-times", "--scenarios", kScenarios, "--out", out.string()});
}

std::map<std::string, std::string> files_in(const fs::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(directory)) {
    files[entry.path().filename().string()] = content_of(entry.path());
  }
  return files;
}

TEST(FiguresCommand, WritesThemAllTwiceTheSame) {
  const TemporaryDirectory directory;
  for (const char* name : {"a", "b"}) {
    const ProgramResult result = run_figures(directory.path() / name);
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(result.out, HasSubstr("wrote 13 figures"));
  }
  const auto first = files_in(directory.path() / "a");
  const auto second = files_in(directory.path() / "b");
  EXPECT_EQ(first.size(), second.size());
  for (const auto& [file, content] : first) {
    EXPECT_FALSE(content.empty()) << file;
    EXPECT_TRUE(second.at(file) == content) << file;
  }
  for (const std::string name : kNames) {
    for (const char* format : {".gp", ".svg", ".png"})
      EXPECT_TRUE(first.contains(name + format)) << name;
    EXPECT_THAT(first.at("index.md"), HasSubstr("`" + name + "`"));
  }
}

TEST(FiguresCommand, DrawsWhatWasMeasured) {
  const TemporaryDirectory directory;
  const std::string file = (directory.path() / "m.json").string();
  const ProgramResult measured = run_bqsa_bench(
      {"measure", "--processes", "2", "--sweep", "plane_nm", "--sweep", "gate", "--out", file});
  ASSERT_EQ(measured.status, 0) << measured.err;
  const std::string out = (directory.path() / "figures").string();
  const ProgramResult result =
      run_bqsa_bench({"figures", "--measurements", file, "--scenarios", kScenarios, "--out", out});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, IsEmpty());
  const auto files = files_in(out);
  for (const std::string name :
       {"fig05_time_against_nm", "fig05_estimated", "fig05_fair", "time_against_miss_rate"}) {
    EXPECT_TRUE(files.contains(name + ".png")) << name;
  }
}

TEST(FiguresCommand, SaysWhatIsLeftOutWithoutGnuplot) {
  const TemporaryDirectory directory;
  const std::string path = getenv("PATH");
  setenv("PATH", "", 1);
  const ProgramResult result = run_figures(directory.path());
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("gnuplot was not found"));
  EXPECT_THAT(result.out, HasSubstr("gnuplot-nox"));
  const auto files = files_in(directory.path());
  EXPECT_TRUE(files.contains("fig08_planar_configurations.gp"));
  EXPECT_TRUE(files.contains("fig12_planar_joint_angles_bqsa.csv"));
  for (const auto& [file, content] : files) {
    EXPECT_THAT(file, Not(::testing::EndsWith(".png")));
    EXPECT_THAT(file, Not(::testing::EndsWith(".svg")));
  }
  EXPECT_THAT(files.at("index.md"), Not(HasSubstr("png")));
}

void expect_refused(const std::vector<std::string>& words, const std::string& message) {
  const ProgramResult result = run_bqsa_bench(words);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, StartsWith("bqsa-bench: error: "));
  EXPECT_THAT(result.err, HasSubstr(message));
}

TEST(FiguresCommand, RefusesWhatItCannotUse) {
  const TemporaryDirectory directory;
  const std::string out = (directory.path() / "out").string();
  write_file(directory.path() / "file", "in the way");
  expect_refused({"figures", "--without-times", "--scenarios", kScenarios, "--out",
                  (directory.path() / "file" / "figures").string()},
                 "expected a directory that can be made");
  expect_refused({"figures", "--without-times", "--scenarios", "/nonexistent", "--out", out},
                 "/nonexistent/planar_7r.yaml");
  expect_refused(
      {"figures", "--measurements", "/nonexistent.json", "--scenarios", kScenarios, "--out", out},
      "/nonexistent.json");
  expect_refused({"figures", "--measurements", "a.json", "--without-times", "--out", out},
                 "--without-times");

  fs::create_directories(directory.path() / "swapped");
  for (const char* name : {"planar_7r", "puma560_ellipsoid", "puma560_wall"}) {
    fs::copy_file(kPuma, directory.path() / "swapped" / (std::string(name) + ".yaml"));
  }
  expect_refused({"figures", "--without-times", "--scenarios",
                  (directory.path() / "swapped").string(), "--out", out},
                 "expected a scenario for bqsa_paper");
}

/// The sweep of the gate is in every file that `measure` writes, and in no figure.
TEST(FiguresCommand, TakesWhatMeasureWrites) {
  const TemporaryDirectory directory;
  const std::string file = (directory.path() / "m.json").string();
  const std::string out = (directory.path() / "out").string();
  ASSERT_EQ(
      run_bqsa_bench({"measure", "--sweep", "gate", "--processes", "1", "--out", file}).status, 0);
  const ProgramResult result =
      run_bqsa_bench({"figures", "--measurements", file, "--scenarios", kScenarios, "--out", out});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("no times of plane_nm: its figures are left out"));
  EXPECT_THAT(result.out, HasSubstr("wrote 13 figures"));
}

/// Before it measures, which takes minutes.
TEST(FiguresCommand, AsksForScenariosFirst) {
  const TemporaryDirectory directory;
  expect_refused({"figures", "--scenarios", "/nonexistent", "--out", directory.path().string()},
                 "/nonexistent/planar_7r.yaml");
  EXPECT_TRUE(fs::is_empty(directory.path()));
}

}  // namespace
}  // namespace bqsa::harness
