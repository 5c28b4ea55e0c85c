#include "harness/scenario/orientation_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>

namespace bqsa::harness {
namespace {

/// A turn this close to half a turn could as well go the other way [rad].
constexpr double kHalfTurn = std::numbers::pi - 1e-6;

/// Rotation given by `rpy` or `quaternion`, one of which is there.
Eigen::Quaterniond read_rotation(const YamlValue& value, const Units& units) {
  const std::optional<YamlValue> rpy = value.find("rpy");
  const std::optional<YamlValue> quaternion = value.find("quaternion");
  if (rpy && quaternion) quaternion->fail("either rpy or quaternion", "both");
  if (rpy) return Eigen::Quaterniond(read_rpy(*rpy, units));
  return Eigen::Quaterniond(read_quaternion(value.get("quaternion", "rpy or quaternion")));
}

Eigen::Quaterniond read_end(const YamlValue& value, const std::string& key, const Units& units) {
  const YamlValue end = value.get(key, "a mapping of rpy or quaternion");
  end.expect_keys({"rpy", "quaternion"});
  return read_rotation(end, units);
}

}  // namespace

Eigen::Matrix3d Turning::at(double s) const {
  const auto above = std::upper_bound(knots.begin(), knots.end(), s);
  if (rotations.size() == 1 || above == knots.begin()) return rotations.front().toRotationMatrix();
  if (above == knots.end()) return rotations.back().toRotationMatrix();
  const auto next = static_cast<std::size_t>(above - knots.begin());
  const double part = (s - knots[next - 1]) / (knots[next] - knots[next - 1]);
  return rotations[next - 1].slerp(part, rotations[next]).toRotationMatrix();
}

Turning read_orientation(const YamlValue& value, const Units& units, int dimension) {
  if (dimension != 3) value.fail("no orientation, since the robot is planar", "one");
  const std::string kind = value.get("kind", "axis or pose").choice({"axis", "pose"});
  Turning turning{kind == "axis" ? TaskKind::kAxis : TaskKind::kPose};
  if (value.has("from") || value.has("to")) {
    value.expect_keys({"kind", "from", "to"});
    turning.rotations = {read_end(value, "from", units), read_end(value, "to", units)};
    turning.knots = {0, 1};
    const double angle = turning.rotations.front().angularDistance(turning.rotations.back());
    if (!(angle < kHalfTurn)) {
      value.get("to", "").fail("less than half a turn from from", units.show_angle(angle));
    }
    return turning;
  }
  value.expect_keys({"kind", "rpy", "quaternion"});
  if (value.has("rpy") || value.has("quaternion")) {
    turning.rotations = {read_rotation(value, units)};
    turning.knots = {0};
  }
  return turning;
}

void add_waypoint(const WaypointFile& file, std::size_t row, double knot, Turning& turning) {
  const Eigen::Quaterniond rotation = file.quaternion(row, 4);
  if (!turning.rotations.empty()) {
    const double angle = turning.rotations.back().angularDistance(rotation);
    if (!(angle < kHalfTurn)) {
      file.fail(row, "qw", "less than half a turn from the row before",
                fmt::format("{:g} degrees", angle * 180 / std::numbers::pi));
    }
  }
  turning.rotations.push_back(rotation);
  turning.knots.push_back(knot);
}

}  // namespace bqsa::harness
