#include "harness/campaign/campaign_file.hpp"

#include <fmt/format.h>

#include <limits>
#include <optional>

#include "harness/campaign/campaign_methods.hpp"
#include "harness/campaign/campaign_scenarios.hpp"
#include "harness/scenario/yaml_value.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

constexpr std::string_view kSchema = "bqsa-campaign/1";
constexpr std::string_view kSchemaOfAnyVersion = "bqsa-campaign/";
constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

constexpr double kMostSeconds = 1e6;
constexpr double kLeastBudget = 1e-3;  // [s]
constexpr double kLeastLimit = 1e-2;   // [s]
constexpr int kMostMebibytes = 1 << 24;
constexpr double kMostNoise = 1;  // [rad]

double number_in(const YamlValue& value, double least, double most, const char* unit) {
  const double number = value.number();
  if (number < least || number > most) {
    value.fail(fmt::format("a number from {:g} to {:g} [{}]", least, most, unit));
  }
  return number;
}

void read_limits(const YamlValue& value, RunLimits& limits) {
  value.expect_keys({"time", "memory"});
  if (const auto time = value.find("time")) {
    limits.wall_s = number_in(*time, kLeastLimit, kMostSeconds, "s");
  }
  if (const auto memory = value.find("memory")) {
    limits.memory_bytes = static_cast<std::uint64_t>(memory->whole_number(1, kMostMebibytes))
                          << 20U;
  }
}

void read_disturbance(const YamlValue& value, Disturbance& disturbance) {
  value.expect_keys({"joint_noise", "latency"});
  if (const auto noise = value.find("joint_noise")) {
    disturbance.joint_noise = number_in(*noise, 0, kMostNoise, "rad");
  }
  if (const auto latency = value.find("latency")) {
    disturbance.latency_ticks = latency->whole_number(0, 1);
  }
}

KeptTrajectories read_trajectories(const YamlValue& value) {
  const std::string kept = value.choice({"all", "failures", "none"});
  if (kept == "all") return KeptTrajectories::kAll;
  return kept == "none" ? KeptTrajectories::kNone : KeptTrajectories::kFailures;
}

void expect_few_runs(const YamlValue& top, const Campaign& campaign) {
  double scenarios = static_cast<double>(campaign.scenarios.size());
  for (const GeneratedScenarios& generated : campaign.generated) scenarios += generated.count;
  const double runs =
      scenarios * static_cast<double>(campaign.methods.size()) * campaign.repetitions;
  if (runs > kMostRuns) {
    top.fail(fmt::format("at most {} runs", kMostRuns),
             fmt::format("{:.0f}: {:.0f} scenarios, {} methods, {} repetitions", runs, scenarios,
                         campaign.methods.size(), campaign.repetitions));
  }
}

}  // namespace

bool is_campaign_file(const std::filesystem::path& file) {
  try {
    const YamlValue top = YamlValue::parse(file.string(), read_text_file(file, kMaxBytes));
    const std::optional<YamlValue> schema = top.find("schema");
    return schema && schema->text().starts_with(kSchemaOfAnyVersion);
  } catch (const InputError&) {
    return false;
  }
}

Campaign load_campaign(const std::filesystem::path& file, const std::vector<MethodEntry>& known) {
  const YamlValue top = YamlValue::parse(file.string(), read_text_file(file, kMaxBytes));
  top.get("schema", std::string(kSchema)).choice({kSchema});
  top.expect_keys({"schema", "name", "description", "scenarios", "methods", "repetitions", "seed",
                   "plan_budget", "limits", "disturbance", "trajectories"});
  Campaign campaign;
  campaign.file = file;
  campaign.name = top.get("name", "the campaign's name").name();
  if (const auto description = top.find("description")) campaign.description = description->text();
  if (const auto repetitions = top.find("repetitions")) {
    campaign.repetitions = repetitions->whole_number(1, kMostRuns);
  }
  if (const auto seed = top.find("seed")) {
    campaign.seed =
        static_cast<std::uint64_t>(seed->whole_number(0, std::numeric_limits<int>::max()));
  }
  if (const auto budget = top.find("plan_budget")) {
    campaign.settings.plan_budget_s = number_in(*budget, kLeastBudget, kMostSeconds, "s");
  }
  if (const auto limits = top.find("limits")) read_limits(*limits, campaign.limits);
  if (const auto disturbance = top.find("disturbance")) {
    read_disturbance(*disturbance, campaign.settings.disturbance);
  }
  if (const auto kept = top.find("trajectories")) campaign.trajectories = read_trajectories(*kept);
  campaign.methods = read_methods(top.get("methods", "a list of methods"), known);
  NamedScenarios named =
      read_scenarios(top.get("scenarios", "a list of scenarios"), file.parent_path());
  campaign.scenarios = std::move(named.files);
  campaign.generated = std::move(named.generated);
  expect_few_runs(top, campaign);
  return campaign;
}

}  // namespace bqsa::harness
