/// @file
/// Where a run is: written by the control loop, readable from another process while it runs.
#pragma once

#include <atomic>
#include <cstddef>
#include <new>

#include "bqsa/method.hpp"

namespace bqsa::harness {

/// Lives in memory that is shared with another process, which may read it after the run has died.
/// Writing is a few stores a tick: no allocation, no system call.
class RunProgress {
 public:
  /// Size of the memory for a run of so many ticks.
  static constexpr std::size_t bytes(int ticks) {
    return sizeof(RunProgress) + static_cast<std::size_t>(ticks) * kRowBytes;
  }

  /// @param memory  of bytes(ticks), aligned for doubles; not freed
  static RunProgress* make(void* memory) { return new (memory) RunProgress; }

  void begin_tick(int tick) { tick_.store(tick, std::memory_order_relaxed); }

  /// The arm has reached q at the tick that began last.
  void add_row(const JointVector& q) {
    const int row = rows_.load(std::memory_order_relaxed);
    double* place = row_at(row);
    for (int j = 0; j < q.size(); ++j) place[j] = q(j);
    rows_.store(row + 1, std::memory_order_release);
  }

  int tick() const { return tick_.load(std::memory_order_relaxed); }  ///< in progress; 0 before
  int rows() const { return rows_.load(std::memory_order_acquire); }  ///< without the start

  /// Joint angles of the rows after the start [rad].
  /// @param row  0 .. rows() - 1
  JointVector row(int row, int joints) const {
    const double* place = row_at(row);
    JointVector q(joints);
    for (int j = 0; j < joints; ++j) q(j) = place[j];
    return q;
  }

 private:
  static constexpr std::size_t kRowBytes = kMaxJoints * sizeof(double);

  RunProgress() = default;

  double* row_at(int row) {
    return reinterpret_cast<double*>(this + 1) + static_cast<std::size_t>(row) * kMaxJoints;
  }
  const double* row_at(int row) const {
    return reinterpret_cast<const double*>(this + 1) + static_cast<std::size_t>(row) * kMaxJoints;
  }

  std::atomic<int> tick_{0};
  std::atomic<int> rows_{0};
};

}  // namespace bqsa::harness
