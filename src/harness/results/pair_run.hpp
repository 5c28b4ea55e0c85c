/// @file
/// One method on one scenario, from the run to the stored record.
#pragma once

#include <string>

#include "harness/judge/judge.hpp"
#include "harness/results/result_store.hpp"
#include "harness/results/run_record.hpp"

namespace bqsa::harness {

struct StoredRun {
  std::string record;            ///< as stored
  std::string trajectory_error;  ///< why the trajectory could not be stored; empty if it was,
                                 ///< or was not to be
};

/// Runs the method if it applies to the scenario, judges it and stores record and trajectory, in
/// this order, so that no older record stands beside a newer trajectory.
/// @param judge  of the scenario's problem
/// @throws InputError if the record cannot be written; then nothing is stored
StoredRun run_pair(const Scenario& scenario, const Judge& judge, const MethodSpec& method,
                   const Circumstances& circumstances, ResultStore& store);

}  // namespace bqsa::harness
