// Numbers of a generated scenario: the random stream, rounding, and that the file is the problem.
#include "harness/generator/scenario_draft.hpp"

#include <gtest/gtest.h>

#include <map>

#include "../scenario/scenario_files.hpp"
#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {
namespace {

TEST(RandomStream, IsSplitMix64) {
  // Published sequence of the seed 1234567.
  RandomStream stream{1234567};
  EXPECT_EQ(stream.bits(), 6457827717110365317U);
  EXPECT_EQ(stream.bits(), 3203168211198807973U);
  EXPECT_EQ(stream.bits(), 9817491932198370423U);
  EXPECT_EQ(stream.bits(), 4593380528125082431U);
  EXPECT_EQ(stream.bits(), 16408922859458223821U);
}

TEST(RandomStream, EveryKeyCounts) {
  std::map<std::uint64_t, int> first;
  for (std::uint64_t a = 0; a < 4; ++a) {
    for (std::uint64_t b = 0; b < 4; ++b) {
      for (std::uint64_t c = 0; c < 4; ++c) ++first[RandomStream{a, b, c}.bits()];
    }
  }
  EXPECT_EQ(first.size(), 64U);
}

TEST(RandomStream, KeepsRangesAndMeans) {
  constexpr int kDraws = 20000;
  RandomStream stream{3, 1, 4};
  double sum = 0, logarithms = 0;
  std::map<int, int> wholes;
  Eigen::Vector3d directions = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector4d quaternion_squares = Eigen::Vector4d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const double u = stream.uniform(-2, 4);
    ASSERT_TRUE(u >= -2 && u < 4);
    sum += u;
    const double l = stream.log_uniform(0.01, 1);
    ASSERT_TRUE(l >= 0.01 && l <= 1);
    logarithms += std::log10(l);
    ++wholes[stream.whole(3, 7)];
    const Eigen::Vector3d d = stream.direction(3);
    ASSERT_NEAR(d.norm(), 1, 1e-12);
    directions += d;
    squares += d.cwiseAbs2();
    const Eigen::Vector3d in_plane = stream.direction(2);
    ASSERT_EQ(in_plane.z(), 0);
    ASSERT_NEAR(in_plane.norm(), 1, 1e-12);
    const Eigen::Vector4d q = stream.quaternion();
    ASSERT_NEAR(q.norm(), 1, 1e-12);
    quaternion_squares += q.cwiseAbs2();
  }
  EXPECT_NEAR(sum / kDraws, 1, 0.05);
  EXPECT_NEAR(logarithms / kDraws, -1, 0.02);
  ASSERT_EQ(wholes.size(), 5U);
  EXPECT_EQ(wholes.begin()->first, 3);
  for (const auto& [value, count] : wholes) EXPECT_NEAR(count, kDraws / 5, 250) << value;
  EXPECT_LT((directions / kDraws).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((squares / kDraws - Eigen::Vector3d::Constant(1.0 / 3)).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((quaternion_squares / kDraws - Eigen::Vector4d::Constant(0.25)).cwiseAbs().maxCoeff(),
            0.01);
}

TEST(Rounded, GivesTheNearestNumberOfSixDecimals) {
  EXPECT_EQ(rounded(0.1234564), 0.123456);
  EXPECT_EQ(rounded(0.1234566), 0.123457);
  EXPECT_EQ(rounded(-2.0000004), -2);
  EXPECT_EQ(rounded(0.4), 0.4);
  EXPECT_FALSE(std::signbit(rounded(-1e-9)));
  EXPECT_EQ(rounded(Eigen::Vector3d(1e-7, 0.5, 1.0 / 3)), Eigen::Vector3d(0, 0.5, 0.333333));
}

TEST(ScenarioDraft, WritesAnyNameOfARobotSoThatItReadsBack) {
  const TestDirectory directory;
  ScenarioDraft draft{.name = "drafted", .description = "one", .robot = {}};
  draft.path = CircleDraft{
      .center = {0, 0, 0}, .radius = 1, .axis_u = {1, 0, 0}, .axis_v = {0, 1, 0}, .turn = 0.5};
  draft.robot.rows = {{0, 0, 0, 0}};
  draft.robot.p_LT = {1, 0, 0};
  draft.limits = {JointVector::Constant(1, -1), JointVector::Constant(1, 1),
                  JointVector::Constant(1, 1)};
  draft.start = JointVector::Zero(1);
  draft.duration = 1;
  draft.ticks = 10;
  draft.obstacles = {{.name = "far",
                      .kind = ShapeKind::kSphere,
                      .center = {9, 9, 9},
                      .semi_axes = Eigen::Vector3d::Constant(0.1),
                      .rotation = {1, 0, 0, 0}}};
  for (const std::string name :
       {"UR5e", "", "a: b # c", "\"quoted\" \\ 'n", "- [x, {y}]", "7", "Müller"}) {
    draft.robot_name = name;
    EXPECT_EQ(directory.load(to_yaml(draft)).robot_name, name);
  }
}

/// The problem of a draft against that of its file, read by the loader.
void expect_same_as_file(const ScenarioDraft& draft) {
  const TestDirectory directory;
  const Problem made = to_problem(draft);
  const Problem read = directory.load(to_yaml(draft)).problem;
  EXPECT_EQ(read.name, made.name);
  EXPECT_EQ(read.ticks, made.ticks);
  EXPECT_EQ(read.dt, made.dt);
  EXPECT_EQ(read.start, made.start);
  EXPECT_EQ(read.limits.lower, made.limits.lower);
  EXPECT_EQ(read.limits.upper, made.limits.upper);
  EXPECT_EQ(read.limits.max_velocity, made.limits.max_velocity);
  ChainPose pose, pose_read;
  made.chain.forward(made.start, pose);
  read.chain.forward(read.start, pose_read);
  EXPECT_EQ(pose.p_WO, pose_read.p_WO);
  ASSERT_EQ(read.obstacles.size(), made.obstacles.size());
  for (int tick = 0; tick <= made.ticks; ++tick) {
    const double t = made.time(tick);
    EXPECT_LT((read.desired_tip(t) - made.desired_tip(t)).norm(), 1e-14) << tick;
    for (std::size_t i = 0; i < made.obstacles.size(); ++i) {
      const Ellipsoid& a = made.obstacles[i].at(tick);
      const Ellipsoid& b = read.obstacles[i].at(tick);
      EXPECT_EQ(read.obstacles[i].moves(), made.obstacles[i].moves());
      EXPECT_LT((a.center() - b.center()).norm(), 1e-14) << tick;
      EXPECT_EQ(a.semi_axes(), b.semi_axes());
      EXPECT_LT((a.quadratic_form() - b.quadratic_form()).norm(), 1e-12 * a.quadratic_form().norm())
          << tick;
    }
  }
}

TEST(ScenarioDraft, PlanarProblemIsThatOfItsFile) {
  ScenarioDraft draft{.name = "drafted", .description = "two", .robot = planar_chain({1, 0.8})};
  draft.limits.max_velocity = JointVector::Constant(2, 0.785398);
  draft.start.resize(2);
  draft.start << 0.25, 1.5;
  ChainPose pose;
  SerialChain(draft.robot).forward(draft.start, pose);
  draft.path = LineDraft{rounded(pose.tip()), {0.6, 0.9, 0}};
  draft.duration = 5;
  draft.ticks = 50;
  draft.obstacles = {{.name = "still",
                      .center = {-1.5, 0.4, 0},
                      .semi_axes = {0.2, 0.1, 0.2},
                      .rotation = {0.7, 0, 0, 0}},
                     {.name = "moved",
                      .center = {-1.5, -0.4, 0},
                      .semi_axes = {0.2, 0.1, 0.2},
                      .rotation = {-0.7, 0, 0, 0},
                      .motion = MotionDraft{{0.1, -0.05, 0}, {0, 0, 0.4}}}};
  expect_same_as_file(draft);
  draft.limits.lower = JointVector::Constant(2, -1.5);
  draft.limits.upper = JointVector::Constant(2, 1.75);
  expect_same_as_file(draft);
  draft.limits = {};
  expect_same_as_file(draft);
}

TEST(ScenarioDraft, SpatialProblemIsThatOfItsFile) {
  ScenarioDraft draft{.name = "drafted", .description = "three", .robot = {}};
  draft.robot.convention = DhConvention::kModified;
  draft.robot.rows = {{0, 0, 0.3, 0.1}, {0.05, -1.5707963267948966, 0, 0}, {0.4, 0, 0.1, -0.2}};
  draft.robot.p_LT = {0.3, 0, 0.05};
  draft.limits = {JointVector::Constant(3, -2.5), JointVector::Constant(3, 2.967059728390360),
                  JointVector::Constant(3, 1.4835298641951802)};
  draft.start = JointVector::Constant(3, 0.4);
  draft.start(2) = 1.6;
  ChainPose pose;
  SerialChain(draft.robot).forward(draft.start, pose);
  const Eigen::Vector3d u(0.267261, 0.534522, 0.801784), v(0.872872, 0.218218, -0.436436);
  draft.path = CircleDraft{.center = rounded(Eigen::Vector3d(pose.tip() - 0.1 * u)),
                           .radius = 0.1,
                           .axis_u = u,
                           .axis_v = v,
                           .turn = 2.5};
  draft.duration = 5;
  draft.ticks = 50;
  draft.obstacles = {{.name = "still",
                      .center = {0, 0, -1},
                      .semi_axes = {0.1, 0.05, 0.03},
                      .rotation = {0.5, -0.5, 0.5, 0.500001}},
                     {.name = "moved",
                      .center = {0, 0, -2},
                      .semi_axes = {0.1, 0.05, 0.03},
                      .rotation = {0.8, 0, 0.6, 0},
                      .motion = MotionDraft{{0.02, 0.1, -0.05}, {0.1, -0.2, 0.4}}}};
  expect_same_as_file(draft);
}

}  // namespace
}  // namespace bqsa::harness
