/// @file
/// One method on one scenario, from the run to the stored record.
#pragma once

#include <string>

#include "harness/judge/judge.hpp"
#include "harness/results/result_store.hpp"
#include "harness/results/run_record.hpp"

namespace bqsa::harness {

/// Runs the method if it applies to the scenario, judges and stores trajectory and record.
/// @param judge  of the scenario's problem
/// @returns the record as stored
/// @throws InputError if the results cannot be written
std::string run_pair(const Scenario& scenario, const Judge& judge, const MethodSpec& method,
                     const Circumstances& circumstances, ResultStore& store);

}  // namespace bqsa::harness
