/// @file
/// A robot in URDF as urdfdom reads it, and its joints as the chain has them. Includes headers of
/// urdfdom.
#pragma once

#include <urdf_model/joint.h>
#include <urdf_model/link.h>
#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <string>
#include <vector>

#include "bqsa/kinematics/chain_description.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {

class UrdfModel {
 public:
  /// @throws InputError with what the parser says of a text that is no URDF, or if it is too long for
  ///   the parser
  explicit UrdfModel(const std::string& urdf);
  ~UrdfModel();
  UrdfModel(const UrdfModel&) = delete;
  UrdfModel& operator=(const UrdfModel&) = delete;

  const std::string& name() const { return robot_->getName(); }  ///< of the robot

  /// @throws InputError with the links that there are
  const urdf::Link& link(const std::string& name) const;

  /// The joints between two links, base to tip.
  /// @throws InputError if the tip does not hang from the base
  std::vector<urdf::JointSharedPtr> joints_between(const std::string& base,
                                                   const std::string& tip) const;

 private:
  urdf::ModelInterfaceSharedPtr robot_;
};

const char* name_of(const urdf::Joint& joint);  ///< of its type

/// Throws InputError that names the joint.
[[noreturn]] void refuse(const urdf::Joint& joint, const std::string& expected,
                         const std::string& got);

/// One frame in another.
JointPlacement placement(const urdf::Pose& pose);

/// A frame given in a second one, which is given in a third, in the third.
JointPlacement composed(const JointPlacement& second, const JointPlacement& first);

/// A frame whose z is the joint's axis, in the joint's own frame.
/// @throws InputError if the axis has no length
Eigen::Matrix3d along_axis(const urdf::Joint& joint);

}  // namespace bqsa::harness
