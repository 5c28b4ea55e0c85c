/// @file
/// Whether benchmarks take longer than they did.
#pragma once

#include "harness/measuring/benchmark_file.hpp"
#include "harness/results/comparison_report.hpp"

namespace bqsa::harness {

/// For each benchmark in both: the ratio of medians over repetitions, new over old, with the p of Mann
/// and Whitney's test, and Welch's interval of the ratio of geometric means. It is worse if both
/// ratio and interval lie above the threshold: the test alone finds differences between any two runs.
/// Intervals are as wide as the number of benchmarks asks for (confidence_of_each()). Benchmarks with a
/// single repetition, of other machines or compilers, or only indicative ones are not decided.
/// @throws InputError if there is no benchmark that is in both
ComparisonReport compare_times(const BenchmarkFile& before, const BenchmarkFile& after,
                               const ComparisonSettings& settings = {});

}  // namespace bqsa::harness
