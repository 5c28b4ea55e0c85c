/// @file
/// The estimators by what they rest on.
#pragma once

#include <vector>

#include "harness/claims/estimator.hpp"

namespace bqsa::harness::claims {

std::vector<Estimator> counting_estimators();    ///< multiplications, counted as they are done
std::vector<Estimator> timing_estimators();      ///< sweeps
std::vector<Estimator> geometry_estimators();    ///< lemmas and categories, in whole numbers
std::vector<Estimator> kinematics_estimators();  ///< the hybrid inverse kinematics
std::vector<Estimator> run_estimators();         ///< runs of methods on scenarios, judged
std::vector<Estimator> behaviour_estimators();   ///< what happens within a run, tick by tick
std::vector<Estimator> answer_estimators();      ///< batches against extended precision
std::vector<Estimator> crowd_estimators();       ///< many obstacles
std::vector<Estimator> companion_estimators();   ///< what other programs of the build find
std::vector<Estimator> speed_estimators();       ///< how close to the machine's limits

}  // namespace bqsa::harness::claims
