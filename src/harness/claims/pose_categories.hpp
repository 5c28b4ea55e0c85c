/// @file
/// Categories of all links and obstacles of an arm at one configuration.
#pragma once

#include <vector>

#include "bqsa/geometry/segment_test.hpp"
#include "bqsa/problem.hpp"

namespace bqsa::harness::claims {

struct PairCategory {
  int link = 0;      ///< number
  int obstacle = 0;  ///< index into Problem::obstacles
  Category category = Category::kNoCollision1;
};

/// By links, base to tip, then obstacles, these being where they are at the tick.
std::vector<PairCategory> pair_categories(const Problem& problem, const JointVector& q, int tick);

}  // namespace bqsa::harness::claims
