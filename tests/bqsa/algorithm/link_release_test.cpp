#include "bqsa/link_release.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <bit>

#include "bqsa/bqsa_planar.hpp"
#include "support/allocation_guard.hpp"
#include "support/distance_oracle.hpp"
#include "support/random_scenes.hpp"
#include "support/replay.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using test_support::DistanceOracle;
using test_support::Generator;
using test_support::random_ellipsoid;
using test_support::uniform;

SerialChain arm_of(int dimension) {
  return SerialChain(dimension == 2 ? planar_chain(std::vector<double>(7, 0.2))
                                    : test_support::seven_joint_arm());
}

JointVector random_posture(Generator& generator, int joints) {
  return JointVector::NullaryExpr(joints,
                                  [&](Eigen::Index) { return uniform(generator, -1.2, 1.2); });
}

double true_distance(const SerialChain& arm, const JointVector& q, const Link& link,
                     const Ellipsoid& shape) {
  ChainPose pose;
  arm.forward(q, pose);
  const DistanceOracle oracle(pose.p_WO.col(link.start), pose.p_WO.col(link.end), shape);
  return static_cast<double>(oracle.distance());
}

template <typename Dimension>
class LinkReleaseTest : public ::testing::Test {
 protected:
  static constexpr int kDimension = Dimension::value;

  static Ellipsoid as_solid(const EllipsoidN<kDimension>& shape) {
    if constexpr (kDimension == 2) {
      return embedded(shape);
    } else {
      return shape;
    }
  }

  /// d distance / dq as LinkRelease takes it, before the projection on the self-motions.
  static JointVector gradient(const SerialChain& arm, const ChainPose& pose, const Link& link,
                              const typename ObstacleField<kDimension>::Proximity& proximity) {
    TaskJacobian J_start, J_end;
    arm.jacobian(pose, link.start, J_start);
    arm.jacobian(pose, link.end, J_end);
    const auto& [distance, t, normal] = proximity;
    return (1 - t) * (J_start.transpose() * normal) + t * (J_end.transpose() * normal);
  }

  static JointVector differences(const SerialChain& arm, const JointVector& q, const Link& link,
                                 const Ellipsoid& shape, double h) {
    JointVector result(arm.joints());
    for (int j = 0; j < arm.joints(); ++j) {
      const JointVector e = h * JointVector::Unit(arm.joints(), j);
      result(j) = (true_distance(arm, q + e, link, shape) - true_distance(arm, q - e, link, shape));
    }
    return result / (2 * h);
  }
};
using DimensionTypes =
    ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LinkReleaseTest, DimensionTypes);

TYPED_TEST(LinkReleaseTest, ProximityWithAClearanceIsTheDistanceAndItsGradient) {
  constexpr int kDim = TestFixture::kDimension;
  Generator generator(60);
  const SerialChain arm = arm_of(kDim);
  WorkCounters counters;
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const JointVector q = random_posture(generator, arm.joints());
    const Ellipsoid shape = this->as_solid(random_ellipsoid<kDim>(generator, 0.05, 0.3));
    ObstacleField<kDim> field;
    const std::vector<Obstacle> obstacles = {{"o", shape}};
    field.assign(obstacles, counters, 1);
    field.keep(10);
    ChainPose pose;
    arm.forward(q, pose);
    for (const Link& link : arm.links()) {
      const double distance = true_distance(arm, q, link, shape);
      if (distance < 1e-3) continue;
      const auto proximity = field.proximity(pose, link, 0);
      ASSERT_NEAR(proximity.distance, distance, 1e-12) << "case " << i << ", link " << link.number;
      const JointVector error =
          this->gradient(arm, pose, link, proximity) - this->differences(arm, q, link, shape, 1e-5);
      ASSERT_LT(error.norm(), 1e-6) << "case " << i << ", link " << link.number;
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
}

TYPED_TEST(LinkReleaseTest, ProximityByTheQuadraticIsTheDistanceAndItsGradientNearContact) {
  constexpr int kDim = TestFixture::kDimension;
  Generator generator(61);
  const SerialChain arm = arm_of(kDim);
  WorkCounters counters;
  constexpr double kNear = 1e-5;  // [m]
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const JointVector q = random_posture(generator, arm.joints());
    const Ellipsoid somewhere = this->as_solid(random_ellipsoid<kDim>(generator, 0.05, 0.3));
    ChainPose pose;
    arm.forward(q, pose);
    ObstacleField<kDim> field;
    for (const Link& link : arm.links()) {
      const std::vector<Obstacle> elsewhere = {{"o", somewhere}};
      field.assign(elsewhere, counters, 1);
      field.keep(10);
      const auto far = field.proximity(pose, link, 0);
      if (far.distance < 1e-3) continue;
      Eigen::Vector3d way = Eigen::Vector3d::Zero();
      way.head<kDim>() = (far.distance - kNear) * far.normal;
      const Ellipsoid shape(somewhere.center() + way, somewhere.semi_axes(), somewhere.rotation());
      const std::vector<Obstacle> obstacles = {{"o", shape}};
      field.assign(obstacles, counters);
      const auto proximity = field.proximity(pose, link, 0);
      ASSERT_NEAR(proximity.distance, kNear, 0.01 * kNear) << "case " << i;
      const JointVector error =
          this->gradient(arm, pose, link, proximity) - this->differences(arm, q, link, shape, 1e-7);
      ASSERT_LT(error.norm(), 0.01) << "case " << i << ", link " << link.number;
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
}

/// The least |dq| with all a_cᵀ dq >= missing_c, from all sets of active contacts; the condition number
/// of the contacts goes to `condition`.
JointVector least_motion_by_enumeration(std::span<const Contact> contacts, double& condition) {
  using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const auto count = static_cast<unsigned>(contacts.size());
  const Eigen::Index joints = contacts[0].a.size();
  LongMatrix A(count, joints);
  LongVector missing(count);
  for (unsigned c = 0; c < count; ++c) {
    A.row(c) = contacts[c].a.cast<long double>();
    missing(c) = contacts[c].missing;
  }
  const LongMatrix directions = A.rowwise().normalized();
  const Eigen::VectorXd s = directions.cast<double>().jacobiSvd().singularValues();
  condition = s(0) / s(s.size() - 1);
  LongVector best;
  for (unsigned active = 0; active < 1U << count; ++active) {
    const int rows = std::popcount(active);
    LongMatrix A_active(rows, joints);
    LongVector b(rows);
    for (unsigned c = 0, row = 0; c < count; ++c) {
      if ((active >> c & 1U) == 0) continue;
      A_active.row(row) = A.row(c);
      b(row++) = missing(c);
    }
    LongVector dq = LongVector::Zero(joints);
    if (rows > 0) {
      const LongMatrix gram = A_active * A_active.transpose();
      const LongVector lambda = gram.fullPivLu().solve(b);
      if ((lambda.array() < 0).any()) continue;
      dq = A_active.transpose() * lambda;
    }
    if (((A * dq - missing).array() < -1e-15L).any()) continue;
    if (best.size() == 0 || dq.norm() < best.norm()) best = dq;
  }
  return best.cast<double>();
}

TEST(LeastMotion, IsTheSmallestMotionThatAllContactsAllow) {
  Generator generator(62);
  int active_contacts = 0, idle_contacts = 0, compared = 0;
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const int joints = 4 + i % 4;
    std::vector<Contact> contacts(static_cast<std::size_t>(1 + i / 4 % 4));
    for (Contact& contact : contacts) {
      const double scale = test_support::log_uniform(generator, 0.05, 1);
      contact.a = JointVector::NullaryExpr(
          joints, [&](Eigen::Index) { return scale * test_support::normal(generator); });
      contact.missing = uniform(generator, -0.01, 0.02);
    }
    double condition = 0;
    const JointVector expected = least_motion_by_enumeration(contacts, condition);
    if (condition > 4) continue;
    ASSERT_EQ(expected.size(), joints) << "case " << i;
    const JointVector dq = least_motion(joints, contacts);
    const double error = (dq - expected).norm() / (1e-3 + expected.norm());
    ASSERT_LT(error, 1e-3) << "case " << i << ", condition " << condition;
    worst = std::max(worst, error);
    ++compared;
    for (const Contact& contact : contacts) {
      EXPECT_GE(contact.lambda, 0);
      ++(contact.lambda > 0 ? active_contacts : idle_contacts);
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(active_contacts, 1000);
  EXPECT_GT(idle_contacts, 1000);
  RecordProperty("compared", compared);
  RecordProperty("worst", std::to_string(worst));
}

/// An arm whose links are to be released.
template <int Dim>
struct Bench {
  explicit Bench(Problem the_problem) : problem(std::move(the_problem)) {
    const double clearance = problem.link_radius + problem.margin;
    obstacles.assign(problem.obstacles, counters, clearance);
    obstacles.keep(clearance + settings.safety_offset);
    release.assign(problem, task, obstacles, settings, counters);
  }

  /// From the start posture.
  bool run(const JointBox& box) {
    q = problem.start;
    problem.chain.forward(q, pose);
    output = {};
    return release.release(tip_of(problem.start), box, q, pose, &output);
  }

  Eigen::Vector3d tip_of(const JointVector& posture) const {
    ChainPose at;
    problem.chain.forward(posture, at);
    return at.tip();
  }

  Problem problem;
  TipTask task{problem};
  BqsaSettings settings;
  WorkCounters counters;
  ObstacleField<Dim> obstacles;
  LinkRelease<Dim> release;
  JointVector q;
  ChainPose pose;
  StepOutput output;
};

JointBox box_around(const JointVector& q, double half_width) {
  return {q.array() - half_width, q.array() + half_width};
}

template <int Dim>
Problem problem_with(const JointVector& start, std::vector<Obstacle> obstacles) {
  return {.name = "release",
          .chain = arm_of(Dim),
          .obstacles = std::move(obstacles),
          .ticks = 1,
          .dt = 0.04,
          .start = start};
}

/// The point of a link that divides it so, 0 .. 1.
Eigen::Vector3d on_link(const SerialChain& arm, const JointVector& q, std::size_t link, double t) {
  ChainPose pose;
  arm.forward(q, pose);
  const Link& at = arm.links()[link];
  return (1 - t) * pose.p_WO.col(at.start) + t * pose.p_WO.col(at.end);
}

Ellipsoid ball(const Eigen::Vector3d& center, double radius) {
  return {center, Eigen::Vector3d::Constant(radius)};
}

/// One to three balls that links of a random posture reach into, in the plane or in space.
template <int Dim>
Problem hit_arm(Generator& generator) {
  const SerialChain arm = arm_of(Dim);
  const JointVector q = random_posture(generator, arm.joints());
  std::vector<Obstacle> balls;
  for (const int count = static_cast<int>(uniform(generator, 1, 3.999));
       static_cast<int>(balls.size()) < count;) {
    const auto link = static_cast<std::size_t>(
        uniform(generator, 1, static_cast<double>(arm.links().size()) - 1e-3));
    Eigen::Vector3d aside = Eigen::Vector3d::Zero();
    aside.head<Dim>() = test_support::random_direction<Dim>(generator);
    const double radius = uniform(generator, 0.02, 0.06);
    const Eigen::Vector3d center = on_link(arm, q, link, uniform(generator, 0.1, 0.8)) +
                                   uniform(generator, 0.5, 0.95) * radius * aside;
    balls.push_back({"ball", ball(center, radius)});
  }
  return problem_with<Dim>(q, balls);
}

TYPED_TEST(LinkReleaseTest, FreesAllLinksWithinTheBoxAndKeepsTheTip) {
  constexpr int kDim = TestFixture::kDimension;
  Generator generator(63);
  int freed = 0, at_a_limit = 0;
  for (int i = 0; i < 200; ++i) {
    Problem problem = hit_arm<kDim>(generator);
    problem.link_radius = i % 2 == 0 ? 0 : 0.004;
    Bench<kDim> bench(problem);
    const JointBox box = box_around(problem.start, uniform(generator, 0.02, 0.5));
    if (!bench.run(box)) continue;
    ++freed;
    EXPECT_TRUE(box.contains(bench.q)) << "case " << i;
    EXPECT_LT((bench.tip_of(bench.q) - bench.tip_of(problem.start)).norm(), 1e-9) << "case " << i;
    for (const Link& link : problem.chain.links()) {
      for (const Obstacle& obstacle : problem.obstacles) {
        EXPECT_GT(true_distance(problem.chain, bench.q, link, obstacle.shape),
                  problem.link_radius + bench.settings.safety_offset - 1e-12)
            << "case " << i << ", link " << link.number;
      }
    }
    EXPECT_GT(bench.output.clamp_count, 0) << "case " << i;
    at_a_limit += (bench.q.array() - box.lower.array() < 1e-6).any() ||
                  (box.upper.array() - bench.q.array() < 1e-6).any();
  }
  EXPECT_GT(freed, 50);
  EXPECT_GT(at_a_limit, 5) << "no box was in the way";
}

TYPED_TEST(LinkReleaseTest, TakesJointsIntoTheirInterval) {
  constexpr int kDim = TestFixture::kDimension;
  Generator generator(64);
  int done = 0;
  for (int i = 0; i < 100; ++i) {
    Bench<kDim> bench(problem_with<kDim>(random_posture(generator, 7), {}));
    const JointVector& start = bench.problem.start;
    JointBox box = box_around(start, 0.2);
    const int joint = i % 7;
    const double beyond = uniform(generator, 0.005, 0.05);
    if (i % 2 == 0) {
      box.lower(joint) = start(joint) + beyond;
    } else {
      box.upper(joint) = start(joint) - beyond;
    }
    if (!bench.run(box)) continue;
    ++done;
    EXPECT_TRUE(box.contains(bench.q)) << "case " << i;
    EXPECT_LT((bench.tip_of(bench.q) - bench.tip_of(start)).norm(), 1e-9) << "case " << i;
  }
  EXPECT_GT(done, 70);
}

TYPED_TEST(LinkReleaseTest, GivesUpWhereNoSelfMotionHelps) {
  constexpr int kDim = TestFixture::kDimension;
  Generator generator(65);
  Problem problem = hit_arm<kDim>(generator);
  const Eigen::Vector3d on_base = on_link(problem.chain, problem.start, 0, 0.2);
  problem.obstacles = {{"in the base", ball(on_base, 0.06)}};
  Bench<kDim> bench(problem);
  EXPECT_FALSE(bench.run(box_around(problem.start, 3)));

  Bench<kDim> held(hit_arm<kDim>(generator));
  EXPECT_FALSE(held.run(box_around(held.problem.start, 1e-7))) << "an arm that may not move";

  Bench<kDim> off_the_path(problem_with<kDim>(JointVector::Constant(7, 0.3), {}));
  JointVector q = off_the_path.problem.start;
  off_the_path.problem.chain.forward(q, off_the_path.pose);
  EXPECT_FALSE(off_the_path.release.release({9, 9, 0}, box_around(q, 3), q, off_the_path.pose));
}

TYPED_TEST(LinkReleaseTest, NeverClaimsFreedomWhenThereAreMoreContactsThanItKeeps) {
  constexpr int kDim = TestFixture::kDimension;
  Generator generator(66);
  int freed = 0, given_up = 0;
  for (int i = 0; i < 40; ++i) {
    Problem problem = hit_arm<kDim>(generator);
    const std::vector<Obstacle> balls = problem.obstacles;
    Eigen::Vector3d aside = Eigen::Vector3d::Zero();
    aside(1) = 0.012;
    std::vector<Obstacle> beads;
    for (std::size_t k = 0; k < 100; ++k) {
      const std::size_t link = 1 + k % (problem.chain.links().size() - 1);
      const Eigen::Vector3d at =
          on_link(problem.chain, problem.start, link, uniform(generator, 0, 1));
      beads.push_back({"bead", ball(at + aside, 0.001)});
    }
    const bool balls_first = i % 2 == 0;
    problem.obstacles = balls_first ? balls : beads;
    const std::vector<Obstacle>& rest = balls_first ? beads : balls;
    problem.obstacles.insert(problem.obstacles.end(), rest.begin(), rest.end());
    Bench<kDim> bench(problem);
    if (!bench.run(box_around(problem.start, 1))) {
      ++given_up;
      continue;
    }
    ++freed;
    for (const Link& link : problem.chain.links()) {
      for (const Obstacle& obstacle : problem.obstacles) {
        ASSERT_GT(true_distance(problem.chain, bench.q, link, obstacle.shape), 0) << "case " << i;
      }
    }
  }
  EXPECT_GT(given_up, 10);
  this->RecordProperty("freed", freed);
}

TYPED_TEST(LinkReleaseTest, DoesNotAllocate) {
  constexpr int kDim = TestFixture::kDimension;
  Generator generator(67);
  int freed = 0, given_up = 0;
  for (int i = 0; i < 30; ++i) {
    Bench<kDim> bench(hit_arm<kDim>(generator));
    const JointBox box = box_around(bench.problem.start, 0.1);
    const test_support::AllocationGuard guard;
    ++(bench.run(box) ? freed : given_up);
    ASSERT_EQ(guard.allocations(), 0U);
  }
  EXPECT_GT(freed, 2);
  EXPECT_GT(given_up, 2);
}

/// An arm at rest on which two balls close from both sides within one tick.
Problem caught_arm(Generator& generator) {
  Problem problem = problem_with<2>(random_posture(generator, 7), {});
  const SerialChain& arm = problem.chain;
  problem.desired_tip = [tip = on_link(arm, problem.start, 6, 1)](double) { return tip; };
  const auto first = static_cast<std::size_t>(uniform(generator, 1, 4.999));
  for (const std::size_t link : {first, first + 1}) {
    const Eigen::Vector3d start = on_link(arm, problem.start, link, 0);
    const Eigen::Vector3d along = (on_link(arm, problem.start, link, 1) - start).normalized();
    const double side = link == first ? 1 : -1;
    const Eigen::Vector3d across(-side * along.y(), side * along.x(), 0);
    const Eigen::Vector3d at = start + uniform(generator, 0.06, 0.14) * along;
    constexpr double kRadius = 0.03;
    const auto ball_at = [&](double distance) {
      return ball(at + (kRadius + distance) * across, kRadius);
    };
    const double far = 0.01, close = -uniform(generator, 0.002, 0.01);
    problem.obstacles.push_back({"ball", ball_at(far), {ball_at(far), ball_at(close)}});
  }
  return problem;
}

TEST(BackwardSearchRelease, FreesArmsThatAreCaughtWhereOneLinkAfterTheOtherDoesNot) {
  Generator generator(68);
  int scenes = 0, one_by_one = 0, together = 0, only_together = 0;
  while (scenes < 100) {
    const Problem problem = caught_arm(generator);
    if (!test_support::sampled_hits(problem, {problem.start}, 0).empty()) continue;
    ++scenes;
    BqsaSettings never, last;
    never.release = Release::kNever;
    BqsaPlanar search_never(PlanarVariant::kExact, never), search_last(PlanarVariant::kExact, last);
    const bool alone =
        test_support::replay(search_never, problem).last.state != TickState::kInfeasible;
    const test_support::Replay run = test_support::replay(search_last, problem);
    const bool all = run.last.state != TickState::kInfeasible;
    if (all) {
      EXPECT_TRUE(test_support::sampled_hits(problem, run.q, 50).empty()) << "scene " << scenes;
    }
    EXPECT_TRUE(all || !alone) << "scene " << scenes;
    one_by_one += alone;
    together += all;
    only_together += all && !alone;
  }
  RecordProperty("one_by_one", one_by_one);
  RecordProperty("together", together);
  EXPECT_GT(one_by_one, 0);
  EXPECT_GT(only_together, 5);
}

TEST(BackwardSearchRelease, RescuesATickWhoseOwnStepBreaksAJointLimit) {
  Problem problem = test_support::planar_7r();
  problem.obstacles.clear();
  BqsaSettings settings;
  settings.release = Release::kNever;
  BqsaPlanar tracking(PlanarVariant::kExact, settings);
  const test_support::Replay unlimited = test_support::replay(tracking, problem);
  problem.limits.lower = JointVector::Constant(7, -10);
  problem.limits.upper = JointVector::Constant(7, 10);
  const double highest = unlimited.q.back()(3), start = problem.start(3);
  const double limit = start + 0.5 * (highest - start);
  (highest > start ? problem.limits.upper : problem.limits.lower)(3) = limit;
  const test_support::Replay refused = test_support::replay(tracking, problem);
  EXPECT_EQ(refused.last.reason, Infeasible::kJointLimit);

  for (const auto release : {Release::kLast, Release::kFirst}) {
    settings.release = release;
    BqsaPlanar releasing(PlanarVariant::kExact, settings);
    const test_support::Replay run = test_support::replay(releasing, problem);
    EXPECT_EQ(run.q.size(), 401U) << name_of(run.last.reason);
    for (const JointVector& q : run.q) ASSERT_TRUE(problem.within_limits(q));
    EXPECT_LT(run.tip_error, 1e-8);
  }
}

TEST(BackwardSearchRelease, ComesLastOnlyWhereTheSearchLinkByLinkFailed) {
  const Problem problem = test_support::planar_7r();
  BqsaSettings settings;
  std::vector<test_support::Replay> runs;
  for (const auto release : {Release::kNever, Release::kLast, Release::kFirst}) {
    settings.release = release;
    BqsaPlanar search(PlanarVariant::kExact, settings);
    runs.push_back(test_support::replay(search, problem));
    ASSERT_EQ(runs.back().q.size(), 401U);
    EXPECT_TRUE(test_support::sampled_hits(problem, runs.back().q, 20).empty());
  }
  EXPECT_EQ(runs[0].q, runs[1].q);
  EXPECT_NE(runs[0].q, runs[2].q);
  EXPECT_EQ(runs[0].clamped_ticks, 139);
}

}  // namespace
}  // namespace bqsa
