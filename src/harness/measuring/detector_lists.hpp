/// @file
/// The detectors, file by file; `detectors()` puts them in one row.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "harness/measuring/detector.hpp"

namespace bqsa::harness {

std::vector<Detector> quadratic_detectors();
std::vector<Detector> batch_detectors();
std::vector<Detector> test_point_detectors();
std::vector<Detector> exact_distance_detectors();
std::vector<Detector> fcl_detectors();
std::vector<Detector> ccd_detectors();
std::vector<Detector> bullet_detectors();

/// `Detector::multiplications` of the polar form: 9 or 14 a link, and the arm's first point.
double polar_multiplications(const WorkloadSize& size);

/// `Detector::multiplications` of what nobody counts: not a number.
double not_counted(const WorkloadSize& size);

/// A library's query, in the plane and in space.
Detector library_detector(std::string_view name, std::string_view label, std::string_view what,
                          std::unique_ptr<Detection> (*prepare)(const Workload&));

}  // namespace bqsa::harness
