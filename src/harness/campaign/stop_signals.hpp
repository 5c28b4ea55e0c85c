/// @file
/// Ctrl-C and the like, put off until it suits.
#pragma once

#include <csignal>

#include "harness/pipe.hpp"

namespace bqsa::harness {

/// While it lives, SIGINT, SIGTERM and SIGHUP stay pending instead of ending this process, but for those
/// that it ignores anyway (nohup). Processes that it forks inherit that, until let_through().
class StopSignals {
 public:
  /// @throws std::system_error if there is no descriptor to be had
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// One that has come, else 0. It stays pending. Also in forked processes, each of which has its own.
  int pending() const;

  /// Can be read when one has come; for poll(). Not to be read.
  int descriptor() const { return descriptor_.number(); }

  /// Ends this process by a signal that has come, as if it had never been put off.
  [[noreturn]] static void die_of(int signal);

  /// For a process that was forked: the signals do again what they do by default.
  static void let_through();

 private:
  sigset_t put_off_;
  sigset_t before_;
  Descriptor descriptor_;
};

}  // namespace bqsa::harness
