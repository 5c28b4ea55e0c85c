// The command compare, on results and benchmarks made up here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/results/result_store.hpp"
#include "program_runner.hpp"

namespace bqsa::harness {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

/// A success of `bqsa` that could be published, as it was recorded.
Json a_success() {
  for (const StoredLine& line : read_lines(runs_file(BQSA_SOURCE_DIR "/results/paper_scenarios"))) {
    Json record = Json::parse(line.text);
    if (record["method"]["variant"] == "bqsa" && record["scenario"]["name"] == "planar_7r") {
      record["times"]["against"] = Json::array();
      record["times"]["warm_median_s"] = 2e-6;
      record["times"]["warm_p99_s"] = 9e-6;
      return record;
    }
  }
  throw std::runtime_error("no reference run of bqsa");
}

class Compare : public testing::Test {
 protected:
  static constexpr std::size_t kRuns = 10;

  Compare() {
    for (std::size_t i = 0; i < kRuns; ++i) {
      Json record = a_success();
      record["scenario"]["name"] = fmt::format("problem_{}", i);
      before_.push_back(record);
    }
    after_ = before_;
  }

  std::string directory(const std::string& name, const std::vector<Json>& records) const {
    const std::filesystem::path path = directory_.path() / name;
    std::filesystem::create_directory(path);
    std::string text;
    for (const Json& record : records) text += record.dump() + '\n';
    write_file(runs_file(path), text);
    return path.string();
  }

  ProgramResult compare(const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words{"compare", directory("old", before_), directory("new", after_)};
    words.insert(words.end(), options.begin(), options.end());
    return run_bqsa_bench(words);
  }

  /// The line of a quantity, with single spaces.
  static std::string row(const ProgramResult& result, const std::string& quantity) {
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string text;
      for (std::string word; words >> word;) text += (text.empty() ? "" : " ") + word;
      if (text.starts_with("bqsa " + quantity)) return text;
    }
    return "no such row";
  }

  TemporaryDirectory directory_;
  std::vector<Json> before_, after_;
};

void fail(Json& record) {
  record["judged"]["success"] = false;
  record["judged"]["failures"] = {"drift"};
  record["claim_holds"] = false;
}

TEST_F(Compare, OfTheSameIsATieAndShort) {
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out,
              testing::MatchesRegex("[0-9]+ compared: [0-9]+ ties, 0 better, 0 worse\n"));
  const ProgramResult all = compare({"--all"});
  EXPECT_EQ(row(all, "success"), "bqsa success 10 of 10 10 of 10 0 lost, 0 won 1.000 tie");
  EXPECT_THAT(row(all, "tick median"), HasSubstr("2 us 2 us x 1.000 1.000 .. 1.000"));
}

TEST_F(Compare, OneLostSuccessIsARegression) {
  fail(after_[3]);
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(row(result, "success"), "bqsa success 10 of 10 9 of 10 1 lost, 0 won 1.000 WORSE");
  EXPECT_THAT(result.out, HasSubstr("0 better, 1 worse"));
}

TEST_F(Compare, OneWonIsNone) {
  fail(before_[3]);
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(row(result, "success"), HasSubstr("0 lost, 1 won 1.000 better"));
}

TEST_F(Compare, AsManyWonAsLostIsATieThatIsShown) {
  fail(before_[3]);
  fail(after_[4]);
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(row(result, "success"), HasSubstr("1 lost, 1 won 1.000 tie"));
}

/// Of a planner one lost of ten may be chance; ten of ten are not.
TEST_F(Compare, PlannersHaveToLoseMoreThanChanceWould) {
  for (Json& record : before_) record["method"]["seed"] = 1;
  after_ = before_;
  fail(after_[3]);
  EXPECT_EQ(compare().status, 0);
  for (Json& record : after_) fail(record);
  EXPECT_EQ(compare().status, 1);
}

TEST_F(Compare, MoreWorkIsARegression) {
  const std::uint64_t quadratics = before_[0]["counters"]["quadratics"];
  after_[0]["counters"]["quadratics"] = quadratics * 2;  // 10 % in all
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(row(result, "quadratics"),
            fmt::format("bqsa quadratics {} {} x 1.100 more in 1, less in 0 1.000 WORSE",
                        10 * quadratics, 11 * quadratics));
  after_[0]["counters"]["quadratics"] = quadratics + 1;  // shown, but the same
  const ProgramResult same = compare();
  EXPECT_EQ(same.status, 0);
  EXPECT_THAT(row(same, "quadratics"), HasSubstr("tie"));
}

TEST_F(Compare, ALargerTipErrorIsARegression) {
  for (Json& record : after_) record["judged"]["tip_error_at_ticks"]["max_m"] = 5e-4;
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(row(result, "tip error"), HasSubstr("0.5 +0.5 +0.5 .. +0.5"));
}

TEST_F(Compare, TimesAreWorseBeyondTheThresholdOnly) {
  const auto slow_down = [this](double factor) {
    for (std::size_t i = 0; i < kRuns; ++i) {
      const double wavering = 1 + 0.01 * static_cast<double>(i % 3);
      after_[i]["times"]["warm_median_s"] = 2e-6 * factor * wavering;
    }
  };
  slow_down(1.05);
  EXPECT_EQ(compare().status, 0);
  slow_down(1.24);
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(row(result, "tick median"), HasSubstr("2 us 2.5 us x 1.252 1.240 .. 1.265"));
  EXPECT_THAT(result.out, HasSubstr("1 worse"));
  EXPECT_EQ(compare({"--threshold", "1.5"}).status, 0);
  slow_down(0.5);
  EXPECT_THAT(row(compare(), "tick median"), HasSubstr("better"));
}

TEST_F(Compare, TimesOfAnotherMachineCannotBeWorse) {
  for (Json& record : after_) {
    record["times"]["warm_median_s"] = 2e-5;
    record["provenance"]["processor"] = "Another";
  }
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(row(result, "tick median"), HasSubstr("x 10.000 10.000 .. 10.000 0.002 not decided"));
  EXPECT_THAT(result.out, HasSubstr("times are not decided upon: processors"));
  after_[0]["counters"]["quadratics"] = 1'000'000'000;
  EXPECT_EQ(compare().status, 1);  // work can
}

TEST_F(Compare, TimesThatAreOnlyIndicativeCannotBeWorse) {
  for (Json& record : after_) {
    record["times"]["warm_median_s"] = 2e-5;
    record["times"]["against"] = {"assertions on"};
  }
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("times are not decided upon: assertions on\n"));
}

TEST_F(Compare, FewTimesDecideNothing) {
  before_.resize(3);
  after_.resize(3);
  for (Json& record : after_) record["times"]["warm_median_s"] = 2e-5;
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("times of fewer than 6 scenarios are not decided upon"));
}

TEST_F(Compare, PairsTheSameScenarioFilesOnly) {
  after_[0]["scenario"]["sha256"] = std::string(64, '0');
  after_.pop_back();
  fail(after_[0]);
  const ProgramResult result = compare();
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("2 of 10 runs only in OLD\n1 of 9 runs only in NEW\n"));
  after_.clear();
  const ProgramResult none = compare();
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("nothing to compare"));
}

TEST_F(Compare, RefusesWhatItCannotRead) {
  const std::string good = directory("good", before_);
  const std::string bad = directory("bad", {before_[0], before_[1], Json("nonsense")});
  ProgramResult result = run_bqsa_bench({"compare", good, bad});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("bad/runs.jsonl:3: not a run record"));

  const std::string file = (directory_.path() / "garbage.json").string();
  write_file(file, "{\n  \"context\": {},\n  garbage\n}\n");
  result = run_bqsa_bench({"compare", file, file});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("garbage.json:3: not JSON"));

  result = run_bqsa_bench({"compare", good, file});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("expected two results directories or two files"));
  EXPECT_EQ(run_bqsa_bench({"compare", good, good + "/missing"}).status, 2);
  EXPECT_EQ(run_bqsa_bench({"compare", good, good, "--threshold", "0.9"}).status, 2);
}

class CompareBenchmarks : public testing::Test {
 protected:
  std::string file(const std::string& name, double factor) const {
    Json json = {{"context", {{"num_cpus", 2}, {"library_build_type", "release"}}}};
    for (int benchmark = 0; benchmark < 3; ++benchmark) {
      for (int r = 0; r < 10; ++r) {
        const double slower = benchmark == 1 ? factor : 1;
        json["benchmarks"].push_back({{"name", fmt::format("BM_{}", benchmark)},
                                      {"run_type", "iteration"},
                                      {"repetition_index", r},
                                      {"cpu_time", slower * (100 + r % 3)},
                                      {"real_time", slower * (100 + r % 3)},
                                      {"time_unit", "ns"}});
      }
    }
    const std::filesystem::path path = directory_.path() / name;
    write_file(path, json.dump());
    return path.string();
  }
  TemporaryDirectory directory_;
};

TEST_F(CompareBenchmarks, FindsTheOneThatGotSlower) {
  const ProgramResult result = run_bqsa_bench({"compare", file("old", 1), file("new", 1.3)});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("BM_1"));
  EXPECT_THAT(result.out, Not(HasSubstr("BM_0")));
  EXPECT_THAT(result.out, HasSubstr("x 1.300"));
  EXPECT_THAT(result.out, HasSubstr("3 compared: 2 ties, 0 better, 1 worse\n"));
  EXPECT_EQ(run_bqsa_bench({"compare", file("old", 1), file("new", 1.05)}).status, 0);
  EXPECT_EQ(run_bqsa_bench({"compare", file("old", 1.3), file("new", 1)}).status, 0);
}

/// Measurements as of a quick `measure`: a few processes, whose times waver by some per cent. One
/// contestant made half as slow again has to be found among a thousand times; the file itself is a tie.
TEST(CompareMeasurements, FindTheContestantThatTakesHalfAsLongAgain) {
  const TemporaryDirectory directory;
  const auto file = [&](const char* name, double factor) {
    Json json = {{"context", {{"num_cpus", 2}, {"library_build_type", "release"}}}};
    for (int contestant = 0; contestant < 80; ++contestant) {
      for (int size = 0; size < 13; ++size) {
        for (int process = 0; process < 4; ++process) {
          const int drawn = (7 * contestant + 5 * size + 3 * process) % 11;
          const double wavering = 1 + 0.004 * drawn;
          json["benchmarks"].push_back(
              {{"name", fmt::format("sweep/{}/nk:{}", contestant, 1 << size)},
               {"run_type", "iteration"},
               {"repetition_index", process},
               {"cpu_time", (contestant == 40 ? factor : 1) * (1 << size) * wavering},
               {"time_unit", "ns"}});
        }
      }
    }
    const std::filesystem::path path = directory.path() / name;
    write_file(path, json.dump());
    return path.string();
  };
  const std::string old = file("old", 1);
  const ProgramResult same = run_bqsa_bench({"compare", old, old});
  EXPECT_EQ(same.status, 0);
  EXPECT_THAT(same.out, HasSubstr("1040 compared: 1040 ties, 0 better, 0 worse\n"));
  const ProgramResult slower = run_bqsa_bench({"compare", old, file("new", 1.5)});
  EXPECT_EQ(slower.status, 1);
  EXPECT_THAT(slower.out, HasSubstr("sweep/40/"));
  EXPECT_THAT(slower.out, Not(HasSubstr("sweep/41/")));
  EXPECT_EQ(run_bqsa_bench({"compare", file("new", 1.5), old}).status, 0);
}

}  // namespace
}  // namespace bqsa::harness
