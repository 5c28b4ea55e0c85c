// Families of solids on the arms of robots/ against the rules of docs/generator.md, obstacles by
// points on their surfaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "../scenario/scenario_files.hpp"
#include "harness/generator/generator.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/judge_kinematics.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kScenarios = 5;  // one of each arm

const Family& family(const std::string& name) { return *find_family(name); }

const GeneratedScenario& generated(const std::string& name, int index) {
  static std::map<std::pair<std::string, int>, GeneratedScenario> made;
  const std::pair key(name, index);
  const auto found = made.find(key);
  if (found != made.end()) return found->second;
  static const std::vector<Arm> kArms = arms_of(family("clutter"), BQSA_SOURCE_DIR "/robots");
  Rejections ignored;
  const std::vector<Arm>& arms = family(name).spatial ? kArms : std::vector<Arm>();
  return made.emplace(key, generate(family(name), 7, index, arms, ignored)).first->second;
}

/// Points on the surface of a box, its centre and half lengths, columns of R its edges.
std::vector<Vector3d> points_of(const Box& box) {
  std::vector<Vector3d> points;
  constexpr int kSteps = 12;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = -1; side <= 1; side += 2) {
      for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j <= kSteps; ++j) {
          Vector3d s;
          s(axis) = side;
          s((axis + 1) % 3) = 2.0 * i / kSteps - 1;
          s((axis + 2) % 3) = 2.0 * j / kSteps - 1;
          points.push_back(box.center + box.rotation * s.cwiseProduct(box.half_lengths));
        }
      }
    }
  }
  return points;
}

/// Rings on a cylinder; with caps of a capsule.
std::vector<Vector3d> rings(const Vector3d& a, const Vector3d& b, double radius, bool caps) {
  const Vector3d z = (b - a).normalized();
  const Vector3d x = z.unitOrthogonal();
  const Vector3d y = z.cross(x);
  std::vector<Vector3d> points;
  for (int i = 0; i <= 16; ++i) {
    for (int k = 0; k < 24; ++k) {
      const double angle = k * std::numbers::pi / 12;
      const Vector3d out = std::cos(angle) * x + std::sin(angle) * y;
      points.push_back(a + i / 16.0 * (b - a) + radius * out);
      if (!caps) continue;
      const double rise = i * std::numbers::pi / 32;
      points.push_back(b + radius * (std::cos(rise) * out + std::sin(rise) * z));
      points.push_back(a + radius * (std::cos(rise) * out - std::sin(rise) * z));
    }
  }
  return points;
}

std::vector<Vector3d> points_of(const Solid& solid) {
  if (const auto* const box = std::get_if<Box>(&solid)) return points_of(*box);
  if (const auto* const capsule = std::get_if<Capsule>(&solid)) {
    return rings(capsule->a, capsule->b, capsule->radius, true);
  }
  const auto& cylinder = std::get<Cylinder>(solid);
  return rings(cylinder.a, cylinder.b, cylinder.radius, false);
}

double distance(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d d = b - a;
  const double s = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0;
  return (p - a - s * d).norm();
}

class Scenes : public ::testing::TestWithParam<std::string> {
 protected:
  Scenario scenario(int index) const { return directory_.load(generated(GetParam(), index).yaml); }

 private:
  TestDirectory directory_;
};

TEST_P(Scenes, AreSolvedByTheirWitnessesFarFromTheTruth) {
  for (int index = 0; index < kScenarios; ++index) {
    SCOPED_TRACE(index);
    const GeneratedScenario& made = generated(GetParam(), index);
    const Scenario loaded = scenario(index);
    const Problem& problem = loaded.problem;
    const Judgement judgement = Judge(problem, loaded.truth).judge(made.witness);
    for (const Failure failure : judgement.failures) ADD_FAILURE() << name_of(failure);
    ASSERT_TRUE(loaded.reference_clearance);
    EXPECT_NEAR(*loaded.reference_clearance, judgement.clearance, 1e-5);
    EXPECT_GE(judgement.clearance_at_ticks, 0.010 - 1e-6);

    const JudgeKinematics kinematics(problem.chain.description());
    PointPositions positions;
    double least = 1;
    for (const TrueObstacle& obstacle : loaded.truth) {
      for (const Solid& part : obstacle.parts) {
        const std::vector<Vector3d> points = points_of(part);
        for (int tick = 0; tick <= problem.ticks; tick += 20) {
          kinematics.place(made.witness.q[static_cast<std::size_t>(tick)], positions);
          for (std::size_t k = 0; k < problem.chain.links().size(); ++k) {
            const Link& link = problem.chain.links()[k];
            const Vector3d& a = positions.points[static_cast<std::size_t>(link.start)];
            const Vector3d& b = positions.points[static_cast<std::size_t>(link.end)];
            for (const Vector3d& p : points) {
              least = std::min(least, distance(p, a, b) - problem.radius_of(k));
            }
          }
        }
      }
    }
    EXPECT_GE(least, 0.010 - 1e-6);
  }
}

class ScenesOfRealArms : public Scenes {};

TEST_P(ScenesOfRealArms, HaveThemInTurnWithAGripperAndThickLinks) {
  for (int index = 0; index < kScenarios; ++index) {
    const Problem problem = scenario(index).problem;
    const double first = problem.chain.description().rows.front().d;
    EXPECT_EQ(first, (std::vector{0.36, 0.333, 0.1625, 0.1807, 0.0}.at(index % 5))) << index;
    EXPECT_GE(problem.chain.description().p_LT.z(), 0.15) << index;
    for (std::size_t link = 0; link < problem.chain.links().size(); ++link) {
      EXPECT_GE(problem.radius_of(link), 0.04) << index;
      EXPECT_LE(problem.radius_of(link), 0.08) << index;
    }
    EXPECT_EQ(problem.limits.max_velocity.size(), problem.chain.joints()) << index;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ScenesOfRealArms,
                         ::testing::Values("clutter", "corridor", "shelf", "crossing", "stretched"),
                         [](const auto& tested) { return tested.param; });

INSTANTIATE_TEST_SUITE_P(All, Scenes,
                         ::testing::Values("clutter", "corridor", "shelf", "crossing", "stretched",
                                           "any_arm"),
                         [](const auto& tested) { return tested.param; });

TEST(Clutter, HasTwoToTenSolidsOfAllKinds) {
  std::set<std::size_t> kinds;
  std::set<std::size_t> numbers;
  int balls = 0;
  const TestDirectory directory;
  for (int index = 0; index < 30; ++index) {
    const Scenario loaded = directory.load(generated("clutter", index).yaml);
    numbers.insert(loaded.truth.size());
    for (const TrueObstacle& obstacle : loaded.truth) {
      for (const Solid& part : obstacle.parts) kinds.insert(part.index());
      balls += obstacle.is_ellipsoid();
    }
  }
  EXPECT_EQ(*numbers.begin(), 2U);
  EXPECT_EQ(*numbers.rbegin(), 10U);
  EXPECT_THAT(kinds, ElementsAre(1, 2, 3));  // box, cylinder, capsule
  EXPECT_GT(balls, 10);
}

TEST(Corridor, HasParallelWallsOfTheStatedWidth) {
  const TestDirectory directory;
  for (int index = 0; index < kScenarios; ++index) {
    const Scenario loaded = directory.load(generated("corridor", index).yaml);
    ASSERT_EQ(loaded.truth.size(), 2U);
    const auto& first = std::get<Box>(loaded.truth[0].parts.front());
    const auto& second = std::get<Box>(loaded.truth[1].parts.front());
    const Vector3d n = first.rotation.col(2);
    EXPECT_NEAR(n.dot(second.rotation.col(2)), 1, 1e-5) << index;
    const double between = n.dot(second.center - first.center) - 0.02;
    EXPECT_GE(between, 0.12 + 2 * 0.04 - 1e-4) << index;
    EXPECT_LE(between, 0.30 + 2 * 0.08 + 1e-4) << index;
  }
}

TEST(Shelf, HasTheEndOfThePathBetweenItsBoardsAndTheStartOutside) {
  const TestDirectory directory;
  for (int index = 0; index < kScenarios; ++index) {
    const Scenario loaded = directory.load(generated("shelf", index).yaml);
    ASSERT_EQ(loaded.truth.size(), 5U);
    const auto board = [&loaded](std::size_t i) {
      return std::get<Box>(loaded.truth[i].parts.front());
    };
    const Eigen::Matrix3d R = board(0).rotation;  // x inwards
    const auto local = [&R, &board](const Vector3d& p) -> Vector3d {
      return R.transpose() * (p - (board(0).center + board(1).center) / 2);
    };
    const Problem& problem = loaded.problem;
    const Vector3d end = local(problem.desired_tip(problem.duration()));
    const Vector3d start = local(problem.desired_tip(0));
    EXPECT_GT(end.z(), local(board(0).center).z() + 0.08) << index;
    EXPECT_LT(end.z(), local(board(1).center).z() - 0.08) << index;
    EXPECT_GT(end.y(), local(board(2).center).y() + 0.08) << index;
    EXPECT_LT(end.y(), local(board(3).center).y() - 0.08) << index;
    EXPECT_LT(end.x(), local(board(4).center).x() - 0.07) << index;
    EXPECT_GT(end.x() - start.x(), 0.2 - 1e-4) << index;
  }
}

TEST(Crossing, MovesTheFirstObstacle) {
  const TestDirectory directory;
  for (int index = 0; index < kScenarios; ++index) {
    const Scenario loaded = directory.load(generated("crossing", index).yaml);
    EXPECT_TRUE(loaded.problem.obstacles.front().moves()) << index;
  }
}

TEST(AnyArm, DrawsArmsOfSixToEightJointsAndDifferentShapes) {
  std::set<int> joints;
  std::set<std::string> robots;
  const TestDirectory directory;
  for (int index = 0; index < 20; ++index) {
    const std::string& yaml = generated("any_arm", index).yaml;
    const Problem problem = directory.load(yaml).problem;
    joints.insert(problem.chain.joints());
    robots.insert(yaml.substr(yaml.find("robot:"), yaml.find("start:") - yaml.find("robot:")));
    double length = 0;
    for (const DhRow& row : problem.chain.description().rows) length += row.a + row.d;
    EXPECT_GE(length, 0.9 - 1e-4) << index;
    EXPECT_LE(length, 1.4 + 1e-4) << index;
  }
  EXPECT_THAT(joints, ElementsAre(6, 7, 8));
  EXPECT_EQ(robots.size(), 20U);
}

/// The names that users know the arms by, in the order in which the generator takes them.
TEST_P(Scenes, NameTheArmUnlessItIsRandom) {
  const std::vector<std::string> arms = {"KUKA LBR iiwa 14", "Franka Panda", "UR5e", "UR10e",
                                         "PUMA 560"};
  for (int index = 0; index < kScenarios; ++index) {
    const std::string expected =
        GetParam() == "any_arm" ? "" : arms[static_cast<std::size_t>(index) % arms.size()];
    EXPECT_EQ(scenario(index).robot_name, expected) << index;
  }
}

TEST(ReferenceClearance, IsInTheFilesOfTheseFamiliesAlone) {
  EXPECT_THAT(generated("clutter", 0).yaml, HasSubstr("\nreference_clearance: 0.0"));
  Rejections ignored;
  EXPECT_THAT(generate(family("planar"), 7, 0, {}, ignored).yaml,
              Not(HasSubstr("reference_clearance")));
}

}  // namespace
}  // namespace bqsa::harness
