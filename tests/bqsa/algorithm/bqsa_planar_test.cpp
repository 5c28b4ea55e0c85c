#include "bqsa/bqsa_planar.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <numbers>
#include <random>

#include "bqsa/bqsa_methods.hpp"
#include "bqsa/geometry/separation.hpp"
#include "bqsa/planar_self_motion.hpp"
#include "support/paper_problems.hpp"
#include "support/replay.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using test_support::kDegree;
using test_support::LinkAndObstacle;
using test_support::planar_7r;
using test_support::Replay;
using test_support::replay;
using test_support::sampled_hits;
using ::testing::IsEmpty;
using ::testing::IsSubsetOf;
using ::testing::UnorderedElementsAre;

const LinkAndObstacle kLink6Obstacle{6, 1};
const LinkAndObstacle kLink7Object{7, 0};

/// The paper's scene with the control period as the parameter.
class PlanarScene : public ::testing::TestWithParam<int> {};

TEST_P(PlanarScene, ExactVariantIsFreeAtAndBetweenTicks) {
  const Problem problem = planar_7r(GetParam());
  BqsaPlanar method(PlanarVariant::kExact);
  const Replay run = replay(method, problem);
  ASSERT_EQ(run.q.size(), static_cast<std::size_t>(problem.ticks + 1));
  EXPECT_THAT(sampled_hits(problem, run.q, 8000 / problem.ticks), IsEmpty());
  EXPECT_THAT(run.clamped, UnorderedElementsAre(kLink6Obstacle, kLink7Object));
  EXPECT_LT(run.tip_error, 1e-8);
  EXPECT_LT(run.largest_step, 2 * kDegree);
  EXPECT_LE(run.most_increments, 4) << "exits are computed, not searched for in increments";
}

TEST_P(PlanarScene, PaperVariantIsFreeWithinItsReportedError) {
  const Problem problem = planar_7r(GetParam());
  BqsaPlanar method(PlanarVariant::kPaper);
  const Replay run = replay(method, problem);
  ASSERT_EQ(run.q.size(), static_cast<std::size_t>(problem.ticks + 1));
  EXPECT_THAT(sampled_hits(problem, run.q, 8000 / problem.ticks), IsEmpty());
  EXPECT_THAT(run.clamped, UnorderedElementsAre(kLink6Obstacle, kLink7Object));
  EXPECT_LT(run.tip_error, 3.5e-3);
  EXPECT_LE(run.guard_fired, run.clamped_ticks / 10);
}

INSTANTIATE_TEST_SUITE_P(Ticks, PlanarScene, ::testing::Values(200, 400, 1000, 4000),
                         ::testing::PrintToStringParamName());

TEST(BqsaPlanar, WithoutObstaclesItTracksAndNeverClamps) {
  Problem problem = planar_7r();
  problem.obstacles.clear();
  BqsaPlanar method(PlanarVariant::kExact);
  const Replay run = replay(method, problem);
  EXPECT_EQ(run.q.size(), 401U);
  EXPECT_THAT(run.clamped, IsEmpty());
  EXPECT_LT(run.tip_error, 1e-8);
}

/// Free ticks from random postures to a tip that is `way` away [m]: the tip arrives, and where links turn little the
/// joint step is Jᵀ y with J of the start. It takes so many passes of kinematics in the mean.
double passes_of_free_ticks(double way, bool slight) {
  Problem problem = planar_7r();
  problem.obstacles.clear();
  const SerialChain& chain = problem.chain;
  BqsaPlanar method(PlanarVariant::kExact);
  method.prepare(problem);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  constexpr int kTicks = 200;
  ChainPose pose;
  TaskJacobian J;
  for (int i = 0; i < kTicks; ++i) {
    StepInput input;
    input.tick = 1;
    input.q = JointVector::NullaryExpr(chain.joints(),
                                       [&](Eigen::Index) { return 0.4 * angle(generator); });
    chain.forward(input.q, pose);
    const double direction = angle(generator);
    input.p_WT_desired =
        pose.tip() + way * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0);
    chain.jacobian(pose, chain.points() - 1, J);
    StepOutput output;
    method.step(input, output);
    EXPECT_EQ(output.state, TickState::kFree) << name_of(output.reason);
    chain.forward(output.q, pose);
    EXPECT_LT((pose.tip() - input.p_WT_desired).norm(), 1.01e-9);
    const Eigen::VectorXd step = output.q - input.q;
    const Eigen::MatrixXd rows = Eigen::MatrixXd(J).transpose();
    const Eigen::VectorXd y = rows.colPivHouseholderQr().solve(step);
    const double most = slight ? 1e-12 + 1e-9 * step.norm() : step.norm();
    EXPECT_LT((step - rows * y).norm(), most);
  }
  return static_cast<double>(method.counters().kinematics) / kTicks;
}

TEST(BqsaPlanar, FreeTicksGoAlongTheRowsOfTheJacobianInFewPasses) {
  EXPECT_LT(passes_of_free_ticks(1e-4, true), 3.05)
      << "the start, one to find the step, the answer";
  EXPECT_LT(passes_of_free_ticks(2e-3, true), 4.05) << "one more to find it";
}

TEST(BqsaPlanar, FreeTicksThatTurnLinksFarArriveAllTheSame) {
  EXPECT_GT(passes_of_free_ticks(0.03, false), 4.05) << "as methods for all arms do it";
}

TEST(BqsaPlanar, KeepsLinkRadiusAndMargin) {
  for (const auto& [radius, margin] : {std::pair{0.005, 0.0}, {0.0, 0.004}, {0.003, 0.003}}) {
    Problem problem = planar_7r(200);
    problem.link_radius = radius;
    problem.margin = margin;
    BqsaPlanar method(PlanarVariant::kExact);
    const Replay run = replay(method, problem);
    EXPECT_EQ(run.q.size(), 201U) << name_of(run.last.reason);
    EXPECT_THAT(sampled_hits(problem, run.q, 4, radius + margin), IsEmpty());
    EXPECT_GT(run.clamped_ticks, 0);
  }
}

/// Random arms with one obstacle put on a link that plain tracking would lead into it.
struct RandomScene {
  Problem problem;
  bool valid = false;
};

/// With an obstacle that one of the links from number `first` on would hit.
RandomScene random_scene(test_support::Generator& generator, int first = 3) {
  using test_support::uniform;
  Problem problem = planar_7r(150);
  problem.obstacles.clear();
  problem.start = JointVector::NullaryExpr(
      7, [&](Eigen::Index i) { return uniform(generator, i == 0 ? -1.5 : -0.8, 0.8); });
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Eigen::Vector3d from = pose.tip();
  const Eigen::Vector3d to =
      0.6 * from + Eigen::Vector3d(uniform(generator, -0.6, 0.6), uniform(generator, -0.6, 0.6), 0);
  problem.desired_tip = [from, to](double t) -> Eigen::Vector3d {
    return from + t / 10 * (to - from);
  };
  BqsaPlanar tracking(PlanarVariant::kExact);
  const Replay nominal = replay(tracking, problem);
  if (nominal.q.size() != 151U) return {problem};
  problem.chain.forward(nominal.q[80], pose);
  const int link = static_cast<int>(uniform(generator, first, 7.999));
  const Eigen::Vector2d on_link =
      pose.p_WO.col(link - 1).head<2>() +
      uniform(generator, 0.1, 0.9) * (pose.p_WO.col(link) - pose.p_WO.col(link - 1)).head<2>();
  const double size = uniform(generator, 0.03, 0.12);
  const Ellipse shape =
      rotated_ellipse(on_link, {size, uniform(generator, 0.4, 1) * size}, uniform(generator, 0, 3));
  problem.obstacles = {{"obstacle", embedded(shape)}};
  for (const JointVector& q : nominal.q) {
    problem.chain.forward(q, pose);
    if (shape.level(pose.tip().head<2>()) < 0.2) return {problem};
  }
  return {problem, sampled_hits(problem, {problem.start}, 0).empty()};
}

TEST(BqsaPlanar, OnRandomScenesEveryClaimOfFreedomIsTrueAndMostAreSolved) {
  test_support::Generator generator(7);
  int scenes = 0, solved = 0, infeasible = 0;
  while (scenes < 60) {
    const RandomScene scene = random_scene(generator);
    if (!scene.valid) continue;
    ++scenes;
    BqsaPlanar method(PlanarVariant::kExact);
    const Replay run = replay(method, scene.problem);
    EXPECT_THAT(sampled_hits(scene.problem, run.q, 20), IsEmpty()) << "scene " << scenes;
    EXPECT_LT(run.tip_error, 1e-3) << "scene " << scenes;
    EXPECT_LE(run.largest_step, kDefaultMaxStep) << "scene " << scenes;
    if (run.last.state == TickState::kInfeasible) {
      ++infeasible;
      EXPECT_EQ(run.last.q, run.q.back()) << "an infeasible tick must hold the last configuration";
      EXPECT_NE(run.last.reason, Infeasible::kNot);
    } else {
      ++solved;
    }
  }
  EXPECT_EQ(solved + infeasible, 60);
  EXPECT_GE(solved, 45);
  RecordProperty("solved", solved);
}

TEST(BqsaPlanar, ThePaperVariantsClaimsAreTrueToo) {
  test_support::Generator generator(8);
  BqsaSettings unweighted = default_settings(PlanarVariant::kPaper);
  unweighted.clamped_weight = 1;
  int scenes = 0, clamped = 0, weights_matter = 0;
  while (scenes < 40) {
    const RandomScene scene = random_scene(generator);
    if (!scene.valid) continue;
    ++scenes;
    BqsaPlanar method(PlanarVariant::kPaper);
    const Replay run = replay(method, scene.problem);
    EXPECT_THAT(sampled_hits(scene.problem, run.q, 20), IsEmpty()) << "scene " << scenes;
    clamped += run.clamped_ticks > 0;
    BqsaPlanar without_weights(PlanarVariant::kPaper, unweighted);
    weights_matter += replay(without_weights, scene.problem).q != run.q;
  }
  EXPECT_GT(clamped, 30);
  EXPECT_GT(weights_matter, 0) << "no scene clamps a link whose anchor leaves joints to hold still";
}

TEST(BqsaPlanar, KeepsTheTipOfASmallArmOnItsPathToo) {
  Problem small = planar_7r();
  small.chain = SerialChain(planar_chain(std::vector<double>(7, 0.004)));
  small.obstacles.clear();
  const Problem large = planar_7r();
  small.desired_tip = [&large](double t) -> Eigen::Vector3d { return 0.01 * large.desired_tip(t); };
  BqsaPlanar method(PlanarVariant::kExact);
  const Replay run = replay(method, small);
  EXPECT_EQ(run.q.size(), 401U);
  EXPECT_LT(run.tip_error, 1e-8);
}

/// A link keeps what the halvings of an increment would leave it, and hardly more.
TEST(BqsaPlanar, LeavesLinksAtTheExit) {
  const Problem problem = planar_7r();
  BqsaSettings settings;
  settings.retries = 0;
  BqsaPlanar method(PlanarVariant::kExact, settings);
  method.prepare(problem);
  const double beyond = settings.increment / 128 * problem.chain.reach(0, 7);
  StepInput input;
  StepOutput output;
  ChainPose pose;
  input.q = problem.start;
  int cleared = 0;
  for (input.tick = 1; input.tick <= problem.ticks; ++input.tick) {
    input.t = problem.time(input.tick);
    input.p_WT_desired = problem.desired_tip(input.t);
    method.step(input, output);
    if (output.state == TickState::kInfeasible) break;
    input.q = output.q;
    problem.chain.forward(output.q, pose);
    for (int c = 0; c < output.clamp_count; ++c) {
      const Clamp& clamp = output.clamps[static_cast<std::size_t>(c)];
      const Ellipsoid& shape =
          problem.obstacles[static_cast<std::size_t>(clamp.obstacle)].at(input.tick);
      const double kept =
          separation<3>(shape, pose.p_WO.col(clamp.link - 1), pose.p_WO.col(clamp.link));
      EXPECT_GT(kept, settings.safety_offset) << input.tick;
      EXPECT_LT(kept, settings.safety_offset + beyond) << input.tick;
      ++cleared;
    }
  }
  EXPECT_GT(cleared, 30);
}

/// Least distance to keep of the links numbered lowest .. highest, as the quadratic proves it [m].
double kept(const Problem& problem, const JointVector& q, int lowest, int highest) {
  ChainPose pose;
  problem.chain.forward(q, pose);
  double least = std::numeric_limits<double>::infinity();
  for (int link = lowest; link <= highest; ++link) {
    for (const Obstacle& obstacle : problem.obstacles) {
      least = std::min(least,
                       separation<3>(obstacle.shape, pose.p_WO.col(link - 1), pose.p_WO.col(link)));
    }
  }
  return least;
}

/// What a tick says of a link that it turned, where it turned no other: the same tick without obstacles
/// shows from where.
TEST(BqsaPlanar, TurnsALinkToItsExitWithinTheSearchRange) {
  test_support::Generator generator(9);
  int scenes = 0, turned = 0, too_far = 0;
  while (scenes < 60) {
    const RandomScene scene = random_scene(generator, 1);
    if (!scene.valid) continue;
    BqsaSettings settings;
    settings.retries = 0;
    settings.release = Release::kNever;
    settings.search_range = ++scenes % 2 == 0 ? 0.01 : 0.6;
    const Problem& problem = scene.problem;
    Problem empty = problem;
    empty.obstacles.clear();
    const double resolution = std::ldexp(settings.increment, -settings.settling);
    WorkCounters counters;
    PlanarSelfMotion self_motion;
    self_motion.assign(problem.chain, counters);
    ChainPose pose;
    BqsaPlanar method(PlanarVariant::kExact, settings), tracking(PlanarVariant::kExact, settings);
    method.prepare(problem);
    tracking.prepare(empty);
    StepInput input;
    StepOutput output, prediction;
    input.q = problem.start;
    for (input.tick = 1; input.tick <= problem.ticks; ++input.tick) {
      input.t = problem.time(input.tick);
      input.p_WT_desired = problem.desired_tip(input.t);
      method.step(input, output);
      tracking.step(input, prediction);
      if (output.state == TickState::kInfeasible) break;
      input.q = output.q;
      if (output.clamp_count != 1) continue;
      ++turned;
      const Clamp& clamp = output.clamps[0];
      const double turn = (output.q - prediction.q).head(clamp.link).sum();
      EXPECT_NEAR(clamp.offset, turn, 1e-9) << scenes << ' ' << input.tick;
      EXPECT_LE(std::abs(clamp.offset), settings.search_range) << scenes << ' ' << input.tick;
      const int lowest = clamp.link <= 3 ? 1 : clamp.link;
      EXPECT_GT(kept(problem, output.q, lowest, clamp.anchor), settings.safety_offset)
          << scenes << ' ' << input.tick;
      JointVector back = output.q;
      problem.chain.forward(back, pose);
      ASSERT_TRUE(self_motion.turn_link(clamp.link, clamp.anchor,
                                        std::copysign(resolution, -clamp.offset), back, pose));
      too_far += kept(problem, back, lowest, clamp.anchor) > settings.safety_offset;
    }
  }
  EXPECT_GT(turned, 1000);
  EXPECT_LT(too_far, turned / 200) << "next to a stretched arm a turn is not smooth";
}

TEST(BqsaPlanar, EndsATickWhenItsIncrementsAreSpent) {
  BqsaSettings settings;
  settings.max_increments = 1;
  BqsaPlanar method(PlanarVariant::kExact, settings);
  const Replay run = replay(method, planar_7r());
  EXPECT_EQ(run.last.reason, Infeasible::kNoFreeConfiguration);
  EXPECT_LT(run.q.size(), 401U);
}

TEST(BqsaPlanar, RefusesATickWithoutAWayOutAndSaysWhichLinkAndObstacle) {
  Problem problem = planar_7r();
  // A wall of obstacles across link 4 leaves no orientation of it within the search range.
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Eigen::Vector2d middle = 0.5 * (pose.p_WO.col(3) + pose.p_WO.col(4)).head<2>();
  problem.obstacles = {{"boulder", embedded(rotated_ellipse(middle, {0.3, 0.3}, 0))}};
  BqsaPlanar method(PlanarVariant::kExact);
  const Replay run = replay(method, problem);
  EXPECT_EQ(run.q.size(), 1U);
  EXPECT_EQ(run.last.state, TickState::kInfeasible);
  EXPECT_EQ(run.last.reason, Infeasible::kNoFreeConfiguration);
  EXPECT_GT(run.last.link, 0);
  EXPECT_EQ(run.last.obstacle, 0);
  EXPECT_EQ(run.last.q, problem.start);
  EXPECT_EQ(run.last.clamp_count, 0) << "nothing was moved out of the way";
}

TEST(BqsaPlanar, RefusesAStepBeyondTheVelocityLimitAndBeyondJointLimits) {
  Problem fast = planar_7r();
  fast.limits.max_velocity = JointVector::Constant(7, 1e-3);
  BqsaPlanar method(PlanarVariant::kExact);
  EXPECT_EQ(replay(method, fast).last.reason, Infeasible::kStepTooLarge);

  Problem narrow = planar_7r();
  narrow.limits.lower = narrow.start.array() - 0.05;
  narrow.limits.upper = narrow.start.array() + 0.05;
  const Replay run = replay(method, narrow);
  EXPECT_EQ(run.last.reason, Infeasible::kJointLimit);
  for (const JointVector& q : run.q) EXPECT_TRUE(narrow.within_limits(q));
}

TEST(BqsaPlanar, ClampingKeepsJointLimitsOrRefuses) {
  // Limits that plain tracking keeps and that clamping, unlimited, breaks.
  Problem problem = planar_7r();
  Problem without = problem;
  without.obstacles.clear();
  BqsaPlanar method(PlanarVariant::kExact);
  problem.limits.lower = problem.limits.upper = problem.start;
  for (const JointVector& q : replay(method, without).q) {
    problem.limits.lower = problem.limits.lower.cwiseMin(JointVector(q.array() - 0.01));
    problem.limits.upper = problem.limits.upper.cwiseMax(JointVector(q.array() + 0.01));
  }
  bool unlimited_breaks_them = false;
  for (const JointVector& q : replay(method, planar_7r()).q) {
    unlimited_breaks_them = unlimited_breaks_them || !problem.within_limits(q);
  }
  EXPECT_TRUE(unlimited_breaks_them);
  const Replay run = replay(method, problem);
  EXPECT_GT(run.clamped_ticks, 0);
  for (const JointVector& q : run.q) EXPECT_TRUE(problem.within_limits(q));
}

TEST(BqsaPlanar, GivesTheSameTrajectoryEveryTime) {
  const Problem problem = planar_7r();
  BqsaPlanar method(PlanarVariant::kExact);
  const Replay first = replay(method, problem);
  const WorkCounters first_work = method.counters();
  const Replay second = replay(method, problem);
  EXPECT_EQ(first.q, second.q);
  EXPECT_EQ(first_work.quadratics, method.counters().quadratics);
  EXPECT_GT(first_work.quadratics, 400U * 14U);
}

TEST(BqsaPlanar, RefusesSpatialProblemsAndOtherChains) {
  BqsaPlanar method(PlanarVariant::kExact);
  Problem modified = planar_7r();
  ChainDescription chain = modified.chain.description();
  chain.convention = DhConvention::kModified;
  modified.chain = SerialChain(chain);
  EXPECT_THROW(method.prepare(modified), std::invalid_argument);
  EXPECT_THROW(method.prepare(test_support::puma560_ellipsoid()), std::invalid_argument);
  EXPECT_EQ(why_not_applicable(bqsa_paper_method().capabilities, test_support::puma560_ellipsoid()),
            "spatial problems not supported yet");
}

}  // namespace
}  // namespace bqsa
