#include "harness/measuring/measure_processes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "harness/input_error.hpp"
#include "harness/measuring/measurements.hpp"
#include "harness/temporary_directory.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A shell as the program: `$2` is the number of the process, `$4` the file.
std::vector<std::string> shell(const std::string& script) {
  return {"/bin/sh", "-c", script, "sh"};
}

std::string fault_of(const std::vector<std::string>& command) {
  try {
    measure_processes(command, 3);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

std::string json_with(double seconds) {
  Sweep sweep{.name = "plane_nk", .axis = SweepAxis::kPairs, .sizes = {{}}, .series = {}};
  sweep.series = {{.name = "bqsa", .seconds = {{seconds}}, .paper_seconds = {}}};
  return measurements_json({.origin = {}, .sweeps = {sweep}});
}

TEST(MeasureProcesses, PoolsWhatEachOfThemWrote) {
  const TemporaryDirectory directory;
  for (int i = 1; i <= 3; ++i) {
    write_text_file(directory.path() / std::to_string(i), json_with(i * 1e-6));
  }
  const std::vector<Sweep> pooled =
      measure_processes(shell("cp " + directory.path().string() + "/$2 $4"), 3);
  ASSERT_EQ(pooled.size(), 1u);
  const std::vector<double>& seconds = pooled[0].series[0].seconds[0];
  ASSERT_EQ(seconds.size(), 3u);
  for (int i = 1; i <= 3; ++i) EXPECT_DOUBLE_EQ(seconds[static_cast<std::size_t>(i) - 1], i * 1e-6);
}

TEST(MeasureProcesses, SayWhichOfThemFailedAndHow) {
  EXPECT_THAT(fault_of(shell("exit 3")),
              HasSubstr("measuring process 1 of 3: ended with status 3; nothing is kept"));
  EXPECT_THAT(fault_of(shell("kill -9 $$")), HasSubstr("process 1 of 3: ended by signal 9"));
  EXPECT_THAT(fault_of({"/no/such/program"}), HasSubstr("cannot start /no/such/program"));
  EXPECT_THAT(fault_of(shell("true")), HasSubstr("1.json"));             // wrote nothing
  EXPECT_THAT(fault_of(shell("echo '{' > $4")), HasSubstr("not JSON"));  // or nonsense
}

}  // namespace
}  // namespace bqsa::harness
