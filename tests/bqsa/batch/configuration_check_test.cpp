// Many configurations at a time against the scalar kinematics and the exact distance.

#include "bqsa/batch/configuration_check.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "bqsa/batch/ellipsoid_around.hpp"
#include "bqsa/geometry/nearest_plane.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "support/allocation_guard.hpp"
#include "support/instruction_sets.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using test_support::Generator;
using test_support::uniform;
using test_support::with_all_instruction_sets;

struct ArmCase {
  const char* name;
  int dimension;
  DhConvention convention;
  int joints;
  bool tool;
};

void PrintTo(const ArmCase& arm, std::ostream* out) { *out << arm.name; }

/// Rows with twists, offsets and some without length, base and tool anywhere.
SerialChain random_arm(const ArmCase& arm, Generator& generator) {
  ChainDescription chain;
  chain.dimension = arm.dimension;
  chain.convention = arm.convention;
  const bool in_space = arm.dimension == 3;
  for (int j = 0; j < arm.joints; ++j) {
    DhRow row{.a = uniform(generator, -0.4, 0.4), .offset = uniform(generator, -2, 2)};
    if (in_space) {
      row.alpha = uniform(generator, -3, 3);
      row.d = uniform(generator, -0.3, 0.3);
    }
    if (j % 3 == 2) row.a = row.d = 0;
    chain.rows.push_back(row);
  }
  chain.p_WB.head(arm.dimension) = test_support::random_vector<3>(generator, 5).head(arm.dimension);
  if (in_space) {
    chain.R_WB = test_support::random_rotation<3>(generator);
  } else {
    chain.R_WB.topLeftCorner<2, 2>() = test_support::random_rotation<2>(generator);
  }
  if (arm.tool) {
    chain.p_LT.head(arm.dimension) =
        test_support::random_vector<3>(generator, 0.3).head(arm.dimension);
  }
  return SerialChain(chain);
}

/// Around the base, so that some configurations are free and some are not.
std::vector<Ellipsoid> random_shapes(const SerialChain& chain, int count, Generator& generator) {
  std::vector<Ellipsoid> shapes;
  for (int j = 0; j < count; ++j) {
    const Eigen::Vector3d away = test_support::random_direction<3>(generator);
    const Eigen::Vector3d center = chain.description().p_WB + uniform(generator, 0.1, 1.2) * away;
    if (chain.dimension() == 3) {
      const Ellipsoid any = test_support::random_ellipsoid<3>(generator, 0.02, 0.2);
      shapes.emplace_back(center, any.semi_axes(), any.rotation());
    } else {
      const Ellipse any = test_support::random_ellipsoid<2>(generator, 0.02, 0.1);
      shapes.push_back(embedded(Ellipse(center.head<2>(), any.semi_axes(), any.rotation())));
    }
  }
  return shapes;
}

JointVector random_angles(int joints, double largest, Generator& generator) {
  JointVector q(joints);
  for (double& angle : q) angle = uniform(generator, -largest, largest);
  return q;
}

/// Least distance of all links to all shapes, less than zero if one hits [m].
double least_distance(const SerialChain& chain, const std::vector<Ellipsoid>& shapes,
                      const JointVector& q) {
  ChainPose pose;
  chain.forward(q, pose);
  double least = std::numeric_limits<double>::infinity();
  for (const Link& link : chain.links()) {
    const Eigen::Vector3d p1 = pose.p_WO.col(link.start), p2 = pose.p_WO.col(link.end);
    for (const Ellipsoid& shape : shapes) {
      if (hits(polar_form<3>(shape, p1, p2))) return -1;
      least = std::min(least, nearest_plane<3>(shape, p1, p2).distance);
    }
  }
  return least;
}

bool is_free(const std::vector<std::uint16_t>& free, int i) {
  return (free[static_cast<std::size_t>(i / 16)] >> i % 16 & 1) != 0;
}

class ConfigurationChecks : public testing::TestWithParam<ArmCase> {};

INSTANTIATE_TEST_SUITE_P(
    Arms, ConfigurationChecks,
    testing::Values(ArmCase{"Plane", 2, DhConvention::kStandard, 7, false},
                    ArmCase{"PlaneWithTool", 2, DhConvention::kStandard, 4, true},
                    ArmCase{"PlaneModified", 2, DhConvention::kModified, 5, true},
                    ArmCase{"Space", 3, DhConvention::kStandard, 7, false},
                    ArmCase{"SpaceWithTool", 3, DhConvention::kStandard, 6, true},
                    ArmCase{"SpaceModified", 3, DhConvention::kModified, 7, true},
                    ArmCase{"SpaceModifiedNoTool", 3, DhConvention::kModified, 16, false},
                    ArmCase{"OneJoint", 3, DhConvention::kStandard, 1, false}),
    [](const auto& arm) { return std::string(arm.param.name); });

TEST_P(ConfigurationChecks, FreeIsCertainAndWhatIsFarIsFree) {
  constexpr int kArms = 8;
  constexpr int kConfigurations = 203;
  Generator generator(1);
  int free_found = 0, hits_found = 0;
  for (int number = 0; number < kArms; ++number) {
    const SerialChain chain = random_arm(GetParam(), generator);
    const double clearance = number % 2 == 0 ? 0 : 0.02;
    const std::vector<Ellipsoid> shapes = random_shapes(chain, 12, generator);
    const ConfigurationCheck check(chain, shapes, clearance);
    EXPECT_LT(check.point_error(), 1e-3);
    ConfigurationArray configurations(chain.joints(), kConfigurations);
    std::vector<double> distance;
    for (int i = 0; i < kConfigurations; ++i) {
      const JointVector q = random_angles(chain.joints(), 4 * std::numbers::pi, generator);
      configurations.set(i, q);
      distance.push_back(least_distance(chain, shapes, q));
    }
    with_all_instruction_sets([&] {
      std::vector<std::uint16_t> free(configurations.blocks(), 0xABCD);
      check.certainly_free(configurations, free);
      for (int i = 0; i < kConfigurations; ++i) {
        const double d = distance[static_cast<std::size_t>(i)];
        if (d < clearance) {
          EXPECT_FALSE(is_free(free, i)) << "arm " << number << ", configuration " << i;
          ++hits_found;
        } else if (d > 5 * clearance + 0.02) {
          EXPECT_TRUE(is_free(free, i)) << "arm " << number << ", configuration " << i;
          ++free_found;
        }
      }
      EXPECT_EQ(free.back() >> kConfigurations % 16, 0) << "there are no more configurations";
    });
  }
  const int sets = static_cast<int>(instruction_sets().size());
  EXPECT_GT(free_found, 100 * sets);
  EXPECT_GT(hits_found, 50 * sets);
}

/// Balls that touch an end-point, or are just beside it. Of large angles rounding alone is 6e-5 rad.
TEST_P(ConfigurationChecks, DecideNextToEndPointsWithinTheirError) {
  constexpr double kRadius = 0.1;
  Generator generator(2);
  int touching = 0, apart = 0;
  for (int number = 0; number < 100; ++number) {
    const SerialChain chain = random_arm(GetParam(), generator);
    const double largest = number % 4 < 2 ? 4 * std::numbers::pi : 1000;
    const JointVector q = random_angles(chain.joints(), largest, generator);
    ConfigurationArray configurations(chain.joints(), 1);
    configurations.set(0, q);
    ChainPose pose;
    chain.forward(q, pose);
    for (const Link& link : chain.links()) {
      const double gap =
          number % 2 == 0 ? -1e-12 : test_support::log_uniform(generator, 1e-5, 1e-3);
      Eigen::Vector3d away = test_support::random_direction<3>(generator);
      if (chain.dimension() == 2) away = Eigen::Vector3d(away.x(), away.y(), 0).normalized();
      const Eigen::Vector3d center = pose.p_WO.col(link.end) + (kRadius + gap) * away;
      const std::vector<Ellipsoid> ball = {{center, Eigen::Vector3d::Constant(kRadius)}};
      const ConfigurationCheck check(chain, ball, 0, largest);
      const double distance = least_distance(chain, ball, q);
      const bool touches = distance <= 0;
      if (!touches && distance < 4 * check.point_error() + 2e-5) continue;
      ++(touches ? touching : apart);
      with_all_instruction_sets([&] {
        std::vector<std::uint16_t> free(1);
        check.certainly_free(configurations, free);
        EXPECT_EQ(free.front(), !touches) << "arm " << number << ", link " << link.number;
      });
    }
  }
  EXPECT_GE(touching, 50);
  EXPECT_GE(apart, 5);
}

TEST(ConfigurationCheck, WhatIsNoNumberOrTooLargeIsNotFree) {
  const SerialChain chain(planar_chain({0.3, 0.3, 0.3}));
  const ConfigurationCheck check(chain, {}, 0, 3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  ConfigurationArray configurations(3, 16);
  for (int i = 0; i < 16; ++i) configurations.set(i, JointVector::Constant(3, 1));
  int i = 0;
  for (const double bad : {nan, -nan, inf, -inf, 3.001, -3.001}) {
    JointVector q = JointVector::Constant(3, 1);
    q(i % 3) = bad;
    configurations.set(i++, q);
  }
  with_all_instruction_sets([&] {
    std::vector<std::uint16_t> free(1);
    check.certainly_free(configurations, free);
    EXPECT_EQ(free.front(), 0xFFC0);
  });
}

TEST(ConfigurationCheck, AnglesThatSinesAreNotGoodForAreNotFree) {
  for (const double offset : {0.0, -30'000.0, 1e5}) {
    ChainDescription arm = planar_chain({0.3, 0.3, 0.3});
    arm.rows[1].offset = offset;
    const ConfigurationCheck check(SerialChain(arm), {}, 0, 1e6);
    ConfigurationArray configurations(3, 2);
    configurations.set(0, JointVector::Constant(3, 7'000));
    configurations.set(1, JointVector::Constant(3, 39'000));
    with_all_instruction_sets([&] {
      std::vector<std::uint16_t> free(1);
      check.certainly_free(configurations, free);
      EXPECT_EQ(free.front(), offset < 1e5 ? 1 : 0) << offset;
    });
  }
}

TEST(ConfigurationCheck, AnObstacleThatMovedIsWhereItWasPut) {
  const SerialChain chain(planar_chain({0.5, 0.5}));
  const Ellipsoid far = embedded(rotated_ellipse({5, 5}, {0.1, 0.1}, 0));
  const Ellipsoid on_the_arm = embedded(rotated_ellipse({0.7, 0}, {0.1, 0.1}, 0));
  ConfigurationCheck check(chain, std::vector<Ellipsoid>{far, far}, 0.01);
  ConfigurationArray configurations(2, 1);
  std::vector<std::uint16_t> free(1);
  const test_support::AllocationGuard guard;
  check.certainly_free(configurations, free);
  EXPECT_EQ(free.front(), 1);
  check.set(1, on_the_arm);
  check.certainly_free(configurations, free);
  EXPECT_EQ(free.front(), 0);
  EXPECT_EQ(guard.allocations(), 0U);
}

TEST(ConfigurationCheck, BadArgumentsAreRefused) {
  const SerialChain chain(planar_chain({0.5, 0.5}));
  EXPECT_THROW(ConfigurationCheck(chain, {}, -1), std::invalid_argument);
  EXPECT_THROW(ConfigurationCheck(chain, {}, 0, -1), std::invalid_argument);
  EXPECT_THROW(ConfigurationCheck(chain, {}, 0, std::nan("")), std::invalid_argument);
}

template <int Dim>
void expect_to_contain_all_points_around() {
  Generator generator(3);
  double closest = std::numeric_limits<double>::infinity();
  for (int number = 0; number < 300; ++number) {
    const auto shape = test_support::random_ellipsoid<Dim>(generator, 1e-3, 1);
    const double distance = test_support::log_uniform(generator, 1e-4, 1);
    const EllipsoidN<Dim> around = ellipsoid_around(shape, distance);
    for (int direction = 0; direction < 100; ++direction) {
      const auto n = test_support::random_direction<Dim>(generator);
      const double excess = around.support(n) - (shape.support(n) + distance);
      ASSERT_GE(excess, -1e-14) << number;
      closest = std::min(closest, excess / distance);
    }
  }
  EXPECT_LT(closest, 0.05) << "needlessly large";
}

/// A convex body is told by its support function, and that of all points around adds the distance.
TEST(EllipsoidAround, ContainsAllPointsWithinTheDistance) {
  expect_to_contain_all_points_around<2>();
  expect_to_contain_all_points_around<3>();
}

template <int Dim>
void expect_the_largest_excess() {
  Generator generator(4);
  for (int number = 0; number < 100; ++number) {
    const auto shape = test_support::random_ellipsoid<Dim>(generator, 1e-3, 1);
    const double distance = test_support::log_uniform(generator, 1e-4, 1);
    const EllipsoidN<Dim> around = ellipsoid_around(shape, distance);
    const double stated = largest_excess_around(shape, distance);
    double largest = 0;
    const auto look = [&](const Eigen::Matrix<double, Dim, 1>& n) {
      const double excess = around.support(n) - (shape.support(n) + distance);
      ASSERT_LE(excess, stated + 1e-14) << number;
      largest = std::max(largest, excess);
    };
    for (int k = 0; k < 300; ++k) look(test_support::random_direction<Dim>(generator));
    for (int k = 0; k < Dim; ++k) look(shape.rotation().col(k));
    EXPECT_NEAR(largest, stated, 1e-13) << number;
  }
}

TEST(EllipsoidAround, ReachesNoFurtherThanItsLargestExcess) {
  expect_the_largest_excess<2>();
  expect_the_largest_excess<3>();
}

TEST(EllipsoidAround, OfABallIsExact) {
  const Ellipsoid ball(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d::Constant(0.3));
  const Ellipsoid around = ellipsoid_around(ball, 0.1);
  EXPECT_TRUE(around.semi_axes().isApprox(Eigen::Vector3d::Constant(0.4), 1e-14));
  EXPECT_EQ(around.center(), ball.center());
  EXPECT_EQ(ellipsoid_around(ball, 0).semi_axes(), ball.semi_axes());
  EXPECT_THROW(ellipsoid_around(ball, -0.1), std::invalid_argument);
}

}  // namespace
}  // namespace bqsa
