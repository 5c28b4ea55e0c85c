// `bqsa-bench claims` as a user meets it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "harness/program/program_runner.hpp"

namespace bqsa::harness::claims {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kScenarios = BQSA_SOURCE_DIR "/scenarios";

std::string claims_text(const std::string& value) {
  return "schema: bqsa-claims/1\nclaims:\n"
         "- {id: count, statement: s, source: p, estimator: {name: multiplications},\n"
         "   as_stated: [{figure: total, is: '==', value: " +
         value +
         "}], expected: confirmed}\n"
         "- {id: freedom, statement: s, source: p,\n"
         "   estimator: {name: redundancy, scenario: planar_7r},\n"
         "   as_stated: [{figure: redundancy, is: '==', value: 5}], expected: confirmed}\n";
}

TEST(ClaimsCommand, EndsWithTheStatusOfItsVerdicts) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "claims.yaml";
  const std::vector<std::string> words = {"claims", "--claims", file.string(), "--scenarios",
                                          kScenarios};
  write_file(file, claims_text("25"));
  const ProgramResult good = run_bqsa_bench(words);
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("2 claims: 2 confirmed"));
  EXPECT_EQ(good.err, "");

  write_file(file, claims_text("24"));
  const ProgramResult broken = run_bqsa_bench(words);
  EXPECT_EQ(broken.status, 1);
  EXPECT_THAT(broken.err,
              HasSubstr("claim count no longer holds: expected confirmed, found refuted"));

  write_file(file, claims_text("many"));
  const ProgramResult bad = run_bqsa_bench(words);
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr("claims.yaml:4: claims[0].as_stated[0].value: expected a number, "
                                 "got many"));
}

TEST(ClaimsCommand, ShowsOneClaimInFull) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "claims.yaml";
  write_file(file, claims_text("25"));
  const ProgramResult one = run_bqsa_bench(
      {"claims", "--claims", file.string(), "--scenarios", kScenarios, "--only", "freedom"});
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_THAT(one.out, StartsWith("freedom\n"));
  EXPECT_THAT(one.out, HasSubstr("holds     redundancy == 5"));
  const ProgramResult unknown =
      run_bqsa_bench({"claims", "--claims", file.string(), "--only", "freedoms"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("--only: expected one of count, freedom, got freedoms"));
}

TEST(ClaimsCommand, WritesARecordFromWhichTheTableIsMade) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "claims.yaml";
  const auto out = directory.path() / "out";
  write_file(file, claims_text("25"));
  const ProgramResult run = run_bqsa_bench(
      {"claims", "--claims", file.string(), "--scenarios", kScenarios, "--out", out.string()});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto record = nlohmann::json::parse(content_of(out / "claims.json"));
  EXPECT_EQ(record.at("claims").size(), 2u);
  EXPECT_EQ(record.at("claims").at(0).at("verdict"), "confirmed");
  EXPECT_EQ(record.at("build").at("commit").get<std::string>().empty(), false);
  EXPECT_FALSE(record.contains("measured")) << "nothing rests on times";

  const std::string json = (out / "claims.json").string();
  EXPECT_EQ(run_bqsa_bench({"claims", "--render", json}).out, content_of(out / "claims.md"));
  const auto readme = directory.path() / "README.md";
  write_file(readme, "top\n<!-- claims -->\n<!-- /claims -->\nend\n");
  EXPECT_EQ(run_bqsa_bench({"claims", "--render", json, "--into", readme.string()}).status, 0);
  EXPECT_EQ(content_of(readme),
            "top\n<!-- claims -->\n" + content_of(out / "claims.md") + "<!-- /claims -->\nend\n");
  write_file(readme, "top\n");
  const ProgramResult no_block =
      run_bqsa_bench({"claims", "--render", json, "--into", readme.string()});
  EXPECT_EQ(no_block.status, 2);
  EXPECT_EQ(content_of(readme), "top\n");
}

}  // namespace
}  // namespace bqsa::harness::claims
