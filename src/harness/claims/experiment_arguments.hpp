/// @file
/// Arguments of the estimators that run a method on a scenario.
#pragma once

#include <vector>

#include "harness/claims/estimator.hpp"
#include "harness/claims/laboratory.hpp"

namespace bqsa::harness::claims {

/// scenario, method, moved, center; followed by `more`.
std::vector<ArgumentDeclaration> experiment_arguments(std::vector<ArgumentDeclaration> more = {});

/// The experiment that they ask for.
/// @throws InputError if `center` is not three numbers
Experiment experiment_of(const Arguments& arguments);

}  // namespace bqsa::harness::claims
