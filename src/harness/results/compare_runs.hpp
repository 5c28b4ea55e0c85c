/// @file
/// Whether new runs are better or worse than old ones of the same scenarios by the same methods.
#pragma once

#include <vector>

#include "harness/results/comparison_report.hpp"
#include "harness/results/table_row.hpp"

namespace bqsa::harness {

/// Growth of a method's work that is still the same: where compilers round differently, a search may
/// take a step more.
inline constexpr double kSameWork = 0.01;

/// Difference of tip errors that is still none [m].
inline constexpr double kSameTipError = 1e-6;

/// Fewer pairs of times say nothing about what is typical: from six on, all on one side are unlikely
/// by chance (sign test, 3 %).
inline constexpr std::size_t kFewestTimePairs = 6;

/// Pairs runs by scenario file, method with parameters, seed, and repetition; of several the last counts. For
/// each method:
/// - success: worse if more scenarios are lost than won. Methods that answer tick by tick repeat
///   themselves exactly; for planners, whose plans depend on the time they get, the exact sign test
///   (McNemar's) has to agree;
/// - of scenarios that both solved: tip error (median of the differences beyond kSameTipError), work
///   counters (sums; worse by more than kSameWork), times of ticks or of plans (median of the ratios,
///   bootstrap interval).
/// Times of other processors or compilers, or that are only indicative, are compared but not decided.
/// @throws InputError if no run of one set has a partner in the other
ComparisonReport compare_runs(const std::vector<TableRow>& before,
                              const std::vector<TableRow>& after,
                              const ComparisonSettings& settings = {});

}  // namespace bqsa::harness
