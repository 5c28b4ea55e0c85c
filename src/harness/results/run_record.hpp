/// @file
/// One run as one line of JSON (schema bqsa-run/1, docs/results-format.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/failure_class.hpp"
#include "harness/isolated_run.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/motion_quality.hpp"
#include "harness/method_spec.hpp"
#include "harness/results/provenance.hpp"
#include "harness/runner.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {

/// Of which runs the trajectory is stored.
enum class KeptTrajectories { kAll, kFailures, kNone };

/// The place of a run in a campaign.
struct CampaignPlace {
  std::string campaign;  ///< its name
  std::string key;       ///< PlannedRun::key
  int repetition = 1;
};

/// What all runs of one call have in common.
struct Circumstances {
  RunSettings settings;
  std::string command_line;
  KeptTrajectories trajectories = KeptTrajectories::kAll;
  RunLimits limits = {};    ///< of each run
  bool in_process = false;  ///< run in this process and without limits, for profiling
  std::vector<std::string> out_of_tree = {};     ///< methods that were added to the stock program
  int jobs = 1;                                  ///< runs side by side
  std::optional<CampaignPlace> place = {};       ///< of a run of a campaign
  Durability durability = Durability::kProgram;  ///< of trajectories
};

/// Name of a method as it ran, in records, tables and file names: variant_name(), and what disturbed
/// it; in a campaign campaign_variant_name().
std::string variant_name(const MethodSpec& method, const Circumstances& circumstances);

/// The same without the seed of the noise, which in a campaign differs by scenario and repetition.
std::string campaign_variant_name(const MethodSpec& method, const Disturbance& disturbance);

/// Name of the file of a run's trajectory: variant_name(), and the seed of a planning method where it
/// is not the default; in a campaign variant_name() and the first 16 digits of the run's key.
std::string run_name(const MethodSpec& method, const Circumstances& circumstances);

/// A run that took place. Without a line break at the end.
/// @param diagnosis        of a run in which a reactive method gave up
/// @param trajectory_file  relative to the results directory; empty if it was not stored
std::string run_record(const Scenario& scenario, const MethodSpec& method,
                       const RunOutcome& outcome, const std::optional<Diagnosis>& diagnosis,
                       const Judgement& judgement, const MotionQuality& motion,
                       const MachineState& machine, const Circumstances& circumstances,
                       const std::string& trajectory_file);

/// A pair of method and problem that does not fit, and why.
std::string not_applicable_record(const Scenario& scenario, const MethodSpec& method,
                                  const std::string& why, const MachineState& machine,
                                  const Circumstances& circumstances);

}  // namespace bqsa::harness
