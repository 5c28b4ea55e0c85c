// What the contract asks of every method, whatever it does: one suite over the whole list, and over
// what `new-method` writes.
//
// The linker lets calls of the chain's kinematics, of one configuration or many, and of the hybrid
// inverse kinematics pass through here (CMakeLists.txt, --wrap), so that the work counters are compared
// with calls that were made.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "baselines/skeleton.hpp"
#include "bqsa/batch/configuration_check.hpp"
#include "bqsa/hybrid_ik.hpp"
#include "bqsa/kinematics/planar_tip.hpp"
#include "harness/conformance.hpp"
#include "harness/generator/generator.hpp"
#include "harness/method_spec.hpp"
#include "harness/methods.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/temporary_directory.hpp"
#include "support/allocation_guard.hpp"

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
#define BQSA_FORWARD_FROM \
  _ZNK4bqsa11SerialChain12forward_fromERKN5Eigen6MatrixIdLin1ELi1ELi0ELi16ELi1EEES5_RNS_9ChainPoseE
#define BQSA_JACOBIAN \
  _ZNK4bqsa11SerialChain8jacobianERKNS_9ChainPoseEiRN5Eigen6MatrixIdLin1ELin1ELi0ELi6ELi16EEE
#define BQSA_PLANAR_TIP _ZN4bqsa9PlanarTip6assignERKNS_11SerialChainERKNS_9ChainPoseE
#define BQSA_MOVE_PLANAR_TIP _ZNK4bqsa9PlanarTip4moveERKN5Eigen6MatrixIdLi2ELi1ELi0ELi2ELi1EEE
#define BQSA_HYBRID_IK \
  _ZN4bqsa15solve_hybrid_ikERKN5Eigen6MatrixIdLin1ELin1ELi0ELi6ELi16EEERKNS1_IdLin1ELi1ELi0ELi6ELi1EEERKNS1_IdLin1ELi1ELi0ELi16ELi1EEESA_RKNS_16HybridIkSettingsERNS_14HybridIkResultE
#define BQSA_CERTAINLY_FREE \
  _ZNK4bqsa18ConfigurationCheck14certainly_freeERKNS_18ConfigurationArrayESt4spanItLm18446744073709551615EE
#define BQSA_JOIN(a, b) a##b
#define BQSA_NAME(prefix, name) BQSA_JOIN(prefix, name)

extern "C" {
void BQSA_NAME(__real_, BQSA_FORWARD)(const bqsa::SerialChain*, const bqsa::JointVector&,
                                      bqsa::ChainPose&);
void BQSA_NAME(__real_, BQSA_FORWARD_FROM)(const bqsa::SerialChain*, const bqsa::JointVector&,
                                           const bqsa::JointVector&, bqsa::ChainPose&);
void BQSA_NAME(__real_, BQSA_JACOBIAN)(const bqsa::SerialChain*, const bqsa::ChainPose&, int,
                                       bqsa::TaskJacobian&);
void BQSA_NAME(__real_, BQSA_PLANAR_TIP)(bqsa::PlanarTip*, const bqsa::SerialChain&,
                                         const bqsa::ChainPose&);
bqsa::PlanarTip::Moved BQSA_NAME(__real_, BQSA_MOVE_PLANAR_TIP)(const bqsa::PlanarTip*,
                                                                const Eigen::Vector2d&);
void BQSA_NAME(__real_, BQSA_HYBRID_IK)(const bqsa::TaskJacobian&, const bqsa::TaskVector&,
                                        const bqsa::JointVector&, const bqsa::JointVector&,
                                        const bqsa::HybridIkSettings&, bqsa::HybridIkResult&);
void BQSA_NAME(__real_, BQSA_CERTAINLY_FREE)(const bqsa::ConfigurationCheck*,
                                             const bqsa::ConfigurationArray&,
                                             std::span<std::uint16_t>);

void BQSA_NAME(__wrap_, BQSA_FORWARD)(const bqsa::SerialChain* chain, const bqsa::JointVector& q,
                                      bqsa::ChainPose& pose) {
  ++g_calls.forward;
  BQSA_NAME(__real_, BQSA_FORWARD)(chain, q, pose);
}

void BQSA_NAME(__wrap_, BQSA_FORWARD_FROM)(const bqsa::SerialChain* chain,
                                           const bqsa::JointVector& q_from,
                                           const bqsa::JointVector& q, bqsa::ChainPose& pose) {
  ++g_calls.forward;
  BQSA_NAME(__real_, BQSA_FORWARD_FROM)(chain, q_from, q, pose);
}

void BQSA_NAME(__wrap_, BQSA_JACOBIAN)(const bqsa::SerialChain* chain, const bqsa::ChainPose& pose,
                                       int point, bqsa::TaskJacobian& J) {
  ++g_calls.jacobian;
  BQSA_NAME(__real_, BQSA_JACOBIAN)(chain, pose, point, J);
}

void BQSA_NAME(__wrap_, BQSA_PLANAR_TIP)(bqsa::PlanarTip* tip, const bqsa::SerialChain& chain,
                                         const bqsa::ChainPose& pose) {
  ++g_calls.jacobian;
  BQSA_NAME(__real_, BQSA_PLANAR_TIP)(tip, chain, pose);
}

bqsa::PlanarTip::Moved BQSA_NAME(__wrap_, BQSA_MOVE_PLANAR_TIP)(const bqsa::PlanarTip* tip,
                                                                const Eigen::Vector2d& y) {
  ++g_calls.forward;
  return BQSA_NAME(__real_, BQSA_MOVE_PLANAR_TIP)(tip, y);
}

void BQSA_NAME(__wrap_, BQSA_HYBRID_IK)(const bqsa::TaskJacobian& J, const bqsa::TaskVector& x_dot,
                                        const bqsa::JointVector& weights,
                                        const bqsa::JointVector& phi,
                                        const bqsa::HybridIkSettings& settings,
                                        bqsa::HybridIkResult& result) {
  ++g_calls.hybrid_ik;
  BQSA_NAME(__real_, BQSA_HYBRID_IK)(J, x_dot, weights, phi, settings, result);
}

void BQSA_NAME(__wrap_, BQSA_CERTAINLY_FREE)(const bqsa::ConfigurationCheck* check,
                                             const bqsa::ConfigurationArray& configurations,
                                             std::span<std::uint16_t> free) {
  g_calls.forward += static_cast<std::uint64_t>(configurations.count());
  BQSA_NAME(__real_, BQSA_CERTAINLY_FREE)(check, configurations, free);
}
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)

namespace bqsa::harness {
namespace {

/// Plans have to be found, however loaded the machine is.
constexpr ConformanceSettings kSettings{.plan_budget_s = 120, .limits = {.wall_s = 600}};

/// Scenes of the paper, one with prismatic joints, two with an orientation, and generated ones: at rest and moving, planar and
/// spatial, with and without limits. No method has been tuned on them.
const std::vector<Problem>& problems() {
  static const std::vector<Problem> kProblems = [] {
    std::vector<Problem> list{
        load_scenario(BQSA_SOURCE_DIR "/scenarios/planar_7r.yaml").problem,
        load_scenario(BQSA_SOURCE_DIR "/scenarios/puma560_wall.yaml").problem,
        load_scenario(BQSA_SOURCE_DIR "/tests/harness/program/rail_arm.yaml").problem,
        load_scenario(BQSA_SOURCE_DIR "/tests/harness/program/iiwa_pose.yaml").problem,
        load_scenario(BQSA_SOURCE_DIR "/tests/harness/program/iiwa_axis.yaml").problem};
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

std::vector<MethodSpec> variants() {
  std::vector<MethodSpec> list;
  for (const MethodEntry& entry : methods()) list.push_back(with_defaults(entry));
  list.push_back(with_defaults(baselines::skeleton_method()));
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

/// A method's name and parameters as part of a test's name.
std::string identifier(const MethodSpec& spec) {
  std::string name = spec.entry.name + "_" + changed_parameters(spec.parameters);
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  while (name.ends_with('_')) name.pop_back();
  return name;
}

using LawAndMethod = std::tuple<Law, MethodSpec>;

class Laws : public ::testing::TestWithParam<LawAndMethod> {};

TEST_P(Laws, Kept) {
  const auto& [law, spec] = GetParam();
  const LawCheck check = law.check(spec, problems(), kSettings);
  for (const Finding& finding : check.findings) {
    ADD_FAILURE() << finding.where << ": expected " << finding.expected << ", found "
                  << finding.found;
  }
  if (!check.not_asked.empty()) return;
  // With its limits tightened a planner may find no plan; a reactive method goes some of the way.
  const int least = law.name != "limits" ? 1 : spec.entry.capabilities.plans ? 0 : 21;
  EXPECT_GE(check.compared, least);
}

INSTANTIATE_TEST_SUITE_P(OfEveryMethod, Laws,
                         ::testing::Combine(::testing::ValuesIn(laws()),
                                            ::testing::ValuesIn(variants())),
                         [](const ::testing::TestParamInfo<LawAndMethod>& tested) {
                           return std::get<Law>(tested.param).name + "_" +
                                  identifier(std::get<MethodSpec>(tested.param));
                         });

/// What takes a linker's tricks to see.
class Conformance : public ::testing::TestWithParam<MethodSpec> {
 protected:
  const MethodSpec& spec() const { return GetParam(); }
};

TEST_P(Conformance, CountersEqualToTheCallsThatWereMade) {
  for (const Problem& problem : applicable(spec(), problems())) {
    const auto method = spec().entry.make(spec().parameters);
    method->prepare(problem);
    const WorkCounters before = method->counters();
    g_calls = {};
    if (auto* planner = dynamic_cast<PlanningMethod*>(method.get())) {
      planner->plan(kSettings.plan_budget_s, 1);
    } else {
      auto& reactive = dynamic_cast<ReactiveMethod&>(*method);
      StepInput input{.q = problem.start};
      StepOutput output;
      for (int tick = 1; tick <= problem.ticks; ++tick) {
        input.tick = tick;
        input.t = problem.time(tick);
        input.p_WT_desired = problem.desired_tip(input.t);
        input.R_WT_desired = problem.rotation_at(input.t);
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
  if (spec().entry.capabilities.plans || !test_support::kCountsAllocations) return;
  for (const Problem& problem : applicable(spec(), problems())) {
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
      input.R_WT_desired = problem.rotation_at(input.t);
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

INSTANTIATE_TEST_SUITE_P(OfEveryMethod, Conformance, ::testing::ValuesIn(variants()),
                         [](const auto& tested) { return identifier(tested.param); });

}  // namespace

void PrintTo(const MethodSpec& spec, std::ostream* out) { *out << variant_name(spec); }
void PrintTo(const Law& law, std::ostream* out) { *out << law.name; }

}  // namespace bqsa::harness
