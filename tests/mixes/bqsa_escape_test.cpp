#include "mixes/bqsa_escape.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "bqsa/bqsa_methods.hpp"
#include "support/paper_problems.hpp"
#include "support/replay.hpp"

namespace bqsa::mixes {
namespace {

using test_support::Replay;
using test_support::replay;
using test_support::sampled_hits;

std::unique_ptr<ReactiveMethod> make(
    const MethodEntry& entry,
    std::initializer_list<std::pair<const char*, const char*>> changes = {}) {
  ParameterValues values(entry.parameters);
  for (const auto& [name, value] : changes) values.set(name, value);
  std::unique_ptr<Method> method = entry.make(values);
  return std::unique_ptr<ReactiveMethod>(dynamic_cast<ReactiveMethod*>(method.release()));
}

/// Obstacles in reach but never within influence: nothing leans, every step is that of bqsa.
TEST(BqsaEscape, IsBqsaWhereNothingIsNear) {
  for (Problem problem : {test_support::planar_7r(), test_support::puma560_ellipsoid()}) {
    const auto mix = make(bqsa_escape_method(), {{"influence", "2e-6"}, {"full_distance", "1e-6"}});
    const auto alone = make(bqsa_method());
    for (Obstacle& obstacle : problem.obstacles) {
      obstacle.shape =
          Ellipsoid(obstacle.shape.center() + Eigen::Vector3d(9, 0, 0), obstacle.shape.semi_axes());
    }
    EXPECT_EQ(replay(*mix, problem).q, replay(*alone, problem).q);
    problem =
        problem.dimension() == 2 ? test_support::planar_7r() : test_support::puma560_ellipsoid();
    EXPECT_NE(replay(*make(bqsa_escape_method()), problem).q, replay(*alone, problem).q);
  }
}

/// It gets away before links touch, stays on the path like bqsa, and what it claims is so.
TEST(BqsaEscape, KeepsThePapersArmsAwayAndOnTheirPaths) {
  const auto alone = make(bqsa_method());
  const auto mix = make(bqsa_escape_method());
  for (const Problem& problem : {test_support::planar_7r(), test_support::puma560_ellipsoid(),
                                 test_support::puma560_wall()}) {
    const Replay run = replay(*mix, problem);
    ASSERT_EQ(run.q.size(), static_cast<std::size_t>(problem.ticks) + 1) << problem.name;
    EXPECT_NE(run.last.state, TickState::kInfeasible);
    EXPECT_LT(run.tip_error, 2e-9);
    EXPECT_TRUE(sampled_hits(problem, run.q, 4).empty()) << problem.name;
    EXPECT_LT(run.clamped_ticks, replay(*alone, problem).clamped_ticks) << problem.name;
  }
}

/// A wild escape is cut to what the joints can do, and costs no success.
TEST(BqsaEscape, LeansNoFurtherThanTheJointsCan) {
  const Problem problem = test_support::planar_7r();
  const auto wild =
      make(bqsa_escape_method(),
           {{"influence", "0.3"}, {"full_distance", "0.25"}, {"escape_velocity", "50"}});
  const Replay run = replay(*wild, problem);
  ASSERT_EQ(run.q.size(), static_cast<std::size_t>(problem.ticks) + 1);
  EXPECT_TRUE(sampled_hits(problem, run.q, 4).empty());
  EXPECT_LT(run.tip_error, 2e-9);
  EXPECT_LE(run.largest_step, problem.max_step(0));
  EXPECT_GT(run.largest_step, 0.5 * problem.max_step(0));
}

TEST(BqsaEscape, CountsTheWorkOfBothParts) {
  const Problem problem = test_support::planar_7r();
  const auto mix = make(bqsa_escape_method());
  replay(*mix, problem);
  EXPECT_GT(mix->counters().quadratics, 0U);
  EXPECT_GT(mix->counters().distance_queries, 0U);
}

}  // namespace
}  // namespace bqsa::mixes
