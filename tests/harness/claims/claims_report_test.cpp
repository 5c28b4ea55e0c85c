// The record of an evaluation and what is made of it.
#include "harness/claims/claims_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "harness/claims/claims_file.hpp"
#include "harness/claims/claims_record.hpp"
#include "harness/methods.hpp"
#include "harness/scenario/scenario_files.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness::claims {
namespace {

using testing::HasSubstr;
using testing::Not;

nlohmann::ordered_json record_of(const char* value) {
  const TestDirectory directory;
  const std::string text =
      std::string(
          "schema: bqsa-claims/1\nclaims:\n- id: count\n"
          "  statement: so | many\n  source: section 3.4\n"
          "  estimator: {name: multiplications}\n"
          "  as_stated: [{figure: total, is: '==', value: ") +
      value +
      "}]\n  corrected: {text: others, bounds: [{figure: total, is: '<', value: "
      "26}]}\n  expected: confirmed\n";
  const std::vector<Claim> claims = load_claims(directory.write("c.yaml", text));
  const std::vector<Sweep> none;
  Laboratory laboratory({}, methods(), none);
  return claims_record(evaluate(claims, laboratory, {}),
                       {.build = build_info(), .machine = {}, .measured = {}});
}

TEST(ClaimsReport, MarksWhatNoLongerHolds) {
  EXPECT_THAT(claims_table(record_of("25")), HasSubstr("\n1 claims: 1 confirmed, "));
  EXPECT_THAT(claims_table(record_of("25")), HasSubstr("  count "));
  EXPECT_THAT(claims_table(record_of("25")), HasSubstr("none breaks what is expected\n"));
  EXPECT_THAT(claims_table(record_of("24")), HasSubstr("! count "));
  EXPECT_THAT(claims_table(record_of("24")), HasSubstr("; 1 no longer as expected\n"));
}

TEST(ClaimsReport, ShowsAClaimInFull) {
  const std::string text = claim_in_full(record_of("24").at("claims").at(0));
  for (const char* part :
       {"statement: so | many", "source: section 3.4", "verdict: confirmed with correction",
        "expected: confirmed", "standing: no longer holds", "fails     total == 24",
        "holds     total < 26", "total 25: ", "bqsa-bench claims --only count"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(ClaimsReport, MakesMarkdownOfTheRecord) {
  const std::string text = claims_markdown(record_of("25"));
  EXPECT_THAT(text, HasSubstr("| `count`: so \\| many | section 3.4 | confirmed | total 25 |\n"));
  EXPECT_THAT(text, Not(HasSubstr("Corrected")));
  EXPECT_THAT(claims_markdown(record_of("24")), HasSubstr("*Corrected: others*"));
}

TEST(ClaimsReport, ReplacesTheBlockAlone) {
  const std::string table = claims_markdown(record_of("25"));
  const std::string before = "a\n<!-- claims -->\nold\n<!-- /claims -->\nb\n";
  const std::string after = with_claims_block(before, table);
  EXPECT_EQ(after, "a\n<!-- claims -->\n" + table + "<!-- /claims -->\nb\n");
  EXPECT_EQ(with_claims_block(after, table), after);
  for (const char* bad : {"a\n", "<!-- claims -->\n", "<!-- /claims -->\n<!-- claims -->\n",
                          "<!-- claims -->\n<!-- claims -->\n<!-- /claims -->\n"}) {
    EXPECT_THROW(with_claims_block(bad, table), InputError) << bad;
  }
}

TEST(ClaimsReport, RefusesOtherFiles) {
  const std::string good = record_of("25").dump();
  const TestDirectory directory;
  for (const char* text :
       {"", "{", "[]", "{\"schema\": \"bqsa-claims-result/2\"}", "{\"schema\": 1}"}) {
    EXPECT_THROW(read_claims_record(directory.write("r.json", text)), InputError) << text;
  }
  EXPECT_EQ(read_claims_record(directory.write("r.json", good)).dump(), good);
}

TEST(ClaimsReport, OfTheReadmeIsThatOfTheReferenceResult) {
  constexpr std::size_t kMaxBytes = 1 << 20;
  const std::string readme = read_text_file(BQSA_SOURCE_DIR "/README.md", kMaxBytes);
  const auto record = read_claims_record(BQSA_SOURCE_DIR "/results/claims/claims.json");
  EXPECT_EQ(with_claims_block(readme, claims_markdown(record)), readme)
      << "bqsa-bench claims --render results/claims/claims.json --into README.md";
}

}  // namespace
}  // namespace bqsa::harness::claims
