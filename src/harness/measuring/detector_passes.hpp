/// @file
/// A detector at work, as sweeps take its time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "harness/measuring/detector.hpp"

namespace bqsa::harness {

/// Passes of a detector over all pairs of a workload, pose after pose.
class DetectorPasses {
 public:
  /// The workload outlives them.
  DetectorPasses(const Detector& detector, const Workload& workload);

  void make(int passes);

  const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::unique_ptr<Detection> detection_;
  int poses_;
  int pose_ = 0;
  std::vector<std::uint8_t> hit_;
  std::uint64_t hits_ = 0;  ///< so that the answers are consumed
};

/// @param pairs  that each detector is asked at least
/// @throws std::runtime_error if the answers of one of them are wrong
void require_right_answers(const Workload& workload, const std::vector<const Detector*>& detectors,
                           int pairs);

}  // namespace bqsa::harness
