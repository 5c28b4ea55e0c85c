#include "harness/measuring/detector_passes.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "harness/measuring/verify_detector.hpp"

namespace bqsa::harness {

DetectorPasses::DetectorPasses(const Detector& detector, const Workload& workload)
    : name_(detector.name),
      detection_(detector.prepare(workload)),
      poses_(static_cast<int>(workload.poses.size())),
      hit_(static_cast<std::size_t>(workload.size.pairs())) {}

void DetectorPasses::make(int passes) {
  for (int i = 0; i < passes; ++i) {
    detection_->detect(pose_, hit_);
    hits_ += hit_.back();
    pose_ = pose_ + 1 < poses_ ? pose_ + 1 : 0;
  }
}

void require_right_answers(const Workload& workload, const std::vector<const Detector*>& detectors,
                           int pairs) {
  const ReferenceAnswers reference = reference_answers(workload, pairs);
  for (const Detector* detector : detectors) {
    const std::string broken =
        broken_promise(*detector, verify_detector(*detector, workload, reference));
    if (broken.empty()) continue;
    throw std::runtime_error(fmt::format(
        "nk = {}, NM = {} in {} dimensions: {}; no times are taken", workload.size.pairs(),
        workload.size.point_pairs(), workload.size.dimension, broken));
  }
}

}  // namespace bqsa::harness
