/// @file
/// How far it is, on a terminal as one line that is written over, elsewhere now and then.
#pragma once

#include <chrono>
#include <cstddef>
#include <iosfwd>
#include <string>

#include "harness/program/commands.hpp"

namespace bqsa::harness {

class Progress {
 public:
  /// @param shown  else nothing is ever written
  /// @param total  pieces of work
  /// @param lines  writes a line a minute where there is no terminal
  Progress(const Console& console, bool shown, std::size_t total, bool lines = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param done   pieces of work that are done
  /// @param about  what is said besides
  void show(std::size_t done, const std::string& about);

 private:
  using Clock = std::chrono::steady_clock;

  void overwrite(const std::string& text);

  std::ostream& err_;
  bool terminal_;
  bool lines_;
  std::size_t total_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_line_ = start_;
};

}  // namespace bqsa::harness
