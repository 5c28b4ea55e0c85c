// Claims files: the repository's own is complete, and bad ones are refused with their place.
#include "harness/claims/claims_file.hpp"

#include <gtest/gtest.h>

#include <set>

#include "harness/scenario/scenario_files.hpp"

namespace bqsa::harness::claims {
namespace {

constexpr const char* kGood = R"(schema: bqsa-claims/1
claims:
- id: counts
  statement: so many
  source: section 3.4
  estimator: {name: multiplications}
  as_stated:
    - {figure: total, is: "==", value: 25}
  corrected:
    text: so many
    bounds: [{figure: total, is: within, from: 1, to: 2}]
  expected: confirmed
  note: none
- id: errors
  statement: so far
  source: section 4.1
  estimator:
    - {name: run, as: a, scenario: planar_7r, method: bqsa}
    - {name: lemma_1, as: b, samples: 100}
  as_stated:
    - {figure: a.error, is: "<", value: 3.5, unit: mm}
    - {unknown: "lost"}
  expected: not decidable
)";

std::string refusal(const std::string& text) {
  const TestDirectory directory;
  return message_of(directory, [&] { load_claims(directory.write("c.yaml", text)); });
}

std::string with(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  if (at == std::string::npos) ADD_FAILURE() << "no " << part;
  return at == std::string::npos ? text : text.replace(at, part.size(), by);
}

TEST(ClaimsFile, OfTheRepositoryIsComplete) {
  const std::vector<Claim> claims = load_claims(BQSA_SOURCE_DIR "/claims.yaml");
  EXPECT_GE(claims.size(), 50u);
  std::set<std::string> used;
  int gates = 0, timing = 0;
  for (const Claim& claim : claims) {
    SCOPED_TRACE(claim.id);
    EXPECT_FALSE(claim.statement.empty());
    EXPECT_FALSE(claim.source.empty());
    EXPECT_FALSE(claim.calls.empty());
    EXPECT_FALSE(claim.as_stated.empty());
    EXPECT_FALSE(claim.gate && !claim.timing());
    EXPECT_EQ(claim.expected == Verdict::kUndecided, !claim.as_stated[0].unknown.empty())
        << "what is not decidable says why";
    for (const EstimatorCall& call : claim.calls) used.insert(call.estimator->name);
    gates += claim.gate;
    timing += claim.timing();
  }
  EXPECT_EQ(gates, 2);
  EXPECT_GE(timing, 12);
  for (const Estimator& estimator : estimators()) {
    EXPECT_TRUE(used.contains(estimator.name)) << estimator.name << " serves no claim";
  }
}

TEST(ClaimsFile, IsReadAsItStands) {
  const TestDirectory directory;
  const std::vector<Claim> claims = load_claims(directory.write("c.yaml", kGood));
  ASSERT_EQ(claims.size(), 2u);
  EXPECT_EQ(claims[0].as_stated[0].relation, Relation::kEqual);
  EXPECT_EQ(claims[0].as_stated[0].lower, 25);
  EXPECT_EQ(claims[0].corrected->bounds[0].relation, Relation::kWithin);
  EXPECT_EQ(claims[0].corrected->bounds[0].upper, 2);
  EXPECT_FALSE(claims[0].timing());
  EXPECT_EQ(claims[1].calls[0].prefix, "a.");
  EXPECT_EQ(claims[1].calls[0].arguments.text("method"), "bqsa");
  EXPECT_EQ(claims[1].calls[1].arguments.whole("samples"), 100);
  EXPECT_EQ(claims[1].as_stated[0].unit, "mm");
  EXPECT_EQ(claims[1].as_stated[1].unknown, "lost");
  EXPECT_EQ(claims[1].expected, Verdict::kUndecided);
}

TEST(ClaimsFile, ANumberMayDependOnTheVectorInstructions) {
  const TestDirectory directory;
  std::vector<Claim> claims = load_claims(
      directory.write("c.yaml", with(kGood, "value: 25", "value: {AVX3: 400, AVX2: 200}")));
  const Bound& bound = claims[0].as_stated[0];
  EXPECT_EQ(text_of(bound), "== 400 with AVX3, 200 with AVX2");
  EXPECT_FALSE(bound.not_here.empty()) << "as long as nothing is chosen";
  choose_numbers(claims, "AVX3");
  EXPECT_EQ(bound.lower, 400);
  EXPECT_EQ(bound.upper, 400);
  EXPECT_EQ(bound.not_here, "");
  choose_numbers(claims, "AVX2");
  EXPECT_EQ(bound.lower, 200);
  choose_numbers(claims, "SSE4");
  EXPECT_EQ(bound.not_here,
            "vector instructions are SSE4, bounds are == 400 with AVX3, 200 with AVX2");
  EXPECT_EQ(claims[0].corrected->bounds[0].not_here, "") << "a plain number holds everywhere";
}

struct BadFile {
  const char* part;
  const char* by;
  const char* message;
};

TEST(ClaimsFile, IsRefusedWithLineKeyExpectedAndFound) {
  const BadFile cases[] = {
      {"bqsa-claims/1", "bqsa-claims/2",
       "c.yaml:1: schema: expected bqsa-claims/1, got bqsa-claims/2"},
      {"  source: section 3.4\n", "",
       "c.yaml:3: claims[0].source: expected section, figure or equation of the paper, got "
       "nothing"},
      {"id: counts", "id: errors",
       "c.yaml:14: claims[1].id: expected an id of its own for each claim, got errors"},
      {"id: counts", "id: Counts!",
       "c.yaml:3: claims[0].id: expected a name of 1 to 64 characters a-z, 0-9, _, got Counts!"},
      {"{name: multiplications}", "{name: lemma_3}", ""},
      {"{name: multiplications}", "{name: multiplications, form: paper}",
       "c.yaml:6: claims[0].estimator.form: expected a known key, the nearest being name, got "
       "form"},
      {"figure: total, is: \"==\"", "figure: totals, is: \"==\"",
       "c.yaml:8: claims[0].as_stated[0].figure: expected one of quadratic, quadratic_shared, "
       "discriminant, total, total_shared, total_with_criteria, got totals"},
      {"is: \"==\"", "is: \"=\"",
       "c.yaml:8: claims[0].as_stated[0].is: expected <, <=, >, >=, == or within, got \"=\""},
      {"value: 25", "value: many",
       "c.yaml:8: claims[0].as_stated[0].value: expected a number, got many"},
      {"value: 25", "value: {AVX3: 400, SSE4: 100}",
       "c.yaml:8: claims[0].as_stated[0].value.SSE4: expected a known key, the nearest being AVX3, "
       "got SSE4"},
      {"value: 25", "value: {AVX3: many}",
       "c.yaml:8: claims[0].as_stated[0].value.AVX3: expected a number, got many"},
      {", value: 25", "", "c.yaml:8: claims[0].as_stated[0].value: expected a number, got nothing"},
      {"from: 1, to: 2", "from: 3, to: 2",
       "c.yaml:11: claims[0].corrected.bounds[0].to: expected at least 3, got 2"},
      {"from: 1, to: 2", "value: 2",
       "c.yaml:11: claims[0].corrected.bounds[0].from: expected a number, got nothing"},
      {"value: 25", "value: 25, to: 3",
       "c.yaml:8: claims[0].as_stated[0].to: expected nothing beside value, got 3"},
      {", unit: mm", "",
       "c.yaml:21: claims[1].as_stated[0].unit: expected mm, the unit of a.error, got nothing"},
      {"unit: mm", "unit: m",
       "c.yaml:21: claims[1].as_stated[0].unit: expected mm, the unit of a.error, got m"},
      {"value: 25", "value: 25, unit: mm",
       "c.yaml:8: claims[0].as_stated[0].unit: expected -, the unit of total, got mm"},
      {"as: b", "as: a",
       "c.yaml:19: claims[1].estimator[1]: expected a name of its own for each estimator, `as: "
       "NAME`, got a second of the same"},
      {", method: bqsa", "",
       "c.yaml:18: claims[1].estimator[0].method: expected a reactive method, M[:key=value,...], "
       "got nothing"},
      {"samples: 100", "samples: 0",
       "c.yaml:19: claims[1].estimator[1].samples: expected a whole number from 1 to 100000000, "
       "got 0"},
      {"samples: 100", "samples: 1.5",
       "c.yaml:19: claims[1].estimator[1].samples: expected a whole number from 1 to 100000000, "
       "got 1.5"},
      {"expected: confirmed", "expected: true",
       "c.yaml:12: claims[0].expected: expected confirmed, confirmed with correction, refuted or "
       "not decidable, got true"},
      {"unknown: \"lost\"", "unknown: \"\"",
       "c.yaml:22: claims[1].as_stated[1].unknown: expected why it is unknown, got \"\""},
      {"  as_stated:\n    - {figure: total, is: \"==\", value: 25}\n", "  as_stated: []\n",
       "c.yaml:7: claims[0].as_stated: expected at least one bound, got a list of 0"},
      {"note: none", "notes: none",
       "c.yaml:13: claims[0].notes: expected a known key, the nearest being note, got notes"},
      {"expected: not decidable", "expected: confirmed with correction",
       "c.yaml:14: claims[1].corrected: expected the correction that is expected, got nothing"},
  };
  EXPECT_EQ(refusal(kGood), "no error");
  for (const BadFile& bad : cases) {
    SCOPED_TRACE(bad.by);
    const std::string message = refusal(with(kGood, bad.part, bad.by));
    if (*bad.message == '\0') {
      EXPECT_TRUE(
          message.starts_with("c.yaml:6: claims[0].estimator.name: expected one of "
                              "multiplications, pass_multiplications, "))
          << message;
      EXPECT_TRUE(message.ends_with(", got lemma_3")) << message;
    } else {
      EXPECT_EQ(message, bad.message);
    }
  }
}

}  // namespace
}  // namespace bqsa::harness::claims
