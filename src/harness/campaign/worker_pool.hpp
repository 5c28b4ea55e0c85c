/// @file
/// Work for processes of one thread each, so that what one of them suffers stays with it.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/campaign/campaign_log.hpp"

namespace bqsa::harness {

/// What became of a piece of work.
struct WorkResult {
  std::size_t item = 0;
  std::string answer;
  std::string died;  ///< how the process ended that should have answered; empty if it did answer
};

/// Forked processes that each do one piece of work at a time, each pinned to a processor of its own as far as
/// there are any that this process may use and no other pool on the machine has. They end with the pool,
/// and die with this process whatever it dies of; one that dies is replaced.
///
/// Only the calling thread survives in them: the calling process must have one thread.
class WorkerPool {
 public:
  /// Does the work of one item and says what came out. Must not throw.
  using Work = std::function<std::string(std::size_t item)>;

  /// @throws std::system_error if there is no process or pipe to be had
  WorkerPool(int processes, Work work);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  bool has_idle() const;  ///< a process that has nothing to do
  bool is_busy() const;   ///< any process has something to do

  /// Gives an item to an idle process, of which there must be one.
  /// @throws std::system_error if a process that died cannot be replaced
  void start(std::size_t item);

  /// Waits for the next result of a pool that is busy; nothing if `wake` could be read before.
  /// @param wake  a descriptor
  std::optional<WorkResult> wait(int wake);

 private:
  struct Worker;

  void hire(Worker& worker);
  [[noreturn]] void serve(Worker& worker);
  WorkResult take(Worker& worker);

  Work work_;
  std::vector<FileLock> claims_;  ///< to processors
  std::vector<std::unique_ptr<Worker>> workers_;
};

/// Processors that this process may use, by number.
std::vector<int> usable_processors();

}  // namespace bqsa::harness
