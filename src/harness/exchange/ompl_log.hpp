/// @file
/// OMPL's benchmark logs, which `ompl_benchmark_statistics` reads (OMPL 1.5, `ompl::tools::Benchmark`).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/exchange/exported_runs.hpp"

namespace bqsa::harness {

/// The log of one experiment. Real numbers have digits that SQLite, which rounds some texts to a
/// neighbour, reads back as the same.
std::string ompl_log(const ExportedExperiment& experiment, const std::vector<Origin>& origins);

/// Writes the log of the only experiment to a file named `*.log`, or those of all to a directory of any
/// other name: `00001_<experiment>.log`, numbered in their order. Logs of an earlier export into the
/// directory that are not of this one are removed.
/// @return the files, in order
/// @throws InputError for a file if there are several experiments, or what cannot be written
std::vector<std::filesystem::path> write_ompl_logs(const ExportedRuns& runs,
                                                   const std::filesystem::path& place);

}  // namespace bqsa::harness
