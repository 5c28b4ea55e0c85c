#include "harness/scenario/urdf_model.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// Collects what the parser would print as a warning or error.
class ParserMessages : public console_bridge::OutputHandler {
 public:
  ParserMessages() { console_bridge::useOutputHandler(this); }
  ~ParserMessages() override { console_bridge::restorePreviousOutputHandler(); }
  ParserMessages(const ParserMessages&) = delete;
  ParserMessages& operator=(const ParserMessages&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (first_.empty() && level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) first_ = text;
  }

  const std::string& first() const { return first_; }

 private:
  std::string first_;
};

/// The parser calls itself for each level of nesting, of which there can be as many as elements.
void check_size(const std::string& urdf) {
  constexpr std::size_t kMostElements = 10'000;
  std::size_t elements = 0;
  for (std::size_t i = 0; i + 1 < urdf.size(); ++i)
    elements += urdf[i] == '<' && urdf[i + 1] != '/' ? 1 : 0;
  if (elements <= kMostElements) return;
  throw InputError(fmt::format("expected a robot of at most {} elements of XML, got {}",
                               kMostElements, elements));
}

urdf::ModelInterfaceSharedPtr parse(const std::string& urdf) {
  check_size(urdf);
  const ParserMessages messages;
  urdf::ModelInterfaceSharedPtr robot;
  try {
    robot = urdf::parseURDF(urdf);
  } catch (const std::exception& error) {
    throw InputError(fmt::format("expected a robot in URDF, got one of which the parser says: {}",
                                 excerpt(error.what())));
  }
  if (robot && !robot->links_.empty()) return robot;
  throw InputError(fmt::format("expected a robot in URDF, got one of which the parser says: {}",
                               messages.first().empty() ? "nothing" : excerpt(messages.first())));
}

std::string names(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& name : list) {
    text += fmt::format("{}'{}'", text.empty() ? "" : ", ", excerpt(name));
  }
  return text.empty() ? "nothing" : text;
}

Vector3d vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

}  // namespace

UrdfModel::UrdfModel(const std::string& urdf) : robot_(parse(urdf)) {}

/// Links hold those that hang from them, which would keep a circle of them for ever.
UrdfModel::~UrdfModel() {
  for (const auto& [name, link] : robot_->links_) link->child_links.clear();
}

const urdf::Link& UrdfModel::link(const std::string& name) const {
  const urdf::LinkConstSharedPtr found = robot_->getLink(name);
  if (found) return *found;
  std::vector<std::string> there;
  for (const auto& [other, unused] : robot_->links_) there.push_back(other);
  throw InputError(fmt::format("expected one of the robot's links, got '{}'; there are {}",
                               excerpt(name), names(there)));
}

std::vector<urdf::JointSharedPtr> UrdfModel::joints_between(const std::string& base,
                                                            const std::string& tip) const {
  std::map<std::string, std::string> above_link;
  for (const auto& [name, joint] : robot_->joints_) {
    const auto [first, is_new] = above_link.try_emplace(joint->child_link_name, name);
    if (is_new) continue;
    throw InputError(
        fmt::format("link '{}': expected one joint that it hangs from, got '{}' and '{}'",
                    excerpt(first->first), excerpt(first->second), excerpt(name)));
  }
  link(base);
  std::vector<urdf::JointSharedPtr> joints;
  std::vector<std::string> above{tip};
  const urdf::Link* at = &link(tip);
  while (at->name != base && at->parent_joint) {
    if (joints.size() == robot_->joints_.size()) {
      throw InputError(
          fmt::format("expected a tree of links, got a circle through '{}'", excerpt(tip)));
    }
    joints.push_back(at->parent_joint);
    at = &link(at->parent_joint->parent_link_name);
    above.push_back(at->name);
  }
  if (at->name != base) {
    throw InputError(
        fmt::format("expected a tip link that hangs from '{}', got '{}', which hangs from {}",
                    excerpt(base), excerpt(tip), names({above.begin() + 1, above.end()})));
  }
  std::ranges::reverse(joints);
  return joints;
}

const char* name_of(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return "revolute";
    case urdf::Joint::CONTINUOUS:
      return "continuous";
    case urdf::Joint::PRISMATIC:
      return "prismatic";
    case urdf::Joint::FLOATING:
      return "floating";
    case urdf::Joint::PLANAR:
      return "planar";
    case urdf::Joint::FIXED:
      return "fixed";
    default:
      return "unknown";
  }
}

void refuse(const urdf::Joint& joint, const std::string& expected, const std::string& got) {
  throw InputError(
      fmt::format("joint '{}': expected {}, got {}", excerpt(joint.name), expected, got));
}

JointPlacement placement(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return {.R_PJ = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix(),
          .p_PJ = vector(pose.position)};
}

JointPlacement composed(const JointPlacement& second, const JointPlacement& first) {
  return {.R_PJ = second.R_PJ * first.R_PJ, .p_PJ = second.p_PJ + second.R_PJ * first.p_PJ};
}

Eigen::Matrix3d along_axis(const urdf::Joint& joint) {
  const Vector3d axis = vector(joint.axis);
  if (!std::isfinite(axis.norm()) || !(axis.norm() > 0)) {
    refuse(joint, "an axis of some length",
           fmt::format("({}, {}, {})", axis.x(), axis.y(), axis.z()));
  }
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis.normalized())
      .toRotationMatrix();
}

}  // namespace bqsa::harness
