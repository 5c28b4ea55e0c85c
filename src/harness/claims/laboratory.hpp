/// @file
/// What estimators work with: scenarios, methods, measured times, and how much work they may do.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/claims/recorded_run.hpp"
#include "harness/judge/judge.hpp"
#include "harness/measuring/sweep.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa::harness::claims {

/// What is run: a scenario, changed as told, and a method on it.
struct Experiment {
  std::string scenario;         ///< name of a file in the directory of scenarios, without `.yaml`
  std::string method;           ///< `M[:key=value,...]`, a reactive one
  bool obstacles = true;        ///< false: all taken away
  std::string moved = {};       ///< name of an obstacle that is put elsewhere; empty: none
  Eigen::Vector3d center = {};  ///< where its centre is put [m]
  int refinement = 1;           ///< ticks in place of one, each that much shorter

  std::string key() const;  ///< tells experiments apart
};

class Laboratory {
 public:
  struct Settings {
    std::filesystem::path scenarios = "scenarios";
    bool full = false;

    /// Of this program's build; where other programs of the same build are.
    std::filesystem::path build_directory = {};
  };

  /// @param methods, sweeps  outlive the laboratory
  Laboratory(Settings settings, const std::vector<MethodEntry>& methods,
             const std::vector<Sweep>& sweeps)
      : settings_(std::move(settings)), methods_(methods), sweeps_(sweeps) {}

  /// How many samples to draw where a quick evaluation draws so many.
  int samples(int quick) const { return settings_.full ? kFullFactor * quick : quick; }
  static constexpr int kFullFactor = 20;
  bool full() const { return settings_.full; }

  const std::filesystem::path& build_directory() const { return settings_.build_directory; }

  /// The problem of an experiment.
  /// @throws InputError if there is no such scenario or obstacle
  Problem problem(const Experiment& experiment);

  /// The run of an experiment; made once.
  /// @throws InputError for a method that is not there, not reactive or not applicable
  const RecordedRun& run(const Experiment& experiment);

  /// What the judge says of it; judged once.
  const Judgement& judgement(const Experiment& experiment);

  /// A problem of a planar family, made once.
  /// @throws InputError if there is no such family
  const Problem& generated(const std::string& family, std::uint64_t seed, int index);

  /// A reactive method with its parameters.
  /// @throws InputError as run()
  MethodSpec method(const std::string& text) const;

  /// Null if it was not measured.
  const Sweep* sweep(std::string_view name) const;

 private:
  const Scenario& scenario(const std::string& name);

  Settings settings_;
  const std::vector<MethodEntry>& methods_;
  const std::vector<Sweep>& sweeps_;
  std::map<std::string, Scenario> scenarios_;
  std::map<std::string, Problem> generated_;
  std::map<std::string, RecordedRun> runs_;
  std::map<std::string, Judgement> judgements_;
};

}  // namespace bqsa::harness::claims
