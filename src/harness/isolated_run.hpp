/// @file
/// A run in a process of its own, so that nothing a method does can touch anything but that run.
#pragma once

#include <cstdint>

#include "harness/runner.hpp"

namespace bqsa::harness {

struct RunLimits {
  double wall_s = 120;                       ///< from fork until the method has ended [s]
  std::uint64_t memory_bytes = 4ULL << 30U;  ///< beyond what the harness itself has [byte]
};

/// Like run_method(), in a forked process that is killed with all its children when it exceeds a
/// limit or has answered.
///
/// A method that ends its process, by a signal or an exit, has crashed; one that exceeds the wall
/// time has timed out; one that gets no memory, or has more than the limit resident, processes that
/// it has started included, is out of memory.
/// Of a reactive method that ends so the rows up to the last tick answered are kept. What it writes
/// to its standard output is lost, the end of its standard error is kept for the message of a crash.
/// The processor time of the process and of all that it has started, as the kernel counts it, has to
/// be explained by the wall time of the run: otherwise work was hidden, or the clock was not the
/// harness' own. Of an external method it is the processor time of the outcome.
///
/// Under the address sanitizer, and of external methods, only resident memory is limited: the sanitizer
/// and the run-times of some languages reserve more address space than any limit.
/// The calling process must have one thread.
/// @throws std::system_error if there is no process or pipe to be had
RunOutcome run_isolated(const Problem& problem, const MethodEntry& method,
                        const ParameterValues& parameters, const RunSettings& settings,
                        const RunLimits& limits);

}  // namespace bqsa::harness
