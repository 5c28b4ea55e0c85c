#include "harness/scenario/urdf_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/scenario/units.hpp"
#include "harness/scenario/urdf_model.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Matrix3d;

/// Coordinates that programs have rounded to nearly nothing are nothing, or there would be a link of
/// that length [m].
constexpr double kNothing = 1e-12;

/// The place of a joint, or of the tip, in the frame before it.
Eigen::Vector3d place(const JointPlacement& placement) {
  return placement.p_PJ.norm() < kNothing ? Eigen::Vector3d::Zero() : placement.p_PJ;
}

bool moves(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS ||
         joint.type == urdf::Joint::PRISMATIC;
}

void add_limits(const std::vector<urdf::JointSharedPtr>& moving, UrdfChain& result) {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  const auto count = static_cast<Eigen::Index>(moving.size());
  JointVector lower = JointVector::Constant(count, -kUnlimited);
  JointVector upper = JointVector::Constant(count, kUnlimited);
  JointVector velocity = JointVector::Zero(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const urdf::Joint& joint = *moving[static_cast<std::size_t>(j)];
    if (joint.type != urdf::Joint::CONTINUOUS) {
      if (!joint.limits) {
        refuse(joint, fmt::format("limits, as a {} joint has them", name_of(joint)), "none");
      }
      lower(j) = joint.limits->lower;
      upper(j) = joint.limits->upper;
      if (!(lower(j) <= upper(j))) {
        refuse(joint, "a lower limit not above the upper one",
               fmt::format("{} and {}", lower(j), upper(j)));
      }
      const bool slides = joint.type == urdf::Joint::PRISMATIC;
      if (slides && !(std::max(-lower(j), upper(j)) <= kMaxLength)) {
        refuse(joint, fmt::format("limits within {} m", kMaxLength),
               fmt::format("{} and {}", lower(j), upper(j)));
      }
    }
    if (joint.limits) velocity(j) = joint.limits->velocity;
  }
  if (lower.array().isFinite().any() || upper.array().isFinite().any()) {
    result.limits.lower = lower;
    result.limits.upper = upper;
  }
  if (!(velocity.array() != 0).any()) return;
  for (Eigen::Index j = 0; j < count; ++j) {
    if (velocity(j) > 0 && std::isfinite(velocity(j))) continue;
    refuse(*moving[static_cast<std::size_t>(j)],
           "a positive velocity limit, as other joints have one", fmt::format("{}", velocity(j)));
  }
  result.limits.max_velocity = velocity;
}

}  // namespace

UrdfChain read_urdf_chain(const std::string& urdf, const std::string& base,
                          const std::string& tip) {
  const UrdfModel model(urdf);
  UrdfChain result;
  result.robot = model.name();
  std::vector<urdf::JointSharedPtr> moving;
  JointPlacement since;  // the last joint that moves, or the base
  for (const urdf::JointSharedPtr& joint : model.joints_between(base, tip)) {
    since = composed(since, placement(joint->parent_to_joint_origin_transform));
    if (!(since.p_PJ.cwiseAbs().maxCoeff() <= kMaxLength)) {
      refuse(*joint, fmt::format("an origin within {} m of the joint before it", kMaxLength),
             "one beyond");
    }
    if (joint->type == urdf::Joint::FIXED) continue;
    if (!moves(*joint)) {
      refuse(*joint, "a revolute, continuous, prismatic or fixed joint", name_of(*joint));
    }
    if (joint->mimic) {
      refuse(*joint, "a joint of its own",
             fmt::format("one that mimics '{}'", excerpt(joint->mimic->joint_name)));
    }
    const Matrix3d R = along_axis(*joint);
    const bool slides = joint->type == urdf::Joint::PRISMATIC;
    result.chain.placements.push_back(
        {.R_PJ = since.R_PJ * R,
         .p_PJ = place(since),
         .type = slides ? JointType::kPrismatic : JointType::kRevolute});
    since = {.R_PJ = R.transpose()};
    moving.push_back(joint);
    result.joints.push_back(joint->name);
  }
  if (moving.empty() || moving.size() > kMaxJoints) {
    throw InputError(fmt::format("expected 1 to {} joints that move between '{}' and '{}', got {}",
                                 kMaxJoints, excerpt(base), excerpt(tip), moving.size()));
  }
  result.chain.p_LT = place(since);
  result.chain.R_LT = since.R_PJ;
  add_limits(moving, result);
  return result;
}

}  // namespace bqsa::harness
