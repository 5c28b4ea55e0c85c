/// @file
/// What is done with processes that outlive what started them.
#pragma once

#include <sys/types.h>

#include <vector>

namespace bqsa::harness {

/// Takes in, while it lives, every process below this one that loses its parent, whatever session or
/// group it is in, and ends it.
class StrayProcesses {
 public:
  StrayProcesses();
  StrayProcesses(const StrayProcesses&) = delete;
  StrayProcesses& operator=(const StrayProcesses&) = delete;
  ~StrayProcesses();

  /// Ends and waits for the strays there are, and all that is below them. Children that this process
  /// had before are left alone, ones that it started since must have been waited for.
  /// @return their processor time [s]
  double end();

 private:
  std::vector<pid_t> own_;  ///< children of before
  int took_in_before_ = 0;
};

}  // namespace bqsa::harness
