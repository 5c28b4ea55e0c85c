#include "baselines/closest/vectorized_test_point_search.hpp"

#include <gtest/gtest.h>

#include "baselines/closest/test_point_search.hpp"
#include "bqsa/batch/instruction_set.hpp"
#include "support/closest_point_scenes.hpp"

namespace bqsa::baselines {
namespace {

using test_support::Generator;
using test_support::random_closest_point_scene;
using test_support::uniform;

TEST(VectorizedTestPointSearch, AnswersWhatTheScalarSearchAnswers) {
  Generator generator(1);
  const std::span<const InstructionSet> sets = instruction_sets();
  int compared = 0, inside = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Problem problem = random_closest_point_scene(generator, trial);
    const TestPointCounts counts{.link = 2 + trial % 29, .obstacle = 3 + trial % 150};
    const double exempt_length = trial % 5 == 0 ? 0 : uniform(generator, 0, 0.3);
    const double reach = uniform(generator, 0, 1);
    TestPointSearch scalar(counts);
    VectorizedTestPointSearch vectorized(counts);
    WorkCounters scalar_work, vectorized_work;
    scalar.assign(problem, exempt_length, scalar_work);
    vectorized.assign(problem, exempt_length, vectorized_work);
    ChainPose pose;
    problem.chain.forward(problem.start, pose);
    std::vector<ClosestPoint> expected, found;
    for (const int tick : {0, 3}) {
      scalar.go_to(tick);
      vectorized.go_to(tick);
      scalar.search(pose, reach, expected);
      use_instruction_set(sets[static_cast<std::size_t>(trial) % sets.size()].name);
      vectorized.search(pose, reach, found);
      ASSERT_EQ(found.size(), expected.size()) << trial;
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_EQ(found[k].link, expected[k].link) << trial;
        EXPECT_EQ(found[k].obstacle, expected[k].obstacle) << trial;
        EXPECT_NEAR(found[k].distance, expected[k].distance, 1e-14) << trial;
        // Of pairs that are equally close to rounding, either may be named.
        if (std::abs(found[k].s - expected[k].s) > 1e-12) continue;
        EXPECT_LT((found[k].direction - expected[k].direction).norm(), 1e-11) << trial;
        ++compared;
        inside += found[k].distance < 0;
      }
    }
    EXPECT_EQ(vectorized_work.point_pairs, scalar_work.point_pairs) << trial;
  }
  use_instruction_set(sets.front().name);
  EXPECT_GT(compared, 3000);
  EXPECT_GT(inside, 100);
}

}  // namespace
}  // namespace bqsa::baselines
