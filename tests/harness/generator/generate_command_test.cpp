// `bqsa-bench generate` as a user calls it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../program/program_runner.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kRobots = BQSA_SOURCE_DIR "/robots";

ProgramResult generate(const std::string& family, const std::string& count, const fs::path& out,
                       const std::string& seed = "1", const std::string& robots = kRobots) {
  return run_bqsa_bench({"generate", "--family", family, "--count", count, "--seed", seed, "--out",
                         out.string(), "--robots", robots});
}

std::size_t files_in(const fs::path& directory) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(directory), fs::directory_iterator()));
}

TEST(GenerateCommand, WritesScenariosThatValidate) {
  const TemporaryDirectory directory;
  for (const std::string family :
       {"planar", "spatial", "moving", "singular", "narrow", "planar_any"}) {
    const fs::path out = directory.path() / family;
    const ProgramResult result = generate(family, "3", out);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(result.out, HasSubstr("wrote 3 scenarios, 0 were there; rejected"));
    EXPECT_EQ(files_in(out), 3U);
    const ProgramResult valid =
        run_bqsa_bench({"validate", (out / (family + "_s1_00000.yaml")).string(),
                        (out / (family + "_s1_00001.yaml")).string(),
                        (out / (family + "_s1_00002.yaml")).string()});
    EXPECT_EQ(valid.status, 0) << valid.err;
  }
}

TEST(GenerateCommand, AFileDoesNotDependOnTheCount) {
  const TemporaryDirectory directory;
  const fs::path one = directory.path() / "one", more = directory.path() / "more";
  generate("moving", "2", one);
  generate("moving", "5", more);
  for (const char* file : {"moving_s1_00000.yaml", "moving_s1_00001.yaml"}) {
    EXPECT_THAT(content_of(one / file), HasSubstr("motion: {kind: linear, velocity: ["));
    EXPECT_EQ(content_of(one / file), content_of(more / file));
  }
}

TEST(GenerateCommand, AddsToWhatIsThereAndOverwritesNothing) {
  const TemporaryDirectory directory;
  EXPECT_EQ(generate("planar", "2", directory.path()).status, 0);
  const ProgramResult again = generate("planar", "4", directory.path());
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.out, HasSubstr("wrote 2 scenarios, 2 were there"));

  const fs::path changed = directory.path() / "planar_s1_00001.yaml";
  write_file(changed, "mine");
  const ProgramResult refused = generate("planar", "6", directory.path());
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("planar_s1_00001.yaml: expected no file or what is to be "
                                     "written, got another one"));
  EXPECT_EQ(content_of(changed), "mine");
  EXPECT_EQ(files_in(directory.path()), 4U);
}

TEST(GenerateCommand, WritesWitnessesThatAreJudgedSuccesses) {
  const TemporaryDirectory directory;
  const auto with_witnesses = [&directory](const std::string& family) {
    return run_bqsa_bench({"generate", "--family", family, "--count", "2", "--seed", "1", "--out",
                           directory.path().string(), "--robots", kRobots, "--witnesses"});
  };
  for (const std::string family : {"planar", "spatial", "moving", "singular", "narrow"}) {
    EXPECT_EQ(generate(family, "1", directory.path()).status, 0);
    const ProgramResult result = with_witnesses(family);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("wrote 1 scenarios, 1 were there"));
    for (const char* index : {"0", "1"}) {
      const fs::path scenario = directory.path() / (family + "_s1_0000" + index + ".yaml");
      const fs::path witness = directory.path() / (family + "_s1_0000" + index + ".witness.csv");
      const ProgramResult judged =
          run_bqsa_bench({"judge", scenario.string(), witness.string(), "--strict"});
      EXPECT_EQ(judged.status, 0) << judged.err;
      EXPECT_THAT(judged.out, HasSubstr("verdict: success"));
    }
  }
  EXPECT_EQ(files_in(directory.path()), 20U);
  EXPECT_EQ(with_witnesses("planar").status, 0);

  write_file(directory.path() / "planar_s1_00001.witness.csv", "mine");
  const ProgramResult refused = with_witnesses("planar");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("planar_s1_00001.witness.csv: expected no file or what is to "
                                     "be written, got another one"));
  const ProgramResult without = with_witnesses("planar_any");
  EXPECT_EQ(without.status, 2);
  EXPECT_THAT(without.err, HasSubstr("--witnesses: expected a family that has them, got "
                                     "planar_any"));
  EXPECT_EQ(files_in(directory.path()), 20U);
}

TEST(GenerateCommand, RefusesWhatItCannotDo) {
  const TemporaryDirectory directory;
  const fs::path out = directory.path() / "out";
  const ProgramResult family = generate("plane", "1", out);
  EXPECT_EQ(family.status, 2);
  EXPECT_THAT(family.err, HasSubstr("--family: expected one of planar, spatial, moving, singular, "
                                    "narrow, planar_any, clutter, corridor, shelf, crossing, "
                                    "stretched, any_arm, got plane"));
  EXPECT_EQ(generate("planar", "0", out).status, 2);
  EXPECT_EQ(generate("planar", "100001", out).status, 2);
  const ProgramResult seed = generate("planar", "1", out, "-1");
  EXPECT_EQ(seed.status, 2);
  EXPECT_THAT(seed.err, HasSubstr("--seed"));
  const ProgramResult robots = generate("spatial", "1", out, "1", directory.path().string());
  EXPECT_EQ(robots.status, 2);
  EXPECT_THAT(robots.err, HasSubstr("kuka_lbr_iiwa14.yaml: expected a file, got nothing there"));
  EXPECT_FALSE(fs::exists(out));

  write_file(out, "a file");
  const ProgramResult no_directory = generate("planar", "1", out);
  EXPECT_EQ(no_directory.status, 2);
  EXPECT_THAT(no_directory.err, HasSubstr("expected a directory that can be made"));
}

TEST(GenerateCommand, ListNamesTheFamilies) {
  const ProgramResult list = run_bqsa_bench({"list", "--scenarios", BQSA_SOURCE_DIR "/scenarios"});
  EXPECT_EQ(list.status, 0);
  for (const char* family :
       {"  planar ", "  spatial ", "  moving ", "  singular ", "  narrow ", "  planar_any "}) {
    EXPECT_THAT(list.out, HasSubstr(family));
  }
}

}  // namespace
}  // namespace bqsa::harness
