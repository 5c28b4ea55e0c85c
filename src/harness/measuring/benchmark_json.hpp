/// @file
/// Google Benchmark's JSON, as its reporter writes it: the context, then an entry for each repetition and
/// each aggregate of them.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "harness/results/provenance.hpp"

namespace bqsa::harness {

/// Of a benchmark of ours the processor time is the wall time, taken on one thread by a monotonic clock.
class BenchmarkJson {
 public:
  using Json = nlohmann::ordered_json;

  /// @param host        name of the machine
  /// @param assertions  the program had them
  /// @param ours        what we say beyond Google Benchmark
  BenchmarkJson(const MachineState& machine, const std::string& host, bool assertions,
                const Json& ours);

  /// An entry of a benchmark that was run so often.
  /// @param further  what the entry says beyond its time
  void add_repetition(const std::string& name, std::size_t index, std::size_t repetitions,
                      std::int64_t iterations, double seconds, const Json& further);

  /// Mean, median and standard deviation of the repetitions, of which there is at least one.
  void add_aggregates(const std::string& name, std::span<const double> seconds,
                      const Json& further);

  std::string text() const;

 private:
  Json context_;
  std::vector<Json> entries_;
};

}  // namespace bqsa::harness
