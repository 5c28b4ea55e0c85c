// Runs as claims see them, against the runner and the judge.
#include <gtest/gtest.h>

#include "harness/claims/estimator.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/methods.hpp"
#include "harness/runner.hpp"

namespace bqsa::harness::claims {
namespace {

class RunEstimators : public testing::Test {
 protected:
  Findings estimate(const std::string& name,
                    const std::vector<std::pair<std::string, std::string>>& given) {
    const Estimator* estimator = find_estimator(name);
    Arguments arguments;
    for (const ArgumentDeclaration& one : estimator->arguments) {
      arguments.set(one.name, one.fallback.value_or(""));
    }
    for (const auto& [key, value] : given) arguments.set(key, value);
    return estimator->estimate(arguments, laboratory_);
  }

  static double value(const Findings& findings, const std::string& name) {
    for (const Figure& figure : findings.figures) {
      if (figure.name == name) return figure.value;
    }
    ADD_FAILURE() << "no figure " << name;
    return 0;
  }

  std::vector<Sweep> none_;
  Laboratory laboratory_{{.scenarios = BQSA_SOURCE_DIR "/scenarios"}, methods(), none_};
};

TEST_F(RunEstimators, RunAsTheRunnerDoes) {
  for (const char* method : {"bqsa", "bqsa_paper", "none"}) {
    SCOPED_TRACE(method);
    const RecordedRun& recorded = laboratory_.run({.scenario = "planar_7r", .method = method});
    const MethodSpec spec = parse_method_spec(method, methods());
    const RunOutcome outcome = run_method(recorded.problem, spec.entry, spec.parameters);
    ASSERT_EQ(recorded.trajectory.q.size(), outcome.trajectory.q.size());
    for (std::size_t k = 0; k < outcome.trajectory.q.size(); ++k) {
      ASSERT_EQ(recorded.trajectory.q[k], outcome.trajectory.q[k]) << "row " << k;
    }
    int clamped = 0, guarded = 0;
    for (const RecordedTick& tick : recorded.ticks) {
      clamped += tick.state == TickState::kClamped;
      guarded += tick.guard_fired;
    }
    EXPECT_EQ(clamped, outcome.clamped_ticks);
    EXPECT_EQ(guarded, outcome.guard_fired);
  }
}

TEST_F(RunEstimators, FollowAnObstacleThatIsMoved) {
  const std::vector<std::pair<std::string, std::string>> there = {{"scenario", "planar_7r"},
                                                                  {"method", "none"}};
  auto elsewhere = there;
  elsewhere.push_back({"moved", "obstacle"});
  elsewhere.push_back({"center", "-3000 0 0"});
  EXPECT_EQ(value(estimate("run", there), "collisions"), 3);
  EXPECT_EQ(value(estimate("run", elsewhere), "collisions"), 1);  // (7, object)
}

TEST_F(RunEstimators, ChangeTheVerdictsFigureWithTheMethod) {
  EXPECT_EQ(
      value(estimate("hits_along_run", {{"scenario", "planar_7r"}, {"method", "bqsa"}}), "hits"),
      0);
  EXPECT_GT(
      value(estimate("hits_along_run", {{"scenario", "planar_7r"}, {"method", "none"}}), "hits"),
      0);
}

TEST_F(RunEstimators, SeeThatASelfMotionOfTheWholeArmTurnsOuterLinks) {
  const auto turned = [&](const char* method) {
    return value(estimate("outer_links", {{"scenario", "planar_7r"}, {"method", method}}),
                 "turned");
  };
  EXPECT_LT(turned("bqsa"), 1e-6);
  EXPECT_GT(turned("bqsa:release=first"), 0.01);
}

/// What a method says of itself decides nothing alone: the judge is asked, and the pairs that its steps
/// would hit are found from its postures.
TEST_F(RunEstimators, TellACollidingRunAndPairsNotReported) {
  for (const char* estimator :
       {"cleared_pairs", "outer_links", "errors_while_avoiding", "velocity_jumps"}) {
    SCOPED_TRACE(estimator);
    const auto with = [&](const char* method) {
      return estimate(estimator,
                      {{"scenario", "planar_7r"}, {"method", method}, {"pairs", "7 object"}});
    };
    EXPECT_EQ(value(with("bqsa"), "success"), 1);
    EXPECT_EQ(value(with("none"), "success"), 0);
  }
  const Findings silent = estimate(
      "cleared_pairs", {{"scenario", "planar_7r"}, {"method", "none"}, {"pairs", "7 object"}});
  EXPECT_EQ(value(silent, "unreported"), 3);  // of (5, obstacle), (6, obstacle), (7, object)
  EXPECT_EQ(value(silent, "others_hit_without_avoidance"), 2);
}

TEST_F(RunEstimators, CallAMotionSmoothThatMeetsNothing) {
  const Findings free = estimate("velocity_jumps", {{"scenario", "planar_7r"}, {"method", "none"}});
  EXPECT_NEAR(value(free, "jump_exponent"), 1, 0.05);
  EXPECT_NEAR(value(free, "step_exponent"), 1, 0.05);
  EXPECT_EQ(value(free, "jump"), value(free, "open_jump"));
}

TEST_F(RunEstimators, FindFreePosturesWhereThereAreSome) {
  const auto free = [&](const char* center) {
    return value(estimate("free_postures", {{"scenario", "puma560_wall"},
                                            {"method", "none"},
                                            {"moved", "wall"},
                                            {"center", center},
                                            {"samples", "300"}}),
                 "free");
  };
  EXPECT_EQ(free("547 0 634"), 0);
  EXPECT_GT(free("547 170 634"), 0);
}

TEST_F(RunEstimators, RefuseWhatTheyCannotRun) {
  const auto message = [&](const std::vector<std::pair<std::string, std::string>>& arguments) {
    try {
      estimate("run", arguments);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message({{"scenario", "planar_7r"}, {"method", "ompl"}}),
            "ompl: expected a reactive method of this program, got another");
  EXPECT_EQ(
      message(
          {{"scenario", "planar_7r"}, {"method", "bqsa"}, {"moved", "post"}, {"center", "0 0 0"}}),
      "post: expected an obstacle of planar_7r, got none of that name");
  EXPECT_EQ(message({{"scenario", "planar_7r"},
                     {"method", "bqsa"},
                     {"moved", "obstacle"},
                     {"center", "0 0"}}),
            "center: expected three numbers, X Y Z [mm], got 0 0");
  EXPECT_EQ(message({{"scenario", "planar_7r"}, {"method", "bqsa"}, {"center", "0 0 0"}}),
            "center: expected none without moved, got 0 0 0");
  EXPECT_NE(message({{"scenario", "planar_8r"}, {"method", "bqsa"}}), "no error");
}

}  // namespace
}  // namespace bqsa::harness::claims
