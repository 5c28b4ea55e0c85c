#include "harness/measuring/measurements.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "harness/input_error.hpp"
#include "harness/measuring/benchmark_file.hpp"
#include "harness/temporary_directory.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

MachineState idle_machine() {
  return {.processor = "Some Processor",
          .cores = 4,
          .governor = "performance",
          .mhz = 2600,
          .load = 0.1,
          .os = "Some System",
          .date = "2026-01-02T03:04:05Z"};
}

BuildInfo release_build() {
  return {.version = "1.2.3",
          .commit = "0123456789012345678901234567890123456789",
          .compiler = "GNU 12.2.0",
          .build_type = "Release",
          .flags = "-O3",
          .libraries = {{"Eigen", "3.4.0"}}};
}

/// Two sweeps, two processes; the second contestant of the first was left out at the second size.
Measurements example() {
  const WorkloadSize small = workload_size(2, 27, 6);
  const WorkloadSize large = workload_size(2, 27, 600);
  Sweep points{
      .name = "plane_nm", .axis = SweepAxis::kPointPairs, .sizes = {small, large}, .series = {}};
  points.series = {{.name = "bqsa",
                    .seconds = {{1e-7, 1.1e-7}, {1.2e-7, 1.3e-7}},
                    .paper_seconds = {2e-7, 3e-7},
                    .paper_passes = {100, 50}},
                   {.name = "test_points", .seconds = {{4e-7, 5e-7}, {}}, .paper_seconds = {}}};
  Sweep steps{.name = "step_nk", .axis = SweepAxis::kPairs, .sizes = {}, .series = {}};
  steps.sizes = {{.dimension = 2, .links = 7, .obstacles = 10}};
  steps.series = {{.name = "qp", .seconds = {{3e-6, 4e-6}}, .paper_seconds = {}}};
  return {.origin = {.build = release_build(),
                     .before = idle_machine(),
                     .other_cores = 0.25,
                     .instruction_set = "AVX2",
                     .effort = "quick",
                     .command_line = "bqsa-bench measure",
                     .against = {"a reason"}},
          .sweeps = {points, steps}};
}

class MeasurementsFile : public testing::Test {
 protected:
  std::string written(const std::string& text) const {
    write_text_file(file_, text);
    return file_;
  }
  std::string refusal(const std::string& text) const {
    try {
      read_measurements(written(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  TemporaryDirectory directory_;
  const std::string file_ = (directory_.path() / "m.json").string();
};

TEST_F(MeasurementsFile, ReadsWhatWasWritten) {
  const Measurements original = example();
  const Measurements read = read_measurements(written(measurements_json(original)));
  EXPECT_EQ(read.origin.build.commit, original.origin.build.commit);
  EXPECT_EQ(read.origin.build.libraries, original.origin.build.libraries);
  EXPECT_EQ(read.origin.before.processor, "Some Processor");
  EXPECT_EQ(read.origin.before.load, 0.1);
  EXPECT_EQ(read.origin.other_cores, 0.25);
  EXPECT_EQ(read.origin.instruction_set, "AVX2");
  EXPECT_THAT(read.origin.against, ElementsAre("a reason"));
  ASSERT_EQ(read.sweeps.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Sweep& was = original.sweeps[i];
    const Sweep& is = read.sweeps[i];
    EXPECT_EQ(is.name, was.name);
    EXPECT_EQ(is.axis, was.axis);
    EXPECT_EQ(is.sizes, was.sizes);
    ASSERT_EQ(is.series.size(), was.series.size());
    for (std::size_t c = 0; c < is.series.size(); ++c) {
      EXPECT_EQ(is.series[c].name, was.series[c].name);
      ASSERT_EQ(is.series[c].seconds.size(), was.series[c].seconds.size());
      for (std::size_t s = 0; s < is.sizes.size(); ++s) {
        ASSERT_EQ(is.series[c].seconds[s].size(), was.series[c].seconds[s].size());
        for (std::size_t p = 0; p < is.series[c].seconds[s].size(); ++p) {
          EXPECT_DOUBLE_EQ(is.series[c].seconds[s][p], was.series[c].seconds[s][p]);
        }
      }
    }
  }
  const Series& bqsa = *read.sweeps[0].find("bqsa");
  ASSERT_EQ(bqsa.paper_seconds.size(), 2u);
  EXPECT_DOUBLE_EQ(bqsa.paper_seconds[1], 3e-7);
  EXPECT_THAT(bqsa.paper_passes, ElementsAre(100, 50));
  EXPECT_TRUE(read.sweeps[0].find("test_points")->paper_seconds.empty());
}

TEST_F(MeasurementsFile, HasTheEntriesOfGoogleBenchmark) {
  const nlohmann::json json = nlohmann::json::parse(measurements_json(example()));
  EXPECT_EQ(json["context"]["num_cpus"], 4);
  EXPECT_EQ(json["context"]["date"], "2026-01-02T03:04:05Z");
  EXPECT_EQ(json["context"]["library_build_type"], "release");
  EXPECT_EQ(json["context"]["bqsa"]["publishable"], false);
  std::vector<std::string> names;
  for (const auto& entry : json["benchmarks"]) names.push_back(entry["name"]);
  EXPECT_EQ(names.size(), 2 * (5 + 1) + 5 + 5u);
  EXPECT_THAT(names, testing::IsSupersetOf(
                         {"plane_nm/bqsa/NM:600/nk:27", "plane_nm/bqsa/NM:600/nk:27_median",
                          "plane_nm/bqsa/NM:600/nk:27/paper", "step_nk/qp/nk:70"}));
  const auto& second = json["benchmarks"][1];
  EXPECT_EQ(second["run_type"], "iteration");
  EXPECT_EQ(second["repetition_index"], 1);
  EXPECT_EQ(second["time_unit"], "ns");
  EXPECT_NEAR(second["cpu_time"], 110, 1e-9);
  const auto& mean = json["benchmarks"][2];
  EXPECT_EQ(mean["aggregate_name"], "mean");
  EXPECT_NEAR(mean["real_time"], 105, 1e-9);
  EXPECT_NEAR(json["benchmarks"][4]["real_time"], 10 / std::sqrt(2), 1e-9);  // of 100 and 110
}

TEST_F(MeasurementsFile, SaysWhereItIsNotWhatItShouldBe) {
  const std::string good = measurements_json(example());
  EXPECT_THAT(refusal("{\n\n  \"context\": nothing"), HasSubstr("m.json:3: not JSON"));
  EXPECT_THAT(refusal(good.substr(0, good.size() / 2)), HasSubstr("not JSON, or cut short"));
  EXPECT_THAT(refusal("[]"), HasSubstr("m.json: not measurements: expected an object"));
  EXPECT_THAT(refusal(R"({"context": {"num_cpus": 2}, "benchmarks": []})"),
              HasSubstr("context: expected what bqsa-bench measure writes"));
  const auto with = [&good](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal(with("bqsa-measurements/1", "other/1")),
              HasSubstr("context.bqsa.schema: expected bqsa-measurements/1, got other/1"));
  EXPECT_THAT(refusal(with("\"k\":3", "\"k\":-3")),
              HasSubstr("benchmarks[0].k: expected a whole number"));
  EXPECT_THAT(refusal(with("\"cpu_time\":", "\"cpu_time\":-")),
              HasSubstr("benchmarks[0].cpu_time: expected a positive number of ns"));
  Measurements cut = example();
  cut.sweeps[0].series[1].seconds[0].pop_back();
  EXPECT_THAT(refusal(measurements_json(cut)),
              HasSubstr("benchmarks: expected times of 2 processes at every size of "
                        "plane_nm/test_points, got 1"));
  EXPECT_THAT(refusal(with("plane_nm/bqsa/NM:6/nk:27", "plane_nm")),
              HasSubstr("benchmarks[0].name: expected SWEEP/SERIES/..."));
  EXPECT_THAT(refusal(with("\"processes\": 2", "\"processes\": 3")),
              HasSubstr("benchmarks: expected times of 3 processes at every size of plane_nm/bqsa, "
                        "got 2"));
  EXPECT_THAT(refusal(good.substr(0, good.find("\"benchmarks\": [")) + "\"benchmarks\": []}"),
              HasSubstr("benchmarks: expected a benchmark with times"));
}

/// An independent reader of the format: the tool that Google Benchmark ships.
TEST_F(MeasurementsFile, IsReadByGoogleBenchmarksOwnComparison) {
  const std::string python = "/usr/bin/python3";
  const std::string tool = "/usr/share/benchmark/compare.py";
  const bool there = std::filesystem::exists(tool) &&
                     std::system((python + " -c 'import scipy' 2> /dev/null").c_str()) == 0;
  if (!there) GTEST_SKIP() << "needs the packages libbenchmark-tools and python3-scipy";
  Measurements slower = example();
  slower.sweeps[1].series[0].seconds[0] = {6e-6, 8e-6};
  const std::string old_file = written(measurements_json(example()));
  const std::string new_file = (directory_.path() / "new.json").string();
  const std::string out_file = (directory_.path() / "out").string();
  write_text_file(new_file, measurements_json(slower));
  const std::string command = python + " " + tool + " --no-color benchmarks " + old_file + " " +
                              new_file + " > " + out_file;
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream in(out_file);
  std::string found;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("step_nk/qp/nk:70_median")) found = line;
  }
  EXPECT_THAT(found, HasSubstr("+1.0000"));  // twice as long
  EXPECT_THAT(found, HasSubstr("3500"));     // [ns]
  EXPECT_THAT(found, HasSubstr("7000"));
}

TEST(Pooling, PutsProcessesSideBySide) {
  const std::vector<Sweep> one = example().sweeps;
  std::vector<Sweep> two = one;
  two[0].series[0].seconds[0] = {7e-7};
  two[0].series[0].paper_seconds = {};
  const std::vector<Sweep> pooled = pool({one, two});
  EXPECT_THAT(pooled[0].series[0].seconds[0], ElementsAre(1e-7, 1.1e-7, 7e-7));
  EXPECT_THAT(pooled[0].series[0].paper_seconds, ElementsAre(2e-7, 3e-7));
  EXPECT_EQ(pooled[1].series[0].seconds[0].size(), 4u);
  two[0].sizes[0].obstacles = 4;
  EXPECT_THROW(pool({one, two}), std::runtime_error);
  two = one;
  two[1].series[0].name = "other";
  EXPECT_THROW(pool({one, two}), std::runtime_error);
}

TEST(ReasonsAgainstMeasuring, AreTheBuildAndTheWorkOfOthers) {
  MachineState machine = idle_machine();
  EXPECT_TRUE(reasons_against_measuring(release_build(), machine, 1.0).empty());  // of 4 cores
  EXPECT_THAT(reasons_against_measuring(release_build(), machine, 1.1),
              ElementsAre("others kept 1.1 of 4 cores busy"));
  machine.load = 9;  // a build that has ended
  EXPECT_TRUE(reasons_against_measuring(release_build(), machine, 0.1).empty());
  BuildInfo debug = release_build();
  debug.build_type = "Debug";
  debug.assertions = true;
  EXPECT_THAT(reasons_against_measuring(debug, machine, 0.1),
              ElementsAre("build type Debug", "assertions on"));
}

TEST(IndicativeNote, IsSaidOnlyIfThereIsAReason) {
  EXPECT_EQ(indicative_note({}), "");
  EXPECT_EQ(indicative_note({"a", "b"}), "! times are only indicative: a, b\n");
}

}  // namespace
}  // namespace bqsa::harness
