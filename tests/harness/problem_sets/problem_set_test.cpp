// Problem sets in the formats of VAMP and Robometrics. Their files here are our own.
#include "harness/problem_sets/problem_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "harness/scenario/scenario_files.hpp"

namespace bqsa::harness {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using Kind = SetObstacle::Kind;

const std::string kFiles = BQSA_SOURCE_DIR "/tests/harness/problem_sets/files/";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string content_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What is said of a set in a file.
std::string refusal(const std::string& name, const std::string& text) {
  const TestDirectory directory;
  return message_of(directory, [&] { read_problem_set(directory.write(name, text)); });
}

TEST(ProblemSet, ReadsTheFormatOfVamp) {
  const std::vector<PlanningProblem> set = read_problem_set(kFiles + "vamp_like.json");
  ASSERT_EQ(set.size(), 3U);
  const PlanningProblem& table = set[0];
  EXPECT_EQ(table.group, "table");
  EXPECT_EQ(table.index, 1);
  ASSERT_EQ(table.obstacles.size(), 3U);
  const SetObstacle& top = table.obstacles[0];
  EXPECT_EQ(top.name, "table top");
  EXPECT_EQ(top.kind, Kind::kBox);
  EXPECT_TRUE(top.size.isApprox(Eigen::Vector3d(0.5, 1, 0.04)));  // twice the half extents
  EXPECT_TRUE(top.center.isApprox(Eigen::Vector3d(0.6, 0, 0.08)));
  const Eigen::Quaterniond turn(top.rotation(0), top.rotation(1), top.rotation(2), top.rotation(3));
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()));
  EXPECT_LT(turn.angularDistance(expected), 1e-12);
  const SetObstacle& can = table.obstacles[2];
  EXPECT_EQ(can.kind, Kind::kCylinder);
  EXPECT_EQ(can.radius, 0.03);
  EXPECT_EQ(can.length, 0.14);
  EXPECT_EQ(table.start.size(), 7);
  EXPECT_EQ(table.start(3), -2.2);
  ASSERT_EQ(table.goals.size(), 1U);
  EXPECT_EQ(table.goals[0](0), 0.9);
  EXPECT_EQ(set[2].obstacles[0].kind, Kind::kSphere);
  EXPECT_EQ(set[2].goals.size(), 2U);
}

TEST(ProblemSet, ReadsTheFormatOfRobometrics) {
  const std::vector<PlanningProblem> set = read_problem_set(kFiles + "robometrics_like.yaml");
  ASSERT_EQ(set.size(), 1U);
  EXPECT_EQ(set[0].group, "shelf_panda");
  ASSERT_EQ(set[0].obstacles.size(), 3U);
  const SetObstacle& board = set[0].obstacles[0];
  EXPECT_EQ(board.name, "board");
  EXPECT_TRUE(board.size.isApprox(Eigen::Vector3d(0.4, 0.6, 0.04)));  // whole lengths
  const Eigen::Quaterniond turn(board.rotation(0), board.rotation(1), board.rotation(2),
                                board.rotation(3));
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitZ()));
  EXPECT_LT(turn.angularDistance(expected), 1e-12);
  EXPECT_EQ(set[0].obstacles[1].length, 0.14);
  EXPECT_TRUE(set[0].obstacles[2].center.isApprox(Eigen::Vector3d(0.3, -0.4, 0.7)));
  ASSERT_EQ(set[0].goals.size(), 2U);
  EXPECT_EQ(set[0].goals[1](0), 0.9);
}

TEST(ProblemSet, ReadsAnglesWhereThereIsNoQuaternion) {
  const TestDirectory directory;
  const std::string text = with(content_of(kFiles + "vamp_like.json"),
                                "\"orientation_quat_xyzw\": [0, 0, 0.04997916927067833, "
                                "0.9987502603949663]",
                                "\"unknown\": 1");
  const auto set = read_problem_set(directory.write("set.json", text));
  EXPECT_NEAR(set[0].obstacles[0].rotation(3), std::sin(0.05), 1e-12);
}

TEST(ProblemSet, RefusesWhatItDoesNotUnderstand) {
  const std::string vamp = content_of(kFiles + "vamp_like.json");
  EXPECT_THAT(refusal("s.json", with(vamp, "0.9987502603949663]", "0.5]")),
              HasSubstr("s.json:1: problems.table[0].box[0].orientation_quat_xyzw: expected a "
                        "quaternion of length 1, got one of length"));
  EXPECT_THAT(refusal("s.json", with(vamp, "[0, 0, 0.1]", "[0, 0, 0.4]")),
              HasSubstr("expected the rotation of orientation_euler_xyz, got one that is"));
  EXPECT_THAT(refusal("s.json", with(vamp, "\"half_extents\": [0.25, 0.5, 0.02]",
                                     "\"half_extents\": [0.25, -0.5, 0.02]")),
              EndsWith("half_extents: expected three positive lengths, got a list of 3"));
  EXPECT_THAT(refusal("s.json", with(vamp, "\"sphere\": []", "\"capsule\": [{}]")),
              HasSubstr("expected obstacles of box, cylinder and sphere alone"));
  EXPECT_THAT(refusal("s.json", with(vamp, "\"goals\": [[0.9, ", "\"goals\": [[")),
              HasSubstr("goals[0]: expected 7 joint values, as in start"));
  EXPECT_THAT(refusal("s.json", "{\"problems\": {}}"), HasSubstr("expected at least one problem"));
  EXPECT_THAT(refusal("s.json", "{\"problems\": 3}"), HasSubstr("problems: expected a mapping"));

  const std::string robometrics = content_of(kFiles + "robometrics_like.yaml");
  EXPECT_THAT(refusal("s.yaml", with(robometrics, "    cuboid:", "    mesh:")),
              HasSubstr("obstacles.mesh: expected a known key"));
  EXPECT_THAT(refusal("s.yaml", with(robometrics, "height: 0.14", "height: 0")),
              HasSubstr("cylinder.can.height: expected a positive length, got 0"));
  EXPECT_THAT(refusal("s.yaml", with(robometrics, "radius: 0.03", "radius: .nan")),
              HasSubstr("cylinder.can.radius: expected a finite number"));
  EXPECT_THAT(refusal("s.yaml", with(robometrics, "  start:", "  begin:")),
              HasSubstr("shelf_panda[0].start: expected a list of joint values"));
}

}  // namespace
}  // namespace bqsa::harness
