// No BQSA variant allocates in a control tick, however the tick ends.

#include <gtest/gtest.h>

#include <functional>

#include "bqsa/bqsa_planar.hpp"
#include "bqsa/bqsa_projection.hpp"
#include "bqsa/bqsa_spatial.hpp"
#include "support/paper_problems.hpp"
#include "support/replay.hpp"
#include "support/warm_run.hpp"

namespace bqsa {
namespace {

using test_support::warm_run;
using test_support::WarmRun;

struct Variant {
  const char* name;
  std::function<std::unique_ptr<ReactiveMethod>(int retries)> make;
  Problem (*scene)();
  double link_radius;  // [m]
};
void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

Problem planar_scene() { return test_support::planar_7r(); }

template <PlanarVariant kVariant>
std::unique_ptr<ReactiveMethod> make_planar(int retries) {
  BqsaSettings settings = default_settings(kVariant);
  settings.retries = retries;
  return std::make_unique<BqsaPlanar>(kVariant, settings);
}

std::unique_ptr<ReactiveMethod> make_spatial(int retries) {
  BqsaSettings settings;
  settings.retries = retries;
  return std::make_unique<BqsaSpatial>(settings);
}

std::unique_ptr<ReactiveMethod> make_projection(int retries) {
  BqsaSettings settings;
  settings.retries = retries;
  return std::make_unique<BqsaProjection>(std::nullopt, settings);
}

constexpr int kDefaultRetries = BqsaSettings{}.retries;

class WarmSteps : public ::testing::TestWithParam<Variant> {
 protected:
  Problem scene() const {
    Problem problem = GetParam().scene();
    problem.link_radius = GetParam().link_radius;
    return problem;
  }
  WarmRun run(const Problem& problem, int retries = kDefaultRetries) const {
    return warm_run(*GetParam().make(retries), problem);
  }
};

TEST_P(WarmSteps, DoNotAllocateWhileClamping) {
  const WarmRun warm = run(scene());
  EXPECT_EQ(warm.allocations, 0U);
  EXPECT_GT(warm.clamped, 20);
}

TEST_P(WarmSteps, DoNotAllocateWhereNoConfigurationIsFree) {
  Problem problem = scene();
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Eigen::Vector3d on_link = 0.5 * (pose.p_WO.col(3) + pose.p_WO.col(4));
  problem.obstacles.push_back({"boulder", Ellipsoid(on_link, {0.3, 0.3, 0.3})});
  const WarmRun warm = run(problem);
  EXPECT_EQ(warm.allocations, 0U);
  EXPECT_EQ(warm.infeasible, problem.ticks);
  EXPECT_EQ(warm.no_free_motion, 0);
}

/// A bead that the outermost link sweeps over between two ticks of plain tracking.
Problem with_bead(Problem problem) {
  Problem without = problem;
  without.obstacles.clear();
  const bool planar = problem.dimension() == 2;
  const auto tracking = planar ? make_planar<PlanarVariant::kExact>(0) : make_spatial(0);
  const test_support::Replay nominal = test_support::replay(*tracking, without);
  ChainPose pose;
  const std::size_t k = nominal.q.size() / 2;
  problem.chain.forward(0.5 * (nominal.q[k] + nominal.q[k + 1]), pose);
  const Link link = problem.chain.links()[problem.chain.links().size() - 1];
  const Eigen::Vector3d on_link = 0.5 * (pose.p_WO.col(link.start) + pose.p_WO.col(link.end));
  problem.obstacles = {{"bead", Ellipsoid(on_link, {1e-5, 1e-5, 1e-5})}};
  return problem;
}

TEST_P(WarmSteps, DoNotAllocateWhileRetrying) {
  const Problem problem = with_bead(scene());
  const WarmRun without_retries = run(problem, 0);
  EXPECT_EQ(without_retries.allocations, 0U);
  EXPECT_GT(without_retries.no_free_motion, 0) << "no tick would have to be tried again";
  for (const int retries : {1, 3, kDefaultRetries}) {
    EXPECT_EQ(run(problem, retries).allocations, 0U) << retries << " retries";
  }
}

TEST_P(WarmSteps, DoNotAllocateWhereThePathLeavesTheReach) {
  Problem problem = scene();
  const Eigen::Vector3d from = problem.desired_tip(0);
  problem.desired_tip = [from](double t) -> Eigen::Vector3d { return (1 + t) * from; };
  const WarmRun warm = run(problem);
  EXPECT_EQ(warm.allocations, 0U);
  EXPECT_GT(warm.infeasible, problem.ticks / 2);
}

INSTANTIATE_TEST_SUITE_P(
    Variants, WarmSteps,
    ::testing::Values(
        Variant{"Exact", make_planar<PlanarVariant::kExact>, planar_scene, 0},
        Variant{"ExactRadius", make_planar<PlanarVariant::kExact>, planar_scene, 0.003},
        Variant{"Paper", make_planar<PlanarVariant::kPaper>, planar_scene, 0},
        Variant{"PaperRadius", make_planar<PlanarVariant::kPaper>, planar_scene, 0.003},
        Variant{"Spatial", make_spatial, test_support::puma560_ellipsoid, 0},
        Variant{"SpatialRadius", make_spatial, test_support::puma560_ellipsoid, 0.001},
        Variant{"SpatialWall", make_spatial, test_support::puma560_wall, 0},
        Variant{"Projection", make_projection, test_support::puma560_ellipsoid, 0},
        Variant{"ProjectionRadius", make_projection, test_support::puma560_ellipsoid, 0.001},
        Variant{"ProjectionWall", make_projection, test_support::puma560_wall, 0}),
    [](const auto& variant) { return std::string(variant.param.name); });

/// The hybrid IK where its task matrix has lost rank, is zero, or calls for damping.
TEST(WarmHybridIk, DoesNotAllocateAtSingularitiesEither) {
  const int n = 7;
  TaskJacobian regular = TaskJacobian::Random(3, n);
  TaskJacobian deficient = regular;
  deficient.row(2) = deficient.row(0) + deficient.row(1);
  TaskJacobian damped = deficient;
  damped(2, 0) += 1e-3;
  HybridIkResult result;
  int damping = 0, lost_rank = 0;
  for (const TaskJacobian& J : {regular, deficient, damped, TaskJacobian(0 * regular)}) {
    for (const double speed : {0.0, 1e-4, 1.0}) {
      const TaskVector x_dot = TaskVector::Constant(3, speed);
      const JointVector weights = JointVector::LinSpaced(n, 1, 1e4);
      const JointVector phi = JointVector::Ones(n);
      const test_support::AllocationGuard guard;
      solve_hybrid_ik(J, x_dot, weights, phi, {}, result);
      EXPECT_EQ(guard.allocations(), 0U);
      damping += result.lambda > 0;
      lost_rank += result.rank < 3;
    }
  }
  EXPECT_GT(damping, 0);
  EXPECT_GT(lost_rank, 0);
}

}  // namespace
}  // namespace bqsa
