#include "bqsa/batch/motion_filter.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace bqsa {
namespace {

constexpr int kMiddles = ConfigurationArray::kBlock;

/// M of the class comment [m].
double longest_way(const SerialChain& chain, const JointVector& q0, const JointVector& q1) {
  const JointVector dq = q1 - q0;
  JointVector travel;
  if (chain.has_prismatic_joints()) travel = q0.cwiseAbs().cwiseMax(q1.cwiseAbs());
  double longest = 0;
  for (const Link& link : chain.links()) {
    double way = 0;
    for (int j = 0; j < chain.moving_joints(link.end); ++j) {
      way += std::abs(dq(j)) * (travel.size() > 0 ? chain.speed_bound(j, link.end, travel)
                                                  : chain.reach(j, link.end));
    }
    longest = std::max(longest, way);
  }
  return longest;
}

}  // namespace

MotionFilter::MotionFilter(const SerialChain& chain, std::span<const Ellipsoid> shapes,
                           double clearance)
    : chain_(&chain), middles_(chain.joints(), kMiddles) {
  for (const double spacing : kSpacings) checks_.emplace_back(chain, shapes, clearance + spacing);
}

bool MotionFilter::certainly_free(const JointVector& q0, const JointVector& q1) {
  const JointVector dq = q1 - q0;
  const double needed = longest_way(*chain_, q0, q1) / (1.5 * kMiddles);
  const auto* spacing = std::ranges::find_if(kSpacings, [&](double s) { return needed <= s; });
  if (spacing == std::end(kSpacings)) return false;
  for (int i = 0; i < kMiddles; ++i) middles_.set(i, q0 + (i + 0.5) / kMiddles * dq);
  std::uint16_t free = 0;
  checks_[static_cast<std::size_t>(spacing - kSpacings)].certainly_free(middles_,
                                                                        std::span(&free, 1));
  looked_at_ += kMiddles;
  return free == 0xFFFF;
}

}  // namespace bqsa
