/// @file
/// Results of any program made with Google Benchmark, as its JSON reporter writes them.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace bqsa::harness {

/// One benchmark's repetitions.
struct BenchmarkTimes {
  std::string name;
  std::vector<double> seconds;  ///< processor time of an iteration, of each repetition [s]
};

struct BenchmarkFile {
  std::vector<BenchmarkTimes> benchmarks;  ///< in order of appearance
  std::string machine;                     ///< what the file says of the processor
  std::string compiler;                    ///< empty if it does not say
  std::vector<std::string> against;        ///< why its times are only indicative, as far as it says
};

/// @throws InputError naming the file, and line or key, if it is not Google Benchmark's JSON, has no
///   benchmark with times, or an error in one
BenchmarkFile read_benchmark_file(const std::filesystem::path& file);

/// The JSON of a file.
/// @throws InputError naming the file, and the line where it is not JSON
nlohmann::json read_json(const std::filesystem::path& file);

}  // namespace bqsa::harness
