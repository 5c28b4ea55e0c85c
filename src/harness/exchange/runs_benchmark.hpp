/// @file
/// Times of runs as Google Benchmark's JSON.
#pragma once

#include <string>

#include "harness/exchange/exported_runs.hpp"

namespace bqsa::harness {

/// For each scenario and variant with a success, benchmarks `<scenario>/<variant>/` with the end
/// `step_median` and `step_p99`, or `plan` for a planning method: an entry for each run that was judged a
/// success, and their mean, median and standard deviation. Each says how many of how many runs those are.
/// Where two scenario files have one name, `@` and 8 digits of the file's hash follow it.
std::string runs_benchmark_json(const ExportedRuns& runs);

}  // namespace bqsa::harness
