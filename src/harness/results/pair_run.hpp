/// @file
/// One method on one scenario, from the run to the stored record.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "harness/judge/judge.hpp"
#include "harness/results/result_store.hpp"
#include "harness/results/run_record.hpp"

namespace bqsa::harness {

/// A run that took place, or could not, and what the judge says of it.
struct JudgedPair {
  std::string record;
  Claim claim = Claim::kNothing;               ///< of a run that took place
  bool killed = false;                         ///< by a signal 9 that the harness did not send
  std::unique_ptr<StagedTextFile> trajectory;  ///< not yet in its place; null if not to be stored
  std::string trajectory_error;                ///< why it could not be written; else empty
};

/// Runs the method if it applies to the scenario and judges it. Stores nothing but the trajectory, and
/// that leaves an older one in its place until it is committed.
/// @param judge      of the scenario's problem
/// @param directory  of the results
JudgedPair judged_pair(const Scenario& scenario, const Judge& judge, const MethodSpec& method,
                       const Circumstances& circumstances, const std::filesystem::path& directory);

struct StoredRun {
  std::string record;            ///< as stored
  std::string trajectory_error;  ///< why the trajectory could not be stored; empty if it was,
                                 ///< or was not to be
};

/// The same, and stores record and trajectory, in this order, so that no older record stands beside a
/// newer trajectory.
/// @throws InputError if the record cannot be written; then nothing is stored
StoredRun run_pair(const Scenario& scenario, const Judge& judge, const MethodSpec& method,
                   const Circumstances& circumstances, ResultStore& store);

}  // namespace bqsa::harness
