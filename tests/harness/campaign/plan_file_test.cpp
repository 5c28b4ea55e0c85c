#include "harness/campaign/plan_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/campaign/campaigns.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;

/// Two scenarios, two methods, the last run left out.
Plan small_plan() {
  Plan plan;
  plan.campaign = "small";
  plan.scenarios = {{"a.yaml", "a", ""}, {"b.yaml", "b", ""}};
  plan.methods = {parse_method_spec("plain", known_methods()),
                  parse_method_spec("tuned:gain=2.5", known_methods())};
  plan.runs = {{0, 0, 1, 5, "k1"}, {0, 1, 1, 5, "k2"}, {1, 0, 2, 6, "k3"}};
  plan.settings.disturbance.joint_noise = 1e-3;
  return plan;
}

const char* const kText =
    R"({"schema":"bqsa-plan/1","campaign":"small","program":"0.1.0, commit x","runs":3}
{"key":"k1","scenario":"a","variant":"plain+noise=0.001","repetition":1}
{"key":"k2","scenario":"a","variant":"tuned@91a23648+noise=0.001","repetition":1}
{"key":"k3","scenario":"b","variant":"plain+noise=0.001","repetition":2}
)";

std::string text_in(const TestDirectory& directory) {
  std::ifstream file(directory.path() / "plan.jsonl", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(PlanFile, HasALineARunAfterItsHead) {
  const TestDirectory directory;
  EXPECT_FALSE(has_plan(directory.path()));
  write_plan(small_plan(), "0.1.0, commit x", directory.path());
  EXPECT_TRUE(has_plan(directory.path()));
  EXPECT_EQ(text_in(directory), kText);
}

TEST(PlanFile, IsReadAsItWasWritten) {
  const TestDirectory directory;
  write_plan(small_plan(), "0.1.0, commit x", directory.path() / "made");
  const ListedPlan plan = read_plan(directory.path() / "made");
  EXPECT_EQ(plan.campaign, "small");
  EXPECT_EQ(plan.program, "0.1.0, commit x");
  ASSERT_EQ(plan.runs.size(), 3u);
  EXPECT_EQ(plan.runs[1].key, "k2");
  EXPECT_EQ(plan.runs[1].scenario, "a");
  EXPECT_EQ(plan.runs[1].variant, "tuned@91a23648+noise=0.001");
  EXPECT_EQ(plan.runs[2].repetition, 2);
}

TEST(PlanFile, WithTheSameBytesIsLeftAlone) {
  const TestDirectory directory;
  write_plan(small_plan(), "p", directory.path());
  const fs::path file = directory.path() / "plan.jsonl";
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
  const auto before = fs::last_write_time(file);
  write_plan(small_plan(), "p", directory.path());
  EXPECT_EQ(fs::last_write_time(file), before);
}

TEST(PlanFile, OfTheSameCampaignIsReplaced) {
  const TestDirectory directory;
  write_plan(small_plan(), "p", directory.path());
  Plan changed = small_plan();
  changed.runs.pop_back();
  write_plan(changed, "p", directory.path());
  EXPECT_EQ(read_plan(directory.path()).runs.size(), 2u);
}

TEST(PlanFile, OfAnotherCampaignIsRefusedAndStays) {
  const TestDirectory directory;
  write_plan(small_plan(), "p", directory.path());
  Plan other = small_plan();
  other.campaign = "other";
  EXPECT_EQ(message_of(directory, [&] { write_plan(other, "p", directory.path()); }),
            directory.path().string() +
                ": expected a directory of campaign other or an empty one, got one of campaign "
                "small");
  EXPECT_EQ(read_plan(directory.path()).campaign, "small");
}

TEST(PlanFile, AFileThatIsNoPlanIsRefusedAndStays) {
  const TestDirectory directory;
  directory.write("plan.jsonl", "my notes\n");
  EXPECT_EQ(message_of(directory, [&] { write_plan(small_plan(), "p", directory.path()); }),
            "plan.jsonl:1: not a plan: damaged");
  EXPECT_EQ(text_in(directory), "my notes\n");
}

TEST(PlanFile, ThatIsNotWholeIsRefusedWithItsLine) {
  const TestDirectory directory;
  const auto refused = [&](const std::string& text) {
    directory.write("plan.jsonl", text);
    return message_of(directory, [&] { read_plan(directory.path()); });
  };
  EXPECT_EQ(message_of(directory, [&] { read_plan(directory.path()); }),
            "plan.jsonl: expected a file, got nothing there");
  const std::string text = kText;
  EXPECT_EQ(refused(text), "no error");
  EXPECT_EQ(refused(""), "plan.jsonl: not a plan: expected 0 runs, got 0");
  EXPECT_EQ(refused(text.substr(0, text.size() - 1)), "plan.jsonl:4: not a plan: cut short");
  EXPECT_EQ(refused(text.substr(0, text.rfind("{"))),
            "plan.jsonl: not a plan: expected 3 runs, got 2");
  EXPECT_EQ(refused(text + text.substr(text.rfind("{"))),
            "plan.jsonl: not a plan: expected 3 runs, got 4");
  EXPECT_EQ(refused(with(text, "bqsa-plan/1", "bqsa-plan/2")),
            "plan.jsonl:1: not a plan: schema: expected bqsa-plan/1, got bqsa-plan/2");
  EXPECT_EQ(refused(with(text, "\"key\":\"k2\"", "\"kee\":\"k2\"")),
            "plan.jsonl:3: not a plan: key: missing");
  EXPECT_EQ(refused(with(text, "\"repetition\":2", "\"repetition\":-2")),
            "plan.jsonl:4: not a plan: repetition: expected a whole number");
  EXPECT_EQ(refused("[]\n"), "plan.jsonl:1: not a plan: expected an object");
}

}  // namespace
}  // namespace bqsa::harness
