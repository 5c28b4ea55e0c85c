/// @file
/// BQSA that looks ahead along the known path and the known motion of the obstacles; beyond the paper.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bqsa/backward_search.hpp"

namespace bqsa {

struct LookaheadSettings {
  LookaheadSettings() { bqsa.release = Release::kFirst; }

  BqsaSettings bqsa;
  int horizon = 100;       ///< ticks that are imagined ahead
  int branches = 400;      ///< ways around one dead end that are tried, at most
  double lean_turn = 0.5;  ///< turn of the fastest joint that leaning one way comes to [rad]
};

/// A tick that only reacts meets an obstacle when a link is already there. As path and obstacles are
/// known, the same tick can be imagined ahead of time:
///
///   1. The arm follows a plan, the certified configurations of the ticks ahead. Each tick makes the
///      plan's first step and imagines one more tick at its end, by the backward search.
///   2. Where that tick would take a step that is too large, an obstacle is met too late. It is imagined
///      once more without the limit, and the plan is pulled towards it: going back from there, each
///      configuration is moved by the least self-motion to where the next one is within reach, until the
///      plan is met again. The self-motion so starts before contact and is spread over the ticks it takes.
///   3. At a dead end the plan is taken back some ticks, and the arm leans one way from there: besides
///      following the path, one link moves to one side by a self-motion until the dead end is passed.
///      Tried are all links and sides, from 4 ticks before the dead end, then 8, 16, ... back to now.
///
/// The quadratics and certificates are those of the reactive search; nothing is drawn at random. A tick
/// is infeasible only when the plan has come to its end. If the arm is not where it was planned to be,
/// the plan is kept if its next configuration can be reached all the same, certified; otherwise a new
/// plan is made from where the arm is, at the cost of imagining the whole horizon in one tick. So a
/// tick that only moves on costs as much as a reactive one, one that plans up to `horizon` times as
/// much, and one at a dead end up to `branches` times that: times of this method are means, not bounds.
///
/// The path is the problem's; what StepInput says of it is not looked at. Of configurations moved by 2, the
/// clamps reported are those with which they were first imagined.
class BqsaLookahead final : public ReactiveMethod {
 public:
  explicit BqsaLookahead(const LookaheadSettings& settings = {});

  /// @throws std::invalid_argument if the problem has no path
  void prepare(const Problem& problem) override;

  /// Does not allocate, but at dead ends.
  void step(const StepInput& input, StepOutput& output) override;

 private:
  /// Configurations of consecutive ticks, each with how the search came to it; a ring of fixed size.
  class Plan {
   public:
    Plan() = default;
    explicit Plan(int capacity) : rows_(static_cast<std::size_t>(capacity)) {}

    void restart(int tick, const JointVector& q);
    int first_tick() const { return first_; }
    int last_tick() const { return last_; }
    StepOutput& at(int tick) { return rows_[static_cast<std::size_t>(tick) % rows_.size()]; }
    const StepOutput& at(int tick) const {
      return rows_[static_cast<std::size_t>(tick) % rows_.size()];
    }
    void add(const StepOutput& output) { copy(output, at(++last_)); }
    StepOutput& next() { return at(last_ + 1); }  ///< to be written, and then added by `take_next`
    void take_next() { ++last_; }
    void drop_first() { ++first_; }
    void cut_after(int tick) { last_ = tick; }

   private:
    std::vector<StepOutput> rows_;
    int first_ = 0;
    int last_ = -1;
  };

  StepInput input_after(const Plan& plan) const;

  bool leads_on(int now, const JointVector& q);
  bool imagine(Plan& plan, int last);
  bool spread();
  bool pull(int tick, const JointVector& q_next, JointVector& q);
  bool branch(int last);
  bool lean(int from, const Link& link, const Eigen::Vector3d& direction, int last);

  LookaheadSettings settings_;
  const Problem* problem_ = nullptr;
  std::optional<Problem> unhurried_;  ///< the problem with hardly a limit on steps
  std::unique_ptr<BackwardSearch> search_;
  std::unique_ptr<BackwardSearch> unhurried_search_;
  MotionCertificate certificate_;
  WorkCounters certificate_counters_;
  Plan plan_;                        ///< from where the arm is
  std::vector<JointVector> pulled_;  ///< part of the plan, from its end back
  StepOutput dead_end_;              ///< why no tick could be added to the plan
  int hopeless_ = 0;                 ///< tick that no branch could pass; 0 if none
};

}  // namespace bqsa
