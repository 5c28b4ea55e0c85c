/// @file
/// What is noted of the ticks of a run, and what it comes down to.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/runner.hpp"

namespace bqsa::harness {

/// Ticks in which each link-obstacle pair was cleared; storage for all pairs is taken at once.
class PairTally {
 public:
  explicit PairTally(std::size_t obstacles)
      : obstacles_(obstacles), cells_((kMaxLinks + 1) * obstacles) {}

  /// A pair named twice in a tick counts once.
  void add(const Clamp& clamp, int tick) {
    Cell& cell = cells_[static_cast<std::size_t>(clamp.link) * obstacles_ +
                        static_cast<std::size_t>(clamp.obstacle)];
    if (cell.last_tick == tick) return;
    if (cell.ticks == 0 || cell.last_tick != tick - 1) ++starts_;
    ++cell.ticks;
    cell.last_tick = tick;
  }

  /// Times that a pair was cleared that had not been in the tick before.
  int starts() const { return starts_; }

  std::vector<ClampedPair> pairs() const {
    std::vector<ClampedPair> list;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].ticks == 0) continue;
      list.push_back(
          {static_cast<int>(i / obstacles_), static_cast<int>(i % obstacles_), cells_[i].ticks});
    }
    return list;
  }

 private:
  struct Cell {
    int ticks = 0;
    int last_tick = 0;
  };
  std::size_t obstacles_;
  std::vector<Cell> cells_;
  int starts_ = 0;
};

/// Step times, increments and pairs cleared; storage for all ticks is taken at once.
class TickLog {
 public:
  explicit TickLog(const Problem& problem);

  void add_step(const StepInput& input, double seconds);
  /// The clamps must be sound.
  void add_clamps(const StepOutput& output, int tick);

  /// Writes the step times, the increments and the pairs cleared.
  void summarize(RunOutcome& outcome) const;

 private:
  void summarize(RunTimes& times) const;
  void summarize(TickIncrements& summary) const;

  std::vector<double> step_s_;      ///< of the ticks 1, 2, ...
  std::vector<double> increments_;  ///< of each tick in which a link was cleared
  std::int64_t increments_total_ = 0;
  int increments_max_ = 0;  ///< of one clamp
  double slowest_s_ = -1;   ///< of the warm ticks
  JointVector q_slowest_;   ///< what the method was told at that tick
  PairTally tally_;
};

}  // namespace bqsa::harness
