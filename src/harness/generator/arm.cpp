#include "harness/generator/arm.hpp"

#include <vector>

#include "harness/generator/scenario_draft.hpp"

namespace bqsa::harness {

Arm planar_arm(int links) {
  constexpr double kFirstJoint = 1.5;   // [rad]
  constexpr double kOtherJoints = 0.8;  // [rad]
  const double length = rounded(kPlanarReach / links);
  Arm arm{.chain = planar_chain(std::vector<double>(static_cast<std::size_t>(links), length)),
          .reach = links * length};
  arm.start_high = JointVector::Constant(links, kOtherJoints);
  arm.start_high(0) = kFirstJoint;
  arm.start_low = -arm.start_high;
  return arm;
}

}  // namespace bqsa::harness
