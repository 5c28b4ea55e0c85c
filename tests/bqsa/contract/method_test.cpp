// The contract: which problems a method applies to, the problem's limits, names of states.

#include "bqsa/method.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <string>

namespace bqsa {
namespace {

Problem problem_of_dimension(int dimension) {
  ChainDescription chain = planar_chain({0.3, 0.2});
  chain.dimension = dimension;
  Problem problem{.name = "arm",
                  .chain = SerialChain(chain),
                  .obstacles = {},
                  .desired_tip = {},
                  .start = JointVector::Zero(2),
                  .limits = {}};
  problem.ticks = 10;
  problem.dt = 0.1;
  return problem;
}

Problem planar_problem() { return problem_of_dimension(2); }
Problem spatial_problem() { return problem_of_dimension(3); }

TEST(Applicability, FollowsTheDeclaredCapabilities) {
  const Capabilities nothing, planar{.planar = true}, spatial{.spatial = true};
  EXPECT_EQ(why_not_applicable(planar, planar_problem()), "");
  EXPECT_EQ(why_not_applicable(spatial, spatial_problem()), "");
  EXPECT_EQ(why_not_applicable(nothing, planar_problem()), "planar problems not supported yet");
  EXPECT_EQ(why_not_applicable(planar, spatial_problem()), "spatial problems not supported yet");
}

TEST(Applicability, AsksForLinkRadiusAndMarginOnlyWhereTheyAreUsed) {
  const Capabilities planar{.planar = true};
  Problem problem = planar_problem();
  problem.link_radius = 0.01;
  EXPECT_EQ(why_not_applicable(planar, problem), "link_radius not supported yet");
  EXPECT_EQ(why_not_applicable({.planar = true, .link_radius = true}, problem), "");
  problem.margin = 0.001;
  EXPECT_EQ(why_not_applicable({.planar = true, .link_radius = true}, problem),
            "margin not supported yet");
  EXPECT_EQ(why_not_applicable({.planar = true, .link_radius = true, .margin = true}, problem), "");
}

TEST(Applicability, AsksForOrientationOnlyWhereTheTaskHasOne) {
  const Capabilities position{.spatial = true}, turned{.spatial = true, .orientation = true};
  Problem problem = spatial_problem();
  EXPECT_EQ(why_not_applicable(position, problem), "");
  for (const TaskKind kind : {TaskKind::kAxis, TaskKind::kPose}) {
    problem.task_kind = kind;
    EXPECT_EQ(why_not_applicable(position, problem), "orientation tasks not supported yet");
    EXPECT_EQ(why_not_applicable(turned, problem), "");
  }
}

TEST(Applicability, AsksForPrismaticJointsOnlyWhereThereAreAny) {
  const Capabilities turning{.spatial = true, .prismatic = false}, sliding{.spatial = true};
  Problem problem = spatial_problem();
  EXPECT_EQ(why_not_applicable(turning, problem), "");
  ChainDescription rail;
  rail.placements.push_back({.type = JointType::kPrismatic});
  problem.chain = SerialChain(rail);
  EXPECT_EQ(why_not_applicable(turning, problem), "prismatic joints not supported yet");
  EXPECT_EQ(why_not_applicable(sliding, problem), "");
  EXPECT_EQ(problem.max_step(0), kDefaultMaxSlide);
}

TEST(Applicability, AsksForMotionOnlyWhereAnObstacleMoves) {
  const Capabilities still{.planar = true}, moving{.planar = true, .moving = true};
  Problem problem = planar_problem();
  const Ellipsoid shape({2, 0, 0}, {0.1, 0.1, 0.1});
  problem.obstacles = {{"still", shape}, {"other", shape}};
  EXPECT_EQ(why_not_applicable(still, problem), "");
  problem.obstacles[1].motion.assign(11, shape);
  EXPECT_EQ(why_not_applicable(still, problem), "moving obstacles not supported yet");
  EXPECT_EQ(why_not_applicable(moving, problem), "");
}

TEST(ProblemObstacles, AreWhereTheirMotionSays) {
  const Ellipsoid here({2, 0, 0}, {0.1, 0.1, 0.1}), there({3, 0, 0}, {0.1, 0.1, 0.1});
  const Obstacle still{"still", here}, mover{"mover", here, {here, there}};
  EXPECT_FALSE(still.moves());
  EXPECT_TRUE(mover.moves());
  EXPECT_EQ(still.at(7).center().x(), 2);
  EXPECT_EQ(mover.at(0).center().x(), 2);
  EXPECT_EQ(mover.at(1).center().x(), 3);
}

TEST(ProblemTiming, CountsTicksOfTheControlPeriod) {
  const Problem problem = planar_problem();
  EXPECT_DOUBLE_EQ(problem.duration(), 1);
  EXPECT_DOUBLE_EQ(problem.time(0), 0);
  EXPECT_DOUBLE_EQ(problem.time(10), problem.duration());
}

TEST(ProblemLimits, AreUnlimitedUnlessGiven) {
  const Problem problem = planar_problem();
  EXPECT_TRUE(problem.within_limits(JointVector::Constant(2, 1e6)));
  EXPECT_DOUBLE_EQ(problem.max_step(1), 15 * std::numbers::pi / 180);
}

TEST(ProblemLimits, BoundAnglesInclusivelyAndStepsByVelocity) {
  Problem problem = planar_problem();
  problem.limits.lower = JointVector::Constant(2, -1);
  problem.limits.upper = JointVector::Constant(2, 2);
  problem.limits.max_velocity = JointVector::Constant(2, 0.5);
  problem.limits.max_velocity(1) = 3;
  JointVector q = JointVector::Constant(2, -1);
  EXPECT_TRUE(problem.within_limits(q));
  q(1) = 2;
  EXPECT_TRUE(problem.within_limits(q));
  q(1) = 2.001;
  EXPECT_FALSE(problem.within_limits(q));
  q << -1.001, 0;
  EXPECT_FALSE(problem.within_limits(q));
  EXPECT_DOUBLE_EQ(problem.max_step(0), 0.05);
  EXPECT_DOUBLE_EQ(problem.max_step(1), 0.3);
}

TEST(Names, OfAllStatesAndReasonsAreDistinct) {
  std::set<std::string> states, reasons;
  for (int i = 0; i <= static_cast<int>(TickState::kInfeasible); ++i) {
    states.insert(name_of(static_cast<TickState>(i)));
  }
  for (int i = 0; i <= static_cast<int>(Infeasible::kDiverged); ++i) {
    reasons.insert(name_of(static_cast<Infeasible>(i)));
  }
  EXPECT_EQ(states, (std::set<std::string>{"free", "clamped", "unclaimed", "infeasible"}));
  EXPECT_EQ(reasons.size(), 1u + static_cast<std::size_t>(Infeasible::kDiverged));
  EXPECT_EQ(reasons.count("?"), 0u);
}

}  // namespace
}  // namespace bqsa
