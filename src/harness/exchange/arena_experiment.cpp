#include "harness/exchange/arena_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/results/summary.hpp"

namespace bqsa::harness {
namespace {

/// White space beyond ASCII, in UTF-8; control characters are none of a record's texts.
constexpr std::array<std::string_view, 17> kWideSpaces{
    "\u00a0", "\u1680", "\u2000", "\u2001", "\u2002", "\u2003", "\u2004", "\u2005", "\u2006",
    "\u2007", "\u2008", "\u2009", "\u200a", "\u2028", "\u2029", "\u202f", "\u205f"};
constexpr std::string_view kIdeographicSpace = "\u3000";

/// Length of the white space at the beginning of a text [bytes]; 0 if there is none.
std::size_t space_at(std::string_view text) {
  if (text.front() == ' ') return 1;
  if (text.starts_with(kIdeographicSpace)) return kIdeographicSpace.size();
  const auto* found = std::find_if(kWideSpaces.begin(), kWideSpaces.end(),
                                   [text](std::string_view s) { return text.starts_with(s); });
  return found == kWideSpaces.end() ? 0 : found->size();
}

/// What all runs have in common.
class Common {
 public:
  void add(const std::string& text) {
    if (first_) text_ = text;
    if (text != text_) text_ = "several";
    first_ = false;
  }
  const std::string& text() const { return text_; }

 private:
  bool first_ = true;
  std::string text_;
};

void describe_runs(const ExportedExperiment& experiment, const std::vector<Origin>& origins,
                   ArenaExperiment& arena) {
  constexpr double kMebibyte = 1 << 20;
  Common version;
  Common host;
  Common seed;
  Common processor;
  for (const ExportedConfiguration& configuration : experiment.configurations) {
    arena.runs_per_planner =
        std::max(arena.runs_per_planner, static_cast<int>(configuration.runs.size()));
    for (const ExportedRun& run : configuration.runs) {
      const Origin& origin = origins[run.origin];
      version.add(one_word(origin.text("version")));
      host.add(one_word(origin.text("host")));
      seed.add(one_word(run.seed));
      processor.add(fmt::format("processor: {}\ncores: {}\ngovernor: {}\n",
                                origin.text("processor"), origin.number("cores"),
                                origin.text("governor")));
      arena.total_s += run.total_s;
      arena.time_limit_s = std::max(arena.time_limit_s, origin.number("wall_limit_s"));
      arena.memory_limit_mb =
          std::max(arena.memory_limit_mb, origin.number("memory_limit_bytes") / kMebibyte);
      const std::string date = one_word(run.date);
      if (arena.date.empty() || date < arena.date) arena.date = date;
    }
  }
  arena.version = version.text();
  arena.host = host.text();
  arena.seed = seed.text();
  arena.processor = processor.text();
  if (arena.processor == "several") arena.processor += '\n';
}

/// By name, as the reader of logs adds the columns. One that the scenario lacks is left out, since a log has no
/// word for nothing.
std::vector<ExperimentProperty> properties_of(const ExportedScenario& scenario) {
  const auto whole = [](auto number) { return Cell(static_cast<std::int64_t>(number)); };
  const auto word = [](const std::string& text) {
    return text.empty() ? Cell() : Cell(one_word(text));
  };
  const auto real = [](double number) { return std::isfinite(number) ? Cell(number) : Cell(); };
  const std::string radii = fmt::format("{}", fmt::join(scenario.link_radii_m, " "));
  std::vector<ExperimentProperty> properties = {
      {"control_ticks", "INTEGER", whole(scenario.ticks)},
      {"dimension", "INTEGER", whole(scenario.dimension)},
      {"dt_s", "REAL", scenario.dt_s},
      {"gap_lost_m", "REAL", scenario.gap_lost_m},
      {"joints", "INTEGER", whole(scenario.joints)},
      {"link_radii_m", "TEXT", radii.empty() ? Cell() : Cell(radii)},
      {"link_radius_m", "REAL", scenario.link_radius_m},
      {"links", "INTEGER", whole(scenario.links)},
      {"margin_m", "REAL", scenario.margin_m},
      {"nk", "INTEGER", whole(scenario.nk)},
      {"obstacles", "INTEGER", whole(scenario.obstacles.size())},
      {"orientation", "TEXT", word(scenario.orientation)},
      {"orientation_tolerance_rad", "REAL", real(scenario.orientation_tolerance_rad)},
      {"radius_excess_m", "REAL", scenario.radius_excess_m},
      {"reference_clearance_m", "REAL", real(scenario.reference_clearance_m)},
      {"robot", "TEXT", word(scenario.robot)},
      {"scenario", "TEXT", one_word(scenario.name)},
      {"scenario_sha256", "TEXT", one_word(scenario.sha256)},
      {"solids", "INTEGER", whole(scenario.solids.size())},
      {"tolerance_m", "REAL", scenario.tolerance_m}};
  std::erase_if(properties, [](const ExperimentProperty& property) {
    return std::holds_alternative<std::monostate>(property.value);
  });
  return properties;
}

}  // namespace

std::string one_word(std::string_view text) {
  std::string word;
  while (!text.empty()) {
    const std::size_t space = space_at(text);
    word += space > 0 ? '_' : text.front();
    text.remove_prefix(std::max<std::size_t>(space, 1));
  }
  return word.empty() ? "unnamed" : word;
}

ArenaExperiment arena_experiment(const ExportedExperiment& experiment,
                                 const std::vector<Origin>& origins) {
  const ExportedScenario& scenario = experiment.scenario;
  ArenaExperiment arena;
  arena.name = one_word(family_of(scenario.name));
  arena.properties = properties_of(scenario);
  arena.setup = fmt::format("scenario: {}\nfile: {}\nsha256: {}\nobstacles: {}\n", scenario.name,
                            scenario.file, scenario.sha256, fmt::join(scenario.obstacles, ", "));
  describe_runs(experiment, origins, arena);
  return arena;
}

std::string arena_settings(const ExportedMethod& method) {
  std::string text;
  for (const std::string& line : method.settings()) text += line + "\n;";
  return text;
}

}  // namespace bqsa::harness
