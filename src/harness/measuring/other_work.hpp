/// @file
/// How much of the machine others used while we measured.
#pragma once

#include <chrono>

namespace bqsa::harness {

/// Counts the processor time of all but this process and the children that it waited for, time that a
/// hypervisor gave to other machines included. Unlike the load average it knows nothing of what went before.
class OtherWork {
 public:
  /// From now on.
  OtherWork();

  /// Cores that others kept busy, on average since the start; not a number where the system does not say.
  double cores() const;

 private:
  std::chrono::steady_clock::time_point start_;
  double others_s_;  ///< at the start, since the machine did [s]
};

}  // namespace bqsa::harness
