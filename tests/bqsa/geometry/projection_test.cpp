// The paper's Lemma 1 as the field of shadows applies it: what it calls free is free in space, and
// how often it calls a free link colliding.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "bqsa/shadow_field.hpp"
#include "segment_families.hpp"
#include "support/distance_oracle.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::Vector3d;
using test_support::DistanceOracle;
using test_support::Family;
using test_support::Generator;
using test_support::make_pair;
using test_support::Pair;
using test_support::random_direction;
using test_support::random_rotation;
using test_support::random_vector;
using test_support::uniform;

/// Asks the field about single segments.
class Asked {
 public:
  explicit Asked(std::vector<Obstacle> obstacles, double distance = 0, double clearance = 0)
      : obstacles_(std::move(obstacles)) {
    field_.assign(obstacles_, counters_, clearance);
    field_.keep(distance);
    pose_.p_WO.resize(3, 2);
  }
  explicit Asked(const Ellipsoid& shape, double distance = 0, double clearance = 0)
      : Asked(std::vector<Obstacle>{{"obstacle", shape}}, distance, clearance) {}

  void go_to(int tick) { field_.go_to(tick); }
  bool hit(const Vector3d& p1, const Vector3d& p2) { return first_hit(p1, p2) >= 0; }
  int first_hit(const Vector3d& p1, const Vector3d& p2, int from = 0) {
    pose_.p_WO << p1, p2;
    return field_.first_hit(pose_, {1, 0, 1}, from);
  }
  std::uint64_t quadratics() const { return counters_.quadratics; }
  std::uint64_t distance_queries() const { return counters_.distance_queries; }

 private:
  std::vector<Obstacle> obstacles_;
  WorkCounters counters_;
  ShadowField field_;
  ChainPose pose_;
};

/// Least level of the segment's projection on the axes u and v of W against the shadow, in extended
/// precision, from the shadow's matrix S Q⁻¹ Sᵀ: at most 0 exactly if the shadows meet.
long double shadow_level(const Pair<3>& pair, int u, int v) {
  using Vector = Eigen::Matrix<long double, 2, 1>;
  using Matrix = Eigen::Matrix<long double, 3, 3>;
  const Matrix R = pair.ellipsoid.rotation().cast<long double>();
  const Matrix inverse =
      R * pair.ellipsoid.semi_axes().cast<long double>().cwiseAbs2().asDiagonal() * R.transpose();
  const auto on_plane = [u, v](const Vector3d& p) { return Vector(p(u), p(v)); };
  const Vector start = on_plane(pair.p1) - on_plane(pair.ellipsoid.center());
  const Vector d = on_plane(pair.p2) - on_plane(pair.p1);
  const long double m00 = inverse(u, u), m01 = inverse(u, v), m11 = inverse(v, v);
  const long double determinant = m00 * m11 - m01 * m01;
  const auto product = [&](const Vector& a, const Vector& b) {
    return (m11 * a(0) * b(0) - m01 * (a(0) * b(1) + a(1) * b(0)) + m00 * a(1) * b(1)) /
           determinant;
  };
  const long double dd = product(d, d);
  const long double t = dd > 0 ? std::clamp(-product(start, d) / dd, 0.0L, 1.0L) : 0.0L;
  const Vector nearest = start + t * d;
  return product(nearest, nearest) - 1;
}

class Lemma1Law : public ::testing::TestWithParam<Family> {};

TEST_P(Lemma1Law, AFreeProjectionIsTrulyFreeInSpace) {
  constexpr int kPairs = 20000;
  Generator generator(70);
  int free_by_projection = 0, overlooked = 0, hit = 0;
  for (int i = 0; i < kPairs; ++i) {
    const Pair<3> pair = make_pair<3>(GetParam(), generator);
    const bool free = !Asked(pair.ellipsoid).hit(pair.p1, pair.p2);
    const bool truly_free = DistanceOracle(pair.p1, pair.p2, pair.ellipsoid).least_norm() > 1;
    ASSERT_TRUE(truly_free || !free) << "case " << i;
    free_by_projection += free;
    overlooked += truly_free && !free;
    hit += !truly_free;
  }
  EXPECT_GT(free_by_projection, kPairs / 20);
  EXPECT_GT(hit, kPairs / 20);
  EXPECT_GT(overlooked, 0) << "the converse would hold";
  RecordProperty("free_by_projection", free_by_projection);
  RecordProperty("free_but_called_colliding", overlooked);
}

INSTANTIATE_TEST_SUITE_P(Families, Lemma1Law,
                         ::testing::Values(Family::kRandom, Family::kVertical, Family::kHorizontal,
                                           Family::kNeedle, Family::kSheet, Family::kZeroLength),
                         [](const auto& family) { return test_support::name_of(family.param); });

TEST(ShadowField, HitsExactlyWhereTheShadowsMeetInAllThreePlanes) {
  Generator generator(71);
  int hits = 0, free = 0;
  std::array<int, 3> decided_by_one{};
  for (int i = 0; i < 20000; ++i) {
    const Pair<3> pair = make_pair<3>(Family::kRandom, generator);
    const std::array<long double, 3> levels = {shadow_level(pair, 0, 1), shadow_level(pair, 1, 2),
                                               shadow_level(pair, 2, 0)};
    const auto near_zero = [](long double level) { return std::abs(level) < 1e-9L; };
    if (std::any_of(levels.begin(), levels.end(), near_zero)) continue;
    const auto apart = [](long double level) { return level > 0; };
    const auto apart_count = std::count_if(levels.begin(), levels.end(), apart);
    ASSERT_EQ(Asked(pair.ellipsoid).hit(pair.p1, pair.p2), apart_count == 0) << "case " << i;
    ++(apart_count == 0 ? hits : free);
    for (std::size_t k = 0; k < 3; ++k) decided_by_one[k] += apart_count == 1 && levels[k] > 0;
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(free, 1000);
  for (const int count : decided_by_one) EXPECT_GT(count, 20) << "a plane decides nothing";
}

TEST(ShadowField, CallsAFreeLinkCollidingThatPassesTheCornerOfAllShadows) {
  // All three coordinate shadows of the unit ball meet the link; the ball does not reach it.
  const Ellipsoid ball(Vector3d::Zero(), Vector3d::Ones());
  const Vector3d p1(0.7, 0.7, 0.7), p2(2, 2, 2);
  EXPECT_TRUE(Asked(ball).hit(p1, p2));
  EXPECT_NEAR(static_cast<double>(DistanceOracle(p1, p2, ball).distance()),
              0.7 * std::sqrt(3.0) - 1, 1e-12);
}

TEST(ShadowField, ADistanceToKeepIsKeptInSpace) {
  Generator generator(72);
  int free = 0, free_if_tight = 0;
  std::uint64_t queries = 0;
  for (int i = 0; i < 4000; ++i) {
    const Pair<3> pair = make_pair<3>(i % 2 == 0 ? Family::kRandom : Family::kSheet, generator);
    const double distance = test_support::log_uniform(generator, 1e-4, 0.3);
    Asked cheap(pair.ellipsoid, distance), tight(pair.ellipsoid, distance, distance);
    const bool cheap_free = !cheap.hit(pair.p1, pair.p2);
    const bool tight_free = !tight.hit(pair.p1, pair.p2);
    ASSERT_TRUE(tight_free || !cheap_free) << "case " << i;
    EXPECT_EQ(cheap.distance_queries(), 0U);
    queries += tight.distance_queries();
    free += cheap_free;
    free_if_tight += tight_free;
    if (!tight_free) continue;
    ASSERT_GT(static_cast<double>(DistanceOracle(pair.p1, pair.p2, pair.ellipsoid).distance()),
              distance - 1e-12)
        << "case " << i;
  }
  EXPECT_GT(free, 300);
  EXPECT_GT(free_if_tight, free);
  EXPECT_GT(queries, 300U);
}

TEST(ShadowField, WithAClearanceItHitsExactlyWhereAllShadowsAreCloser) {
  Generator generator(76);
  int hits = 0, free = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pair<3> pair = make_pair<3>(Family::kRandom, generator);
    const double distance = test_support::log_uniform(generator, 1e-2, 0.3);
    long double furthest = 0;
    for (int u = 0; u < 3; ++u) {
      const int v = (u + 1) % 3;
      Eigen::Matrix<double, 2, 3> S = Eigen::Matrix<double, 2, 3>::Zero();
      S(0, u) = S(1, v) = 1;
      const DistanceOracle in_plane({pair.p1(u), pair.p1(v), 0}, {pair.p2(u), pair.p2(v), 0},
                                    embedded(shadow(pair.ellipsoid, S)));
      furthest = std::max(furthest, in_plane.distance());
    }
    if (std::abs(furthest - distance) < 1e-9L) continue;
    const bool hit = Asked(pair.ellipsoid, distance, distance).hit(pair.p1, pair.p2);
    ASSERT_EQ(hit, furthest < distance) << "case " << i;
    ++(hit ? hits : free);
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(free, 500);
}

TEST(ShadowField, AsksThePlanesInTurnUntilOneSaysFree) {
  const Ellipsoid ball(Vector3d::Zero(), Vector3d::Constant(0.1));
  const auto cost = [&ball](const Vector3d& p) {
    Asked asked(ball);
    asked.hit(p, p);
    return asked.quadratics();
  };
  EXPECT_EQ(cost({1, 0, 0}), 0U);        // beside its box
  EXPECT_EQ(cost({0.08, 0.08, 0}), 1U);  // apart in xy
  EXPECT_EQ(cost({0, 0.08, 0.08}), 2U);  // apart in yz
  EXPECT_EQ(cost({0.08, 0, 0.08}), 3U);  // apart in zx only
  EXPECT_EQ(cost({0, 0, 0}), 3U);        // a hit
}

TEST(ShadowField, FindsObstaclesInOrder) {
  const Ellipsoid here(Vector3d::Zero(), Vector3d::Ones()), away({9, 9, 9}, Vector3d::Ones());
  Asked asked({{"a", away}, {"b", here}, {"c", away}, {"d", here}});
  EXPECT_EQ(asked.first_hit(Vector3d::Zero(), Vector3d::Ones()), 1);
  EXPECT_EQ(asked.first_hit(Vector3d::Zero(), Vector3d::Ones(), 2), 3);
  EXPECT_EQ(asked.first_hit(Vector3d::Zero(), Vector3d::Ones(), 4), -1);
}

TEST(ShadowField, FollowsMovingObstacles) {
  Generator generator(73);
  constexpr int kTicks = 20;
  int hits = 0, free = 0;
  for (int i = 0; i < 100; ++i) {
    Obstacle mover{"mover", make_pair<3>(Family::kRandom, generator).ellipsoid};
    const Vector3d step = random_vector<3>(generator, 0.1);
    const Eigen::AngleAxisd turn(uniform(generator, 0, 0.2), random_direction<3>(generator));
    for (int tick = 0; tick <= kTicks; ++tick) {
      const Ellipsoid& last = tick == 0 ? mover.shape : mover.motion.back();
      mover.motion.emplace_back(last.center() + step, last.semi_axes(), turn * last.rotation());
    }
    const Obstacle bystander{"bystander", Ellipsoid({50, 0, 0}, Vector3d::Ones())};
    Asked moving({bystander, mover, bystander});
    for (int tick = 0; tick <= kTicks; ++tick) {
      moving.go_to(tick);
      Asked resting(mover.at(tick));
      const Vector3d p1 = mover.at(tick).center() + random_vector<3>(generator, 1);
      const Vector3d p2 = mover.at(tick).center() + random_vector<3>(generator, 1);
      const bool hit = resting.hit(p1, p2);
      ASSERT_EQ(moving.first_hit(p1, p2), hit ? 1 : -1) << "case " << i << " tick " << tick;
      ++(hit ? hits : free);
    }
  }
  EXPECT_GT(hits, 200);
  EXPECT_GT(free, 200);
}

/// Random links whose distance to the ellipsoid is known: they lie beyond the plane that supports
/// it, and reach down to `gap` above the point where it does.
struct Shape {
  double aspect;  ///< largest to smallest semi-axis; needles and sheets in turn
  bool rotated;   ///< else the axes are parallel to those of W
};

Pair<3> link_at_gap(const Shape& shape, double gap, int i, Generator& generator) {
  constexpr double kLargest = 0.2, kLength = 0.4;  // [m]
  Vector3d axes(kLargest, kLargest / shape.aspect, kLargest / (i % 2 == 0 ? shape.aspect : 1));
  std::shuffle(axes.data(), axes.data() + 3, generator);
  const Eigen::Matrix3d R =
      shape.rotated ? random_rotation<3>(generator) : Eigen::Matrix3d::Identity();
  const Ellipsoid e(Vector3d::Zero(), axes, R);
  const Vector3d n = random_direction<3>(generator);
  const Vector3d touched =
      test_support::surface_point<3>(e, axes.cwiseProduct(R.transpose() * n).normalized());
  const Vector3d nearest = touched + gap * n;
  Vector3d d = random_direction<3>(generator);
  if (uniform(generator, 0, 1) < 0.5) {  // beside the obstacle
    d = (d - n * n.dot(d)).normalized();
    const double before = uniform(generator, 0, kLength);
    return {e, nearest - before * d, nearest + (kLength - before) * d};
  }
  if (d.dot(n) < 0) d = -d;  // ending before it
  return {e, nearest, nearest + kLength * d};
}

TEST(Conservatism, LinksOfKnownDistanceHaveIt) {
  Generator generator(74);
  for (int i = 0; i < 400; ++i) {
    const Shape shape{i % 4 < 2 ? 3.0 : 30.0, i % 3 == 0};
    const Pair<3> pair = link_at_gap(shape, 0.01, i, generator);
    ASSERT_NEAR(static_cast<double>(DistanceOracle(pair.p1, pair.p2, pair.ellipsoid).distance()),
                0.01, 1e-9)
        << "case " << i;
  }
}

/// Prints the share of free links that the projections call colliding, by aspect, pose and
/// distance.
TEST(Conservatism, ShareOfFreeLinksCalledColliding) {
  constexpr int kPairs = 20000;
  constexpr std::array kGaps = {0.001, 0.01, 0.05};  // [m]
  std::printf("aspect  axes      called colliding at  1 mm   10 mm   50 mm\n");
  for (const bool rotated : {false, true}) {
    for (const double aspect : {1.0, 3.0, 10.0, 100.0}) {
      std::array<double, kGaps.size()> share{};
      for (std::size_t g = 0; g < kGaps.size(); ++g) {
        Generator generator(75);
        int called_colliding = 0;
        for (int i = 0; i < kPairs; ++i) {
          const Pair<3> pair = link_at_gap({aspect, rotated}, kGaps[g], i, generator);
          called_colliding += Asked(pair.ellipsoid).hit(pair.p1, pair.p2);
        }
        share[g] = static_cast<double>(called_colliding) / kPairs;
        EXPECT_LT(share[g], 0.9);
        if (g > 0) {
          EXPECT_LT(share[g], share[g - 1]) << "further away is easier to see";
        }
        const std::string label = "aspect_" + std::to_string(static_cast<int>(aspect)) +
                                  (rotated ? "_rotated" : "_aligned") + "_gap_mm_" +
                                  std::to_string(static_cast<int>(1e3 * kGaps[g]));
        RecordProperty(label, std::to_string(share[g]));
      }
      std::printf("%6.0f  %s  %22.1f %% %5.1f %% %5.1f %%\n", aspect,
                  rotated ? "rotated" : "aligned", 100 * share[0], 100 * share[1], 100 * share[2]);
      EXPECT_GT(share[0], 0.05) << "Lemma 1 would be all but exact";
    }
  }
}

}  // namespace
}  // namespace bqsa
