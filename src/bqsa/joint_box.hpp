/// @file
/// Where the joints may be.
#pragma once

#include "bqsa/problem.hpp"

namespace bqsa {

/// Joint angles that a configuration may have: at every joint an interval [rad].
struct JointBox {
  JointVector lower;
  JointVector upper;

  bool contains(const JointVector& q) const {
    return (q.array() >= lower.array()).all() && (q.array() <= upper.array()).all();
  }
};

/// All configurations that one tick can reach from q_last: within the joint limits and the largest
/// steps.
inline JointBox reachable_box(const Problem& problem, const JointVector& q_last) {
  JointBox box{q_last, q_last};
  for (int j = 0; j < problem.chain.joints(); ++j) {
    box.lower(j) -= problem.max_step(j);
    box.upper(j) += problem.max_step(j);
  }
  if (problem.limits.lower.size() > 0) box.lower = box.lower.cwiseMax(problem.limits.lower);
  if (problem.limits.upper.size() > 0) box.upper = box.upper.cwiseMin(problem.limits.upper);
  return box;
}

}  // namespace bqsa
