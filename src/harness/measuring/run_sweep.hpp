/// @file
/// The sweeps themselves: one process's share of the measuring.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "harness/measuring/contest.hpp"
#include "harness/measuring/sweep.hpp"

namespace bqsa::harness {

/// What is measured along what:
/// - `plane_nm`, `space_nm`: a pass of each detector over all pairs, NM from 1 to 10,000, nk = 27;
/// - `plane_nk`, `space_nk`: the same, nk from 1 to 10,000, NM = 600;
/// - `step_nk`, `space_step_nk`: a control step of each reactive method, a planar and a spatial arm
///   among bystanders, nk from 7 (8) to 7,000 (4,000);
/// - `gate`: a pass of `bqsa` (`once`) against another of the same (`once_again`) and against one and a half
///   passes (`half_more`): what a gate on ratios has to call a tie and a difference;
/// - `speed_pairs`, `speed_steps`: what claims on speed compare (speed_of_pairs.hpp, speed_of_steps.hpp).
std::span<const std::string_view> sweep_names();

/// The sweep that measures nothing but the measuring.
inline constexpr std::string_view kGateSweep = "gate";

/// Whether its times are those of control steps, not of passes of a detector.
bool is_of_steps(std::string_view sweep_name);

struct SweepSettings {
  ContestSettings contest;     ///< at every size
  bool paper_protocol = true;  ///< of test points and of BQSA in the paper's form, besides
  int verified_pairs = 2000;   ///< of each detector at each size, before its time is taken
};

/// Whether it has one size only: its series are compared with each other, and no figure is drawn.
bool is_at_one_size(std::string_view sweep_name);

/// In a process of some 20 s for all sweeps together.
SweepSettings quick_sweeps();
/// More and longer blocks; a process of a minute or two.
SweepSettings full_sweeps();

/// Told what is being measured, as `plane_nm`.
using SweepProgress = std::function<void(const std::string&)>;

/// Everything of one sweep, in this process: all contestants at all sizes in one contest, so that neither
/// ratios nor growth depend on how fast the machine was at the time.
/// @throws InputError for a name that is not one of sweep_names()
/// @throws std::runtime_error if a detector's answers are wrong, or a method is not left alone by
///   bystanders: then there are no times
Sweep run_sweep(std::string_view name, const SweepSettings& settings,
                const SweepProgress& progress = {});

}  // namespace bqsa::harness
