// How a task's orientation is read, and what R_WT(t) is in between.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "harness/scenario/scenario_files.hpp"

namespace bqsa::harness {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

/// Two links along x; the frame of the tip is turned by 90 degrees about x.
std::string arm(const std::string& path, const std::string& orientation,
                const std::string& more = "") {
  return fmt::format(
      "schema: bqsa-scenario/1\nname: turned\nunits: {{length: m, angle: deg}}\n"
      "robot: {{kind: dh, joints: [{{a: 1, alpha: 90, d: 0}}, {{a: 1, alpha: 0, d: 0}}]}}\n"
      "start: [0, 0]\n{}"
      "task:\n  path: {}\n  timing: {{duration: 2, ticks: 10}}\n  orientation: {}\n",
      more, path, orientation);
}

const std::string kLine = "{kind: line, start_point: [2, 0, 0], end_point: [1.9, 0, 0]}";

Matrix3d about_x(double degrees) {
  return AngleAxisd(degrees * kDegree, Vector3d::UnitX()).toRotationMatrix();
}
Matrix3d about_z(double degrees) {
  return AngleAxisd(degrees * kDegree, Vector3d::UnitZ()).toRotationMatrix();
}

TEST(Orientation, IsPositionOnlyWhereTheKeyIsAbsent) {
  const TestDirectory directory;
  const std::string text = with(arm(kLine, "X"), "  orientation: X\n", "");
  const Problem problem = directory.load(text).problem;
  EXPECT_EQ(problem.task_kind, TaskKind::kPosition);
  EXPECT_FALSE(problem.desired_rotation);
  EXPECT_EQ(problem.rotation_at(1), Matrix3d::Identity());
}

TEST(Orientation, OneRotationHoldsForTheWholePath) {
  const TestDirectory directory;
  const Problem problem =
      directory
          .load(arm(kLine, "{kind: axis, rpy: [90, 0, 30]}", "start_orientation_tolerance: 31\n"))
          .problem;
  EXPECT_EQ(problem.task_kind, TaskKind::kAxis);
  EXPECT_EQ(problem.orientation_tolerance, 1e-2);
  for (const double t : {-1.0, 0.0, 1.3, 2.0, 5.0}) {
    EXPECT_LT((problem.desired_rotation(t) - about_z(30) * about_x(90)).norm(), 1e-14) << t;
  }
}

TEST(Orientation, BetweenTwoItTurnsEvenlyWithThePathsParameter) {
  const TestDirectory directory;
  std::string text = arm(kLine,
                         "{kind: pose, from: {quaternion: [0.70711, 0.70711, 0, 0]}, "
                         "to: {rpy: [90, 0, 60]}}",
                         "orientation_tolerance: 2\n");
  const Problem linear = directory.load(text).problem;
  EXPECT_EQ(linear.task_kind, TaskKind::kPose);
  EXPECT_NEAR(linear.orientation_tolerance, 2 * kDegree, 1e-15);
  const Problem quintic =
      directory.load(with(text, "ticks: 10", "ticks: 10, profile: quintic")).problem;
  for (int k = 0; k <= 8; ++k) {
    const double x = k / 8.0;
    const double s = x * x * x * (10 - 15 * x + 6 * x * x);
    EXPECT_LT((linear.desired_rotation(2 * x) - about_z(60 * x) * about_x(90)).norm(), 1e-12) << k;
    EXPECT_LT((quintic.desired_rotation(2 * x) - about_z(60 * s) * about_x(90)).norm(), 1e-12) << k;
  }
}

TEST(Orientation, WaypointsHaveTheirOwn) {
  const TestDirectory directory;
  const std::string path = "{kind: waypoints, file: way.csv}";
  directory.write("way.csv",
                  "t,x,y,z,qw,qx,qy,qz\n0,2,0,0,0.70711,0.70711,0,0\n"
                  "0.5,2,0,0,-0.8660254,-0.5,0,0\n"  // 60 degrees about x, the other sign
                  "2,1.9,0,0,0.5,0.8660254,0,0\n");  // 120 degrees
  const Problem problem = directory.load(arm(path, "{kind: pose}")).problem;
  EXPECT_LT((problem.desired_rotation(0) - about_x(90)).norm(), 1e-7);
  EXPECT_LT((problem.desired_rotation(0.25) - about_x(75)).norm(), 1e-7);
  EXPECT_LT((problem.desired_rotation(0.5) - about_x(60)).norm(), 1e-7);
  EXPECT_LT((problem.desired_rotation(1) - about_x(80)).norm(), 1e-7);
  EXPECT_LT((problem.desired_rotation(3) - about_x(120)).norm(), 1e-7);

  const auto refusal = [&](const std::string& orientation) {
    return message_of(directory, [&] { directory.load(arm(path, orientation)); });
  };
  EXPECT_EQ(refusal("{kind: pose, rpy: [90, 0, 0]}"),
            "way.csv:1: expected the header t,x,y,z, got t,x,y,z,qw,qx,qy,qz");
  directory.write("way.csv", "t,x,y,z,qw,qx,qy,qz\n0,2,0,0,0.70711,0.70711,0,0\n2,2,0,0,1,1,0,0\n");
  EXPECT_EQ(refusal("{kind: pose}"),
            "way.csv:3: qw: expected a unit quaternion, got one of length 1.41421");
  directory.write(
      "way.csv",
      "t,x,y,z,qw,qx,qy,qz\n0,2,0,0,0.70711,0.70711,0,0\n2,2,0,0,0.70711,-0.70711,0,0\n");
  EXPECT_EQ(refusal("{kind: pose}"),
            "way.csv:3: qw: expected less than half a turn from the row before, got 180 degrees");
  directory.write("way.csv", "t,x,y,z\n0,2,0,0\n2,1.9,0,0\n");
  EXPECT_EQ(refusal("{kind: pose}"),
            "way.csv:1: expected the header t,x,y,z,qw,qx,qy,qz, got t,x,y,z");
  EXPECT_EQ(refusal("{kind: pose, rpy: [90, 0, 0]}"), "no error");
}

/// The spin about the axis does not count where the axis alone is asked for.
TEST(Orientation, TheStartOfAnAxisTaskMaySpin) {
  const TestDirectory directory;
  const std::string spun = "{kind: pose, rpy: [90, 77, 0]}";
  const auto refusal = [&](const std::string& orientation) {
    return message_of(directory, [&] { directory.load(arm(kLine, orientation)); });
  };
  // Rx(90) turned about its own z, which is -y of the world.
  EXPECT_EQ(refusal(spun),
            "s.yaml:9: task.orientation: expected one that begins within 0.572958 deg of the tip's "
            "at the start, quaternion [0.707107, 0.707107, 0, 0], got one that is 77 deg away");
  EXPECT_EQ(refusal(with(spun, "pose", "axis")), "no error");
}

/// `tool_rpy` turns the frame of the tip in the last one, or in the tip link's.
TEST(Orientation, TheToolHasAFrameOfItsOwn) {
  const TestDirectory directory;
  const std::string text = with(arm(kLine, "{kind: pose, rpy: [90, 20, 0]}"), "d: 0}]}",
                                "d: 0}], tool_rpy: [0, 0, -20]}");
  const Problem problem = directory.load(text).problem;
  EXPECT_LT((problem.chain.description().R_LT - about_z(-20)).norm(), 1e-15);

  directory.write("arm.urdf",
                  "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>"
                  "<joint name='i' type='continuous'><parent link='a'/><child link='b'/>"
                  "<axis xyz='0 0 1'/></joint>"
                  "<joint name='j' type='continuous'><parent link='b'/><child link='c'/>"
                  "<origin xyz='1 0 0'/><axis xyz='0 0 1'/></joint>"
                  "<joint name='k' type='fixed'><parent link='c'/><child link='d'/>"
                  "<origin xyz='1 0 0' rpy='1.5707963267948966 0 0'/></joint></robot>");
  const std::string urdf =
      with(arm(kLine, "{kind: pose, rpy: [90, 20, 0]}"),
           "{kind: dh, joints: [{a: 1, alpha: 90, d: 0}, {a: 1, alpha: 0, d: 0}]}",
           "{kind: urdf, file: arm.urdf, base_link: a, tip_link: d, tool: [0, 0, 0], "
           "tool_rpy: [0, 0, -20]}");
  const Problem from_urdf = directory.load(urdf).problem;
  EXPECT_LT((from_urdf.chain.description().R_LT - about_x(90) * about_z(-20)).norm(), 1e-12);
}

}  // namespace
}  // namespace bqsa::harness
