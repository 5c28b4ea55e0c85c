/// @file
/// The runs of a results directory by scenario and method, as a page lists them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/exchange/exported_runs.hpp"

namespace bqsa::harness::report {

/// A run, or a pair of method and problem that do not fit.
struct IndexedRun {
  std::size_t scenario = 0;                ///< index into RunIndex::scenarios
  std::size_t method = 0;                  ///< index into RunIndex::methods
  std::size_t origin = 0;                  ///< index into RunIndex::origins
  const ExportedRun* run = nullptr;        ///< null if they do not fit
  const ExportedMisfit* misfit = nullptr;  ///< null if they do

  const TableRow& row() const { return run != nullptr ? run->row : misfit->row; }
};

struct RunIndex {
  std::vector<ExportedScenario> scenarios;  ///< in order of first appearance
  std::vector<ExportedMethod> methods;      ///< in the order of the program's list, then the others
  std::vector<Origin> origins;
  std::vector<IndexedRun> runs;  ///< by scenario, then method
};

/// @param runs   outlive what is returned
/// @param known  the program's methods, for their order
RunIndex index_runs(const ExportedRuns& runs, const std::vector<MethodEntry>& known);

}  // namespace bqsa::harness::report
