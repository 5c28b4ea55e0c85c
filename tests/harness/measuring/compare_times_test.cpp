#include "harness/measuring/compare_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "harness/generator/random_stream.hpp"
#include "harness/input_error.hpp"
#include "harness/temporary_directory.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

BenchmarkFile file_with(const std::vector<BenchmarkTimes>& benchmarks) {
  return {.benchmarks = benchmarks, .machine = "m", .compiler = "c", .against = {}};
}

ComparisonFinding only_finding(const std::vector<double>& before, const std::vector<double>& after,
                               double threshold = 1.10) {
  return compare_times(file_with({{"a", before}}), file_with({{"a", after}}),
                       {.time_threshold = threshold})
      .rows.at(0)
      .finding;
}

const std::vector<double> kSteady{1.00, 1.01, 0.99, 1.00, 1.01};
std::vector<double> times(double factor, const std::vector<double>& seconds = kSteady) {
  std::vector<double> scaled;
  for (const double time : seconds) scaled.push_back(factor * time);
  return scaled;
}

TEST(CompareTimes, FindsWhatIsBeyondTheThreshold) {
  EXPECT_EQ(only_finding(kSteady, kSteady), ComparisonFinding::kTie);
  EXPECT_EQ(only_finding(kSteady, times(1.08)),
            ComparisonFinding::kTie);  // certain, but too little
  EXPECT_EQ(only_finding(kSteady, times(1.2)), ComparisonFinding::kWorse);
  EXPECT_EQ(only_finding(kSteady, times(1 / 1.2)), ComparisonFinding::kBetter);
  EXPECT_EQ(only_finding(kSteady, times(1.2), 1.3), ComparisonFinding::kTie);
  EXPECT_EQ(only_finding({1, 2, 3}, {2, 3, 1.5}),
            ComparisonFinding::kTie);  // enough, but uncertain
  EXPECT_EQ(only_finding({1.0}, {3.0}), ComparisonFinding::kUndecided);
}

/// By hand: logarithms 0, 0.02 and 0.3, 0.34: means 0.01, 0.32, variances of the means 1e-4, 4e-4;
/// Welch's freedom 25e-8 / (1e-8 + 16e-8) = 25/17, t quantile of 97.5 % there 6.1881 (by
/// scipy.stats.t.ppf): 0.31 +- 6.1881 x 0.0223607.
TEST(CompareTimes, HasWelchsInterval) {
  const auto row = compare_times(file_with({{"a", {std::exp(0), std::exp(0.02)}}}),
                                 file_with({{"a", {std::exp(0.3), std::exp(0.34)}}}))
                       .rows.at(0);
  EXPECT_EQ(row.change, "x 1.364");  // of the medians
  EXPECT_EQ(row.interval, "1.187 .. 1.566");
  EXPECT_EQ(row.p, "0.333");  // of the six orders two are as extreme
  EXPECT_EQ(row.finding, ComparisonFinding::kWorse);
}

/// 200 benchmarks, five repetitions with 10 % noise: without a guard against their number some would be
/// called worse at any threshold near 1.
TEST(CompareTimes, DoNotCallChanceAmongManyAFinding) {
  RandomStream random{11};
  int found = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const auto draw = [&random] {
      std::vector<BenchmarkTimes> benchmarks;
      for (int i = 0; i < 200; ++i) {
        BenchmarkTimes benchmark{std::to_string(i), {}};
        for (int r = 0; r < 5; ++r) {
          const double normal =
              random.uniform(-1, 1) + random.uniform(-1, 1) + random.uniform(-1, 1);  // variance 1
          benchmark.seconds.push_back(std::exp(0.1 * normal));
        }
        benchmarks.push_back(benchmark);
      }
      return file_with(benchmarks);
    };
    const ComparisonReport report = compare_times(draw(), draw(), {.time_threshold = 1.0001});
    if (report.count(ComparisonFinding::kWorse) + report.count(ComparisonFinding::kBetter) > 0)
      ++found;
  }
  EXPECT_LE(found, 6);  // 5 % of 40 are 2, standard deviation 1.4
}

TEST(CompareTimes, OfOtherMachinesOrIndicativeOnesDecideNothing) {
  const BenchmarkFile before = file_with({{"a", kSteady}});
  BenchmarkFile after = file_with({{"a", times(2)}});
  EXPECT_EQ(compare_times(before, after).count(ComparisonFinding::kWorse), 1);
  after.machine = "another";
  ComparisonReport report = compare_times(before, after);
  EXPECT_EQ(report.count(ComparisonFinding::kUndecided), 1);
  EXPECT_TRUE(report.rows[0].differs);
  EXPECT_THAT(report.notes, testing::Contains(HasSubstr("machines differ: m and another")));
  after = file_with({{"a", times(2)}});
  after.against = {"assertions on"};
  report = compare_times(before, after);
  EXPECT_EQ(report.count(ComparisonFinding::kUndecided), 1);
  EXPECT_THAT(report.notes, testing::Contains(HasSubstr("assertions on")));
}

TEST(CompareTimes, NamesWhatHasNoPartner) {
  const ComparisonReport report = compare_times(
      file_with({{"a", kSteady}, {"b", kSteady}, {"c", kSteady}}), file_with({{"b", kSteady}}));
  EXPECT_EQ(report.rows.size(), 1u);
  EXPECT_THAT(report.notes, testing::Contains("2 of 3 benchmarks only in OLD"));
  EXPECT_THROW(compare_times(file_with({{"a", kSteady}}), file_with({{"b", kSteady}})), InputError);
}

class BenchmarkFiles : public testing::Test {
 protected:
  BenchmarkFile read(const std::string& text) const {
    write_text_file(file_, text);
    return read_benchmark_file(file_);
  }
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  TemporaryDirectory directory_;
  const std::filesystem::path file_ = directory_.path() / "b.json";
};

/// As Google Benchmark 1.7.1 writes it, shortened.
constexpr const char* kForeign = R"({
  "context": {"date": "2026", "num_cpus": 2, "library_build_type": "release",
    "caches": [{"type": "Data", "level": 1, "size": 32768, "num_sharing": 1}]},
  "benchmarks": [
    {"name": "BM_a/8", "run_type": "iteration", "repetition_index": 0, "iterations": 1000,
     "real_time": 3.0, "cpu_time": 2.0, "time_unit": "us"},
    {"name": "BM_a/8", "run_type": "iteration", "repetition_index": 1, "iterations": 1000,
     "real_time": 3.5, "cpu_time": 2.5, "time_unit": "us"},
    {"name": "BM_a/8_mean", "run_type": "aggregate", "real_time": 3.25, "cpu_time": 2.25,
     "time_unit": "us"},
    {"name": "BM_b", "run_type": "iteration", "real_time": 1, "cpu_time": 1, "time_unit": "ms"}
  ]})";

TEST_F(BenchmarkFiles, OfOtherProgramsAreRead) {
  const BenchmarkFile file = read(kForeign);
  ASSERT_EQ(file.benchmarks.size(), 2u);
  EXPECT_EQ(file.benchmarks[0].name, "BM_a/8");
  EXPECT_THAT(file.benchmarks[0].seconds,
              ElementsAre(testing::DoubleEq(2e-6), testing::DoubleEq(2.5e-6)));
  EXPECT_THAT(file.benchmarks[1].seconds, ElementsAre(1e-3));
  EXPECT_EQ(file.machine, "2 cores, L1 32768 B");
  EXPECT_TRUE(file.against.empty());
}

TEST_F(BenchmarkFiles, OfLoadedMachinesAreOnlyIndicative) {
  const auto with_load = [this](const std::string& load) {
    std::string text = kForeign;
    return read(text.insert(text.find("\"num_cpus\""), "\"load_avg\": [" + load + ", 9, 9], "))
        .against;
  };
  EXPECT_THAT(with_load("1.2"), ElementsAre("load average 1.2 on 2 cores before measuring"));
  EXPECT_TRUE(with_load("0.9").empty());
}

/// Which is no JSON, but what Google Benchmark writes.
TEST_F(BenchmarkFiles, MayHaveCountersThatAreNoNumbers) {
  const BenchmarkFile file = read(R"({"context": {"num_cpus": 2}, "benchmarks": [
      {"name": "NaN \"NaN\" Infinity", "cpu_time": 1, "time_unit": "s", "a": NaN, "b": -Infinity,
       "c": Infinity}]})");
  ASSERT_EQ(file.benchmarks.size(), 1u);
  EXPECT_EQ(file.benchmarks[0].name, "NaN \"NaN\" Infinity");
  EXPECT_THAT(refusal(R"({"context": {"num_cpus": 2}, "benchmarks": [
      {"name": "a", "cpu_time": NaN, "time_unit": "s"}]})"),
              HasSubstr("benchmarks[0].cpu_time: expected a positive number"));
}

TEST_F(BenchmarkFiles, ThatCannotBeUsedAreRefused) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kForeign;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal("\n\nhello"), HasSubstr("b.json:3: not JSON"));
  EXPECT_THAT(refusal("{}"), HasSubstr("b.json: not Google Benchmark's JSON: context: missing"));
  EXPECT_THAT(refusal(with("\"us\"", "\"h\"")),
              HasSubstr("benchmarks[0].time_unit: expected ns, us, ms or s, got h"));
  EXPECT_THAT(refusal(with("\"cpu_time\": 2.0", "\"cpu_time\": 0")),
              HasSubstr("benchmarks[0].cpu_time: expected a positive number"));
  EXPECT_THAT(refusal(with("\"iterations\": 1000", "\"error_occurred\": true")),
              HasSubstr("benchmarks[0]: BM_a/8 ended with an error"));
  EXPECT_THAT(refusal(R"({"context": {"num_cpus": 1}, "benchmarks": []})"),
              HasSubstr("expected a benchmark with times"));
}

}  // namespace
}  // namespace bqsa::harness
