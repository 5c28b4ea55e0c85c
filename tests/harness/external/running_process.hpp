/// @file
/// Whether a process is at work.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

namespace bqsa::harness {

/// One that was killed and not yet waited for is not.
inline bool runs(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/stat");
  status.ignore(std::numeric_limits<std::streamsize>::max(), ')');
  char state = 'X';
  status >> state;
  return state != 'X' && state != 'Z';
}

/// Whether it becomes true within a minute.
inline bool within_a_minute(const auto& condition) {
  constexpr int kLooks = 6000;
  for (int i = 0; i < kLooks && !condition(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return condition();
}

}  // namespace bqsa::harness
