/// @file
/// Counts heap allocations of the current thread, to prove that a control loop makes none.
///
/// A test program that links allocation_guard.cpp has its malloc, calloc, realloc and the aligned
/// variants replaced by counting ones; operator new and Eigen end up there too. Under the address
/// sanitizer, which brings its own, nothing is counted: kCountsAllocations tells.
#pragma once

#include <cstdint>

namespace bqsa::test_support {

#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kCountsAllocations = false;
#else
inline constexpr bool kCountsAllocations = true;
#endif

/// Allocations of this thread since the guard was made.
class AllocationGuard {
 public:
  AllocationGuard();
  std::uint64_t allocations() const;

 private:
  std::uint64_t before_;
};

}  // namespace bqsa::test_support
