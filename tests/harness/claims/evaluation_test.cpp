// What is put in decides the verdict: bounds, scenes, sweeps.
#include "harness/claims/evaluation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "harness/claims/claims_file.hpp"
#include "harness/methods.hpp"
#include "harness/scenario/scenario_files.hpp"
#include "synthetic_sweeps.hpp"

namespace bqsa::harness::claims {
namespace {

constexpr double kNano = 1e-9;

/// The last claim of a text, evaluated.
struct Evaluation {
  Verdict verdict;
  Standing standing;
  std::string reason;
  bool broken;
};

Evaluation evaluation_of(const std::string& text, const std::vector<Sweep>& sweeps = {},
                         const TimesState& times = {},
                         const std::string& instruction_set = "AVX3") {
  const TestDirectory directory;
  std::vector<Claim> claims =
      load_claims(directory.write("c.yaml", "schema: bqsa-claims/1\nclaims:\n" + text));
  choose_numbers(claims, instruction_set);
  Laboratory laboratory({.scenarios = BQSA_SOURCE_DIR "/scenarios"}, methods(), sweeps);
  const std::vector<EvaluatedClaim> all = evaluate(claims, laboratory, times);
  return {all.back().verdict, all.back().standing, all.back().reason, any_broken(all)};
}

std::string claim(const std::string& estimator, const std::string& bound,
                  const std::string& rest = "expected: confirmed") {
  return fmt::format(
      "- id: c\n  statement: s\n  source: p\n  estimator: {}\n  as_stated: [{}]\n  {}\n", estimator,
      bound, rest);
}

constexpr const char* kGate =
    "- id: gate\n  statement: s\n  source: p\n  gate: true\n"
    "  estimator:\n    - {name: time_ratio, as: tie, sweep: gate, a: once_again, b: once}\n"
    "    - {name: time_ratio, as: more, sweep: gate, a: half_more, b: once}\n"
    "  as_stated:\n    - {figure: tie.last, is: within, from: 0.9, to: 1.1}\n"
    "    - {figure: more.last, is: within, from: 1.3, to: 1.7}\n  expected: confirmed\n";

TEST(Evaluation, AnotherBoundGivesAnotherVerdict) {
  const std::string counted = "{name: multiplications}";
  const auto with = [&](const char* bound, const char* rest) {
    return evaluation_of(claim(counted, bound, rest)).verdict;
  };
  EXPECT_EQ(with("{figure: total, is: '==', value: 25}", "expected: confirmed"),
            Verdict::kConfirmed);
  EXPECT_EQ(with("{figure: total, is: '==', value: 24}", "expected: confirmed"), Verdict::kRefuted);
  EXPECT_EQ(with("{figure: total, is: '==', value: 24}",
                 "corrected: {text: t, bounds: [{figure: total, is: '<', value: 26}]}\n"
                 "  expected: confirmed"),
            Verdict::kCorrected);
  EXPECT_EQ(with("{unknown: lost}", "expected: confirmed"), Verdict::kUndecided);
}

TEST(Evaluation, AVerdictThatIsNotExpectedBreaks) {
  const auto of = [&](const char* value, const char* expected) {
    return evaluation_of(claim("{name: multiplications}",
                               fmt::format("{{figure: total, is: '==', value: {}}}", value),
                               fmt::format("expected: {}", expected)));
  };
  EXPECT_FALSE(of("25", "confirmed").broken);
  EXPECT_FALSE(of("24", "refuted").broken);
  EXPECT_TRUE(of("24", "confirmed").broken);
  EXPECT_TRUE(of("25", "refuted").broken) << "better than expected is news, too";
  EXPECT_EQ(of("24", "confirmed").standing, Standing::kBroken);
}

TEST(Evaluation, AMachineWithoutTheInstructionsDecidesNothing) {
  const auto of = [](const char* bounds, const char* set, const char* expected) {
    return evaluation_of(
        claim("{name: multiplications}", bounds, fmt::format("expected: {}", expected)), {}, {},
        set);
  };
  const char* by_set = "{figure: total, is: '==', value: {AVX3: 25, AVX2: 24}}";
  EXPECT_EQ(of(by_set, "AVX3", "confirmed").verdict, Verdict::kConfirmed);
  EXPECT_EQ(of(by_set, "AVX2", "confirmed").verdict, Verdict::kRefuted);
  EXPECT_TRUE(of(by_set, "AVX2", "confirmed").broken);
  for (const char* expected : {"confirmed", "refuted"}) {
    const Evaluation one = of(by_set, "SSE4", expected);
    EXPECT_EQ(one.verdict, Verdict::kUndecided);
    EXPECT_EQ(one.standing, Standing::kNotDecidedHere);
    EXPECT_EQ(one.reason, "vector instructions are SSE4, bounds are == 25 with AVX3, 24 with AVX2");
    EXPECT_FALSE(one.broken) << "expected compares only where it can be decided";
  }
  // What does not depend on instructions fails on every machine.
  const Evaluation failed =
      of("{figure: total, is: '==', value: {AVX3: 25}}, {figure: total, is: '==', value: 3}",
         "SSE4", "confirmed");
  EXPECT_EQ(failed.verdict, Verdict::kRefuted);
  EXPECT_TRUE(failed.broken);
}

TEST(Evaluation, WithoutTheOtherProgramNothingIsDecided) {
  const Evaluation one =
      evaluation_of(claim("{name: allocations}", "{figure: step, is: '==', value: 0}"));
  EXPECT_EQ(one.verdict, Verdict::kUndecided);
  EXPECT_EQ(one.standing, Standing::kNotDecidedHere);
  EXPECT_EQ(one.reason, "count_allocations was not built (target companions)");
}

TEST(Evaluation, AnotherSceneGivesAnotherVerdict) {
  const std::string bound = "{figure: collisions, is: '==', value: 1}";
  EXPECT_EQ(evaluation_of(claim("{name: run, scenario: planar_7r, method: none}", bound)).verdict,
            Verdict::kRefuted);
  EXPECT_EQ(evaluation_of(claim("{name: run, scenario: planar_7r, method: none, moved: obstacle, "
                                "center: '-3000 0 0'}",
                                bound))
                .verdict,
            Verdict::kConfirmed);
}

/// Linear or of another power of NM.
std::vector<Sweep> sweeps_of_power(double power) {
  return {
      synthetic_gate(1, 1.5),
      synthetic_sweep("plane_nm", SweepAxis::kPointPairs,
                      {{"points", [power](double nm) { return kNano * std::pow(nm, power); }}})};
}

const std::string kLinear = claim("{name: time_growth, sweep: plane_nm, series: points}",
                                  "{figure: exponent, is: within, from: 0.9, to: 1.1}");

TEST(Evaluation, AnotherSlopeGivesAnotherVerdict) {
  EXPECT_EQ(evaluation_of(kGate + kLinear, sweeps_of_power(1)).verdict, Verdict::kConfirmed);
  const Evaluation steep = evaluation_of(kGate + kLinear, sweeps_of_power(1.5));
  EXPECT_EQ(steep.verdict, Verdict::kRefuted);
  EXPECT_EQ(steep.standing, Standing::kBroken);
}

TEST(Evaluation, WithoutAGateThatTellsTiesFromDifferencesNoTimeIsJudged) {
  const Sweep wide = synthetic_gate(1, 1.5, 10);
  for (const Sweep& gate :
       {synthetic_gate(1.5, 1.5), synthetic_gate(1, 1.1), synthetic_gate(0.8, 1.5), wide}) {
    std::vector<Sweep> sweeps = sweeps_of_power(1);
    sweeps[0] = gate;
    const Evaluation one = evaluation_of(kGate + kLinear, sweeps);
    EXPECT_EQ(one.verdict, Verdict::kUndecided);
    EXPECT_EQ(one.standing, Standing::kNotDecidedHere);
    EXPECT_EQ(one.reason, "the gate's self-test gate was not confirmed");
    const bool tells_nothing = gate.series[0].seconds == wide.series[0].seconds;
    EXPECT_EQ(one.broken, !tells_nothing) << "on a quiet machine the gate must not be wrong";
    const TimesState loaded{.reasons_against = {"load"}};
    EXPECT_FALSE(evaluation_of(kGate + kLinear, sweeps, loaded).broken);
  }
  const Evaluation without = evaluation_of(kLinear, sweeps_of_power(1));
  EXPECT_EQ(without.verdict, Verdict::kUndecided);
  EXPECT_EQ(without.reason, "the claims file has no self-test of the gate");
  EXPECT_TRUE(without.broken) << "whoever takes the gate away silences nothing";
}

TEST(Evaluation, WideIntervalsBreakNothing) {
  std::vector<Sweep> noisy = sweeps_of_power(1);
  noisy[1] = synthetic_sweep(
      "plane_nm", SweepAxis::kPointPairs,
      {{"points", [](double) { return kNano; }}, {"bqsa", [](double) { return kNano; }}}, 300);
  const std::string ratio = claim("{name: time_ratio, sweep: plane_nm, a: points, b: bqsa}",
                                  "{figure: last, is: within, from: 0.99, to: 1.01}");
  const TimesState loaded{.reasons_against = {"load average 7"}};
  const Evaluation wide = evaluation_of(kGate + ratio, noisy);
  EXPECT_EQ(wide.verdict, Verdict::kUndecided);
  EXPECT_EQ(wide.standing, Standing::kNotDecidedHere);
  EXPECT_EQ(wide.reason, "intervals reach across a bound; measure again, or longer");
  EXPECT_FALSE(wide.broken);
  const Evaluation excused = evaluation_of(kGate + ratio, noisy, loaded);
  EXPECT_EQ(excused.standing, Standing::kNotDecidedHere);
  EXPECT_EQ(excused.reason, "times are only indicative: load average 7");
  EXPECT_FALSE(excused.broken);
  const std::string corrected =
      claim("{name: time_ratio, sweep: plane_nm, a: points, b: bqsa}",
            "{figure: last, is: '>', value: 1.0e6}",
            "corrected: {text: t, bounds: [{figure: last, is: within, from: 0.99, to: 1.01}]}\n"
            "  expected: confirmed with correction");
  EXPECT_EQ(evaluation_of(kGate + corrected, noisy, loaded).standing, Standing::kNotDecidedHere);
  // A refutation is one, load or not: ratios come from interleaved blocks.
  EXPECT_TRUE(evaluation_of(kGate + kLinear, sweeps_of_power(1.5), loaded).broken);
}

/// All but those on times and the one on random problems, which takes longest.
TEST(Evaluation, OfTheRepositorysClaimsGivesWhatIsExpected) {
  std::vector<Claim> claims = load_claims(BQSA_SOURCE_DIR "/claims.yaml");
  std::erase_if(claims, [](const Claim& one) {
    return one.timing() || one.calls[0].estimator->name == "random_problems";
  });
  EXPECT_GE(claims.size(), 35u);
  const std::vector<Sweep> none;
  Laboratory laboratory({.scenarios = BQSA_SOURCE_DIR "/scenarios"}, methods(), none);
  for (const EvaluatedClaim& one : evaluate(claims, laboratory, {})) {
    if (one.standing == Standing::kNotDecidedHere) continue;  // needs another program
    EXPECT_EQ(one.verdict, one.claim->expected) << one.claim->id;
  }
}

TEST(Evaluation, NamesTheClaimOfAnArgumentThatMeansNothing) {
  try {
    evaluation_of(claim("{name: run, scenario: planar_7r, method: nothing}",
                        "{figure: success, is: '==', value: 1}"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("claim c: estimator run: ")) << error.what();
  }
}

}  // namespace
}  // namespace bqsa::harness::claims
