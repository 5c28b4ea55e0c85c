/// @file
/// What leaves out obstacles must change no answer: everything is compared with plain loops over all pairs.
#include "bqsa/neighbourhood/neighbour_lists.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "bqsa/batch/instruction_set.hpp"
#include "bqsa/geometry/nearest_plane.hpp"
#include "bqsa/motion_certificate.hpp"
#include "bqsa/obstacle_field.hpp"
#include "bqsa/shadow_field.hpp"
#include "support/all_pairs_certificate.hpp"
#include "support/allocation_guard.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test_support::AllPairsCertificate;
using test_support::Generator;
using test_support::log_uniform;
using test_support::random_direction;
using test_support::random_ellipsoid;
using test_support::random_rotation;
using test_support::random_vector;
using test_support::uniform;

constexpr int kTicks = 60;

enum class Crowd { kBalls, kSheets, kNeedles, kAnything };

Vector3d axes_of(Crowd crowd, Generator& generator) {
  const double small = log_uniform(generator, 1e-4, 1e-2);
  const double large = log_uniform(generator, 0.05, 0.5);
  switch (crowd) {
    case Crowd::kBalls:
      return Vector3d::Constant(log_uniform(generator, 0.01, 0.2));
    case Crowd::kSheets:
      return {large, uniform(generator, 0.5, 1) * large, small};
    case Crowd::kNeedles:
      return {large, small, uniform(generator, 0.5, 1) * small};
    case Crowd::kAnything:
      break;
  }
  return Vector3d::NullaryExpr([&](Eigen::Index) { return log_uniform(generator, 1e-3, 0.3); });
}

/// A motion to and fro, with turns, of which some stand still for a while.
void set_in_motion(Obstacle& obstacle, bool planar, Generator& generator) {
  const double speed = log_uniform(generator, 1e-4, 0.2);  // a tick
  Vector3d way = random_vector<3>(generator, speed);
  Vector3d axis = random_direction<3>(generator);
  if (planar) {
    way.z() = 0;
    axis = Vector3d::UnitZ();
  }
  const double turn = uniform(generator, -1, 1) * log_uniform(generator, 1e-3, 2);
  const int still_from = static_cast<int>(uniform(generator, 0, kTicks));
  Vector3d center = obstacle.shape.center();
  Eigen::Matrix3d rotation = obstacle.shape.rotation();
  const Vector3d axes = obstacle.shape.semi_axes();
  for (int tick = 0; tick <= kTicks; ++tick) {
    obstacle.motion.emplace_back(center, axes, rotation);
    if (tick >= still_from && tick < still_from + 20) continue;
    center += (tick / 10 % 2 == 0 ? 1 : -1) * way;
    rotation = Eigen::AngleAxisd(turn, axis).toRotationMatrix() * rotation;
  }
  obstacle.shape = obstacle.motion.front();
}

std::vector<Obstacle> random_obstacles(Generator& generator, Crowd crowd, int count, bool planar,
                                       double moving_part) {
  std::vector<Obstacle> obstacles;
  for (int j = 0; j < count; ++j) {
    const Vector3d center = random_vector<3>(generator, planar ? 2 : 0.7);
    const Vector3d axes = axes_of(crowd, generator);
    const Ellipsoid shape =
        planar ? embedded(Ellipse(center.head<2>(),
                                  {axes.x(), crowd == Crowd::kSheets ? axes.z() : axes.y()},
                                  random_rotation<2>(generator)))
               : Ellipsoid(center, axes, random_rotation<3>(generator));
    obstacles.push_back({std::to_string(j), shape});
    if (uniform(generator, 0, 1) < moving_part) set_in_motion(obstacles.back(), planar, generator);
  }
  return obstacles;
}

SerialChain random_arm(bool planar, Generator& generator) {
  if (planar) return SerialChain(planar_chain({0.4, 0.3, 0.3, 0.2}));
  ChainDescription arm;
  for (int j = 0; j < 5; ++j) {
    arm.rows.push_back({uniform(generator, 0, 0.3), uniform(generator, -2, 2),
                        uniform(generator, 0, 0.3), uniform(generator, -1, 1)});
  }
  arm.p_LT << 0.05, 0, 0.1;
  return SerialChain(arm);
}

/// Small steps, standing still, and jumps.
class Walk {
 public:
  Walk(int joints, Generator& generator) : generator_(&generator), q_(random(joints, 3)) {}

  const JointVector& next() {
    const double kind = uniform(*generator_, 0, 1);
    if (kind < 0.1) return q_;
    q_ += random(static_cast<int>(q_.size()), kind < 0.2 ? 1 : log_uniform(*generator_, 1e-4, 0.1));
    return q_;
  }

 private:
  JointVector random(int joints, double half_width) {
    return JointVector::NullaryExpr(
        joints, [&](Eigen::Index) { return uniform(*generator_, -half_width, half_width); });
  }

  Generator* generator_;
  JointVector q_;
};

/// The plain test of one pair.
template <int Dim>
bool closer(const EllipsoidN<Dim>& shape, const Eigen::Matrix<double, Dim, 1>& p1,
            const Eigen::Matrix<double, Dim, 1>& p2, double distance, bool tight) {
  const double bound = separation(shape, p1, p2);
  if (bound > distance) return false;
  return !tight || bound <= 0 || nearest_plane<Dim>(shape, p1, p2, distance).distance <= distance;
}

bool hits(const ObstacleField<2>*, const Ellipsoid& shape, const Vector3d& p1, const Vector3d& p2,
          double distance, bool tight) {
  return closer<2>(planar_section(shape), p1.head<2>(), p2.head<2>(), distance, tight);
}
bool hits(const ObstacleField<3>*, const Ellipsoid& shape, const Vector3d& p1, const Vector3d& p2,
          double distance, bool tight) {
  return closer<3>(shape, p1, p2, distance, tight);
}
bool hits(const ShadowField*, const Ellipsoid& shape, const Vector3d& p1, const Vector3d& p2,
          double distance, bool tight) {
  for (int u = 0; u < 3; ++u) {
    const int v = (u + 1) % 3;
    Eigen::Matrix<double, 2, 3> S = Eigen::Matrix<double, 2, 3>::Zero();
    S(0, u) = S(1, v) = 1;
    if (!closer<2>(shadow(shape, S), S * p1, S * p2, distance, tight)) return false;
  }
  return true;
}

template <typename Field>
constexpr bool kPlanar = std::is_same_v<Field, ObstacleField<2>>;

template <typename Field>
class FieldAmongMany : public ::testing::Test {};
using Fields = ::testing::Types<ObstacleField<2>, ObstacleField<3>, ShadowField>;
TYPED_TEST_SUITE(FieldAmongMany, Fields);

TYPED_TEST(FieldAmongMany, FindsWhatAPlainLoopOverAllFinds) {
  constexpr bool kInPlane = kPlanar<TypeParam>;
  Generator generator(11);
  std::uint64_t asked = 0, all_pairs = 0;
  int found = 0, free = 0;
  for (int scene = 0; scene < 24; ++scene) {
    const auto crowd = static_cast<Crowd>(scene % 4);
    const double moving = scene / 4 % 3 == 0 ? 0 : scene / 4 % 3 == 1 ? 0.1 : 1;
    const std::vector<Obstacle> obstacles =
        random_obstacles(generator, crowd, scene % 5 == 0 ? 3 : 120, kInPlane, moving);
    const SerialChain arm = random_arm(kInPlane, generator);
    const bool tight = scene % 2 == 0;
    WorkCounters counters;
    TypeParam field;
    field.assign(obstacles, counters, tight ? 0.01 : 0);
    Walk walk(arm.joints(), generator);
    ChainPose pose;
    double distance = 0;
    int tick = 0;
    for (int step = 0; step < 150; ++step) {
      arm.forward(walk.next(), pose);
      if (step % 7 == 0) distance = step % 3 == 0 ? 0 : log_uniform(generator, 1e-6, 0.1);
      field.keep(distance);
      tick = step % 31 == 0 ? static_cast<int>(uniform(generator, 0, kTicks)) : (tick + 1) % kTicks;
      field.go_to(tick);
      for (const Link& link : arm.links()) {
        const Vector3d p1 = pose.p_WO.col(link.start), p2 = pose.p_WO.col(link.end);
        std::vector<int> expected;
        for (int j = 0; j < static_cast<int>(obstacles.size()); ++j) {
          const Ellipsoid& shape = obstacles[static_cast<std::size_t>(j)].at(tick);
          if (hits(&field, shape, p1, p2, distance, tight)) expected.push_back(j);
        }
        all_pairs += obstacles.size();
        std::vector<int> got;
        for (int j = field.first_hit(pose, link); j >= 0; j = field.first_hit(pose, link, j + 1)) {
          got.push_back(j);
        }
        ASSERT_EQ(got, expected) << "scene " << scene << " step " << step << " link "
                                 << link.number;
        ++(expected.empty() ? free : found);
      }
    }
    asked += counters.quadratics;
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(free, 1000);
  EXPECT_LT(asked, all_pairs / 2) << "lists leave out nothing";
}

template <typename Field>
class NearObstacles : public ::testing::Test {};
using SpaceFields = ::testing::Types<ObstacleField<2>, ObstacleField<3>>;
TYPED_TEST_SUITE(NearObstacles, SpaceFields);

TYPED_TEST(NearObstacles, AreThoseWithinTheBandInOrder) {
  constexpr bool kInPlane = kPlanar<TypeParam>;
  Generator generator(12);
  int met = 0;
  for (int scene = 0; scene < 16; ++scene) {
    const std::vector<Obstacle> obstacles =
        random_obstacles(generator, static_cast<Crowd>(scene % 4), 120, kInPlane, 0.2);
    const SerialChain arm = random_arm(kInPlane, generator);
    WorkCounters counters;
    TypeParam field;
    field.assign(obstacles, counters, scene % 2 == 0 ? 0.02 : 0);
    Walk walk(arm.joints(), generator);
    ChainPose pose;
    for (int step = 0; step < 60; ++step) {
      arm.forward(walk.next(), pose);
      field.go_to(step);
      field.keep(log_uniform(generator, 1e-5, 0.05));
      const double band = log_uniform(generator, 1e-4, 0.05);
      for (const Link& link : arm.links()) {
        std::vector<std::pair<int, double>> expected, got;
        for (int j = 0; j < static_cast<int>(obstacles.size()); ++j) {
          const double distance = field.proximity(pose, link, j).distance;
          if (field.distance(link) - distance >= -band) expected.emplace_back(j, distance);
        }
        field.visit_near(pose, link, band,
                         [&](int j, const auto& near) { got.emplace_back(j, near.distance); });
        ASSERT_EQ(got, expected) << "scene " << scene << " step " << step;
        met += static_cast<int>(expected.size());
      }
    }
  }
  EXPECT_GT(met, 1000);
}

class CertificateAmongMany : public ::testing::TestWithParam<bool> {};

TEST_P(CertificateAmongMany, SaysWhatItSaysOfAllPairs) {
  const bool planar = GetParam();
  Generator generator(13);
  std::uint64_t asked = 0, all_pairs = 0;
  int certified = 0, refused = 0;
  for (int scene = 0; scene < 40; ++scene) {
    const double moving = scene / 4 % 3 == 0 ? 0 : scene / 4 % 3 == 1 ? 0.1 : 1;
    Problem problem{.name = "many", .chain = random_arm(planar, generator)};
    problem.obstacles = random_obstacles(generator, static_cast<Crowd>(scene % 4),
                                         scene % 3 == 0 ? 5
                                         : planar       ? 40
                                                        : 80,
                                         planar, moving);
    problem.link_radius = scene % 2 == 0 ? 0 : 0.01;
    problem.margin = scene % 5 == 0 ? 0.02 : 0;
    WorkCounters counters, counters_of_all;
    MotionCertificate certificate;
    certificate.assign(problem, counters);
    AllPairsCertificate of_all_pairs;
    of_all_pairs.assign(problem, counters_of_all);
    Walk walk(problem.chain.joints(), generator);
    JointVector q0 = walk.next();
    int tick = 0;
    for (int step = 0; step < 120; ++step) {
      tick = step % 31 == 0 ? 1 + static_cast<int>(uniform(generator, 0, kTicks - 1))
                            : 1 + tick % kTicks;
      const JointVector q1 = walk.next();
      const MotionCertificate::Result got = certificate.certify(tick, q0, q1);
      const AllPairsCertificate::Result expected = of_all_pairs.certify(tick, q0, q1);
      ASSERT_EQ(got.certified, expected.certified) << "scene " << scene << " step " << step;
      ASSERT_EQ(got.link, expected.link) << "scene " << scene << " step " << step;
      ASSERT_EQ(got.obstacle, expected.obstacle) << "scene " << scene << " step " << step;
      ++(expected.certified ? certified : refused);
      q0 = q1;
    }
    asked += counters.quadratics;
    all_pairs += counters_of_all.quadratics;
  }
  EXPECT_GT(certified, 500);
  EXPECT_GT(refused, 500);
  EXPECT_LT(asked, all_pairs / 2);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, CertificateAmongMany, ::testing::Bool(),
                         [](const auto& planar) { return planar.param ? "Plane" : "Space"; });

TEST_P(CertificateAmongMany, WhatListsProveClearIsCertifiedAndKeepsItsDistance) {
  const bool planar = GetParam();
  Generator generator(16);
  int clear = 0, refused = 0;
  for (int scene = 0; scene < 40; ++scene) {
    Problem problem{.name = "some", .chain = random_arm(planar, generator)};
    problem.obstacles = random_obstacles(generator, static_cast<Crowd>(scene % 4), 5, planar,
                                         scene % 3 == 0 ? 0.5 : 0);
    WorkCounters counters, counters_of_all;
    MotionCertificate certificate;
    certificate.assign(problem, counters);
    AllPairsCertificate of_all_pairs;
    of_all_pairs.assign(problem, counters_of_all);
    const auto random = [&](double half_width) -> JointVector {
      return JointVector::NullaryExpr(problem.chain.joints(), [&](Eigen::Index) {
        return uniform(generator, -half_width, half_width);
      });
    };
    JointVector q0 = random(2);
    JointVector way;
    for (int tick = 1; tick <= kTicks; ++tick) {
      if (tick % 20 == 1) way = random(log_uniform(generator, 1e-4, 0.03));
      const JointVector q1 = q0 + way;
      const double distance = tick % 2 == 0 ? 0.02 : 0;
      ChainPose pose0, pose1;
      problem.chain.forward(q0, pose0);
      problem.chain.forward(q1, pose1);
      const bool is_clear = certificate.is_clear(tick, q0, pose0, q1, pose1, distance);
      ++(is_clear ? clear : refused);
      if (is_clear) {
        ASSERT_TRUE(of_all_pairs.certify(tick, q0, q1).certified) << "scene " << scene;
        for (const Link& link : problem.chain.links()) {
          for (const Obstacle& obstacle : problem.obstacles) {
            const NearestPlane<3> plane = nearest_plane<3>(
                obstacle.at(tick), pose1.p_WO.col(link.start), pose1.p_WO.col(link.end));
            ASSERT_GT(plane.distance, distance) << "scene " << scene << " tick " << tick;
          }
        }
      }
      certificate.certify(tick, q0, q1);
      q0 = q1;
    }
  }
  EXPECT_GT(clear, 500);
  EXPECT_GT(refused, 100);
}

/// A link by its ends.
struct OneLink {
  ChainPose pose;
  Link link{1, 0, 1};

  OneLink(const Vector3d& p1, const Vector3d& p2) {
    pose.p_WO.resize(3, 2);
    pose.p_WO << p1, p2;
  }
};

TEST(NeighbourLists, LinksWithoutLengthOrWithoutNumbersAreAskedAboutToo) {
  const std::vector<Obstacle> obstacles = {{"away", Ellipsoid({9, 9, 9}, {1, 1, 1})},
                                           {"here", Ellipsoid({0, 0, 0}, {1, 2, 3})}};
  WorkCounters counters;
  ObstacleField<3> field;
  field.assign(obstacles, counters);
  const auto first_hit = [&](const OneLink& one) { return field.first_hit(one.pose, one.link); };
  EXPECT_EQ(first_hit({Vector3d::Zero(), Vector3d::Zero()}), 1);
  EXPECT_EQ(first_hit({Vector3d(1, 0, 0), Vector3d(1, 0, 0)}), 1) << "touches";
  EXPECT_EQ(first_hit({Vector3d(1.001, 0, 0), Vector3d(1.001, 0, 0)}), -1);
  const Vector3d nowhere = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(first_hit({nowhere, Vector3d::Zero()}), 0) << "as the quadratic says";
  EXPECT_EQ(first_hit({Vector3d(1, 0, 0), Vector3d(1, 0, 0)}), 1) << "and is none the worse for it";
  EXPECT_EQ(first_hit({Vector3d(4, 0, 0), Vector3d(4, 0, 0)}), -1) << "by a list, which then says";
  EXPECT_EQ(first_hit({Vector3d(4, 0, 0), nowhere}), 0) << "nothing of this one";
}

/// An arm that wags in the middle of a crowd that stays away from it.
struct FarCrowd {
  Problem problem{.name = "far crowd", .chain = SerialChain(planar_chain({0.3, 0.3, 0.3}))};

  explicit FarCrowd(bool moving = false) {
    Generator generator(14);
    while (problem.obstacles.size() < 2000) {
      const Vector3d center = random_vector<3>(generator, 6);
      if (center.norm() < 1.5) continue;
      Obstacle obstacle{"far", Ellipsoid(center, Vector3d::Constant(0.05))};
      for (int tick = 0; moving && tick <= kTicks; ++tick) {
        obstacle.motion.emplace_back(center + 1e-3 * tick * Vector3d::UnitX(),
                                     Vector3d::Constant(0.05));
      }
      problem.obstacles.push_back(obstacle);
    }
  }

  static JointVector q(int tick) { return JointVector::Constant(3, 0.3 * std::sin(0.05 * tick)); }
};

TEST(NeighbourLists, OfACrowdThatIsFarAwayHardlyAnythingIsAsked) {
  for (const bool moving : {false, true}) {
    const FarCrowd crowd(moving);
    WorkCounters counters;
    MotionCertificate certificate;
    certificate.assign(crowd.problem, counters);
    ObstacleField<3> field;
    field.assign(crowd.problem.obstacles, counters, 0, certificate.neighbours());
    const test_support::AllocationGuard guard;
    ChainPose pose;
    for (int tick = 1; tick <= kTicks; ++tick) {
      crowd.problem.chain.forward(FarCrowd::q(tick), pose);
      field.go_to(tick);
      for (const Link& link : crowd.problem.chain.links()) {
        EXPECT_EQ(field.first_hit(pose, link), -1);
      }
      EXPECT_TRUE(certificate.certify(tick, FarCrowd::q(tick - 1), FarCrowd::q(tick)).certified);
    }
    EXPECT_EQ(guard.allocations(), 0U);
    // Of 12,000 pairs a tick, for field and certificate.
    EXPECT_LT(counters.quadratics, kTicks);
    EXPECT_LT(counters.bounds, kTicks * 100U);
    EXPECT_GT(counters.bounds, 0U);
  }
}

TEST(NeighbourLists, MoreThanAListCanHoldAreAskedOneByOneWithoutAllocating) {
  Generator generator(15);
  std::vector<Obstacle> obstacles;
  for (int j = 0; j < 6000; ++j) {
    obstacles.push_back({"near", Ellipsoid(Vector3d(0, 0.2, 0) + random_vector<3>(generator, 0.02),
                                           Vector3d::Constant(0.1))});
  }
  obstacles[5555] = {"here", Ellipsoid({0, 0, 0}, Vector3d::Constant(0.01))};
  WorkCounters counters;
  ObstacleField<3> field;
  field.assign(obstacles, counters);
  const OneLink one(Vector3d(-1, 0, 0), Vector3d(1, 0, 0));
  const test_support::AllocationGuard guard;
  field.keep(0.09);  // now and then less than to those that are near
  int expected = 0;
  while (!closer<3>(obstacles[static_cast<std::size_t>(expected)].shape, Vector3d(-1, 0, 0),
                    Vector3d(1, 0, 0), 0.09, false)) {
    ++expected;
  }
  EXPECT_EQ(field.first_hit(one.pose, one.link), expected);
  field.keep(0.01);
  EXPECT_EQ(field.first_hit(one.pose, one.link), 5555);
  EXPECT_EQ(guard.allocations(), 0U);
}

/// Boxes of all of them meet the link, and only the last one comes near it.
TEST(NeighbourLists, MoreBoxesThanOneSearchFindsLeaveNothingOut) {
  const Eigen::Matrix3d tilted =
      Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitZ()).toRotationMatrix();
  std::vector<Obstacle> obstacles(
      5000, {"sheet", Ellipsoid(Vector3d(-0.3, -0.3, 0), Vector3d(0.001, 0.5, 0.5), tilted)});
  obstacles.push_back({"here", Ellipsoid({0, 0, 0}, Vector3d::Constant(0.01))});
  WorkCounters counters;
  ObstacleField<3> field;
  field.assign(obstacles, counters);
  const OneLink one(Vector3d(-0.1, 0, 0), Vector3d(0.1, 0, 0));
  EXPECT_EQ(field.first_hit(one.pose, one.link), 5000);
}

TEST(NeighbourLists, ThoseThatAreIncompleteProveNothing) {
  const std::vector<Obstacle> obstacles(
      6000, {"near", Ellipsoid(Vector3d(0, 0.15, 0), Vector3d::Constant(0.1))});
  WorkCounters counters;
  NeighbourLists lists(std::make_shared<ObstacleIndex>(obstacles), FreeBy::kSpace, counters);
  const OneLink one(Vector3d(-1, 0, 0), Vector3d(1, 0, 0));
  int visited = 0;
  lists.visit({0, one.link, one.pose, one.pose, 0.2, 0}, [&visited](int) { ++visited; });
  EXPECT_EQ(visited, 6000);
  EXPECT_FALSE(lists.all_clear({&one.link, 1}, {0, one.link, one.pose, one.pose, 0.01, 0}));
}

double distance_to_segment(const Vector3d& point, const Vector3d& p1, const Vector3d& p2) {
  const Vector3d way = p2 - p1;
  const double t = std::clamp((point - p1).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (p1 + t * way - point).norm();
}

TEST(NeighbourLists, PassagesThatAreAllClearKeepTheirDistance) {
  constexpr double kRadius = 0.1;
  constexpr int kPoints = 4;
  const std::vector<Link> links = {{1, 0, 1}, {2, 1, 2}, {3, 2, 3}};
  Generator generator(17);
  int clear = 0, refused = 0;
  for (int scene = 0; scene < 200; ++scene) {
    std::vector<Obstacle> balls;
    for (int j = 0; j < 4; ++j) {
      balls.push_back(
          {"ball", Ellipsoid(random_vector<3>(generator, 0.8), Vector3d::Constant(kRadius))});
    }
    WorkCounters counters;
    NeighbourLists lists(std::make_shared<ObstacleIndex>(balls), FreeBy::kSpace, counters);
    ChainPose around;
    around.p_WO = Eigen::MatrixXd::NullaryExpr(
        3, kPoints, [&](Eigen::Index, Eigen::Index) { return uniform(generator, -0.6, 0.6); });
    const auto near_by = [&](double most) {
      ChainPose pose = around;
      const double half_width = log_uniform(generator, 1e-4, most);
      for (int k = 0; k < kPoints; ++k) pose.p_WO.col(k) += random_vector<3>(generator, half_width);
      return pose;
    };
    const auto gap = [&](const ChainPose& pose) {
      double least = std::numeric_limits<double>::infinity();
      for (const Link& link : links) {
        for (const Obstacle& ball : balls) {
          least =
              std::min(least, distance_to_segment(ball.shape.center(), pose.p_WO.col(link.start),
                                                  pose.p_WO.col(link.end)));
        }
      }
      return least - kRadius;
    };
    for (const Link& link : links) {
      lists.visit({0, link, around, around, 0, log_uniform(generator, 1e-3, 0.1)}, [](int) {});
    }
    for (int i = 0; i < 100; ++i) {
      const ChainPose from = near_by(0.3), to = near_by(i % 2 == 0 ? 1e-3 : 0.3);
      const double sag = log_uniform(generator, 1e-5, 0.1);
      const double distance = log_uniform(generator, 1e-5, 0.2);
      const bool is_clear = lists.all_clear(links, {0, links[0], from, to, sag, distance});
      ++(is_clear ? clear : refused);
      if (is_clear) {
        ASSERT_GT(std::min(gap(from), gap(to)), sag + distance) << "scene " << scene << " " << i;
      }
    }
  }
  EXPECT_GT(clear, 1000);
  EXPECT_GT(refused, 1000);
}

TEST(ObstacleIndex, TakesLessThan50BytesAnObstacle) {
  const FarCrowd crowd;
  const ObstacleIndex index(crowd.problem.obstacles);
  EXPECT_LT(index.bytes(), 50 * crowd.problem.obstacles.size());
  const FarCrowd moving(true);
  EXPECT_LT(ObstacleIndex(moving.problem.obstacles).bytes(),
            10 * moving.problem.obstacles.size() * kTicks)
      << "of each tick";
}

}  // namespace
}  // namespace bqsa
