/// @file
/// Measurements as a page has them.
#pragma once

#include <string>

#include "harness/measuring/measurements.hpp"
#include "harness/report/json.hpp"

namespace bqsa::harness::report {

/// `Measurements` of the schema: all sweeps of more than one size.
/// @param file  they were read from
Json measurements_json(const Measurements& measurements, const std::string& file);

}  // namespace bqsa::harness::report
