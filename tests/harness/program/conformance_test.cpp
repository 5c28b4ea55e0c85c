// What the contract asks of every method, whatever it does: one suite over the whole list.
//
// The linker lets calls of the chain's kinematics and of the hybrid inverse kinematics pass through
// here (CMakeLists.txt, --wrap), so that the work counters are compared with calls that were made.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "bqsa/hybrid_ik.hpp"
#include "harness/generator/generator.hpp"
#include "harness/method_spec.hpp"
#include "harness/methods.hpp"
#include "harness/runner.hpp"
#include "harness/scenario/scenario.hpp"
#include "support/allocation_guard.hpp"
#include "temporary_directory.hpp"

namespace {

struct Calls {
  std::uint64_t forward = 0;
  std::uint64_t jacobian = 0;
  std::uint64_t hybrid_ik = 0;
};
Calls g_calls;

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
#define BQSA_FORWARD \
  _ZNK4bqsa11SerialChain7forwardERKN5Eigen6MatrixIdLin1ELi1ELi0ELi16ELi1EEERNS_9ChainPoseE
#define BQSA_JACOBIAN \
  _ZNK4bqsa11SerialChain8jacobianERKNS_9ChainPoseEiRN5Eigen6MatrixIdLin1ELin1ELi0ELi6ELi16EEE
#define BQSA_HYBRID_IK \
  _ZN4bqsa15solve_hybrid_ikERKN5Eigen6MatrixIdLin1ELin1ELi0ELi6ELi16EEERKNS1_IdLin1ELi1ELi0ELi6ELi1EEERKNS1_IdLin1ELi1ELi0ELi16ELi1EEESA_RKNS_16HybridIkSettingsERNS_14HybridIkResultE
#define BQSA_JOIN(a, b) a##b
#define BQSA_NAME(prefix, name) BQSA_JOIN(prefix, name)

extern "C" {
void BQSA_NAME(__real_, BQSA_FORWARD)(const bqsa::SerialChain*, const bqsa::JointVector&,
                                      bqsa::ChainPose&);
void BQSA_NAME(__real_, BQSA_JACOBIAN)(const bqsa::SerialChain*, const bqsa::ChainPose&, int,
                                       bqsa::TaskJacobian&);
void BQSA_NAME(__real_, BQSA_HYBRID_IK)(const bqsa::TaskJacobian&, const bqsa::TaskVector&,
                                        const bqsa::JointVector&, const bqsa::JointVector&,
                                        const bqsa::HybridIkSettings&, bqsa::HybridIkResult&);

void BQSA_NAME(__wrap_, BQSA_FORWARD)(const bqsa::SerialChain* chain, const bqsa::JointVector& q,
                                      bqsa::ChainPose& pose) {
  ++g_calls.forward;
  BQSA_NAME(__real_, BQSA_FORWARD)(chain, q, pose);
}

void BQSA_NAME(__wrap_, BQSA_JACOBIAN)(const bqsa::SerialChain* chain, const bqsa::ChainPose& pose,
                                       int point, bqsa::TaskJacobian& J) {
  ++g_calls.jacobian;
  BQSA_NAME(__real_, BQSA_JACOBIAN)(chain, pose, point, J);
}

void BQSA_NAME(__wrap_, BQSA_HYBRID_IK)(const bqsa::TaskJacobian& J, const bqsa::TaskVector& x_dot,
                                        const bqsa::JointVector& weights,
                                        const bqsa::JointVector& phi,
                                        const bqsa::HybridIkSettings& settings,
                                        bqsa::HybridIkResult& result) {
  ++g_calls.hybrid_ik;
  BQSA_NAME(__real_, BQSA_HYBRID_IK)(J, x_dot, weights, phi, settings, result);
}
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)

namespace bqsa::harness {
namespace {

constexpr double kPlenty = 120;  ///< budget of plans that have to be found [s]

/// A scene of the paper and generated ones: at rest and moving, planar and spatial, with and without
/// limits. No method has been tuned on them.
const std::vector<Problem>& problems() {
  static const std::vector<Problem> kProblems = [] {
    std::vector<Problem> list{
        load_scenario(BQSA_SOURCE_DIR "/scenarios/planar_7r.yaml").problem,
        load_scenario(BQSA_SOURCE_DIR "/scenarios/puma560_wall.yaml").problem};
    const TemporaryDirectory directory;
    const std::vector<Arm> arms = spatial_arms(BQSA_SOURCE_DIR "/robots");
    for (const Family& family : families()) {
      if (family.name != "planar" && family.name != "spatial" && family.name != "moving") continue;
      Rejections rejections;
      const GeneratedScenario scenario = generate(family, 6007, 0, arms, rejections);
      const std::filesystem::path file = directory.path() / (scenario.name + ".yaml");
      std::ofstream(file) << scenario.yaml;
      list.push_back(load_scenario(file).problem);
    }
    return list;
  }();
  return kProblems;
}

/// A wall stands across the whole path of an arm: there is no way.
Problem blocked() {
  Problem problem = problems().front();
  problem.name = "blocked";
  const Eigen::Vector3d end = problem.desired_tip(problem.duration());
  problem.obstacles.push_back({"cap", embedded(rotated_ellipse(end.head<2>(), {0.1, 0.1}, 0))});
  return problem;
}

std::vector<MethodSpec> variants() {
  std::vector<MethodSpec> list;
  for (const MethodEntry& entry : methods()) list.push_back(with_defaults(entry));
  for (const char* text :
       {"bqsa:release=never", "maciejewski_klein:closest=test_points,n=8,m=60",
        "maciejewski_klein:closest=test_points_vectorized,n=8,m=60",
        "maciejewski_klein:closest=fcl", "fcl_gp:broadphase=on", "fcl_gp:solver=libccd_m",
        "qp:solver=dual_network,network_steps=500", "compact_qp:constraints=equality",
        "ompl:planner=rrt", "ompl:planner=est"}) {
    list.push_back(parse_method_spec(text, methods()));
  }
  return list;
}

class Conformance : public ::testing::TestWithParam<MethodSpec> {
 protected:
  const MethodSpec& spec() const { return GetParam(); }
  const Capabilities& capabilities() const { return spec().entry.capabilities; }

  std::vector<Problem> applicable() const {
    std::vector<Problem> list;
    for (const Problem& problem : problems()) {
      if (why_not_applicable(capabilities(), problem).empty()) list.push_back(problem);
    }
    return list;
  }

  RunOutcome run(const Problem& problem, std::uint64_t seed = 1, double budget_s = kPlenty) const {
    return run_method(problem, spec().entry, spec().parameters,
                      {.seed = seed, .plan_budget_s = budget_s, .disturbance = {}});
  }
};

void expect_same(const RunOutcome& a, const RunOutcome& b, const std::string& where) {
  EXPECT_EQ(a.claim, b.claim) << where;
  EXPECT_EQ(a.tick, b.tick) << where;
  EXPECT_EQ(a.trajectory.t, b.trajectory.t) << where;
  ASSERT_EQ(a.trajectory.q.size(), b.trajectory.q.size()) << where;
  for (std::size_t k = 0; k < a.trajectory.q.size(); ++k) {
    ASSERT_EQ(a.trajectory.q[k], b.trajectory.q[k]) << where << ", row " << k;
  }
  EXPECT_EQ(a.counters.iterations, b.counters.iterations) << where;
  EXPECT_EQ(a.counters.quadratics, b.counters.quadratics) << where;
  EXPECT_EQ(a.counters.point_pairs, b.counters.point_pairs) << where;
  EXPECT_EQ(a.counters.distance_queries, b.counters.distance_queries) << where;
  EXPECT_EQ(a.counters.kinematics, b.counters.kinematics) << where;
}

TEST_P(Conformance, ApplyingOrSayingWhyNot) {
  EXPECT_FALSE(spec().entry.summary.empty());
  EXPECT_FALSE(spec().entry.source.empty());
  EXPECT_FALSE(applicable().empty()) << "applies to nothing";
  const auto method = spec().entry.make(spec().parameters);
  EXPECT_EQ(dynamic_cast<PlanningMethod*>(method.get()) != nullptr, capabilities().plans);
  EXPECT_EQ(dynamic_cast<ReactiveMethod*>(method.get()) != nullptr, !capabilities().plans);
}

TEST_P(Conformance, SameResultTwiceInOneProcessAndInAnotherOrder) {
  std::vector<Problem> list = applicable();
  std::map<std::string, RunOutcome> first;
  for (const Problem& problem : list) first[problem.name] = run(problem);
  std::reverse(list.begin(), list.end());
  for (const Problem& problem : list) {
    expect_same(run(problem), first[problem.name], problem.name);
  }
}

TEST_P(Conformance, InputsUntouchedNothingHiddenNoCrashFiniteRowsAtTheTicks) {
  for (const Problem& problem : applicable()) {
    const RunOutcome outcome = run(problem);
    EXPECT_FALSE(outcome.inputs_changed) << problem.name;
    EXPECT_FALSE(outcome.work_hidden) << problem.name << ": " << outcome.times.hidden_cpu_s << " s";
    EXPECT_NE(outcome.claim, Claim::kCrashed) << problem.name << ": " << outcome.message;
    EXPECT_NE(outcome.claim, Claim::kTimedOut) << problem.name << ": " << outcome.message;
    EXPECT_NE(outcome.claim, Claim::kOutOfMemory) << problem.name << ": " << outcome.message;
    const Trajectory& trajectory = outcome.trajectory;
    ASSERT_EQ(trajectory.t.size(), trajectory.q.size());
    if (outcome.claim == Claim::kSuccess || outcome.claim == Claim::kNothing) {
      ASSERT_EQ(trajectory.q.size(), static_cast<std::size_t>(problem.ticks) + 1) << problem.name;
    }
    for (std::size_t k = 0; k < trajectory.q.size(); ++k) {
      ASSERT_NEAR(trajectory.t[k], problem.time(static_cast<int>(k)), 1e-12) << problem.name;
      ASSERT_EQ(trajectory.q[k].size(), problem.chain.joints()) << problem.name;
      ASSERT_TRUE(trajectory.q[k].allFinite()) << problem.name << ", row " << k;
    }
  }
}

TEST_P(Conformance, LimitsKeptUnlessDeclaredOtherwise) {
  if (!capabilities().keeps_limits) return;
  int steps = 0;
  for (Problem problem : applicable()) {
    // Tighter limits than the scenes have: the method must give up rather than exceed them.
    problem.limits.max_velocity =
        JointVector::Constant(problem.chain.joints(), 0.6 * problem.max_step(0) / problem.dt);
    const JointVector room = JointVector::Constant(problem.chain.joints(), 0.35);
    problem.limits.lower = problem.start - room;
    problem.limits.upper = problem.start + room;
    const Trajectory trajectory = run(problem, 1, 0.5).trajectory;
    for (std::size_t k = 1; k < trajectory.q.size(); ++k, ++steps) {
      ASSERT_EQ(forbidden_step(problem, trajectory.q[k - 1], trajectory.q[k]), Infeasible::kNot)
          << problem.name << ", tick " << k;
    }
  }
  EXPECT_TRUE(capabilities().plans || steps > 20) << steps;
}

TEST_P(Conformance, DeadlineHonoured) {
  if (!capabilities().plans) return;
  constexpr double kBudget = 0.2;
  const RunOutcome outcome = run(blocked(), 1, kBudget);
  EXPECT_NE(outcome.claim, Claim::kSuccess);
  EXPECT_NE(outcome.claim, Claim::kTimedOut) << outcome.message;
}

TEST_P(Conformance, CountersEqualToTheCallsThatWereMade) {
  for (const Problem& problem : applicable()) {
    const auto method = spec().entry.make(spec().parameters);
    method->prepare(problem);
    const WorkCounters before = method->counters();
    g_calls = {};
    if (auto* planner = dynamic_cast<PlanningMethod*>(method.get())) {
      planner->plan(kPlenty, 1);
    } else {
      auto& reactive = dynamic_cast<ReactiveMethod&>(*method);
      StepInput input{.q = problem.start};
      StepOutput output;
      for (int tick = 1; tick <= problem.ticks; ++tick) {
        input.tick = tick;
        input.t = problem.time(tick);
        input.p_WT_desired = problem.desired_tip(input.t);
        output = {};
        reactive.step(input, output);
        if (output.state == TickState::kInfeasible) break;
        input.q = output.q;
      }
    }
    const WorkCounters& after = method->counters();
    EXPECT_EQ(after.kinematics - before.kinematics, g_calls.forward) << problem.name;
    EXPECT_EQ(after.jacobians - before.jacobians, g_calls.jacobian) << problem.name;
    EXPECT_GE(after.linear_solves - before.linear_solves, g_calls.hybrid_ik) << problem.name;
    EXPECT_GT(g_calls.forward, 0U) << problem.name;
  }
}

/// FCL and libraries behind it take memory in every query; everything of ours takes none.
bool is_ours(const MethodSpec& spec) {
  const std::string text = spec.entry.name + " " + changed_parameters(spec.parameters);
  return text.find("fcl") == std::string::npos;
}

TEST_P(Conformance, AllocationsOfWarmStepsAreReported) {
  if (capabilities().plans || !test_support::kCountsAllocations) return;
  for (const Problem& problem : applicable()) {
    const auto method = spec().entry.make(spec().parameters);
    method->prepare(problem);
    auto& reactive = dynamic_cast<ReactiveMethod&>(*method);
    StepInput input{.q = problem.start};
    StepOutput output;
    std::uint64_t allocations = 0;
    std::uint64_t most = 0;
    int warm = 0;
    for (int tick = 1; tick <= problem.ticks; ++tick) {
      input.tick = tick;
      input.t = problem.time(tick);
      input.p_WT_desired = problem.desired_tip(input.t);
      output = {};
      const test_support::AllocationGuard guard;
      reactive.step(input, output);
      if (tick > 1) {
        ++warm;
        allocations += guard.allocations();
        most = std::max(most, guard.allocations());
      }
      if (output.state == TickState::kInfeasible) break;
      input.q = output.q;
    }
    std::printf("allocations %-40s %-20s %8.2f a warm step, at most %llu\n",
                (spec().entry.name + " " + changed_parameters(spec().parameters)).c_str(),
                problem.name.c_str(), static_cast<double>(allocations) / std::max(warm, 1),
                static_cast<unsigned long long>(most));
    EXPECT_TRUE(!is_ours(spec()) || allocations == 0) << problem.name << ": " << allocations;
    EXPECT_GT(warm, 0);
  }
}

std::string test_name(const ::testing::TestParamInfo<MethodSpec>& info) {
  std::string name = info.param.entry.name + "_" + changed_parameters(info.param.parameters);
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  while (name.ends_with('_')) name.pop_back();
  return name;
}

INSTANTIATE_TEST_SUITE_P(OfEveryMethod, Conformance, ::testing::ValuesIn(variants()), test_name);

}  // namespace

void PrintTo(const MethodSpec& spec, std::ostream* out) { *out << variant_name(spec); }

}  // namespace bqsa::harness
