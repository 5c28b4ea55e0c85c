/// @file
/// What it costs that methods are told of ellipsoids where the obstacles are solids.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bqsa/problem.hpp"
#include "harness/judge/true_obstacle.hpp"

namespace bqsa::harness {

/// One solid.
struct LedgerEntry {
  std::string name;
  std::string kind;
  int parts = 1;  ///< convex ones, of a mesh one for each piece that hangs together
  int ellipsoids = 1;
  double inflation = 0;  ///< no point of the ellipsoids is further from the solid [m]
  double volume_ratio =
      1;  ///< volumes of the ellipsoids over those of the parts; infinite for flat
  bool within_bounds = true;  ///< the inflation and the ratio that were asked for were reached
  std::optional<double> hull_over_mesh = {};  ///< volumes of a mesh's parts over what it encloses;
                                              ///< none for other solids and meshes not closed
};

struct GeometryLedger {
  std::vector<LedgerEntry> solids;  ///< in the order of the obstacles; empty if all are ellipsoids

  /// Bound of how much narrower the ellipsoids make a gap, between two obstacles or between two
  /// parts of one: the largest sum of the two inflations [m].
  double gap_lost = 0;

  /// Bound of how much further than the links' radius methods have to stay away that add it to the
  /// ellipsoids, `largest_excess_around` [m].
  double radius_excess = 0;
};

/// Adds up the entries of a problem's solids.
GeometryLedger geometry_ledger(const Problem& problem, std::vector<LedgerEntry> solids);

}  // namespace bqsa::harness
