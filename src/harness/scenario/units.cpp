#include "harness/scenario/units.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

namespace bqsa::harness {
namespace {

std::string coordinates(int dimension) { return dimension == 2 ? "[x, y]" : "[x, y, z]"; }

}  // namespace

Units Units::read(const YamlValue& value) {
  value.expect_keys({"length", "angle"});
  Units units;
  if (value.get("length", "m or mm").choice({"m", "mm"}) == "mm") {
    units.per_metre = 1000;
    units.length_name = "mm";
  }
  if (value.get("angle", "deg or rad").choice({"deg", "rad"}) == "deg") {
    units.rad_per_angle = std::numbers::pi / 180;
    units.angle_name = "deg";
  }
  return units;
}

double Units::length(const YamlValue& value) const {
  const double metres = value.number() / per_metre;
  if (std::abs(metres) > kMaxLength) value.fail("a length of at most " + show(kMaxLength));
  return metres;
}

double Units::non_negative_length(const YamlValue& value) const {
  const double metres = length(value);
  if (metres < 0) value.fail("a length of 0 or more");
  return metres;
}

double Units::positive_length(const YamlValue& value) const {
  const double metres = length(value);
  if (!(metres > 0)) value.fail("a positive length");
  if (metres < kMinLength) value.fail("a length of at least " + show(kMinLength));
  return metres;
}

double Units::radius_or_zero(const YamlValue& value) const {
  const double metres = non_negative_length(value);
  if (metres > 0 && metres < kMinLength) {
    value.fail("a length of 0 or at least " + show(kMinLength));
  }
  return metres;
}

double Units::angle(const YamlValue& value) const {
  const double radians = value.number() * rad_per_angle;
  if (std::abs(radians) > kMaxAngle) {
    value.fail(fmt::format("an angle of at most {:g} {}", kMaxAngle / rad_per_angle, angle_name));
  }
  return radians;
}

double Units::positive_velocity(const YamlValue& value) const {
  const double velocity = value.number() * rad_per_angle;
  if (!(velocity > 0)) value.fail(fmt::format("a positive velocity in {}/s", angle_name));
  if (velocity > kMaxAngle) {
    value.fail(
        fmt::format("a velocity of at most {:g} {}/s", kMaxAngle / rad_per_angle, angle_name));
  }
  return velocity;
}

Eigen::Vector3d Units::point(const YamlValue& value, int dimension) const {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  int axis = 0;
  const std::string expected = "a point " + coordinates(dimension);
  for (const YamlValue& element : value.list(expected, static_cast<std::size_t>(dimension))) {
    p(axis++) = length(element);
  }
  return p;
}

Eigen::VectorXd Units::positive_lengths(const YamlValue& value, int size) const {
  Eigen::VectorXd lengths(size);
  int index = 0;
  const std::string expected = fmt::format("{} positive lengths", size);
  for (const YamlValue& element : value.list(expected, static_cast<std::size_t>(size))) {
    lengths(index++) = positive_length(element);
  }
  return lengths;
}

std::string Units::show(double metres, int digits) const {
  return fmt::format("{:.{}g} {}", metres * per_metre, digits, length_name);
}

std::string Units::show_angle(double radians) const {
  return fmt::format("{:g} {}", radians / rad_per_angle, angle_name);
}

std::string Units::show(const Eigen::Vector3d& point, int dimension) const {
  const Eigen::Vector3d p = point * per_metre;
  return dimension == 2 ? fmt::format("({:g}, {:g}) {}", p.x(), p.y(), length_name)
                        : fmt::format("({:g}, {:g}, {:g}) {}", p.x(), p.y(), p.z(), length_name);
}

Eigen::Vector3d read_unit_vector(const YamlValue& value, int dimension) {
  const std::string expected = "a unit vector " + coordinates(dimension);
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  int axis = 0;
  for (const YamlValue& element : value.list(expected, static_cast<std::size_t>(dimension))) {
    v(axis++) = element.number();
  }
  const double norm = v.stableNorm();
  if (!(std::abs(norm - 1) <= kUnitTolerance)) {
    value.fail(expected, fmt::format("one of length {:g}", norm));
  }
  return v / norm;
}

Eigen::Matrix3d rotation_of_rpy(double r, double p, double y) {
  const Eigen::AngleAxisd roll(r, Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd pitch(p, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd yaw(y, Eigen::Vector3d::UnitZ());
  return yaw.toRotationMatrix() * pitch.toRotationMatrix() * roll.toRotationMatrix();
}

Eigen::Matrix3d read_rpy(const YamlValue& value, const Units& units) {
  const std::vector<YamlValue> elements = value.list("three angles [r, p, y]", 3);
  return rotation_of_rpy(units.angle(elements[0]), units.angle(elements[1]),
                         units.angle(elements[2]));
}

Eigen::Matrix3d read_quaternion(const YamlValue& value) {
  const std::string expected = "a unit quaternion [w, x, y, z]";
  Eigen::Vector4d wxyz;
  int index = 0;
  for (const YamlValue& element : value.list(expected, 4)) wxyz(index++) = element.number();
  const double norm = wxyz.stableNorm();
  if (!(std::abs(norm - 1) <= kUnitTolerance)) {
    value.fail(expected, fmt::format("one of length {:g}", norm));
  }
  wxyz /= norm;
  return Eigen::Quaterniond(wxyz(0), wxyz(1), wxyz(2), wxyz(3)).toRotationMatrix();
}

std::optional<Eigen::Matrix3d> find_rotation(const YamlValue& value, const Units& units) {
  const std::optional<YamlValue> rpy = value.find("rpy");
  const std::optional<YamlValue> quaternion = value.find("quaternion");
  if (rpy && quaternion) quaternion->fail("either rpy or quaternion", "both");
  if (rpy) return read_rpy(*rpy, units);
  if (quaternion) return read_quaternion(*quaternion);
  return std::nullopt;
}

}  // namespace bqsa::harness
