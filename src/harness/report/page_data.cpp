#include "harness/report/page_data.hpp"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <system_error>

#include "harness/campaign/plan_file.hpp"
#include "harness/methods.hpp"
#include "harness/report/judged_claims.hpp"
#include "harness/report/measured_times.hpp"
#include "harness/report/method_summary.hpp"
#include "harness/report/paper_figures.hpp"
#include "harness/report/run_index.hpp"
#include "harness/report/warnings.hpp"
#include "harness/results/provenance.hpp"
#include "harness/results/record_value.hpp"
#include "harness/results/table.hpp"

namespace bqsa::harness::report {
namespace fs = std::filesystem;
namespace {

constexpr const char* kSchema = "bqsa-report/1";
constexpr std::size_t kMostBadLines = 100;

/// What the plan says of a directory of a campaign.
struct Planned {
  std::optional<std::vector<std::string>> keys = {};
  std::string campaign = {};

  int count() const { return keys ? static_cast<int>(keys->size()) : 0; }
};

Planned planned_runs(const fs::path& directory) {
  Planned planned;
  if (!has_plan(directory)) return planned;
  const ListedPlan plan = read_plan(directory);
  planned.campaign = plan.campaign;
  planned.keys.emplace();
  for (const ListedRun& run : plan.runs) planned.keys->push_back(run.key);
  return planned;
}

std::string name_of_directory(const fs::path& directory) {
  std::error_code none;
  const fs::path whole = fs::weakly_canonical(directory, none);
  return printable((whole.empty() ? directory : whole).filename().string());
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

Json bad_lines_json(const std::vector<std::string>& lines) {
  Json list = Json::array();
  for (const std::string& line : lines) {
    if (list.size() == kMostBadLines) {
      list.push_back(fmt::format("and {} more", lines.size() - kMostBadLines));
      break;
    }
    list.push_back(printable(line));
  }
  return list;
}

Json source_json(const fs::path& directory, const ExportedRuns& runs, const Planned& planned) {
  return {{"directory", printable(directory.string())},
          {"campaign", planned.keys ? Json(printable(planned.campaign)) : Json()},
          {"planned", planned.keys ? Json(planned.count()) : Json()},
          {"runs", runs.runs},
          {"not_applicable", runs.not_applicable},
          {"superseded", runs.superseded},
          {"stale", runs.stale},
          {"bad_lines", bad_lines_json(runs.bad_lines)}};
}

Json scenarios_json(const RunIndex& index, std::vector<PageScene>& scenes) {
  Json list = Json::array();
  for (std::size_t i = 0; i < index.scenarios.size(); ++i) {
    list.push_back(scenario_json(index.scenarios[i], scenes[i].description,
                                 std::move(scenes[i].scene), scenes[i].missing));
  }
  return list;
}

Json methods_json(const RunIndex& index, const std::vector<MethodEntry>& known) {
  Json list = Json::array();
  for (std::size_t i = 0; i < index.methods.size(); ++i) {
    list.push_back(method_json(index.methods[i], i, index.runs, known));
  }
  return list;
}

/// What `read` makes of a file: of the one that was named, or of the usual one if it is there. The latter
/// may be unusable, which becomes a problem.
template <typename Read>
Json beside(const fs::path& named, const fs::path& usual, Read read,
            std::vector<std::string>& problems) {
  if (!named.empty()) return read(named);
  std::error_code none;
  if (!fs::exists(usual, none)) return {};
  try {
    return read(usual);
  } catch (const InputError& error) {
    problems.emplace_back(error.what());
    return {};
  }
}

/// Measurements, claims and figures.
void add_what_lies_beside(const PageSources& sources, Json& json,
                          std::vector<std::string>& problems) {
  const fs::path& directory = sources.directory;
  json["measurements"] = beside(
      sources.measurements, directory / "measurements.json",
      [](const fs::path& file) {
        return measurements_json(read_measurements(file), file.string());
      },
      problems);
  json["claims"] =
      beside(sources.claims, directory / "claims" / "claims.json", claims_json, problems);
  const auto read_figures = [&](const fs::path& index) {
    return figures_json(index.parent_path(), sources.page);
  };
  json["figures"] = beside(sources.figures.empty() ? fs::path() : sources.figures / kFiguresIndex,
                           directory / "figures" / kFiguresIndex, read_figures, problems);
  if (json["figures"].is_null()) json["figures"] = Json::array();
}

}  // namespace

PageData page_data(const PageSources& sources, const std::vector<MethodEntry>& known) {
  const Planned planned = planned_runs(sources.directory);
  const ExportedRuns runs = read_exported_runs(sources.directory, planned.keys);
  if (runs.runs + runs.not_applicable == 0) {
    throw InputError(fmt::format("{}: expected records of runs, got none{}",
                                 sources.directory.string(),
                                 runs.bad_lines.empty() ? "" : "; " + runs.bad_lines.front()));
  }
  const RunIndex index = index_runs(runs, known);
  std::vector<fs::path> roots{sources.directory};
  roots.insert(roots.end(), sources.scenarios.begin(), sources.scenarios.end());
  ScenesAndReplays bulk = scenes_and_replays(
      index, sources.directory, ScenarioFinder(std::move(roots), sources.load), sources.limits);

  PageData page;
  page.problems = runs.bad_lines;
  std::vector<std::string> warned = warnings(runs, index, planned.count());
  Json run_list = Json::array();
  for (std::size_t i = 0; i < index.runs.size(); ++i) {
    run_list.push_back(run_json(index.runs[i], bulk.places[i]));
  }
  Json origins = Json::array();
  for (const Origin& origin : index.origins) origins.push_back(origin_json(origin));

  page.json = {
      {"schema", kSchema},
      {"title", planned.keys ? printable(planned.campaign) : name_of_directory(sources.directory)},
      {"program", "bqsa-bench " + version_text(names_out_of_tree(known))},
      {"date", machine_state().date},
      {"source", source_json(sources.directory, runs, planned)},
      {"success_means", lines_of(success_legend())},
      {"scenarios", scenarios_json(index, bulk.scenes)},
      {"methods", methods_json(index, known)},
      {"runs", std::move(run_list)},
      {"replays", std::move(bulk.replays)},
      {"origins", std::move(origins)},
      {"summary", summary_json(index.runs, index.methods.size())}};
  std::vector<std::string> unusable;
  add_what_lies_beside(sources, page.json, unusable);
  for (const std::string& problem : unusable) warned.push_back("left out: " + printable(problem));
  page.problems.insert(page.problems.end(), unusable.begin(), unusable.end());
  if (!page.json["measurements"].is_null() && page.json["measurements"]["publishable"] == false) {
    warned.emplace_back("the measurements are not publishable (see Provenance)");
  }
  page.json["warnings"] = std::move(warned);
  return page;
}

}  // namespace bqsa::harness::report
