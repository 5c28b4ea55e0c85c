/// @file
/// Calls of libraries that some input may crash.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace bqsa::harness {

/// The function of a guarded call did not return.
struct EndedCall : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a function returns, called in a forked process of its own: one that crashes, recurses without
/// end, or wants more than a minute of processor time or 4 GiB of memory costs an exception here.
/// Memory is not limited under the address sanitizer. The calling process must have one thread.
/// @throws InputError as the function does; EndedCall saying how its process ended, or what else it
///   threw; std::system_error if there is no process or pipe to be had
std::string guarded_call(const std::function<std::string()>& function);

}  // namespace bqsa::harness
