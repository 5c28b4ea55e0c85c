/// @file
/// `task.orientation`: how the tip has to be turned on its way.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "bqsa/problem.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/waypoint_file.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// Orientations of the tip frame in W over the path's parameter s in [0, 1]: from knot to knot it turns evenly
/// about one fixed direction, by the smaller of the two angles that lead from one to the other. Less
/// than half a turn, so that this direction is certain.
struct Turning {
  TaskKind kind = TaskKind::kPosition;
  std::vector<Eigen::Quaterniond> rotations = {};  ///< one does not turn
  std::vector<double> knots = {};  ///< parameters at which they are reached, ascending from 0 to 1

  Eigen::Matrix3d at(double s) const;
};

/// Reads `orientation: {kind, ...}`: one rotation, two, or none where they are to come from the waypoints
/// of the path.
/// @param dimension  of the robot's task; in the plane there is no orientation
Turning read_orientation(const YamlValue& value, const Units& units, int dimension);

/// Adds the orientation of a row `t,x,y,z,qw,qx,qy,qz` of the path's waypoints.
void add_waypoint(const WaypointFile& file, std::size_t row, double knot, Turning& turning);

}  // namespace bqsa::harness
