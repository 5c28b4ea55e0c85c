#include "bqsa/obstacle_field.hpp"

#include <gtest/gtest.h>

#include "support/allocation_guard.hpp"
#include "support/distance_oracle.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using test_support::DistanceOracle;
using test_support::Generator;
using test_support::log_uniform;
using test_support::random_ellipsoid;
using test_support::uniform;

/// A random pose of a planar arm with three links.
ChainPose random_pose(Generator& generator, const SerialChain& arm) {
  ChainPose pose;
  arm.forward(JointVector::NullaryExpr(3, [&](Eigen::Index) { return uniform(generator, -3, 3); }),
              pose);
  return pose;
}

double distance(const ChainPose& pose, const Link& link, const Ellipsoid& shape) {
  const DistanceOracle oracle(pose.p_WO.col(link.start), pose.p_WO.col(link.end), shape);
  return static_cast<double>(oracle.distance());
}

template <typename Field>
class ObstacleFieldTest : public ::testing::Test {};
using Dimensions = ::testing::Types<ObstacleField<2>, ObstacleField<3>>;
TYPED_TEST_SUITE(ObstacleFieldTest, Dimensions);

TYPED_TEST(ObstacleFieldTest, WithAClearanceALinkHitsExactlyWhatIsCloser) {
  const SerialChain arm(planar_chain({0.4, 0.3, 0.3}));
  Generator generator(50);
  WorkCounters counters;
  int closer = 0, further = 0;
  for (int i = 0; i < 1500; ++i) {
    const Ellipsoid shape = embedded(random_ellipsoid<2>(generator, 1e-4, 0.3, 0.5));
    const double wanted = log_uniform(generator, 1e-2, 0.3);
    const std::vector<Obstacle> obstacles = {{"o", shape}};
    TypeParam field;
    field.assign(obstacles, counters, wanted);
    field.keep(wanted);
    const ChainPose pose = random_pose(generator, arm);
    for (const Link& link : arm.links()) {
      const double exact = distance(pose, link, shape);
      if (std::abs(exact - wanted) < 1e-9) continue;
      ASSERT_EQ(field.first_hit(pose, link) == 0, exact < wanted) << "case " << i;
      ++(exact < wanted ? closer : further);
    }
  }
  EXPECT_GT(closer, 500);
  EXPECT_GT(further, 500);
  EXPECT_GT(counters.distance_queries, 100U);
  EXPECT_LT(counters.distance_queries, counters.quadratics / 2);
}

TYPED_TEST(ObstacleFieldTest, WithoutClearanceItAsksTheQuadraticAlone) {
  const SerialChain arm(planar_chain({0.4, 0.3, 0.3}));
  Generator generator(51);
  WorkCounters counters;
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Ellipse ellipse = random_ellipsoid<2>(generator, 1e-4, 0.3, 0.5);
    const std::vector<Obstacle> obstacles = {{"o", embedded(ellipse)}};
    TypeParam field;
    field.assign(obstacles, counters);
    field.keep(0.01);
    const ChainPose pose = random_pose(generator, arm);
    for (const Link& link : arm.links()) {
      const double bound = separation<2>(ellipse, pose.p_WO.col(link.start).template head<2>(),
                                         pose.p_WO.col(link.end).template head<2>());
      if (std::abs(bound - 0.01) < 1e-9) continue;
      ASSERT_EQ(field.first_hit(pose, link) == 0, bound < 0.01) << "case " << i;
      hits += bound < 0.01;
    }
  }
  EXPECT_GT(hits, 50);
  EXPECT_GT(counters.quadratics, 0U);
  EXPECT_LE(counters.quadratics, 2 * 1500U) << "one for the list, one for the answer";
  EXPECT_EQ(counters.distance_queries, 0U);
}

TYPED_TEST(ObstacleFieldTest, SeesAMovingObstacleWhereItIsAtTheTick) {
  const SerialChain arm(planar_chain({0.4, 0.3, 0.3}));
  ChainPose pose;
  arm.forward(JointVector::Zero(3), pose);
  Obstacle mover{"mover", embedded(rotated_ellipse({0.2, 0.5}, {0.3, 0.02}, 0))};
  mover.motion = {mover.shape, embedded(rotated_ellipse({0.55, 0.2}, {0.3, 0.02}, 0)),
                  embedded(rotated_ellipse({0.55, 0.2}, {0.3, 0.02}, 1.5))};
  const Obstacle resting{"resting", embedded(rotated_ellipse({0.9, 0}, {0.05, 0.05}, 0))};
  WorkCounters counters;
  const std::vector<Obstacle> obstacles = {resting, mover};
  TypeParam field;
  field.assign(obstacles, counters);
  const auto hits_of_the_second_link = [&] { return field.first_hit(pose, arm.links()[1]); };
  EXPECT_EQ(hits_of_the_second_link(), -1);
  for (const auto& [tick, hit] : {std::pair{1, -1}, {2, 1}, {1, -1}, {0, -1}, {2, 1}}) {
    field.go_to(tick);
    EXPECT_EQ(hits_of_the_second_link(), hit) << "tick " << tick;
    EXPECT_EQ(field.first_hit(pose, arm.links()[2]), 0) << "tick " << tick;
  }
}

TYPED_TEST(ObstacleFieldTest, DoesNotAllocateOnceAssigned) {
  const SerialChain arm(planar_chain({0.4, 0.3, 0.3}));
  Generator generator(52);
  Obstacle mover{"mover", embedded(random_ellipsoid<2>(generator, 0.01, 0.3))};
  for (int k = 0; k <= 100; ++k) {
    mover.motion.push_back(embedded(rotated_ellipse(test_support::random_vector<2>(generator, 1),
                                                    mover.shape.semi_axes().head<2>(), k)));
  }
  WorkCounters counters;
  const std::vector<Obstacle> obstacles = {mover, mover};
  TypeParam field;
  field.assign(obstacles, counters, 0.1);
  field.keep(0.1);
  ChainPose pose = random_pose(generator, arm);
  int hits = 0;
  const test_support::AllocationGuard guard;
  for (int tick = 0; tick <= 100; ++tick) {
    field.go_to(tick);
    for (const Link& link : arm.links()) hits += field.first_hit(pose, link) == 0;
  }
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_GT(hits, 10);
  EXPECT_GT(counters.distance_queries, 10U);
}

}  // namespace
}  // namespace bqsa
