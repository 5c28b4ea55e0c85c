/// @file
/// The detectors, file by file; `detectors()` puts them in one row.
#pragma once

#include <vector>

#include "harness/measuring/detector.hpp"

namespace bqsa::harness {

std::vector<Detector> quadratic_detectors();
std::vector<Detector> test_point_detectors();
std::vector<Detector> exact_distance_detectors();
std::vector<Detector> fcl_detectors();
std::vector<Detector> ccd_detectors();

}  // namespace bqsa::harness
