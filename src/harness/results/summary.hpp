/// @file
/// Many scenarios at a glance: what methods make of families of problems.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/results/table_row.hpp"

namespace bqsa::harness {

/// Plain text of at most 120 columns (names longer than that excepted): how often each method
/// succeeds on each family, why it fails, how accurate and how fast it is, and methods in pairs. Of
/// several runs of the same scenario file, variant and repetition the last counts.
std::string render_summary(const std::vector<TableRow>& rows);

/// A line for each run that failed: scenario, method, class of failure, and where.
std::string render_failures(const std::vector<TableRow>& rows);

/// A line for each run: figures of its motion that decide nothing, and what they mean.
std::string render_motions(const std::vector<TableRow>& rows);

/// Family of a scenario: its name without an end `_s<seed>_<number>`, or else without digits at the
/// end and what joins them.
std::string family_of(const std::string& scenario);

/// The one class of a run that failed: the judge's most telling verdict, or, if the run only stopped
/// early, why its method gave up, `crashed` or `no plan`.
std::string failure_class(const TableRow& row);

}  // namespace bqsa::harness
