/// @file
/// What the table shows of one run, read from its record.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "harness/input_error.hpp"

namespace bqsa::harness {

/// Numbers that a record holds as null are not a number here.
struct TableRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string scenario;
  std::string sha256;   ///< of the scenario file
  std::string problem;  ///< sizes of the problem, as text
  std::string variant;  ///< method, with the hash of its changed parameters
  std::string changed;  ///< those parameters
  std::string build;    ///< program, compiler and machine, as text
  int ticks = 0;        ///< of the problem

  bool applicable = true;
  bool success = false;  ///< as judged
  bool claim_holds = true;
  std::string claim;                  ///< `success`, `gave up at tick 7`, ...
  std::string claim_detail;           ///< why, if the method says so
  std::vector<std::string> failures;  ///< names of the judge's failures, the most telling first
  std::string disagreement;

  int rows = 0;                       ///< rows of the trajectory, the start included
  std::vector<std::string> collided;  ///< `(6, obstacle)`
  std::vector<std::string> clamped;   ///< `(6, obstacle) x 123`, the number being ticks
  int guard_fired = 0;
  double start_error_m = kNone;  ///< of the tip
  double tip_error_at_ticks_m = kNone;
  double tip_error_between_ticks_m = kNone;
  double clearance_m = kNone;
  bool touching = false;
  double max_joint_step_rad = kNone;

  /// Times are read for successes only: a run that collides, drifts or lies has none.
  double plan_s = kNone;
  double step_median_s = kNone;
  double step_p99_s = kNone;
  std::vector<std::string>
      against_times;  ///< why the times are only indicative; empty if they count
};

/// A length in millimetres, from 10 m on in metres, with its unit.
std::string length_text(double metres);

/// @throws InputError if the text is cut short, is not a record of schema bqsa-run/1, or contradicts
///   itself about success
TableRow parse_run_record(std::string_view record);

}  // namespace bqsa::harness
