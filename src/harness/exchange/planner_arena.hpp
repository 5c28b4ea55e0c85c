/// @file
/// The SQLite database of Planner Arena (https://plannerarena.org), with columns and tables of our own.
#pragma once

#include <filesystem>

#include "harness/exchange/exported_runs.hpp"

namespace bqsa::harness {

/// Writes the database that `ompl_benchmark_statistics` makes of our logs, row for row, and beside it the
/// tables origins, provenance, parameters, counters, claims, failures, contacts and trajectories
/// (docs/exchange.md).
/// @throws InputError for a file that cannot be written, or beside which a journal of a database lies
void write_planner_arena(const ExportedRuns& runs, const std::filesystem::path& file);

}  // namespace bqsa::harness
