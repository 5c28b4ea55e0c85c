#include "harness/judge/self_collision.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>

#include "harness/judge/fcl_links.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/link_distance.hpp"
#include "harness/judge/self_check.hpp"
#include "judge_scenes.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using test_support::free_problem;
using test_support::Generator;
using test_support::log_uniform;
using test_support::random_direction;
using test_support::uniform;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

double point_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double length_squared = (b - a).squaredNorm();
  const double t =
      length_squared > 0 ? std::clamp((p - a).dot(b - a) / length_squared, 0.0, 1.0) : 0;
  return (a + t * (b - a) - p).norm();
}

/// By a ternary search for the minimum of a convex function along the first segment.
double searched_distance(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                         const Vector3d& d) {
  double low = 0, high = 1;
  const auto at = [&](double s) { return point_distance(a + s * (b - a), c, d); };
  for (int k = 0; k < 200; ++k) {
    const double one = low + (high - low) / 3, two = high - (high - low) / 3;
    (at(one) < at(two) ? high : low) = at(one) < at(two) ? two : one;
  }
  return std::min({at(low), at(high), at(0), at(1)});
}

TEST(LinkDistance, IsThatOfASearch) {
  Generator generator(1);
  int crossing = 0, at_ends = 0;
  for (int number = 0; number < 20000; ++number) {
    const Vector3d a = random_direction<3>(generator), u = random_direction<3>(generator);
    Vector3d v = random_direction<3>(generator);
    if (number % 4 == 1) v = u;
    if (number % 4 == 2) v = u + log_uniform(generator, 1e-12, 1e-1) * v;
    const Vector3d b = a + uniform(generator, 0.01, 2) * u;
    const Vector3d near = a + uniform(generator, 0, 1) * (b - a) +
                          log_uniform(generator, 1e-9, 1) * random_direction<3>(generator);
    const Vector3d c = near - uniform(generator, -0.2, 1) * v;
    const Vector3d d = number % 50 == 0 ? c : Vector3d(c + uniform(generator, 0.01, 2) * v);
    const LinkDistance found = link_distance(a, b, c, d);
    const double expected = searched_distance(a, b, c, d);
    ASSERT_NEAR(found.distance, expected, 1e-13 + 1e-9 * expected) << "case " << number;
    ASSERT_LE(found.distance, expected + 1e-14) << "case " << number;
    ASSERT_NEAR((found.on_first - a - found.s * (b - a)).norm(), 0, 1e-14) << "case " << number;
    ASSERT_NEAR((found.on_second - c - found.t * (d - c)).norm(), 0, 1e-14) << "case " << number;
    const bool inner = found.s > 0 && found.s < 1 && found.t > 0 && found.t < 1;
    ++(inner ? crossing : at_ends);
  }
  EXPECT_GT(crossing, 2000);
  EXPECT_GT(at_ends, 2000);
}

/// As nearly parallel as it takes, segments that cross have no distance.
TEST(LinkDistance, OfSegmentsThatCrossIsZero) {
  Generator generator(2);
  for (int number = 0; number < 5000; ++number) {
    const Vector3d middle = random_direction<3>(generator), u = random_direction<3>(generator);
    const Vector3d v = u + log_uniform(generator, 1e-10, 1) * random_direction<3>(generator);
    const LinkDistance found =
        link_distance(middle - 0.7 * u, middle + 0.4 * u, middle - 0.3 * v, middle + 0.9 * v);
    ASSERT_LE(found.distance, 2e-15) << "case " << number;
  }
}

TEST(LinkDistance, ItsNormalProvesIt) {
  Generator generator(3);
  for (int number = 0; number < 5000; ++number) {
    const Vector3d a = random_direction<3>(generator), b = random_direction<3>(generator);
    const Vector3d c = Vector3d(2, 0, 0) + random_direction<3>(generator);
    const Vector3d d = Vector3d(2, 0, 0) + random_direction<3>(generator);
    const LinkDistance found = link_distance(a, b, c, d);
    if (found.distance < 1e-3) continue;
    const Vector3d& n = found.normal;
    ASSERT_NEAR(std::min(n.dot(c), n.dot(d)) - std::max(n.dot(a), n.dot(b)), found.distance, 1e-12)
        << "case " << number;
  }
}

TEST(FclLinks, AgreesWithTheExactDistance) {
  fcl_links_self_test();
  Generator generator(4);
  int hits = 0, misses = 0;
  for (int number = 0; number < 5000; ++number) {
    const Vector3d a = random_direction<3>(generator), u = random_direction<3>(generator);
    const Vector3d v = number % 3 == 0 ? u : random_direction<3>(generator);
    const LinkCapsule one{a, a + 0.8 * u, log_uniform(generator, 1e-5, 0.1)};
    const Vector3d c =
        a + 0.3 * u + log_uniform(generator, 1e-5, 0.3) * random_direction<3>(generator);
    const LinkCapsule other{c, c + uniform(generator, 0.1, 1) * v,
                            log_uniform(generator, 1e-5, 0.1)};
    const double clearance = link_distance(one.start, one.end, other.start, other.end).distance -
                             one.radius - other.radius;
    if (std::abs(clearance) < 1e-9) continue;
    ASSERT_EQ(fcl_links_collide(one, other), clearance < 0)
        << "case " << number << ": " << clearance;
    if (clearance > 0) {
      ASSERT_NEAR(fcl_links_distance(one, other), clearance, 1e-8) << "case " << number;
    }
    ++(clearance < 0 ? hits : misses);
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 500);
}

using Pairs = std::vector<std::pair<int, int>>;

Pairs pairs_of(const ChainDescription& chain, const SelfCollision& self_collision = {}) {
  Problem problem = free_problem(chain, 1);
  problem.link_radius = 0.01;
  const SelfScene scene(problem, self_collision);
  Pairs pairs;
  for (const LinkPair& pair : scene.pairs()) {
    pairs.emplace_back(scene.link(pair.first).number, scene.link(pair.second).number);
  }
  return pairs;
}

TEST(SelfScene, PairsAreThoseWithoutACommonPoint) {
  using P = std::pair<int, int>;
  EXPECT_THAT(pairs_of(planar_chain({1, 1})), IsEmpty());
  EXPECT_THAT(pairs_of(planar_chain({1, 1, 1, 1})), ElementsAre(P(1, 3), P(1, 4), P(2, 4)));
  EXPECT_THAT(pairs_of(planar_chain({1, 1, 1, 1}), {.skip = {{4, 1}, {2, 4}}}),
              ElementsAre(P(1, 3)));
  // The links 2 and 3 have no length: 1, 4 and 5 follow each other, and so does the tool.
  ChainDescription wrist;
  wrist.rows = {{.a = 1}, {.alpha = 1}, {.alpha = -1}, {.a = 0.5}, {.d = 0.3}};
  wrist.p_LT = {0.1, 0, 0};
  EXPECT_THAT(pairs_of(wrist), ElementsAre(P(1, 5), P(1, 6), P(4, 6)));
}

/// Standard, modified and placed chains of joints in all directions, with and without tool.
ChainDescription random_chain(Generator& generator, int number) {
  const int joints = 3 + static_cast<int>(generator() % 5);
  ChainDescription chain;
  if (number % 4 == 0) {
    std::vector<double> lengths;
    for (int j = 0; j < joints; ++j) lengths.push_back(uniform(generator, 0.2, 1));
    chain = planar_chain(lengths);
  } else if (number % 4 == 1) {
    for (int j = 0; j < joints; ++j) {
      chain.placements.push_back({test_support::random_rotation<3>(generator),
                                  uniform(generator, 0.1, 0.6) * random_direction<3>(generator)});
    }
  } else {
    if (number % 4 == 2) chain.convention = DhConvention::kModified;
    for (int j = 0; j < joints; ++j) {
      chain.rows.push_back({.a = generator() % 3 == 0 ? 0 : uniform(generator, -0.6, 0.6),
                            .alpha = uniform(generator, -3, 3),
                            .d = generator() % 3 == 0 ? 0 : uniform(generator, -0.6, 0.6)});
    }
  }
  if (number % 3 == 0) chain.p_LT = {0.3, 0, number % 4 == 0 ? 0 : 0.2};
  return chain;
}

VectorXd random_angles(Generator& generator, int joints, double size) {
  VectorXd q(joints);
  for (double& angle : q) angle = uniform(generator, -size, size);
  return q;
}

TEST(SelfScene, JointsThatCarryTheFirstLinkDoNotMoveThePair) {
  Generator generator(5);
  int moved = 0, pairs = 0;
  for (int number = 0; number < 400; ++number) {
    Problem problem = free_problem(planar_chain({1}), 1);
    problem.chain = SerialChain(random_chain(generator, number));
    problem.link_radius = 0.01;
    const SelfScene scene(problem, {});
    const VectorXd q = random_angles(generator, scene.kinematics().joints(), 3);
    PointPositions positions;
    scene.kinematics().place(q, positions);
    for (const LinkPair& pair : scene.pairs()) {
      const auto clearance = [&](const VectorXd& at) {
        PointPositions placed;
        scene.kinematics().place(at, placed);
        return scene.read(placed, pair, FclQuestion::kHit).clearance;
      };
      const int first = scene.first_joint_between(pair);
      VectorXd other = q;
      other.head(first) = random_angles(generator, first, 3);
      ASSERT_NEAR(clearance(other), clearance(q), 1e-12) << number << ": " << scene.show(pair);
      other(first) += 0.5;
      ++pairs;
      if (std::abs(clearance(other) - clearance(q)) > 1e-6) ++moved;
    }
  }
  EXPECT_GT(pairs, 1000);
  EXPECT_GT(moved, pairs / 3) << "joints are left out that the bounds need not count";
}

/// Least clearance of a pair on a straight joint motion, looked at again and again.
double sampled_clearance(const SelfScene& scene, const LinkPair& pair, const VectorXd& from,
                         const VectorXd& to) {
  constexpr int kSamples = 2000;
  PointPositions positions;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kSamples; ++k) {
    const double s = static_cast<double>(k) / kSamples;
    scene.kinematics().place((1 - s) * from + s * to, positions);
    const auto at = [&](int point) { return positions.points[static_cast<std::size_t>(point)]; };
    const LinkSegment& a = scene.link(pair.first);
    const LinkSegment& b = scene.link(pair.second);
    least = std::min(least, link_distance(at(a.start), at(a.end), at(b.start), at(b.end)).distance);
  }
  return least - scene.reach(pair);
}

TEST(SelfCheck, FindsWhatSamplingFinds) {
  Generator generator(6);
  int contacts = 0, between_only = 0, free = 0;
  for (int number = 0; number < 400; ++number) {
    Problem problem = free_problem(planar_chain({1}), 1);
    problem.chain = SerialChain(random_chain(generator, number));
    problem.link_radius = number % 2 == 0 ? 0.002 : 0.03;
    const SelfScene scene(problem, {});
    const int joints = scene.kinematics().joints();
    const VectorXd from = random_angles(generator, joints, 2.5);
    const VectorXd to = from + random_angles(generator, joints, 1);
    const SelfVerdict verdict = check_self_collision(scene, {from, to}, 1L << 20);
    ASSERT_FALSE(verdict.undecided) << "case " << number;
    ASSERT_EQ(verdict.disagreement, "") << "case " << number;
    for (const LinkPair& pair : scene.pairs()) {
      const double least = sampled_clearance(scene, pair, from, to);
      const auto found = std::find_if(verdict.contacts.begin(), verdict.contacts.end(),
                                      [&](const SelfContact& contact) {
                                        return contact.first == scene.link(pair.first).number &&
                                               contact.second == scene.link(pair.second).number;
                                      });
      const bool collides = found != verdict.contacts.end();
      if (least < -Judge::kTouching || least > 1e-2) {
        ASSERT_EQ(collides, least < 0) << "case " << number << ": " << scene.show(pair);
      }
      ++(collides ? contacts : free);
      if (collides && !found->at_tick) ++between_only;
    }
  }
  EXPECT_GT(contacts, 100);
  EXPECT_GT(between_only, 20);
  EXPECT_GT(free, 1000);
}

TEST(SelfCheck, WithoutWorkNothingIsProven) {
  Problem problem = free_problem(planar_chain({1, 1, 1}), 1);
  problem.link_radius = 0.01;
  const SelfScene scene(problem, {});
  const VectorXd from = Vector3d(0, 0.5, 0.5), to = Vector3d(0, 1.5, 1.5);
  EXPECT_TRUE(check_self_collision(scene, {from, to}, 0).undecided);
  EXPECT_FALSE(check_self_collision(scene, {from, to}, 1000).undecided);
}

/// Link 3, 0.251 long, hangs above link 1 from a height of 0.25, and swings across the vertical in one
/// tick: only upright it reaches down to link 1.
class Swing : public ::testing::Test {
 protected:
  Swing() {
    problem_.link_radius = 2e-4;
    const double up = std::atan2(0.25, -0.4);  // of link 2, from (1, 0) to (0.6, 0.25)
    for (int k = 0; k <= problem_.ticks; ++k) {
      const double swing = (k - 0.5) * 7 * std::numbers::pi / 180;
      JointVector q(3);
      q << 0, up, -std::numbers::pi / 2 + 2 * swing - up;
      trajectory_.t.push_back(problem_.time(k));
      trajectory_.q.push_back(q);
    }
    problem_.start = trajectory_.q.front();
  }

  Judgement judged(const std::optional<SelfCollision>& self_collision) const {
    return Judge(problem_, self_collision).judge(trajectory_);
  }

  Problem problem_ = free_problem(planar_chain({1, std::hypot(0.25, 0.4), 0.251}), 1);
  Trajectory trajectory_;
};

TEST_F(Swing, TunnellingBetweenTicksIsCaught) {
  const Judgement judgement = judged(SelfCollision{});
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kSelfCollision));
  ASSERT_EQ(judgement.self_contacts.size(), 1u);
  const SelfContact& contact = judgement.self_contacts[0];
  EXPECT_EQ(contact.first, 1);
  EXPECT_EQ(contact.second, 3);
  EXPECT_EQ(contact.first_tick, 1);
  EXPECT_FALSE(contact.at_tick);
  EXPECT_EQ(contact.ticks, 0);
  const double height = 0.25 - 0.251 * std::cos(7 * std::numbers::pi / 180);
  EXPECT_NEAR(judgement.self_clearance_at_ticks, height - 4e-4, 1e-12);
}

/// At the middle of the motion link 3 points straight up, and its end moves along link 1: what brings it
/// down later is its acceleration alone.
TEST_F(Swing, AWholeTurnFromTheMiddleIsFollowedToo) {
  const JointVector& base = trajectory_.q.front();
  VectorXd from = base, to = base;
  const double up = std::numbers::pi / 2 - base(1), way = 200 * std::numbers::pi / 180;
  from(2) = up - way;
  to(2) = up + way;
  const SelfScene scene(problem_, {});
  const SelfVerdict verdict = check_self_collision(scene, {from, to}, 1L << 20);
  ASSERT_EQ(verdict.contacts.size(), 1u);
  EXPECT_FALSE(verdict.contacts[0].at_tick);
  EXPECT_GT(verdict.clearance_at_ticks, 0.01);
}

TEST_F(Swing, IsFreeIfNotAskedForOrSkippedOrThin) {
  EXPECT_TRUE(judged(std::nullopt).success());
  EXPECT_TRUE(std::isinf(judged(std::nullopt).self_clearance_at_ticks));
  EXPECT_TRUE(judged(SelfCollision{.skip = {{1, 3}}}).success());
  problem_.link_radius = 6e-4;  // now they meet at both ticks
  const Judgement judgement = judged(SelfCollision{});
  ASSERT_EQ(judgement.self_contacts.size(), 1u);
  EXPECT_TRUE(judgement.self_contacts[0].at_tick);
  EXPECT_EQ(judgement.self_contacts[0].ticks, 2);
  EXPECT_EQ(judgement.self_contacts[0].first_tick, 0);
}

/// A planar arm of five links that rolls up, by the same angle at each joint but the first.
TEST(SelfCollision, AnArmThatFoldsMeetsItself) {
  const int kJoints = 5;
  Problem problem = free_problem(planar_chain({1, 1, 1, 1, 1}), 100);
  problem.link_radius = 0.05;
  JointVector step = JointVector::Constant(kJoints, 0.02);
  step(0) = 0;
  const Trajectory trajectory = test_support::steady_motion(problem, step);
  const Judgement judgement = Judge(problem, SelfCollision{}).judge(trajectory);
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kSelfCollision));
  // The ends of a regular polygon of five sides meet at 72 degrees: link 5 comes near link 1 first.
  ASSERT_FALSE(judgement.self_contacts.empty());
  const SelfContact& contact = judgement.self_contacts.front();
  EXPECT_EQ(std::pair(contact.first, contact.second), std::pair(1, 5));
  EXPECT_TRUE(contact.at_tick);
  const SelfScene scene(problem, {});
  for (int tick = contact.first_tick - 1; tick <= contact.first_tick; ++tick) {
    const auto& q = trajectory.q[static_cast<std::size_t>(tick)];
    const double clearance = sampled_clearance(scene, {0, 4}, q, q);
    EXPECT_EQ(clearance < 0, tick == contact.first_tick) << tick << ": " << clearance;
  }
}

}  // namespace
}  // namespace bqsa::harness
