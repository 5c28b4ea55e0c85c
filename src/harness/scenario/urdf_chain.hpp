/// @file
/// The part of a robot in URDF (http://wiki.ros.org/urdf/XML) between two links, as a chain.
#pragma once

#include <string>
#include <vector>

#include "bqsa/problem.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {

struct UrdfChain {
  ChainDescription
      chain;           ///< by placements; the base link is W, the tip link's frame that of the tip
  JointLimits limits;  ///< empty if no joint has such a limit; a continuous joint's are infinite
  std::vector<std::string> joints;  ///< names of those of the chain, base to tip
  std::string robot;                ///< name of the whole robot, as the file has it
};

/// Joints that turn (revolute, continuous), that slide (prismatic), and fixed ones; others of the
/// robot may be anything. Values of a prismatic joint are metres, along its axis.
/// Inertia, meshes and what else a URDF file holds are not looked at.
/// @param urdf  the file's text
/// @param base  name of the link that is at rest
/// @param tip   name of a link that hangs from it
/// @throws InputError that says what was expected and what was found, without the file's name
UrdfChain read_urdf_chain(const std::string& urdf, const std::string& base, const std::string& tip);

}  // namespace bqsa::harness
