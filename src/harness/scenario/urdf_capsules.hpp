/// @file
/// Radii of a chain's links by the collision geometry of the URDF file that it was read from.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "harness/scenario/urdf_chain.hpp"

namespace bqsa::harness {

/// Points of which the convex hull contains a mesh, by the name that the URDF file gives it [m].
using MeshPoints = std::function<std::vector<Eigen::Vector3d>(const std::string& name)>;

/// The least radii, one for each of SerialChain::links, with which the links, as capsules, contain the
/// collision geometry of all URDF links from base to tip and of those that hang from them by fixed
/// joints, whatever the joint values within the limits. What hangs from them by other joints, such as the
/// fingers of a gripper, is not looked at. A radius is 0 where a link has nothing to contain.
///
/// A URDF link is taken by the chain's link that starts in its frame and rests in it. The distance to a
/// segment is convex, so that it is largest in a corner of a box or mesh; of a cylinder the corners of a
/// prism of 720 sides around it are taken, which is at most 1e-5 of its radius too much. Where the
/// chain's link ends at a prismatic joint, both ends of the joint's range are looked at: if a point is
/// within r of the segments from 0 to e0 and to e1, so it is of that to any point e between e0 and e1,
/// since the line from its nearest point on the one to that on the other crosses it.
///
/// A URDF link in whose frame no link starts, as that would have no length, is taken by the last link
/// before or the first one after it, which has an end in its origin: by the one whose radius grows less.
/// If the joint between the two turns about the neighbour's own line, distances to that do not
/// change with the joint; else the link is taken as a ball around its origin.
///
/// @param chain   as read from the file, perhaps with another tool
/// @param limits  of its joints
/// @throws InputError naming the URDF link if geometry is missing or has no positive, finite size; if
///   there is none at all; as read_urdf_chain; and what `mesh` throws
std::vector<double> least_link_radii(const std::string& urdf, const std::string& base,
                                     const std::string& tip, const ChainDescription& chain,
                                     const JointLimits& limits, const MeshPoints& mesh);

}  // namespace bqsa::harness
