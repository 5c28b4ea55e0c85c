/// @file
/// The blocks of the summary, each a text that ends with a line break or is empty.
#pragma once

#include <string>
#include <vector>

#include "harness/results/summary/tallies.hpp"

namespace bqsa::harness {

/// How a run is classed whose planning method found no plan.
inline constexpr const char* kNoPlan = "no plan";

std::string success_table(const Tallies& tallies);

/// What must not be overlooked: claims that the judge contradicts.
std::string alarms(const Tallies& tallies);

/// Success by robot, for families whose runs are about two or more robots that have a name; empty if there
/// is none. A long name stands in two lines or without its middle.
std::string robot_table(const Tallies& tallies, const std::vector<TableRow>& rows);

std::string failure_table(const Tallies& tallies);

/// What stood in the way of methods that gave up; empty if no run was asked.
std::string why_table(const Tallies& tallies);

/// Methods in pairs, on the scenarios to which both apply, each repetition by itself; empty if no two ever succeeded.
std::string pair_table(const Tallies& tallies, const std::vector<TableRow>& rows);

std::string accuracy_table(const Tallies& tallies);

/// Figures of the motion beyond success; empty if no success has them, as in old records.
std::string motion_table(const Tallies& tallies);

std::string time_table(const Tallies& tallies);

/// Of planning methods; empty if there is no plan.
std::string plan_table(const Tallies& tallies);

}  // namespace bqsa::harness
