#include "harness/campaign/plan_file.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "harness/results/record_value.hpp"
#include "harness/results/run_record.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kSchema = "bqsa-plan/1";

fs::path plan_file(const fs::path& directory) { return directory / kPlanFile; }

std::string plan_text(const Plan& plan, const std::string& program) {
  using Json = nlohmann::ordered_json;
  std::string text = Json{{"schema", kSchema},
                          {"campaign", plan.campaign},
                          {"program", program},
                          {"runs", plan.runs.size()}}
                         .dump() +
                     '\n';
  std::vector<std::string> variants;
  for (const MethodSpec& method : plan.methods) {
    variants.push_back(campaign_variant_name(method, plan.settings.disturbance));
  }
  for (const PlannedRun& run : plan.runs) {
    text += Json{{"key", run.key},
                 {"scenario", plan.scenarios[run.scenario].name},
                 {"variant", variants[run.method]},
                 {"repetition", run.repetition}}
                .dump() +
            '\n';
  }
  return text;
}

/// The lines of the plan, each a JSON value that is given to `read` with its number.
template <typename Read>
void for_each_line(const fs::path& file, const std::string& text, Read read) {
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    ++number;
    try {
      if (end == std::string::npos) throw InputError("not a plan: cut short");
      const auto json = nlohmann::json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                              text.begin() + static_cast<std::ptrdiff_t>(end),
                                              nullptr, /* allow_exceptions = */ false);
      if (json.is_discarded()) throw InputError("not a plan: damaged");
      read(RecordValue(json, {}, "a plan"), number);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}:{}: {}", file.string(), number, error.what()));
    }
    begin = end + 1;
  }
}

/// @return the number of runs that it promises
std::uint64_t read_head(const RecordValue& head, ListedPlan& plan) {
  const std::string schema = head["schema"].text();
  if (schema != kSchema) {
    head["schema"].refuse(fmt::format("expected {}, got {}", kSchema, excerpt(schema)));
  }
  plan.campaign = head["campaign"].text();
  plan.program = head["program"].text();
  return head["runs"].whole();
}

ListedPlan parse_plan(const fs::path& file, const std::string& text) {
  ListedPlan plan;
  std::uint64_t promised = 0;
  for_each_line(file, text, [&](const RecordValue& line, int number) {
    if (number == 1) {
      promised = read_head(line, plan);
      return;
    }
    plan.runs.push_back({line["key"].text(), line["scenario"].text(), line["variant"].text(),
                         line["repetition"].integer()});
  });
  if (text.empty() || plan.runs.size() != promised) {
    throw InputError(fmt::format("{}: not a plan: expected {} runs, got {}", file.string(),
                                 promised, plan.runs.size()));
  }
  return plan;
}

void expect_plan_of(const std::string& campaign, const fs::path& file, const std::string& text) {
  const std::string found = parse_plan(file, text).campaign;
  if (found == campaign) return;
  throw InputError(
      fmt::format("{}: expected a directory of campaign {} or an empty one, got one of campaign {}",
                  file.parent_path().string(), campaign, found));
}

}  // namespace

void write_plan(const Plan& plan, const std::string& program, const fs::path& directory) {
  const std::string text = plan_text(plan, program);
  const fs::path file = plan_file(directory);
  if (has_plan(directory)) {
    const std::string present = read_text_file(file, kMostPlanBytes);
    if (present == text) return;
    expect_plan_of(plan.campaign, file, present);
  }
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) {
    throw InputError(
        fmt::format("{}: expected a directory that can be made, got one that cannot ({})",
                    directory.string(), error.message()));
  }
  StagedTextFile(file, text, Durability::kMachine).commit();
  sync_file(directory);
}

ListedPlan read_plan(const fs::path& directory) {
  const fs::path file = plan_file(directory);
  return parse_plan(file, read_text_file(file, kMostPlanBytes));
}

bool has_plan(const fs::path& directory) {
  std::error_code unknown;
  return fs::exists(plan_file(directory), unknown);
}

std::optional<std::vector<std::string>> planned_keys(const std::filesystem::path& directory) {
  if (!has_plan(directory)) return std::nullopt;
  std::vector<std::string> keys;
  for (const ListedRun& run : read_plan(directory).runs) keys.push_back(run.key);
  return keys;
}

}  // namespace bqsa::harness
