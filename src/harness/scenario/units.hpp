/// @file
/// Lengths and angles as a scenario file writes them, converted to metres and radians once.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// No length or coordinate may be larger: its square still has all digits [m].
inline constexpr double kMaxLength = 1e6;

/// No positive length may be smaller: anything thinner vanishes in the band of 1e-6 m around
/// contact in which the judge says "touching" [m].
inline constexpr double kMinLength = 1e-5;

/// No angle may be larger: its last digit is then 2e-12 [rad].
inline constexpr double kMaxAngle = 1e4;

/// The units of a file, and the reading of values in them. Every reader refuses values of the wrong
/// kind, not finite, or out of the ranges above.
struct Units {
  double per_metre = 1;      ///< file units in a metre
  double rad_per_angle = 1;  ///< radians in a file unit
  std::string length_name = "m";
  std::string angle_name = "rad";

  /// `{length: m | mm, angle: deg | rad}`.
  static Units read(const YamlValue& value);

  double length(const YamlValue& value) const;               ///< any sign [m]
  double non_negative_length(const YamlValue& value) const;  ///< [m]
  double positive_length(const YamlValue& value) const;      ///< at least kMinLength [m]
  double radius_or_zero(const YamlValue& value) const;       ///< 0 or at least kMinLength [m]
  double angle(const YamlValue& value) const;                ///< any sign [rad]
  double positive_velocity(const YamlValue& value) const;    ///< angle per second [rad/s]

  /// A point of `dimension` 2 or 3 coordinates; in the plane z = 0 [m].
  Eigen::Vector3d point(const YamlValue& value, int dimension) const;

  /// `size` positive lengths [m].
  Eigen::VectorXd positive_lengths(const YamlValue& value, int size) const;

  /// For messages: metres in the file's unit, as `12.5 mm`.
  std::string show(double metres, int digits = 6) const;

  /// For messages: radians in the file's unit, as `30 deg`.
  std::string show_angle(double radians) const;

  /// For messages: a point in the file's unit, as `(1, 2, 3) mm`.
  std::string show(const Eigen::Vector3d& point, int dimension) const;
};

/// A unit vector of `dimension` 2 or 3 coordinates, to the digits that people write (1e-4), then
/// normalised; in the plane z = 0.
Eigen::Vector3d read_unit_vector(const YamlValue& value, int dimension);

/// How far from 1 the length of a unit vector or quaternion may be as written.
inline constexpr double kUnitTolerance = 1e-4;

/// The rotation Rz(y) Ry(p) Rx(r) about the fixed axes x, y, z [rad].
Eigen::Matrix3d rotation_of_rpy(double r, double p, double y);

/// The same given by `rpy: [r, p, y]`.
Eigen::Matrix3d read_rpy(const YamlValue& value, const Units& units);

/// Rotation given by `quaternion: [w, x, y, z]` of unit length.
Eigen::Matrix3d read_quaternion(const YamlValue& value);

/// Rotation given by either `rpy` or `quaternion` among the keys of a value; none if neither is
/// there.
std::optional<Eigen::Matrix3d> find_rotation(const YamlValue& value, const Units& units);

}  // namespace bqsa::harness
