#include "harness/judge/motion_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/judge/judge.hpp"
#include "judge_scenes.hpp"
#include "support/distance_oracle.hpp"
#include "support/prismatic_arms.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using test_support::Generator;
using test_support::move_obstacle;
using test_support::uniform;

constexpr long kPlenty = 1L << 24;

struct Motion {
  Problem problem;
  JointVector from;
  JointVector to;
};

JointVector random_angles(Generator& generator, int joints, double half_width) {
  JointVector q(joints);
  for (int j = 0; j < joints; ++j) q(j) = uniform(generator, -half_width, half_width);
  return q;
}

/// The arm among three obstacles put near its links; thick links among spheres.
Motion motion_among_obstacles(Generator& generator, int number, const ChainDescription& chain) {
  const int joints = chain.joints();
  const bool planar = chain.dimension == 2;
  const bool thick = number % 5 == 0;
  Motion motion{test_support::free_problem(chain, 1), {}, {}};
  if (thick) motion.problem.link_radius = 0.02;
  for (std::size_t i = 0; number % 10 == 0 && i < motion.problem.chain.links().size(); ++i) {
    motion.problem.link_radii.push_back(0.02 - 0.005 * static_cast<double>(i % 4));
  }
  motion.from = random_angles(generator, joints, 1.5);
  motion.to = motion.from + random_angles(generator, joints, number % 3 == 0 ? 1.5 : 0.2);
  ChainPose pose;
  motion.problem.chain.forward(0.5 * (motion.from + motion.to), pose);
  for (int k = 0; k < 3; ++k) {
    const Vector3d near_arm =
        pose.p_WO.col(static_cast<Eigen::Index>(generator() % pose.p_WO.cols()));
    Vector3d center = near_arm + test_support::random_vector<3>(generator, 0.5);
    if (planar) center.z() = 0;
    const double size = test_support::log_uniform(generator, 0.005, 0.3);
    if (thick) {
      motion.problem.obstacles.push_back({"ball", Ellipsoid(center, Vector3d::Constant(size))});
    } else if (planar) {
      motion.problem.obstacles.push_back(
          {"ellipse", embedded(rotated_ellipse(center.head<2>(), {size, 0.3 * size},
                                               uniform(generator, 0, 3)))});
    } else {
      motion.problem.obstacles.push_back(
          {"egg", Ellipsoid(center, {size, 0.5 * size, k == 0 ? 1e-3 : size},
                            test_support::random_rotation<3>(generator))});
    }
  }
  return motion;
}

/// A planar or spatial arm.
Motion random_motion(Generator& generator, int number) {
  const int joints = 2 + static_cast<int>(generator() % 6);
  const bool planar = number % 2 == 0;
  ChainDescription chain;
  if (planar) {
    chain = planar_chain(std::vector<double>(static_cast<std::size_t>(joints), 0.4));
  } else {
    if (number % 4 == 1) chain.convention = DhConvention::kModified;
    for (int j = 0; j < joints; ++j) {
      chain.rows.push_back({.a = uniform(generator, 0, 0.4),
                            .alpha = uniform(generator, -2, 2),
                            .d = uniform(generator, 0, 0.3)});
    }
    chain.p_LT << 0.1, 0, 0.1;
  }
  return motion_among_obstacles(generator, number, chain);
}

/// The same while the obstacles move and turn; every fourth of them makes only one of the two.
Motion random_moving_scene(Generator& generator, int number) {
  Motion motion = random_motion(generator, number);
  const bool planar = number % 2 == 0;
  for (std::size_t k = 0; k < motion.problem.obstacles.size(); ++k) {
    const std::size_t kind = (static_cast<std::size_t>(number) + k) % 8;
    const double way = kind == 0 ? 0 : 0.3;
    const double turn = kind == 1 ? 0 : 3;
    move_obstacle(generator, planar, way, turn, motion.problem.obstacles[k]);
  }
  return motion;
}

/// An arm of which some joints slide, among obstacles that are at rest or move.
Motion random_sliding_motion(Generator& generator, int number) {
  const int joints = 2 + static_cast<int>(generator() % 6);
  Motion motion = motion_among_obstacles(generator, number,
                                         test_support::random_prismatic_arm(generator, joints));
  for (Obstacle& obstacle : motion.problem.obstacles) {
    if (number % 2 == 0) move_obstacle(generator, false, 0.3, 3, obstacle);
  }
  return motion;
}

/// For each pair of link and obstacle a number that is negative exactly if they meet, and then at
/// most as far below 0 as the penetration is deep. By the chain of src/bqsa, and without the judge.
class DenseOracle {
 public:
  explicit DenseOracle(const Motion& motion) : motion_(motion) {}

  double depth_bound(double s, std::size_t link, std::size_t obstacle) const {
    ChainPose pose;
    motion_.problem.chain.forward((1 - s) * motion_.from + s * motion_.to, pose);
    const Link& ends = motion_.problem.chain.links()[link];
    const Ellipsoid shape =
        test_support::obstacle_between(motion_.problem.obstacles[obstacle], 1, s);
    const Vector3d a = pose.p_WO.col(ends.start), b = pose.p_WO.col(ends.end);
    if (motion_.problem.link_radius > 0) {
      const double t =
          std::clamp((shape.center() - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      return (a + t * (b - a) - shape.center()).norm() - shape.semi_axes().x() -
             motion_.problem.radius_of(link);
    }
    const double norm = static_cast<double>(test_support::DistanceOracle(a, b, shape).least_norm());
    return (norm - 1) * shape.semi_axes().minCoeff();
  }

  /// Least value over `samples` + 1 configurations, with the number of the sample.
  std::pair<double, int> least(std::size_t link, std::size_t obstacle, int samples) const {
    std::pair<double, int> least{std::numeric_limits<double>::infinity(), 0};
    for (int k = 0; k <= samples; ++k) {
      least = std::min(least, {depth_bound(static_cast<double>(k) / samples, link, obstacle), k});
    }
    return least;
  }

  /// Least value on the two intervals around a sample, by golden section.
  double least_near(int sample, int samples, std::size_t link, std::size_t obstacle) const {
    double low = std::max(0.0, static_cast<double>(sample - 1) / samples);
    double high = std::min(1.0, static_cast<double>(sample + 1) / samples);
    constexpr double kGolden = std::numbers::phi - 1;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 60; ++k) {
      const double x = high - kGolden * (high - low), y = low + kGolden * (high - low);
      const double fx = depth_bound(x, link, obstacle), fy = depth_bound(y, link, obstacle);
      (fx < fy ? high : low) = fx < fy ? y : x;
      least = std::min({least, fx, fy});
    }
    return least;
  }

 private:
  const Motion& motion_;
};

struct Agreement {
  int colliding = 0;
  int free = 0;
  int missed_by_ten = 0;  ///< collisions that ten samples do not show
};

/// Follows random scenes and samples them densely; neither may contradict the other.
template <typename Scene>
void expect_agreement(Scene&& random_scene, int motions, int samples, Agreement& count) {
  constexpr double kDeep = 1.1 * Judge::kTouching;
  Generator generator(1);
  for (int k = 0; k < motions; ++k) {
    const Motion motion = random_scene(generator, k);
    const LinkScene scene(motion.problem);
    const MotionVerdict verdict =
        MotionCheck(scene).follow(motion.from, motion.to, 1, scene.pairs(), kPlenty);
    ASSERT_TRUE(verdict.undecided.empty()) << "case " << k;
    ASSERT_EQ(verdict.contradiction, "") << "case " << k;
    const DenseOracle oracle(motion);
    for (const LinkObstaclePair& pair : scene.pairs()) {
      const bool judged = std::any_of(
          verdict.colliding.begin(), verdict.colliding.end(), [&](const LinkObstaclePair& other) {
            return other.link == pair.link && other.obstacle == pair.obstacle;
          });
      const auto link = static_cast<std::size_t>(pair.link);
      const auto obstacle = static_cast<std::size_t>(pair.obstacle);
      const auto [value, sample] = oracle.least(link, obstacle, samples);
      if (!judged) {
        ++count.free;
        ASSERT_GE(value, -kDeep) << "case " << k << ", link " << pair.link + 1;
        continue;
      }
      ++count.colliding;
      ASSERT_LE(oracle.least_near(sample, samples, link, obstacle), 0)
          << "case " << k << ", link " << pair.link + 1;
      if (oracle.least(link, obstacle, 10).first > 0) ++count.missed_by_ten;
    }
  }
  testing::Test::RecordProperty("colliding", count.colliding);
  testing::Test::RecordProperty("free", count.free);
  testing::Test::RecordProperty("missed_by_ten_samples", count.missed_by_ten);
}

TEST(MotionCheck, AgreesWithDenseSampling) {
  Agreement count;
  expect_agreement(random_motion, 2000, 400, count);
  EXPECT_GT(count.colliding, 1000);
  EXPECT_GT(count.free, 5000);
  EXPECT_GT(count.missed_by_ten, 50);
}

TEST(MotionCheck, AgreesWithDenseSamplingOfObstaclesThatMoveAndTurn) {
  Agreement count;
  expect_agreement(random_moving_scene, 500, 1000, count);
  EXPECT_GT(count.colliding, 300);
  EXPECT_GT(count.free, 3000);
  EXPECT_GT(count.missed_by_ten, 20);
}

TEST(MotionCheck, AgreesWithDenseSamplingOfJointsThatSlide) {
  Agreement count;
  expect_agreement(random_sliding_motion, 1500, 400, count);
  EXPECT_GT(count.colliding, 300);
  EXPECT_GT(count.free, 3000);
  EXPECT_GT(count.missed_by_ten, 20);
}

TEST(MotionCheck, AnArmAtRestAmongObstaclesThatMoveAgreesWithDenseSampling) {
  Agreement count;
  const auto resting = [](Generator& generator, int number) {
    Motion motion = random_moving_scene(generator, number);
    motion.to = motion.from;
    return motion;
  };
  expect_agreement(resting, 400, 1000, count);
  EXPECT_GT(count.colliding, 150);
  EXPECT_GT(count.free, 2000);
  EXPECT_GT(count.missed_by_ten, 5);
}

/// One link of 1 m that turns about the origin by `angle`, passing a ball at angle 0.
struct Sweep {
  explicit Sweep(double ball_x, double angle)
      : problem(test_support::free_problem(planar_chain({1}), 1)),
        from(VectorXd::Constant(1, -angle / 3)),
        to(VectorXd::Constant(1, 2 * angle / 3)) {
    problem.obstacles.push_back({"ball", Ellipsoid({ball_x, 0, 0}, {0.1, 0.1, 0.1})});
  }

  MotionVerdict follow(long limit) const {
    const LinkScene scene(problem);
    return MotionCheck(scene).follow(from, to, 1, scene.pairs(), limit);
  }

  Problem problem;
  VectorXd from;
  VectorXd to;
};

TEST(MotionCheck, DecidesPassesOnEitherSideOfTheTouchingBand) {
  const MotionVerdict clear = Sweep(1.1 + 2e-6, 0.2).follow(kPlenty);
  EXPECT_TRUE(clear.colliding.empty() && clear.undecided.empty());
  EXPECT_FALSE(clear.touching);

  for (const double gap : {0.5e-6, 0.0, -0.5e-6}) {
    const MotionVerdict touching = Sweep(1.1 + gap, 0.2).follow(kPlenty);
    EXPECT_TRUE(touching.colliding.empty() && touching.undecided.empty()) << gap;
    EXPECT_TRUE(touching.touching) << gap;
  }

  const MotionVerdict hit = Sweep(1.1 - 2e-6, 0.2).follow(kPlenty);
  EXPECT_EQ(hit.colliding.size(), 1U);
}

TEST(MotionCheck, SlidingInContactNeedsFewVisits) {
  // The ball lies on the axis of the first joint, so the second link keeps its clearance of 1e-5 m.
  ChainDescription chain;
  chain.rows = {{.a = 0.4}, {.a = 0.8, .alpha = 0.5}, {.a = 0.8}};
  Problem problem = test_support::free_problem(chain, 1);
  const VectorXd from = Eigen::Vector3d(0.3, 2.4, 0.4);
  const VectorXd to = from + VectorXd(Eigen::Vector3d(std::numbers::pi / 180, 0, 0));
  PointPositions positions;
  JudgeKinematics(chain).place(from, positions);
  const double distance = [&] {
    const Vector3d d = positions.points[2] - positions.points[1];
    const double t = -positions.points[1].dot(d) / d.squaredNorm();
    return (positions.points[1] + t * d).norm();
  }();
  problem.obstacles.push_back(
      {"ball", Ellipsoid(Vector3d::Zero(), Vector3d::Constant(distance - 1e-5))});
  const LinkScene scene(problem);
  const MotionVerdict verdict = MotionCheck(scene).follow(from, to, 1, {{1, 0}}, kPlenty);
  EXPECT_TRUE(verdict.colliding.empty() && verdict.undecided.empty());
  EXPECT_NEAR(verdict.clearance, 1e-5, 1e-9);
  EXPECT_LT(verdict.visits, 2000);
  EXPECT_GT(verdict.visits, 0);
}

TEST(MotionCheck, LimitOnVisitsEndsUndecided) {
  const MotionVerdict verdict = Sweep(1.1 + 2e-6, 0.2).follow(5);
  EXPECT_EQ(verdict.undecided.size(), 1U);
  EXPECT_TRUE(verdict.colliding.empty());
  EXPECT_EQ(verdict.visits, 5);
}

TEST(MotionCheck, AMotionWithoutBoundIsUndecidedAtOnce) {
  Sweep sweep(1.2, 0.2);
  sweep.from(0) = -1e308;
  sweep.to(0) = 1e308;
  const MotionVerdict verdict = sweep.follow(kPlenty);
  EXPECT_EQ(verdict.undecided.size(), 1U);
  EXPECT_EQ(verdict.visits, 0);
}

/// A link of 5 m hangs on a joint above a needle and swings past its middle, while the needle turns
/// the other way round: seen from the needle the end of the link curves down to it, by the Coriolis
/// acceleration alone, and back. At both ticks the end is past the needle's ends.
TEST(MotionCheck, CatchesAnEndThatCurvesIntoATurningNeedle) {
  constexpr double kTurn = 0.5, kSwing = 0.08, kLength = 5, kGap = 0.015;
  const auto colliding = [&](double turn) {
    ChainDescription chain = planar_chain({kLength});
    chain.p_WB << 0, kLength + kGap, 0;
    Problem problem = test_support::free_problem(chain, 1);
    Obstacle needle{"needle",
                    embedded(rotated_ellipse({0, 0}, {0.15, 0.001}, -turn / 2)),
                    {embedded(rotated_ellipse({0, 0}, {0.15, 0.001}, -turn / 2)),
                     embedded(rotated_ellipse({0, 0}, {0.15, 0.001}, turn / 2))}};
    problem.obstacles.push_back(needle);
    const VectorXd down = VectorXd::Constant(1, -std::numbers::pi / 2);
    const VectorXd swing = VectorXd::Constant(1, kSwing / 2);
    const LinkScene scene(problem);
    const Motion motion{problem, JointVector(down - swing), JointVector(down + swing)};
    const DenseOracle oracle(motion);
    EXPECT_GT(oracle.depth_bound(0, 0, 0), 1e-4);
    EXPECT_GT(oracle.depth_bound(1, 0, 0), 1e-4);
    const bool hits = oracle.least(0, 0, 1000).first < 0;
    const MotionVerdict verdict =
        MotionCheck(scene).follow(motion.from, motion.to, 1, scene.pairs(), kPlenty);
    EXPECT_TRUE(verdict.undecided.empty());
    EXPECT_EQ(verdict.colliding.size(), hits ? 1U : 0U);
    return verdict.colliding.size();
  };
  EXPECT_EQ(colliding(kTurn), 1U);
  EXPECT_EQ(colliding(0), 0U);
}

/// The slide goes through 0 while the arm turns: its end rises from a sheet's plane by the Coriolis
/// acceleration alone, and into the sheet above.
TEST(MotionCheck, CatchesASlideThatCurvesIntoASheet) {
  constexpr double kGap = 0.02, kThickness = 1e-3;
  Motion motion{test_support::free_problem(test_support::swinging_slide(), 1),
                Eigen::Vector2d(-0.1, -0.5), Eigen::Vector2d(0.1, 0.5)};
  motion.problem.obstacles.push_back(
      {"sheet", Ellipsoid({0, kGap + kThickness, 0}, {2, kThickness, 2})});
  const LinkScene scene(motion.problem);
  const MotionVerdict verdict =
      MotionCheck(scene).follow(motion.from, motion.to, 1, scene.pairs(), kPlenty);
  EXPECT_EQ(verdict.colliding.size(), 2U);
}

TEST(MotionCheck, TravelBoundsTheChangeOfTheClearance) {
  Generator generator(3);
  double tightest = 0;
  int cases = 0;
  for (int k = 0; k < 300; ++k) {
    const Motion motion = random_moving_scene(generator, k);
    const LinkScene scene(motion.problem);
    const std::vector<double> travel = MotionCheck(scene).travel(motion.from, motion.from, 1);
    PointPositions arm;
    scene.kinematics().place(motion.from, arm);
    for (std::size_t i = 0; i < scene.pairs().size(); i += 5) {
      const LinkObstaclePair& pair = scene.pairs()[i];
      const LinkSegment& link = scene.link(pair);
      const Obstacle& obstacle = motion.problem.obstacles[static_cast<std::size_t>(pair.obstacle)];
      const auto distance = [&](double s) {
        return static_cast<double>(
            test_support::DistanceOracle(arm.points[static_cast<std::size_t>(link.start)],
                                         arm.points[static_cast<std::size_t>(link.end)],
                                         test_support::obstacle_between(obstacle, 1, s))
                .distance());
      };
      const double from = uniform(generator, 0, 1), to = uniform(generator, 0, 1);
      const double change = std::abs(distance(to) - distance(from));
      const double bound = std::abs(to - from) * travel[i];
      ASSERT_LE(change, bound + 1e-12) << "case " << k << ", link " << link.number;
      tightest = std::max(tightest, change / bound);
      ++cases;
    }
  }
  EXPECT_GT(cases, 500);
  EXPECT_GT(tightest, 0.9);
}

TEST(MotionCheck, TravelBoundsTheWayOfEveryPoint) {
  Generator generator(2);
  double tightest = 0;
  for (int k = 0; k < 3000; ++k) {
    const Motion motion =
        k % 3 == 2 ? random_sliding_motion(generator, 2 * k + 1) : random_motion(generator, k);
    const LinkScene scene(motion.problem);
    const std::vector<double> travel = MotionCheck(scene).travel(motion.from, motion.to, 1);
    PointPositions first, second;
    scene.kinematics().place(motion.from, first);
    scene.kinematics().place(motion.to, second);
    for (std::size_t i = 0; i < travel.size(); ++i) {
      const LinkSegment& link = scene.link(scene.pairs()[i]);
      for (const int point : {link.start, link.end}) {
        const auto at = static_cast<std::size_t>(point);
        const double way = (first.points[at] - second.points[at]).norm();
        ASSERT_LE(way, travel[i] + 1e-12) << "case " << k << ", link " << link.number;
        if (travel[i] > 0) tightest = std::max(tightest, way / travel[i]);
      }
    }
  }
  EXPECT_GT(tightest, 0.9);
}

}  // namespace
}  // namespace bqsa::harness
