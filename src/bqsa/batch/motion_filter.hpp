/// @file
/// Whole joint-space motions at batch speed: a quick proof that one is free, in front of a slower check.
#pragma once

#include <vector>

#include "bqsa/batch/configuration_check.hpp"

namespace bqsa {

/// Tells of straight joint motions q0 -> q1 of one arm among obstacles at rest that they are certainly
/// free. It is for methods that check many motions; what it does not prove is left to an exact check,
/// whose verdict it does not change.
///
/// No point of the arm moves further than M = max_k sum_j |dq_j| r_jk (SerialChain::speed_bound). The
/// motion is cut into 16 equal parts, whose middles are looked at all at a time
/// (configuration_check.hpp), with the obstacles grown by `spacing` beyond the clearance. If all are free
/// there and M / 32 <= 3/4 spacing, all links keep the clearance and a quarter of the spacing more, all
/// the way. There is a set of obstacles for each of a few spacings; the least that does is taken.
class MotionFilter {
 public:
  /// The spacings [m]; a motion with an M of more than 24 times the last is never certainly free.
  static constexpr double kSpacings[] = {0.0025, 0.01, 0.04, 0.16};

  /// @param chain      must outlive the filter
  /// @param shapes     in the plane `embedded` ellipses
  /// @param clearance  what the links' axes have to keep [m]
  /// @throws std::invalid_argument if the clearance is negative
  MotionFilter(const SerialChain& chain, std::span<const Ellipsoid> shapes, double clearance);

  /// True only if the motion keeps the clearance from end to end. Does not allocate.
  bool certainly_free(const JointVector& q0, const JointVector& q1);

  /// Configurations looked at so far.
  std::uint64_t configurations() const { return looked_at_; }

 private:
  const SerialChain* chain_;
  std::vector<ConfigurationCheck> checks_;  ///< a spacing each
  ConfigurationArray middles_;
  std::uint64_t looked_at_ = 0;
};

}  // namespace bqsa
