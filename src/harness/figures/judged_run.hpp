/// @file
/// A run as figures show it: what the arm did, where it was, and what the judge says of it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "harness/judge/judge.hpp"
#include "harness/judge/judge_kinematics.hpp"
#include "harness/runner.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa::harness {

struct JudgedRun {
  Scenario scenario;
  std::string method;
  RunOutcome outcome;
  Judgement judgement;

  std::vector<LinkSegment> links;
  std::vector<PointPositions>
      positions;  ///< at the ticks, by the judge's kinematics; row 0 is the start

  const Problem& problem() const { return scenario.problem; }
  const Trajectory& trajectory() const { return outcome.trajectory; }
  std::size_t rows() const { return positions.size(); }
  double time(std::size_t row) const { return problem().time(static_cast<int>(row)); }

  /// End-points of a link at a tick [m].
  Eigen::Vector3d start_of(const LinkSegment& link, std::size_t row) const {
    return positions[row].points[static_cast<std::size_t>(link.start)];
  }
  Eigen::Vector3d end_of(const LinkSegment& link, std::size_t row) const {
    return positions[row].points[static_cast<std::size_t>(link.end)];
  }
};

/// Runs a method of the list with its default parameters and judges the run.
/// @throws InputError if the method does not apply to the scenario
JudgedRun judged_run(const Scenario& scenario, std::string_view method);

/// The tip on its way, between the ticks as well.
struct TipSample {
  double t;  ///< [s]
  bool at_tick;
  Eigen::Vector3d desired;  ///< x_d(t) [m]
  Eigen::Vector3d actual;   ///< on the straight joint motion [m]
};

/// At the ticks from the first one on, and at ten instants between any two of them: what the judge
/// takes its tip errors from.
std::vector<TipSample> tip_samples(const JudgedRun& run);

/// A span of time in which something is so.
struct Span {
  double from;  ///< [s]
  double to;
};

/// When some link is within 0.1 mm of an obstacle at the ticks, each tick standing for half a period
/// before and after it.
std::vector<Span> close_spans(const JudgedRun& run);

/// `bqsa_paper: success`, or how it failed.
std::string verdict_text(const JudgedRun& run);

/// What made the run, for the head of a script.
std::string run_provenance(const JudgedRun& run);

}  // namespace bqsa::harness
