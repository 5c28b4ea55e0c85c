#include <fmt/format.h>

#include <limits>
#include <numbers>
#include <ostream>

#include "harness/program/commands.hpp"
#include "harness/scenario/robot_reader.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMillimetre = 1e-3;

/// A word of YAML in quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

/// As the key `robot` of a scenario would name it.
Robot robot_in_urdf(const InspectOptions& options) {
  if (options.base_link.empty() || options.tip_link.empty()) {
    throw InputError(fmt::format("{}: expected --base-link and --tip-link for a robot in URDF",
                                 options.file.string()));
  }
  const YamlValue value = YamlValue::parse(
      options.file.string(),
      fmt::format("{{kind: urdf, file: {}, base_link: {}, tip_link: {}{}}}",
                  quoted(options.file.filename().string()), quoted(options.base_link),
                  quoted(options.tip_link), options.capsules ? ", link_radius: capsules" : ""));
  NamedFiles files(options.file.parent_path(), options.load.allow_outside);
  return read_robot(value, {}, files);
}

/// Of a scenario or robot file.
Robot robot_in_yaml(const InspectOptions& options) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
  const YamlValue top =
      YamlValue::parse(options.file.string(), read_text_file(options.file, kMaxBytes));
  top.get("schema", "bqsa-scenario/1").choice({"bqsa-scenario/1", "bqsa-robot/1"});
  const Units units = Units::read(top.get("units", "a mapping of length, angle"));
  NamedFiles files(options.file.parent_path(), options.load.allow_outside);
  return read_robot(top.get("robot", "a mapping with a kind"), units, files);
}

/// A joint value or its rate, as `30 deg`.
std::string joint_value(double value, bool prismatic, const char* per_second = "") {
  if (std::isinf(value)) return "-";
  return prismatic ? fmt::format("{:.6g} mm{}", value / kMillimetre, per_second)
                   : fmt::format("{:.6g} deg{}", value / kDegree, per_second);
}

void print_joints(const Robot& robot, std::ostream& out) {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  out << fmt::format("{:<6} {:<24} {:<10} {:>13} {:>13} {:>15}\n", "joint", "name", "type", "from",
                     "to", "at most");
  for (int j = 0; j < robot.chain.joints(); ++j) {
    const auto one = [j](const JointVector& limits) {
      double limit = kUnlimited;
      if (limits.size() > 0) limit = limits(j);
      return limit;
    };
    const bool slides = robot.chain.is_prismatic(j);
    const auto i = static_cast<std::size_t>(j);
    out << fmt::format("{:<6} {:<24} {:<10} {:>13} {:>13} {:>15}\n", j + 1,
                       robot.joint_names.empty() ? "-" : excerpt(robot.joint_names[i]),
                       slides ? "prismatic" : "revolute",
                       joint_value(one(robot.limits.lower), slides),
                       joint_value(one(robot.limits.upper), slides),
                       joint_value(one(robot.limits.max_velocity), slides, "/s"));
  }
}

/// Lengths with prismatic joints at 0.
void print_links(const Robot& robot, std::ostream& out) {
  ChainPose pose;
  robot.chain.forward(JointVector::Zero(robot.chain.joints()), pose);
  double reach = 0;
  out << fmt::format("{:<6} {:>12} {:>12}\n", "link", "length [mm]", "radius [mm]");
  for (std::size_t i = 0; i < robot.chain.links().size(); ++i) {
    const Link& link = robot.chain.links()[i];
    const double length = (pose.p_WO.col(link.end) - pose.p_WO.col(link.start)).norm();
    const double radius = robot.link_radii.empty() ? robot.link_radius : robot.link_radii[i];
    const bool varies =
        link.number <= robot.chain.joints() && robot.chain.is_prismatic(link.end - 1);
    out << fmt::format("{:<6} {:>12} {:>12.4f}\n", link.number,
                       fmt::format("{:.4f}{}", length / kMillimetre, varies ? "*" : ""),
                       radius / kMillimetre);
    reach += length;
    if (!varies) continue;
    const int joint = link.end - 1;
    const bool limited = robot.limits.lower.size() > 0 && robot.limits.upper.size() > 0;
    double slide = std::numeric_limits<double>::infinity();
    if (limited) {
      slide = std::max(std::abs(robot.limits.lower(joint)), std::abs(robot.limits.upper(joint)));
    }
    reach += slide;
  }
  if (robot.chain.has_prismatic_joints()) out << "* with its prismatic joint at 0\n";
  out << fmt::format("reach from the base, at most [mm]: {:.4f}\n", reach / kMillimetre);
}

}  // namespace

Status inspect_robot_command(const InspectOptions& options, const Console& console) {
  const Robot robot =
      options.file.extension() == ".urdf" ? robot_in_urdf(options) : robot_in_yaml(options);
  console.out << fmt::format("robot: {} joints, {} links, in {}\n", robot.chain.joints(),
                             robot.chain.links().size(),
                             robot.chain.dimension() == 2 ? "the plane" : "space");
  if (!robot.name.empty()) console.out << fmt::format("name: {}\n", robot.name);
  print_joints(robot, console.out);
  print_links(robot, console.out);
  return kOk;
}

}  // namespace bqsa::harness
