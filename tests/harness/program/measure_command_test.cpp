// The command measure: real times, of which nothing is asserted but that they are there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/measuring/measurements.hpp"
#include "program_runner.hpp"

namespace bqsa::harness {
namespace {

using testing::HasSubstr;

class Measure : public testing::Test {
 protected:
  TemporaryDirectory directory_;
  const std::string out_ = (directory_.path() / "m.json").string();
};

TEST_F(Measure, WritesWhatSeveralProcessesMeasuredAndPrintsIt) {
  const ProgramResult result =
      run_bqsa_bench({"measure", "--sweep", "space_step_nk", "--processes", "2", "--out", out_});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");  // progress is for terminals
  EXPECT_THAT(result.out, HasSubstr("space_step_nk: a control step, nk from 4 to 4000"));
  EXPECT_THAT(result.out, HasSubstr("  maciejewski_klein"));

  const Measurements measured = read_measurements(out_);
  ASSERT_EQ(measured.sweeps.size(), 1u);
  EXPECT_EQ(measured.sweeps[0].sizes.size(), 10u);
  for (const Series& series : measured.sweeps[0].series) {
    for (const auto& processes : series.seconds) EXPECT_EQ(processes.size(), 2u) << series.name;
  }
  EXPECT_EQ(measured.origin.effort, "quick");
  EXPECT_THAT(measured.origin.command_line, HasSubstr("measure --sweep space_step_nk"));
  const std::string mark = "! times are only indicative";
  EXPECT_EQ(result.out.starts_with(mark), !measured.origin.against.empty());

  const ProgramResult compared = run_bqsa_bench({"compare", out_, out_});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr("0 better, 0 worse"));
}

TEST_F(Measure, AsOneOfSeveralWritesOnly) {
  const ProgramResult result =
      run_bqsa_bench({"measure", "--sweep", "space_step_nk", "--process", "2", "--out", out_});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_EQ(read_measurements(out_).sweeps[0].series[0].seconds[0].size(), 1u);
}

TEST_F(Measure, RefusesBeforeItMeasures) {
  ProgramResult result = run_bqsa_bench({"measure", "--sweep", "nk", "--out", out_});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("--sweep: expected one of plane_nm, plane_nk, space_nm, "
                                    "space_nk, step_nk, space_step_nk, gate, "
                                    "speed_pairs, speed_steps, got 'nk'"));
  result = run_bqsa_bench({"measure", "--out", "/no/such/directory/m.json"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("/no/such/directory/m.json"));
  EXPECT_EQ(run_bqsa_bench({"measure", "--quick", "--full", "--out", out_}).status, 2);
  EXPECT_EQ(run_bqsa_bench({"measure"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(out_));
}

}  // namespace
}  // namespace bqsa::harness
