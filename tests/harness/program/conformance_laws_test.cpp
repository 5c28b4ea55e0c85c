// Methods that each break one law of conformance.hpp: that law finds them, and no other.
#include "harness/conformance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <limits>
#include <thread>

#include "test_methods.hpp"

namespace bqsa::harness {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr ConformanceSettings kSettings{.plan_budget_s = 0.2,
                                        .limits = {.wall_s = 60, .memory_bytes = 256U << 20U}};

/// Two joints in the plane, nothing near; the tip goes where the arm goes if both joints turn evenly.
Problem quiet(const char* name, double speed) {
  Problem problem{.name = name, .chain = SerialChain(planar_chain({0.5, 0.5}))};
  problem.ticks = 20;
  problem.dt = 0.05;
  problem.start = Eigen::Vector2d(0, 0.5);
  problem.desired_tip = [chain = problem.chain, speed](double t) -> Eigen::Vector3d {
    ChainPose pose;
    chain.forward(Eigen::Vector2d(speed * t, 0.5), pose);
    return pose.tip();
  };
  return problem;
}

const std::vector<Problem>& problems() {
  static const std::vector<Problem> kProblems = {quiet("slow", 0.2), quiet("quick", 0.3)};
  return kProblems;
}

/// Where the arm has to go: the first joint alone moves, and the tip's distance does not change.
void follow(const StepInput& input, StepOutput& output) {
  output.q = Eigen::Vector2d(std::atan2(input.p_WT_desired.y(), input.p_WT_desired.x()) -
                                 std::atan2(0.5 * std::sin(0.5), 0.5 + 0.5 * std::cos(0.5)),
                             0.5);
}

/// A follower with one thing added.
MethodSpec following(std::function<void(const StepInput&, StepOutput&)> then) {
  return scripted("follower", [then = std::move(then)](const StepInput& input, StepOutput& output) {
    follow(input, output);
    then(input, output);
  });
}

std::vector<std::string> broken_by(const MethodSpec& method) {
  std::vector<std::string> names;
  for (const Law& law : laws()) {
    const LawCheck check = law.check(method, problems(), kSettings);
    if (!check.findings.empty()) names.push_back(law.name);
    for (const Finding& finding : check.findings) {
      EXPECT_EQ(finding.law, law.name);
      EXPECT_FALSE(finding.where.empty() || finding.expected.empty() || finding.found.empty());
      std::printf("%s: %s: expected %s, found %s\n", finding.law.c_str(), finding.where.c_str(),
                  finding.expected.c_str(), finding.found.c_str());
    }
    const bool may_have_no_case = law.name == "limits";  // if it makes no step
    EXPECT_TRUE(check.compared > 0 || !check.not_asked.empty() || may_have_no_case) << law.name;
  }
  return names;
}

TEST(ConformanceLaws, AreKeptByAMethodThatFollows) {
  EXPECT_THAT(broken_by(following([](const StepInput&, StepOutput&) {})), IsEmpty());
}

TEST(ConformanceLaws, AreKeptByAMethodThatGivesUp) {
  EXPECT_THAT(broken_by(following([](const StepInput& input, StepOutput& output) {
                if (input.tick > 3) hold(input.q, Infeasible::kNoFreeMotion, 1, -1, output);
              })),
              IsEmpty());
}

TEST(ConformanceLaws, FindEntriesThatAreNotWhole) {
  const auto declaring = [](const auto& change) {
    MethodEntry entry = scripted("follower", follow).entry;
    change(entry);
    return with_defaults(entry);
  };
  const std::vector<MethodSpec> bad = {
      declaring([](MethodEntry& entry) { entry.name = "Follower"; }),
      declaring([](MethodEntry& entry) { entry.summary = ""; }),
      declaring([](MethodEntry& entry) { entry.source = ""; }),
      declaring([](MethodEntry& entry) {
        entry.parameters = {{"gain", "-", 2, 0, 1, "a gain"}};
      }),
      declaring([](MethodEntry& entry) {
        entry.parameters = {{"gain", "-", 1, 0, 1, ""}};
      }),
      declaring([](MethodEntry& entry) {
        entry.parameters = {{"gain", "-", 1, 0, 1, "a gain"}, {"gain", "-", 1, 0, 1, "a gain"}};
      })};
  for (const MethodSpec& method : bad) EXPECT_THAT(broken_by(method), ElementsAre("declaration"));
}

TEST(ConformanceLaws, FindMethodsThatApplyToNothing) {
  MethodSpec method = scripted("follower", follow);
  method.entry.capabilities.planar = false;
  const Law& declaration = laws().front();
  const LawCheck check = declaration.check(method, problems(), kSettings);
  ASSERT_EQ(check.findings.size(), 1U);
  EXPECT_EQ(check.findings[0].found, "planar problems not supported yet");
}

TEST(ConformanceLaws, FindMethodsOfAnotherKindThanDeclared) {
  MethodSpec method = scripted("follower", follow);
  method.entry.capabilities.plans = true;
  const LawCheck check = laws().front().check(method, problems(), kSettings);
  ASSERT_EQ(check.findings.size(), 1U);
  EXPECT_EQ(check.findings[0].expected, "a PlanningMethod");
  EXPECT_EQ(check.findings[0].found, "a ReactiveMethod");
}

TEST(ConformanceLaws, SurviveMethodsThatCrashAnywhere) {
  MethodSpec in_make = scripted("crashes", follow);
  in_make.entry.make = [](const ParameterValues&) -> std::unique_ptr<Method> {
    raise(SIGSEGV);
    return nullptr;
  };
  EXPECT_THAT(broken_by(in_make), ElementsAre("declaration", "conduct"));

  MethodSpec makes_nothing = scripted("crashes", follow);
  makes_nothing.entry.make = [](const ParameterValues&) { return std::unique_ptr<Method>(); };
  EXPECT_THAT(broken_by(makes_nothing), ElementsAre("declaration", "conduct"));

  EXPECT_THAT(broken_by(following([](const StepInput& input, StepOutput&) {
                if (input.tick == 7) _exit(0);
              })),
              ElementsAre("conduct", "repeatability"));

  // Only the second method of a process dies.
  EXPECT_THAT(broken_by(following([](const StepInput& input, StepOutput&) {
                static int runs = 0;
                if (input.tick == 1 && ++runs == 2) raise(SIGSEGV);
              })),
              ElementsAre("repeatability"));
}

TEST(ConformanceLaws, FindMethodsThatDoNotEnd) {
  const MethodSpec method = following([](const StepInput& input, StepOutput&) {
    if (input.tick == 5) std::this_thread::sleep_for(std::chrono::hours(1));
  });
  ConformanceSettings settings = kSettings;
  settings.limits.wall_s = 2;
  const LawCheck check = laws()[1].check(method, {problems().front()}, settings);
  ASSERT_EQ(check.findings.size(), 1U);
  EXPECT_THAT(check.findings[0].found, HasSubstr("timed out at tick 5"));
}

TEST(ConformanceLaws, FindInputsWrittenTo) {
  EXPECT_THAT(broken_by(following([](const StepInput& input, StepOutput&) {
                const_cast<StepInput&>(input).q(0) += 1e-9;
              })),
              ElementsAre("conduct"));
}

TEST(ConformanceLaws, FindWorkInOtherThreads) {
  const MethodSpec method = following([](const StepInput& input, StepOutput&) {
    if (input.tick == 1) {
      std::thread([] {
        volatile bool working = true;
        while (working) {
        }
      }).detach();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  });
  const LawCheck check = laws()[1].check(method, problems(), kSettings);
  ASSERT_FALSE(check.findings.empty());
  EXPECT_EQ(check.findings[0].expected, "work where its time is measured");
}

TEST(ConformanceLaws, FindRowsThatAreNotFinite) {
  // An answer that cannot be used is a crash too.
  EXPECT_THAT(broken_by(following([](const StepInput& input, StepOutput& output) {
                if (input.tick == 9) output.q(1) = std::numeric_limits<double>::quiet_NaN();
              })),
              ElementsAre("conduct", "rows", "limits"));
}

PlanningMethod::Plan whole_plan() {
  PlanningMethod::Plan plan{.solved = true, .trajectory = {}};
  for (int tick = 0; tick <= 20; ++tick) {
    plan.trajectory.t.push_back(0.05 * tick);
    plan.trajectory.q.push_back(Eigen::Vector2d(0.2 * 0.05 * tick, 0.5));
  }
  return plan;
}

std::size_t rows_found(const std::function<void(PlanningMethod::Plan&)>& change) {
  PlanningMethod::Plan plan = whole_plan();
  change(plan);
  return laws()[2].check(planned("plan", plan), {problems().front()}, kSettings).findings.size();
}

TEST(ConformanceLaws, FindPlansWithMissingLateOrStrangeRows) {
  using Plan = PlanningMethod::Plan;
  EXPECT_EQ(rows_found([](Plan&) {}), 0U);
  EXPECT_EQ(rows_found([](Plan& plan) { plan.trajectory.q.pop_back(); }), 1U);
  EXPECT_EQ(rows_found([](Plan& plan) {
              plan.trajectory.q.pop_back();
              plan.trajectory.t.pop_back();
            }),
            1U);
  EXPECT_EQ(rows_found([](Plan& plan) { plan.trajectory.t[4] += 1e-3; }), 1U);
  EXPECT_EQ(rows_found([](Plan& plan) { plan.trajectory.q[0](0) += 1e-9; }), 1U);
  EXPECT_EQ(rows_found([](Plan& plan) { plan.trajectory.q[4] = Eigen::Vector3d::Zero(); }), 1U);
}

TEST(ConformanceLaws, FindMethodsThatRememberEarlierRuns) {
  EXPECT_THAT(broken_by(following([](const StepInput&, StepOutput& output) {
                static int steps = 0;
                output.q(0) += 1e-15 * steps++;
              })),
              ElementsAre("repeatability"));
}

TEST(ConformanceLaws, FindCountersThatGoOnFromRunToRun) {
  class Counting final : public ReactiveMethod {
   public:
    void prepare(const Problem&) override {}
    void step(const StepInput& input, StepOutput& output) override {
      static std::uint64_t of_all_runs = 0;
      counters_.iterations = ++of_all_runs;
      follow(input, output);
    }
  };
  EXPECT_THAT(
      broken_by(with_defaults(entry_of(
          "counting", [](const ParameterValues&) { return std::make_unique<Counting>(); }))),
      ElementsAre("repeatability"));
}

TEST(ConformanceLaws, FindFalseClaims) {
  EXPECT_THAT(broken_by(scripted("idle", stand_still)), ElementsAre("claims"));
}

TEST(ConformanceLaws, DoNotHoldAMethodToWhatItDoesNotClaim) {
  EXPECT_THAT(broken_by(scripted("idle",
                                 [](const StepInput& input, StepOutput& output) {
                                   stand_still(input, output);
                                   output.state = TickState::kUnclaimed;
                                 })),
              IsEmpty());
}

TEST(ConformanceLaws, FindStepsBeyondTheLimitsUnlessDeclared) {
  // 10 degrees a tick is allowed by the problem, but not by the law's tighter one.
  const auto swings = [](const StepInput& input, StepOutput& output) {
    output.q = input.q;
    output.q(1) += input.tick % 2 == 0 ? -0.17 : 0.17;
    output.state = TickState::kUnclaimed;
  };
  MethodSpec method = scripted("swings", swings);
  EXPECT_THAT(broken_by(method), ElementsAre("limits"));
  method.entry.capabilities.keeps_limits = false;
  EXPECT_THAT(broken_by(method), IsEmpty());
}

TEST(ConformanceLaws, FindJointsBeyondTheirRange) {
  EXPECT_THAT(broken_by(scripted("goes_on",
                                 [](const StepInput& input, StepOutput& output) {
                                   output.q = input.q;
                                   output.q(1) += 0.05;
                                   output.state = TickState::kUnclaimed;
                                 })),
              ElementsAre("limits"));
}

class Planner final : public PlanningMethod {
 public:
  explicit Planner(double overtime_s) : overtime_s_(overtime_s) {}
  void prepare(const Problem& problem) override { problem_ = &problem; }
  Plan plan(double budget_s, std::uint64_t) override {
    if (problem_->obstacles.empty()) return {.solved = false, .trajectory = {}};
    if (overtime_s_ > 0) {
      std::this_thread::sleep_for(std::chrono::duration<double>(budget_s + overtime_s_));
      return {.solved = false, .trajectory = {}};
    }
    return whole_plan();
  }

 private:
  double overtime_s_;
  const Problem* problem_ = nullptr;
};

std::vector<Finding> deadline_findings(double overtime_s) {
  MethodEntry entry = entry_of("planner", [overtime_s](const ParameterValues&) {
    return std::make_unique<Planner>(overtime_s);
  });
  entry.capabilities.plans = true;
  return laws().back().check(with_defaults(entry), problems(), kSettings).findings;
}

TEST(ConformanceLaws, FindPlannersThatAreLateOrSucceedWhereThereIsNoWay) {
  const std::vector<Finding> late = deadline_findings(RunSettings::kPlanGrace + 0.1);
  ASSERT_EQ(late.size(), 1U);
  EXPECT_THAT(late[0].found, HasSubstr("planned for"));
  const std::vector<Finding> false_success = deadline_findings(0);
  ASSERT_EQ(false_success.size(), 1U);
  EXPECT_EQ(false_success[0].expected, "no success claimed");
}

}  // namespace
}  // namespace bqsa::harness
