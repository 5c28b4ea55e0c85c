#include "harness/scenario/robot_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/scenario/mesh_file.hpp"
#include "harness/scenario/urdf_capsules.hpp"
#include "harness/scenario/urdf_chain.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

void expect_joint_count(const YamlValue& value, std::size_t count) {
  if (count < 1 || count > kMaxJoints) {
    value.fail(fmt::format("1 to {} joints", kMaxJoints), std::to_string(count));
  }
}

ChainDescription read_planar_chain(const YamlValue& value, const Units& units) {
  value.expect_keys({"kind", "name", "base", "links", "limits", "link_radius"});
  const YamlValue links = value.get("links", "a list of link lengths");
  const std::vector<YamlValue> elements = links.list("a list of link lengths");
  expect_joint_count(links, elements.size());
  std::vector<double> lengths;
  lengths.reserve(elements.size());
  for (const YamlValue& element : elements) lengths.push_back(units.positive_length(element));
  Eigen::Vector3d base = Eigen::Vector3d::Zero();
  if (const auto given = value.find("base")) base = units.point(*given, 2);
  return planar_chain(lengths, base.head<2>());
}

DhRow read_row(const YamlValue& value, const Units& units) {
  value.expect_keys({"a", "alpha", "d", "offset", "lower", "upper", "max_velocity"});
  const std::optional<YamlValue> offset = value.find("offset");
  return {.a = units.length(value.get("a", "a length")),
          .alpha = units.angle(value.get("alpha", "an angle")),
          .d = units.length(value.get("d", "a length")),
          .offset = offset ? units.angle(*offset) : 0.0};
}

ChainDescription read_dh_chain(const YamlValue& value, const Units& units,
                               DhConvention convention) {
  value.expect_keys(
      {"kind", "name", "base", "rpy", "joints", "tool", "tool_rpy", "limits", "link_radius"});
  ChainDescription chain;
  chain.convention = convention;
  const YamlValue joints = value.get("joints", "a list of joints");
  const std::vector<YamlValue> rows = joints.list("a list of joints");
  expect_joint_count(joints, rows.size());
  for (const YamlValue& row : rows) chain.rows.push_back(read_row(row, units));
  if (const auto base = value.find("base")) chain.p_WB = units.point(*base, 3);
  if (const auto rpy = value.find("rpy")) chain.R_WB = read_rpy(*rpy, units);
  if (const auto tool = value.find("tool")) chain.p_LT = units.point(*tool, 3);
  if (const auto rpy = value.find("tool_rpy")) chain.R_LT = read_rpy(*rpy, units);
  return chain;
}

using ReadOne = double (Units::*)(const YamlValue&) const;

/// One of the lists of `robot.limits`, one number a joint; empty if absent.
JointVector read_limit_list(const YamlValue& limits, const std::string& key, const Units& units,
                            ReadOne read_one, int joints) {
  const std::optional<YamlValue> list = limits.find(key);
  if (!list) return {};
  JointVector numbers(joints);
  int j = 0;
  const std::string expected = fmt::format("a list of {} numbers, one a joint", joints);
  for (const YamlValue& element : list->list(expected, static_cast<std::size_t>(joints))) {
    numbers(j++) = (units.*read_one)(element);
  }
  return numbers;
}

/// One of the limits in the rows of `robot.joints`; empty if no row has it, else `absent` where it
/// is not given.
JointVector read_row_limit(const std::vector<YamlValue>& rows, const std::string& key,
                           const Units& units, ReadOne read_one, double absent) {
  const auto has_key = [&key](const YamlValue& row) { return row.has(key); };
  if (std::none_of(rows.begin(), rows.end(), has_key)) return {};
  JointVector numbers(static_cast<Eigen::Index>(rows.size()));
  Eigen::Index j = 0;
  for (const YamlValue& row : rows) {
    const std::optional<YamlValue> number = row.find(key);
    numbers(j++) = number ? (units.*read_one)(*number) : absent;
  }
  return numbers;
}

/// A joint row may leave out a limit that others have, but not `max_velocity`: without one a joint
/// has the default largest step, which is no velocity.
void expect_all_velocities(const std::vector<YamlValue>& rows) {
  for (const YamlValue& row : rows) row.get("max_velocity", "a velocity, as other joints have one");
}

JointLimits read_limits(const YamlValue& robot, const Units& units, int joints) {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  JointLimits limits;
  if (const std::optional<YamlValue> list = robot.find("joints")) {
    const std::vector<YamlValue> rows = list->list("a list of joints");
    limits.lower = read_row_limit(rows, "lower", units, &Units::angle, -kUnlimited);
    limits.upper = read_row_limit(rows, "upper", units, &Units::angle, kUnlimited);
    limits.max_velocity =
        read_row_limit(rows, "max_velocity", units, &Units::positive_velocity, kUnlimited);
    if (limits.max_velocity.size() > 0) expect_all_velocities(rows);
  }
  if (const std::optional<YamlValue> lists = robot.find("limits")) {
    if (limits.lower.size() + limits.upper.size() + limits.max_velocity.size() > 0) {
      lists->fail("limits either here or in the joints", "both");
    }
    lists->expect_keys({"lower", "upper", "max_velocity"});
    limits.lower = read_limit_list(*lists, "lower", units, &Units::angle, joints);
    limits.upper = read_limit_list(*lists, "upper", units, &Units::angle, joints);
    limits.max_velocity =
        read_limit_list(*lists, "max_velocity", units, &Units::positive_velocity, joints);
  }
  for (int j = 0; limits.lower.size() > 0 && limits.upper.size() > 0 && j < joints; ++j) {
    if (limits.lower(j) <= limits.upper(j)) continue;
    robot.fail("lower limits not above the upper ones",
               fmt::format("{:g} above {:g} for joint {}", limits.lower(j) / units.rad_per_angle,
                           limits.upper(j) / units.rad_per_angle, j + 1));
  }
  return limits;
}

/// Where a mesh of a URDF file lies, seen from the scenario's directory: packages are not looked for, so
/// that what stands in the package has to stand there.
std::string mesh_path(const std::string& name) {
  constexpr std::string_view kPackage = "package://";
  if (name.starts_with(kPackage)) {
    const std::size_t end = name.find('/', kPackage.size());
    return end == std::string::npos ? "" : name.substr(end + 1);
  }
  if (name.find("://") == std::string::npos) return name;
  throw InputError(
      fmt::format("expected a mesh by package:// or a relative name, got '{}'", excerpt(name)));
}

/// Reads each mesh once.
/// @param value  in whose name files are refused
MeshPoints meshes(const YamlValue& value, NamedFiles& files) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 26;
  std::map<std::string, std::vector<Eigen::Vector3d>> known;
  return [&value, &files, known](const std::string& name) mutable {
    const std::filesystem::path path = mesh_path(name);
    const auto [entry, is_new] = known.try_emplace(path.lexically_normal().string());
    if (!is_new) return entry->second;
    const NamedFiles::File file = files.read(value, path, kMaxBytes);
    for (const MeshPart& part : read_mesh(file.name, file.text)) {
      entry->second.insert(entry->second.end(), part.hull.vertices.begin(),
                           part.hull.vertices.end());
    }
    return entry->second;
  };
}

constexpr std::string_view kCapsules = "capsules";

/// The part of a robot in a URDF file between two of its links, with its limits; placed in W like others.
Robot read_urdf_robot(const YamlValue& value, const Units& units, NamedFiles& files) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 22;
  value.expect_keys({"kind", "name", "file", "base_link", "tip_link", "base", "rpy", "tool",
                     "tool_rpy", "link_radius"});
  const YamlValue file = value.get("file", "a file in URDF");
  const std::string base_link = value.get("base_link", "the name of a link").text();
  const std::string tip_link = value.get("tip_link", "the name of a link").text();
  const auto point = [&](const char* key) -> Eigen::Vector3d {
    const auto found = value.find(key);
    return found ? units.point(*found, 3) : Eigen::Vector3d::Zero();
  };
  const auto turn = [&](const char* key) -> Eigen::Matrix3d {
    const auto found = value.find(key);
    return found ? read_rpy(*found, units) : Eigen::Matrix3d::Identity();
  };
  const Eigen::Vector3d p_WB = point("base"), p_LinkTool = point("tool");
  const Eigen::Matrix3d R_WB = turn("rpy"), R_LinkTool = turn("tool_rpy");
  const auto radius = value.find("link_radius");
  const NamedFiles::File urdf = files.read(file, kMaxBytes);
  UrdfChain read;
  std::vector<double> radii;
  try {
    read = read_urdf_chain(urdf.text, base_link, tip_link);
    read.chain.p_WB = p_WB;
    read.chain.R_WB = R_WB;
    read.chain.p_LT += read.chain.R_LT * p_LinkTool;
    read.chain.R_LT *= R_LinkTool;
    if (radius && radius->is(kCapsules)) {
      radii = least_link_radii(urdf.text, base_link, tip_link, read.chain, read.limits,
                               meshes(file, files));
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", urdf.name, error.what()));
  }
  return {.chain = SerialChain(read.chain),
          .limits = read.limits,
          .link_radii = std::move(radii),
          .joint_names = std::move(read.joints),
          .name = is_title(read.robot) ? read.robot : ""};
}

/// Reads `link_radius`: a length, or a list of them.
void read_link_radius(const YamlValue& value, const Units& units, Robot& robot) {
  if (value.is(kCapsules)) value.fail("capsules for a robot of kind urdf alone");
  if (!value.is_list()) {
    robot.link_radius = units.radius_or_zero(value);
    return;
  }
  const std::size_t links = robot.chain.links().size();
  const std::string expected = fmt::format("a length, or a list of {}, one a link", links);
  for (const YamlValue& element : value.list(expected, links)) {
    robot.link_radii.push_back(units.radius_or_zero(element));
  }
}

Robot read_arm(const YamlValue& value, const Units& units, NamedFiles& files) {
  const std::string kind =
      value.get("kind", "planar, dh, mdh or urdf").choice({"planar", "dh", "mdh", "urdf"});
  if (kind == "urdf") return read_urdf_robot(value, units, files);
  SerialChain chain(kind == "planar" ? read_planar_chain(value, units)
                                     : read_dh_chain(value, units,
                                                     kind == "dh" ? DhConvention::kStandard
                                                                  : DhConvention::kModified));
  JointLimits limits = read_limits(value, units, chain.joints());
  return {.chain = std::move(chain), .limits = std::move(limits)};
}

}  // namespace

Robot read_robot(const YamlValue& value, const Units& units, NamedFiles& files) {
  Robot robot = read_arm(value, units, files);
  if (robot.chain.links().empty()) value.fail("at least one link of positive length", "none");
  if (const auto name = value.find("name")) robot.name = name->title();
  const auto radius = value.find("link_radius");
  if (radius && robot.link_radii.empty()) read_link_radius(*radius, units, robot);
  if (!robot.link_radii.empty()) robot.link_radius = std::ranges::max(robot.link_radii);
  return robot;
}

}  // namespace bqsa::harness
