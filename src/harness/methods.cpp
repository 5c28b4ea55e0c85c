#include "harness/methods.hpp"

#include "baselines/closest_point_methods.hpp"
#include "baselines/extended_jacobian.hpp"
#include "baselines/plain_tracking.hpp"
#include "baselines/planning/ompl_methods.hpp"
#include "baselines/planning/self_motion_search.hpp"
#include "baselines/potential_field.hpp"
#include "baselines/test_point.hpp"
#include "baselines/weighted_least_norm.hpp"
#include "bqsa/bqsa_methods.hpp"

namespace bqsa::harness {

const std::vector<MethodEntry>& methods() {
  // clang-format off
  static const std::vector<MethodEntry> kMethods = {
      baselines::plain_tracking_method(),
      bqsa_method(),
      bqsa_paper_method(),
      bqsa_projection_method(),
      bqsa_lookahead_method(),
      baselines::test_point_method(),
      baselines::maciejewski_klein_method(),
      baselines::fcl_gp_method(),
      baselines::potential_field_method(),
      baselines::weighted_least_norm_method(),
      baselines::extended_jacobian_method(),
      baselines::self_motion_search_method(),
      baselines::ompl_method(),
      baselines::ompl_joint_method(),
  };
  // clang-format on
  return kMethods;
}

}  // namespace bqsa::harness
