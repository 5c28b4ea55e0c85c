#include "harness/campaign/plan.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <sstream>
#include <system_error>

#include "harness/campaign/generated_scenarios.hpp"
#include "harness/external/command_words.hpp"
#include "harness/results/provenance.hpp"
#include "harness/sha256.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kSeedDigits = 8;
constexpr std::size_t kKeyDigits = 32;
constexpr std::size_t kMaxProgramBytes = std::size_t{1} << 32;

std::string hash_of_file(const fs::path& file) {
  return sha256_of(read_text_file(file, kMaxProgramBytes));
}

/// `key=value,...` of all parameters.
std::string all_parameters(const MethodSpec& method) {
  std::string text;
  for (const auto& [name, value] : method.parameters.as_text()) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ",", name, value);
  }
  return text;
}

bool is_file(const fs::path& path) {
  std::error_code unknown;
  return fs::is_regular_file(path, unknown);
}

/// The file that a shell would start; empty if there is none.
fs::path program_named(const std::string& word) {
  if (word.find('/') != std::string::npos) return is_file(word) ? fs::path(word) : fs::path();
  const char* const path = std::getenv("PATH");
  std::istringstream directories(path == nullptr ? "" : path);
  for (std::string directory; std::getline(directories, directory, ':');) {
    fs::path file = fs::path(directory) / word;
    if (is_file(file)) return file;
  }
  return {};
}

void expect_different_names(const std::vector<PlannedScenario>& scenarios) {
  std::map<std::string, const PlannedScenario*> by_name;
  for (const PlannedScenario& scenario : scenarios) {
    const auto [other, first] = by_name.try_emplace(scenario.name, &scenario);
    if (first) continue;
    throw InputError(fmt::format("{} and {}: expected scenarios of different names, both are '{}'",
                                 other->second->file.string(), scenario.file.string(),
                                 scenario.name));
  }
}

std::vector<PlannedScenario> planned_scenarios(const Campaign& campaign, const fs::path& directory,
                                               const PlanOptions& options) {
  std::size_t all = campaign.scenarios.size();
  for (const GeneratedScenarios& wanted : campaign.generated) {
    all += static_cast<std::size_t>(wanted.count);
  }
  std::size_t done = 0;
  const auto count = [&] {
    ++done;
    if (options.progress) options.progress(done, all);
  };
  std::vector<PlannedScenario> scenarios;
  scenarios.reserve(all);
  for (const fs::path& file : campaign.scenarios) {
    const Scenario scenario = load_scenario(file, options.load);
    scenarios.push_back({file, scenario.problem.name, scenario.sha256});
    count();
  }
  for (const GeneratedScenarios& wanted : campaign.generated) {
    const std::vector<PlannedScenario> generated =
        generate_scenarios(wanted, directory / "scenarios", count);
    scenarios.insert(scenarios.end(), generated.begin(), generated.end());
  }
  expect_different_names(scenarios);
  return scenarios;
}

}  // namespace

std::uint64_t run_seed(std::uint64_t campaign_seed, const PlannedScenario& scenario,
                       const MethodSpec& method, int repetition) {
  std::string text =
      fmt::format("bqsa-seed/1\n{}\n{}\n{}\n", campaign_seed, scenario.sha256, repetition);
  if (method.entry.capabilities.plans) {
    text += fmt::format("{}\n{}\n", method.entry.name, all_parameters(method));
  }
  return std::stoull(sha256_of(text).substr(0, kSeedDigits), nullptr, 16);
}

std::string program_identity(const std::vector<std::string>& out_of_tree) {
  const BuildInfo& build = build_info();
  std::string text = fmt::format(
      "version {}\ncommit {}\nbuild {}\nflags {}\nassertions {}\nsanitizers {}\ncompiler {}\n",
      build.version, build.commit, build.build_type, build.flags, build.assertions,
      build.sanitizers, build.compiler);
  for (const auto& [name, version] : build.libraries) {
    text += fmt::format("library {} {}\n", name, version);
  }
  const bool commit_says_it = !build.dirty && build.commit != kUnknownCommit && out_of_tree.empty();
  if (!commit_says_it) text += fmt::format("sha256 {}\n", hash_of_file("/proc/self/exe"));
  return text;
}

std::string method_identity(const MethodSpec& method) {
  std::string text =
      fmt::format("method {}\nparameters {}\n", method.entry.name, all_parameters(method));
  if (method.entry.external.empty()) return text;
  text += fmt::format("command {}\n", method.entry.external);
  const std::vector<std::string> words = command_words(method.entry.external);
  const fs::path program = program_named(words.front());
  if (!program.empty()) text += fmt::format("program {}\n", hash_of_file(program));
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (is_file(words[i])) text += fmt::format("file {} {}\n", i, hash_of_file(words[i]));
  }
  return text;
}

std::string run_key(const PlannedScenario& scenario, const std::string& method, int repetition,
                    std::uint64_t seed, const RunSettings& settings, const RunLimits& limits,
                    const std::string& program) {
  return sha256_of(fmt::format("bqsa-key/1\nscenario {}\n{}repetition {}\nseed {}\nnoise {} rad\n"
                               "latency {}\nbudget {} s\nwall {} s\nmemory {}\n{}",
                               scenario.sha256, method, repetition, seed,
                               settings.disturbance.joint_noise, settings.disturbance.latency_ticks,
                               settings.plan_budget_s, limits.wall_s, limits.memory_bytes, program))
      .substr(0, kKeyDigits);
}

Plan make_plan(const Campaign& campaign, const fs::path& directory, const PlanOptions& options) {
  Plan plan{.campaign = campaign.name,
            .scenarios = planned_scenarios(campaign, directory, options),
            .methods = campaign.methods,
            .identities = {},
            .runs = {},
            .settings = campaign.settings,
            .limits = campaign.limits,
            .trajectories = campaign.trajectories};
  const std::string program = program_identity(options.out_of_tree);
  for (const MethodSpec& method : plan.methods) plan.identities.push_back(method_identity(method));

  plan.runs.reserve(plan.scenarios.size() * plan.methods.size() *
                    static_cast<std::size_t>(campaign.repetitions));
  for (std::size_t s = 0; s < plan.scenarios.size(); ++s) {
    const PlannedScenario& scenario = plan.scenarios[s];
    for (std::size_t m = 0; m < plan.methods.size(); ++m) {
      for (int repetition = 1; repetition <= campaign.repetitions; ++repetition) {
        const std::uint64_t seed = run_seed(campaign.seed, scenario, plan.methods[m], repetition);
        plan.runs.push_back({s, m, repetition, seed,
                             run_key(scenario, plan.identities[m], repetition, seed, plan.settings,
                                     plan.limits, program)});
      }
    }
  }
  return plan;
}

}  // namespace bqsa::harness
