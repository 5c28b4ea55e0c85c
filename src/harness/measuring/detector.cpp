#include "harness/measuring/detector.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "harness/input_error.hpp"
#include "harness/measuring/detector_lists.hpp"

namespace bqsa::harness {

double not_counted(const WorkloadSize&) { return std::numeric_limits<double>::quiet_NaN(); }

Detector library_detector(std::string_view name, std::string_view label, std::string_view what,
                          std::unique_ptr<Detection> (*prepare)(const Workload&)) {
  return {.name = name,
          .label = label,
          .what = what,
          .accuracy = Accuracy::kLibrary,
          .in_plane = true,
          .in_space = true,
          .multiplications = not_counted,
          .prepare = prepare};
}

std::span<const Detector> detectors() {
  static const std::vector<Detector> kDetectors = [] {
    std::vector<Detector> all;
    for (const auto& some :
         {quadratic_detectors(), batch_detectors(), test_point_detectors(),
          exact_distance_detectors(), fcl_detectors(), ccd_detectors(), bullet_detectors()}) {
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }();
  return kDetectors;
}

const Detector& detector_named(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Detector& detector : detectors()) {
    if (detector.name == name) return detector;
    names.push_back(detector.name);
  }
  throw InputError(
      fmt::format("detector: expected one of {}, got '{}'", fmt::join(names, ", "), name));
}

}  // namespace bqsa::harness
