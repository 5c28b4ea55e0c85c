#include "harness/scenario/geometry_ledger.hpp"

#include <algorithm>
#include <utility>

#include "bqsa/batch/ellipsoid_around.hpp"

namespace bqsa::harness {

GeometryLedger geometry_ledger(const Problem& problem, std::vector<LedgerEntry> solids) {
  GeometryLedger ledger{.solids = std::move(solids)};
  if (ledger.solids.empty()) return ledger;
  double largest = 0, second = 0;
  for (const LedgerEntry& entry : ledger.solids) {
    second = std::max(second, std::min(largest, entry.inflation));
    largest = std::max(largest, entry.inflation);
    if (entry.parts > 1) ledger.gap_lost = std::max(ledger.gap_lost, 2 * entry.inflation);
  }
  // An ellipsoid that is one by itself is not inflated, and narrows a gap by nothing.
  ledger.gap_lost = std::max(ledger.gap_lost, largest + second);
  if (!(problem.link_radius > 0)) return ledger;
  for (const Obstacle& obstacle : problem.obstacles) {
    ledger.radius_excess =
        std::max(ledger.radius_excess, largest_excess_around(obstacle.shape, problem.link_radius));
  }
  return ledger;
}

}  // namespace bqsa::harness
