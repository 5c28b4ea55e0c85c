#include "baselines/plain_tracking.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/paper_problems.hpp"
#include "support/replay.hpp"

namespace bqsa::baselines {
namespace {

using test_support::LinkAndObstacle;
using test_support::Replay;
using test_support::sampled_hits;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

Replay run_on(const Problem& problem) {
  const auto method = plain_tracking_method().make(ParameterValues({}));
  return test_support::replay(static_cast<ReactiveMethod&>(*method), problem);
}

TEST(PlainTracking, HitsTheThreePairsOfThePaperSceneWithoutSeeingThem) {
  const Problem problem = test_support::planar_7r();
  const Replay run = run_on(problem);
  EXPECT_THAT(
      sampled_hits(problem, run.q, 0),
      UnorderedElementsAre(LinkAndObstacle{5, 1}, LinkAndObstacle{6, 1}, LinkAndObstacle{7, 0}));
  EXPECT_EQ(run.last.state, TickState::kUnclaimed);
}

TEST(PlainTracking, TracksToSecondOrderInTheControlPeriod) {
  // The first tick closes the start error, which the following ones must not be measured by.
  Problem coarse = test_support::puma560_ellipsoid();
  Problem fine = coarse;
  fine.ticks *= 4;
  fine.dt /= 4;
  const double ratio = run_on(coarse).tip_error / run_on(fine).tip_error;
  EXPECT_GT(ratio, 12);
  EXPECT_LT(ratio, 20);
}

TEST(PlainTracking, LeadsThePumaForearmIntoBothObstacles) {
  for (const Problem& problem : {test_support::puma560_ellipsoid(), test_support::puma560_wall()}) {
    EXPECT_THAT(sampled_hits(problem, run_on(problem).q, 0), ElementsAre(LinkAndObstacle{4, 0}));
  }
}

TEST(PlainTracking, NeverLooksAtMovingObstaclesEither) {
  const Problem resting = test_support::planar_7r(100);
  Problem moving = resting;
  for (int tick = 0; tick <= moving.ticks; ++tick) {
    const Ellipsoid& shape = resting.obstacles[0].shape;
    moving.obstacles[0].motion.emplace_back(shape.center() + tick * Eigen::Vector3d(0.01, 0.02, 0),
                                            shape.semi_axes());
  }
  EXPECT_EQ(why_not_applicable(plain_tracking_method().capabilities, moving), "");
  EXPECT_EQ(run_on(moving).q, run_on(resting).q);
}

}  // namespace
}  // namespace bqsa::baselines
