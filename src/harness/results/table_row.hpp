/// @file
/// What the table shows of one run, read from its record.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bqsa/work_counters.hpp"
#include "harness/input_error.hpp"
#include "harness/judge/motion_quality.hpp"
#include "harness/log_histogram.hpp"

namespace bqsa::harness {

/// Numbers that a record holds as null are not a number here.
struct TableRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string scenario;
  std::string sha256;    ///< of the scenario file
  std::string problem;   ///< sizes of the problem, as text
  std::string geometry;  ///< what the ellipsoids around solids cost, as text; empty without solids
  std::string robot;     ///< its name; empty if it has none, and of old records
  std::string variant;   ///< method, with the hash of its changed parameters
  std::string changed;   ///< those parameters
  std::string seed;      ///< of a planning method; empty if it answers tick by tick, or is unknown
  std::string key;       ///< CampaignPlace::key; empty if it is not of a campaign
  std::string disturbance;  ///< what disturbed it, as text; empty if nothing did
  std::string build;        ///< program, compiler and machine, as text
  std::string compiler;
  std::string processor;
  int repetition = 0;  ///< CampaignPlace::repetition; 0 if it is not of a campaign
  int ticks = 0;       ///< of the problem

  bool applicable = true;
  bool success = false;  ///< as judged
  bool claim_holds = true;
  bool touching = false;              ///< came within the judge's accuracy of contact
  std::string claim;                  ///< `success`, `gave up at tick 7`, ...
  std::string claim_detail;           ///< why, if the method says so
  std::vector<std::string> failures;  ///< names of the judge's failures, the most telling first
  std::string disagreement;
  std::string gave_up;      ///< name of the reason why a reactive method gave up; else empty
  std::string claim_class;  ///< of a method that gave up: name of its FailureClass, if it is known

  /// Where a run failed, as far as it is known: of a collision the first one, of a method that gave
  /// up the link that it could not free.
  int failure_tick = -1;         ///< -1 if there is none
  int failure_link = 0;          ///< 0 if there is none
  std::string failure_obstacle;  ///< empty if there is none

  int rows = 0;  ///< rows of the trajectory, the start included
  int guard_fired = 0;
  std::vector<std::string> collided;  ///< `(6, obstacle)`
  std::vector<std::string> clamped;   ///< `(6, obstacle) x 123`, the number being ticks
  double start_error_m = kNone;       ///< of the tip
  double tip_error_at_ticks_m = kNone;
  double tip_error_between_ticks_m = kNone;
  double orientation_at_ticks_rad = kNone;  ///< of tasks with an orientation
  double orientation_between_ticks_rad = kNone;
  double clearance_m = kNone;
  double max_joint_step_rad = kNone;
  MotionQuality motion = {};  ///< none in old records
  double clamp_starts = kNone;

  /// Of ticks these are read for successes only: a run that collides, drifts or lies has none.
  double plan_s = kNone;
  double step_median_s = kNone;
  double step_p99_s = kNone;
  LogHistogram step_times;  ///< in RunTimes::kHistogramUnit
  LogHistogram increments;  ///< of the ticks in which a link was cleared
  int increments_max = 0;   ///< likewise, the exact one

  /// Of any run.
  std::optional<WorkCounters> work;
  bool includes_pipe = false;  ///< times of an external method: its answers come through a pipe
  std::vector<std::string> against_times;  ///< why its times are only indicative; success apart
  double slowest_s = kNone;  ///< its slowest tick from 2 on, the one that gave up included
  int slowest_tick = 0;
  std::vector<double> slowest_q;  ///< what the method was told then [rad]; empty in old records
  double run_s = kNone;           ///< wall time of the whole run
};

/// A length in millimetres, from 10 m on in metres, with its unit.
std::string length_text(double metres);

/// @throws InputError if the text is cut short, is not a record of schema bqsa-run/1, or contradicts
///   itself about success or the claim
TableRow parse_run_record(std::string_view record);

/// The last run of each scenario file, variant, seed and repetition, at the place of the first. Keys do not
/// tell runs apart: one of another program has another key and takes the place of the older run.
std::vector<TableRow> last_runs(const std::vector<TableRow>& rows);

/// Number of different scenario files.
std::size_t count_scenarios(const std::vector<TableRow>& rows);

}  // namespace bqsa::harness
