#include "support/allocation_guard.hpp"

#include <cerrno>
#include <cstddef>

namespace {

thread_local std::uint64_t allocation_count = 0;

}  // namespace

namespace bqsa::test_support {

AllocationGuard::AllocationGuard() : before_(allocation_count) {}

std::uint64_t AllocationGuard::allocations() const { return allocation_count - before_; }

}  // namespace bqsa::test_support

#ifndef __SANITIZE_ADDRESS__

extern "C" {

// The allocator of glibc under its second names.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++allocation_count;
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  ++allocation_count;
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) {
  ++allocation_count;
  return __libc_realloc(block, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocation_count;
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  ++allocation_count;
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

}  // extern "C"

#endif
