// Forward kinematics and Jacobians against products of 4x4 transforms and central differences.

#include "bqsa/kinematics/serial_chain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "bqsa/kinematics/planar_tip.hpp"
#include "support/allocation_guard.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using test_support::Generator;
using test_support::uniform;

constexpr double kPi = std::numbers::pi;

Matrix4d turn(const Vector3d& axis, double angle) {
  Matrix4d X = Matrix4d::Identity();
  X.topLeftCorner<3, 3>() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return X;
}

Matrix4d shift(const Vector3d& p) {
  Matrix4d X = Matrix4d::Identity();
  X.topRightCorner<3, 1>() = p;
  return X;
}

/// The points O_1, O_2, ... by the textbook: one transform after the other.
std::vector<Vector3d> textbook_points(const ChainDescription& chain, const JointVector& q) {
  const Vector3d x = Vector3d::UnitX(), z = Vector3d::UnitZ();
  Matrix4d X = shift(chain.p_WB);
  X.topLeftCorner<3, 3>() = chain.R_WB;
  std::vector<Vector3d> points{chain.p_WB};
  for (std::size_t j = 0; j < chain.rows.size(); ++j) {
    const DhRow& row = chain.rows[j];
    const double theta = q(static_cast<Eigen::Index>(j)) + row.offset;
    if (chain.convention == DhConvention::kStandard) {
      X = X * turn(z, theta) * shift(row.d * z) * shift(row.a * x) * turn(x, row.alpha);
    } else {
      X = X * turn(x, row.alpha) * shift(row.a * x) * turn(z, theta) * shift(row.d * z);
    }
    points.push_back(X.topRightCorner<3, 1>());
  }
  if (!chain.p_LT.isZero(0)) points.push_back((X * shift(chain.p_LT)).topRightCorner<3, 1>());
  return points;
}

enum class Kind { kStandard, kModified, kPlanar };

std::string name_of(Kind kind) {
  switch (kind) {
    case Kind::kStandard:
      return "Standard";
    case Kind::kModified:
      return "Modified";
    case Kind::kPlanar:
      return "Planar";
  }
  return "Unknown";
}

void PrintTo(Kind kind, std::ostream* out) { *out << name_of(kind); }

/// 1 to 16 joints, some lengths zero, half of the chains with a tool.
ChainDescription random_chain(Kind kind, Generator& generator) {
  const int joints = static_cast<int>(uniform(generator, 1, 17));
  const auto length = [&] {
    return uniform(generator, 0, 1) < 0.2 ? 0.0 : uniform(generator, -0.5, 0.5);
  };
  const bool planar = kind == Kind::kPlanar;
  ChainDescription chain;
  chain.dimension = planar ? 2 : 3;
  chain.convention = kind == Kind::kModified ? DhConvention::kModified : DhConvention::kStandard;
  for (int j = 0; j < joints; ++j) {
    DhRow row{.a = length(), .offset = uniform(generator, -kPi, kPi)};
    if (!planar) row.d = length(), row.alpha = uniform(generator, -kPi, kPi);
    chain.rows.push_back(row);
  }
  chain.p_WB = test_support::random_vector<3>(generator, 1);
  chain.R_WB = test_support::random_rotation<3>(generator);
  if (uniform(generator, 0, 1) < 0.5) chain.p_LT = test_support::random_vector<3>(generator, 0.3);
  if (planar) {
    chain.p_WB.z() = chain.p_LT.z() = 0;
    chain.R_WB.setIdentity();
    chain.R_WB.topLeftCorner<2, 2>() = test_support::random_rotation<2>(generator);
  }
  return chain;
}

JointVector random_joints(int joints, Generator& generator) {
  return JointVector::NullaryExpr(joints,
                                  [&](Eigen::Index) { return uniform(generator, -kPi, kPi); });
}

ChainPose pose_of(const SerialChain& chain, const JointVector& q) {
  ChainPose pose;
  chain.forward(q, pose);
  return pose;
}

constexpr int kChains = 300;

class RandomChains : public testing::TestWithParam<Kind> {
 protected:
  /// Calls `law(number, chain, q, generator)` for random chains and joint angles.
  template <typename Law>
  void for_all(Law law) {
    Generator generator(80 + static_cast<int>(GetParam()));
    for (int i = 0; i < kChains; ++i) {
      const SerialChain chain(random_chain(GetParam(), generator));
      law(i, chain, random_joints(chain.joints(), generator), generator);
      if (HasFatalFailure()) return;
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Kinds, RandomChains,
                         testing::Values(Kind::kStandard, Kind::kModified, Kind::kPlanar),
                         [](const auto& parameter) { return name_of(parameter.param); });

TEST_P(RandomChains, FromAPoseNearbyAllIsAsFromNothing) {
  for_all([](int i, const SerialChain& chain, const JointVector& q, Generator& generator) {
    for (const double range : {1e-9, 0.06, 1.0}) {  // the last one is not nearby
      const JointVector q_near = q + JointVector::NullaryExpr(q.size(), [&](Eigen::Index) {
                                   return uniform(generator, -range, range);
                                 });
      ChainPose pose = pose_of(chain, q_near);
      const ChainPose expected = pose_of(chain, q);
      chain.forward_from(q_near, q, pose);
      ASSERT_LT((pose.p_WO - expected.p_WO).norm(), 1e-14) << "case " << i;
      ASSERT_LT((pose.axis_W - expected.axis_W).norm(), 1e-14) << "case " << i;
      ASSERT_LT((pose.pivot_W - expected.pivot_W).norm(), 1e-14) << "case " << i;
    }
  });
}

class RandomPlanarChains : public RandomChains {};
INSTANTIATE_TEST_SUITE_P(Kinds, RandomPlanarChains, testing::Values(Kind::kPlanar),
                         [](const auto& parameter) { return name_of(parameter.param); });

TEST_P(RandomPlanarChains, TipStepsAreThoseOfTheWholeChain) {
  int slight = 0, large = 0;
  for_all([&](int i, const SerialChain& chain, const JointVector& q, Generator& generator) {
    const ChainPose pose = pose_of(chain, q);
    TaskJacobian J;
    chain.jacobian(pose, chain.points() - 1, J);
    PlanarTip tip;
    tip.assign(chain, pose);
    ASSERT_LT((tip.gram() - J * J.transpose()).norm(), 1e-13) << "case " << i;

    const auto after = [&](const Eigen::Vector2d& y) -> Eigen::Vector2d {
      return (pose_of(chain, q + J.transpose() * y).tip() - pose.tip()).head<2>();
    };
    const Eigen::Vector2d y = test_support::log_uniform(generator, 1e-4, 0.3) *
                              test_support::random_direction<2>(generator);
    JointVector q_after = q;
    tip.step(y, q_after);
    ASSERT_LT((q_after - q - J.transpose() * y).norm(), 1e-14) << "case " << i;

    double turn = 0, largest = 0;
    for (int j = 0; j < chain.joints(); ++j) {
      turn += J.col(j).dot(y);
      largest = std::max(largest, std::abs(turn));
    }
    const PlanarTip::Moved moved = tip.move(y);
    ASSERT_EQ(moved.slight, largest <= kSlightTurn) << "case " << i;
    ++(moved.slight ? slight : large);
    if (!moved.slight) return;
    ASSERT_LT((moved.way - after(y)).norm(), 1e-11) << "case " << i;
    for (int k = 0; k < 2; ++k) {
      constexpr double kStep = 1e-6;
      const Eigen::Vector2d d = kStep * Eigen::Vector2d::Unit(k);
      const Eigen::Vector2d difference = (after(y + d) - after(y - d)) / (2 * kStep);
      ASSERT_LT((moved.way_per_y.col(k) - difference).norm(), 1e-7) << "case " << i;
    }
  });
  EXPECT_GT(slight, 100);
  EXPECT_GT(large, 10);
}

TEST_P(RandomChains, PointsAreThoseOfTheTextbook) {
  int points = 0;
  for_all([&](int i, const SerialChain& chain, const JointVector& q, Generator&) {
    const std::vector<Vector3d> expected = textbook_points(chain.description(), q);
    const ChainPose pose = pose_of(chain, q);
    ASSERT_EQ(pose.p_WO.cols(), chain.points()) << "case " << i;
    ASSERT_EQ(expected.size(), static_cast<std::size_t>(chain.points())) << "case " << i;
    for (int k = 0; k < chain.points(); ++k, ++points) {
      ASSERT_LT((pose.p_WO.col(k) - expected[static_cast<std::size_t>(k)]).norm(), 1e-13)
          << "case " << i << " point " << k;
    }
    ASSERT_EQ(pose.tip(), pose.p_WO.col(chain.points() - 1)) << "case " << i;
    if (GetParam() == Kind::kPlanar) {
      ASSERT_TRUE(pose.p_WO.row(2).isZero(0)) << "case " << i;
    }
  });
  EXPECT_GT(points, 5 * kChains);
}

TEST_P(RandomChains, JacobiansAreCentralDifferences) {
  int columns = 0;
  for_all([&](int i, const SerialChain& chain, const JointVector& q, Generator&) {
    const ChainPose pose = pose_of(chain, q);
    const double h = 1e-5;
    for (int k = 0; k < chain.points(); ++k) {
      TaskJacobian J;
      chain.jacobian(pose, k, J);
      ASSERT_EQ(J.rows(), chain.dimension());
      ASSERT_EQ(J.cols(), chain.joints());
      for (int j = 0; j < chain.joints(); ++j, ++columns) {
        JointVector forth = q, back = q;
        forth(j) += h;
        back(j) -= h;
        Vector3d column = Vector3d::Zero();
        column.head(chain.dimension()) = J.col(j);
        Vector3d difference =
            (pose_of(chain, forth).p_WO.col(k) - pose_of(chain, back).p_WO.col(k)) / (2 * h);
        if (chain.dimension() == 2) difference.z() = 0;
        ASSERT_LT((column - difference).norm(), 2e-9)
            << "case " << i << " point " << k << " joint " << j;
      }
    }
  });
  EXPECT_GT(columns, 20 * kChains);
}

TEST_P(RandomChains, OnlyTheMovingJointsMoveAPoint) {
  int moved = 0, held = 0;
  for_all([&](int i, const SerialChain& chain, const JointVector& q, Generator&) {
    const ChainPose pose = pose_of(chain, q);
    for (int k = 0; k < chain.points(); ++k) {
      for (int j = 0; j < chain.joints(); ++j) {
        JointVector turned = q;
        turned(j) += 0.3;
        const double distance = (pose_of(chain, turned).p_WO.col(k) - pose.p_WO.col(k)).norm();
        if (j >= chain.moving_joints(k)) {
          ASSERT_LT(distance, 1e-13) << "case " << i << " point " << k << " joint " << j;
          ++held;
        } else {
          moved += distance > 1e-6;
        }
      }
    }
  });
  EXPECT_GT(moved, 10 * kChains);
  EXPECT_GT(held, 10 * kChains);
}

TEST_P(RandomChains, MovingJointsAreAsFewAsTheConventionAllows) {
  for_all([&](int i, const SerialChain& chain, const JointVector&, Generator&) {
    const bool modified = GetParam() == Kind::kModified;
    for (int k = 0; k <= chain.joints(); ++k) {
      ASSERT_EQ(chain.moving_joints(k), modified ? std::max(k - 1, 0) : k) << "case " << i;
    }
    if (chain.points() == chain.joints() + 2) {
      ASSERT_EQ(chain.moving_joints(chain.joints() + 1), chain.joints()) << "case " << i;
    }
  });
}

TEST_P(RandomChains, ReachBoundsTheDistanceFromAnAxis) {
  int compared = 0;
  double closest = std::numeric_limits<double>::infinity();
  for_all([&](int i, const SerialChain& chain, const JointVector&, Generator& generator) {
    for (int sample = 0; sample < 10; ++sample) {
      const ChainPose pose = pose_of(chain, random_joints(chain.joints(), generator));
      for (int k = 0; k < chain.points(); ++k) {
        for (int j = 0; j < chain.joints(); ++j) {
          if (j >= chain.moving_joints(k)) {
            ASSERT_EQ(chain.reach(j, k), 0) << "case " << i << " point " << k << " joint " << j;
            continue;
          }
          const Vector3d arm = pose.p_WO.col(k) - pose.pivot_W.col(j);
          const double distance = Vector3d(pose.axis_W.col(j)).cross(arm).norm();
          ASSERT_LE(distance, chain.reach(j, k) + 1e-13)
              << "case " << i << " point " << k << " joint " << j;
          if (chain.reach(j, k) > 0) closest = std::min(closest, 1 - distance / chain.reach(j, k));
          ++compared;
        }
      }
    }
  });
  EXPECT_GT(compared, 100 * kChains);
  EXPECT_LT(closest, 1e-9) << "the bound is never attained";
}

TEST_P(RandomChains, LinksJoinDistinctNeighboursAndKeepTheirNumbers) {
  int links = 0, skipped = 0;
  for_all([&](int i, const SerialChain& chain, const JointVector& q, Generator&) {
    const ChainPose pose = pose_of(chain, q);
    std::size_t next = 0;
    for (int k = 0; k + 1 < chain.points(); ++k) {
      if ((pose.p_WO.col(k + 1) - pose.p_WO.col(k)).norm() < 1e-14) {
        ++skipped;
        continue;
      }
      ASSERT_LT(next, chain.links().size()) << "case " << i;
      const Link& link = chain.links()[next++];
      ASSERT_EQ(link.number, k + 1) << "case " << i;
      ASSERT_EQ(link.start, k) << "case " << i;
      ASSERT_EQ(link.end, k + 1) << "case " << i;
      ++links;
    }
    ASSERT_EQ(next, chain.links().size()) << "case " << i;
  });
  EXPECT_GT(links, 3 * kChains);
  EXPECT_GT(skipped, kChains / 20);
}

TEST(SerialChain, PutsThePumaTipWhereTheReconstructionSays) {
  const double quarter = kPi / 2;
  ChainDescription puma;
  puma.rows = {{.a = 0, .alpha = quarter, .d = 0.67183},
               {.a = 0.4318},
               {.a = 0.02032, .alpha = -quarter, .offset = -quarter},
               {.alpha = quarter, .d = 0.43307},
               {.alpha = -quarter},
               {.d = 0.05625}};
  const SerialChain chain(puma);
  JointVector q(6);
  q << 0, -60, 90, 0, 10, 0;
  q *= kPi / 180;
  const Vector3d tip_mm = 1e3 * pose_of(chain, q).tip();
  EXPECT_NEAR(tip_mm.x(), 644.20, 5e-3);
  EXPECT_NEAR(tip_mm.y(), 0, 5e-3);
  EXPECT_NEAR(tip_mm.z(), 532.97, 5e-3);

  std::vector<int> numbers;
  for (const Link& link : chain.links()) numbers.push_back(link.number);
  EXPECT_EQ(numbers, (std::vector<int>{1, 2, 3, 4, 6})) << "link 5 has no length";
}

TEST(SerialChain, CountsAToolAsOneMoreLink) {
  ChainDescription chain = planar_chain({0.3, 0, 0.2}, {0.1, -0.4});
  chain.p_LT = {0, 0.05, 0};
  const SerialChain arm(chain);
  EXPECT_EQ(arm.points(), 5);
  ASSERT_EQ(arm.links().size(), 3u);
  EXPECT_EQ(arm.links()[2].number, 4);
  EXPECT_EQ(pose_of(arm, JointVector::Zero(3)).tip(), Vector3d(0.1 + 0.3 + 0.2, -0.4 + 0.05, 0));
}

TEST(SerialChain, HoldsSixteenJointsAndATool) {
  ChainDescription chain = planar_chain(std::vector<double>(16, 0.1));
  chain.p_LT = {0.1, 0, 0};
  const SerialChain arm(chain);
  EXPECT_EQ(arm.points(), kMaxPoints);
  EXPECT_EQ(arm.links().size(), static_cast<std::size_t>(kMaxLinks));
  EXPECT_NEAR(pose_of(arm, JointVector::Zero(16)).tip().x(), 1.7, 1e-14);
}

TEST(SerialChain, DoesNotAllocateInTheControlLoop) {
  ChainDescription description = planar_chain(std::vector<double>(16, 0.1));
  description.p_LT = {0.1, 0, 0};
  const SerialChain chain(description);
  const JointVector q = JointVector::Constant(16, 0.1);
  ChainPose pose;
  TaskJacobian J;
  const test_support::AllocationGuard guard;
  chain.forward(q, pose);
  for (int k = 0; k < chain.points(); ++k) chain.jacobian(pose, k, J);
  EXPECT_EQ(guard.allocations(), 0u);
}

std::string refusal(const ChainDescription& chain) {
  try {
    SerialChain{chain};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SerialChain, RefusesBadDescriptionsAndSaysWhy) {
  const auto changed = [](auto change) {
    ChainDescription chain = planar_chain({0.3, 0.2});
    change(chain);
    return refusal(chain);
  };
  using testing::HasSubstr;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(changed([](ChainDescription&) {}), "accepted");
  EXPECT_THAT(refusal(planar_chain({})), HasSubstr("got 0"));
  EXPECT_THAT(refusal(planar_chain(std::vector<double>(17, 0.1))), HasSubstr("got 17"));
  EXPECT_THAT(changed([](ChainDescription& c) { c.dimension = 4; }), HasSubstr("2 or 3"));
  EXPECT_THAT(changed([&](ChainDescription& c) { c.rows[1].a = nan; }), HasSubstr("finite"));
  EXPECT_THAT(changed([&](ChainDescription& c) { c.rows[1].offset = nan; }), HasSubstr("finite"));
  EXPECT_THAT(changed([&](ChainDescription& c) { c.p_LT.x() = nan; }), HasSubstr("finite"));
  EXPECT_THAT(changed([](ChainDescription& c) { c.R_WB *= 2; }), HasSubstr("orthonormal"));
  EXPECT_THAT(changed([](ChainDescription& c) { c.R_WB = -c.R_WB; }), HasSubstr("right-handed"));
  EXPECT_THAT(changed([](ChainDescription& c) { c.rows[0].d = 0.1; }), HasSubstr("plane z = 0"));
  EXPECT_THAT(changed([](ChainDescription& c) { c.rows[0].alpha = 0.1; }),
              HasSubstr("plane z = 0"));
  EXPECT_THAT(changed([](ChainDescription& c) { c.p_WB.z() = 0.1; }), HasSubstr("plane z = 0"));
}

}  // namespace
}  // namespace bqsa
