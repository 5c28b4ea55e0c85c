#include "harness/exchange/runs_csv.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string_view>

#include "harness/results/summary.hpp"

namespace bqsa::harness {
namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

std::string line_of(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    line += quoted(fields[i]);
  }
  return line + "\r\n";
}

std::string name_of(const RunColumn& column) {
  const bool is_first = &column == run_columns().data();
  return is_first ? "run_s" : column.name;
}

/// Names instead of the numbers that databases have.
std::string figure_text(const RunColumn& column, const Figure& figure) {
  const bool named = column.source == FigureSource::kEnum || column.source == FigureSource::kStatus;
  const auto* index = std::get_if<std::int64_t>(&figure);
  return named && index != nullptr ? values_of(column)[static_cast<std::size_t>(*index)]
                                   : cell_text(cell_of(figure));
}

/// Those of any method, by name.
std::set<std::string> parameter_names(const ExportedRuns& runs) {
  std::set<std::string> names;
  for (const ExportedExperiment& experiment : runs.experiments) {
    for (const ExportedConfiguration& configuration : experiment.configurations) {
      for (const auto& parameter : configuration.method.parameters) names.insert(parameter.name);
    }
  }
  return names;
}

std::vector<std::string> header(const std::set<std::string>& parameters) {
  std::vector<std::string> names{"scenario",
                                 "scenario_sha256",
                                 "scenario_file",
                                 "family",
                                 "robot",
                                 "dimension",
                                 "joints",
                                 "links",
                                 "obstacles",
                                 "nk",
                                 "control_ticks",
                                 "dt_s",
                                 "tolerance_m",
                                 "margin_m",
                                 "link_radius_m",
                                 "link_radii_m",
                                 "orientation",
                                 "orientation_tolerance_rad",
                                 "reference_clearance_m",
                                 "solids",
                                 "gap_lost_m",
                                 "radius_excess_m",
                                 "method",
                                 "variant",
                                 "changed_parameters",
                                 "campaign",
                                 "campaign_key"};
  for (const RunColumn& column : run_columns()) {
    names.push_back(name_of(column));
  }
  names.insert(names.end(), {"all_failures", "claim_obstacle", "claim_message", "disagreement",
                             "trajectory", "date", "load_average", "restarts", "times_against"});
  for (const char* column : Origin::columns()) names.emplace_back(column);
  names.emplace_back("record");
  for (const std::string& parameter : parameters) names.push_back("parameter." + parameter);
  return names;
}

/// Nothing if it is not a number.
std::string number_text(double number) {
  return std::isfinite(number) ? fmt::format("{}", number) : "";
}

std::vector<std::string> scenario_fields(const ExportedScenario& scenario) {
  return {scenario.name,
          scenario.sha256,
          scenario.file,
          family_of(scenario.name),
          scenario.robot,
          fmt::format("{}", scenario.dimension),
          fmt::format("{}", scenario.joints),
          fmt::format("{}", scenario.links),
          fmt::format("{}", scenario.obstacles.size()),
          fmt::format("{}", scenario.nk),
          fmt::format("{}", scenario.ticks),
          fmt::format("{}", scenario.dt_s),
          fmt::format("{}", scenario.tolerance_m),
          fmt::format("{}", scenario.margin_m),
          fmt::format("{}", scenario.link_radius_m),
          fmt::format("{}", fmt::join(scenario.link_radii_m, " ")),
          scenario.orientation,
          number_text(scenario.orientation_tolerance_rad),
          number_text(scenario.reference_clearance_m),
          fmt::format("{}", scenario.solids.size()),
          fmt::format("{}", scenario.gap_lost_m),
          fmt::format("{}", scenario.radius_excess_m)};
}

std::string parameter_text(const ExportedMethod& method, const std::string& name) {
  for (const ExportedParameter& parameter : method.parameters) {
    if (parameter.name == name) return cell_text(parameter.value);
  }
  return "";
}

void append_run(const ExportedRun& run, const Origin& origin, std::vector<std::string>& fields) {
  fields.insert(fields.end(), {run.campaign, run.key});
  for (std::size_t i = 0; i < run.figures.size(); ++i) {
    const bool is_seed = std::string_view(run_columns()[i].name) == "seed";
    fields.push_back(is_seed ? run.seed : figure_text(run_columns()[i], run.figures[i]));
  }
  fields.insert(fields.end(), {fmt::format("{}", fmt::join(run.failures, " ")), run.claim_obstacle,
                               run.claim_message, run.disagreement, run.trajectory, run.date,
                               number_text(run.load_average),
                               run.restarts ? fmt::format("{}", *run.restarts) : "",
                               fmt::format("{}", fmt::join(run.against, ", "))});
  for (const Cell& cell : origin.values) fields.push_back(cell_text(cell));
  fields.push_back(run.record);
}

}  // namespace

std::string runs_csv(const ExportedRuns& runs) {
  const std::set<std::string> parameters = parameter_names(runs);
  std::string text = line_of(header(parameters));
  for (const ExportedExperiment& experiment : runs.experiments) {
    for (const ExportedConfiguration& configuration : experiment.configurations) {
      const ExportedMethod& method = configuration.method;
      std::vector<std::string> head = scenario_fields(experiment.scenario);
      head.insert(head.end(), {method.name, method.variant, method.changed});
      std::vector<std::string> values;
      values.reserve(parameters.size());
      for (const std::string& name : parameters) values.push_back(parameter_text(method, name));
      for (const ExportedRun& run : configuration.runs) {
        std::vector<std::string> fields = head;
        append_run(run, runs.origins[run.origin], fields);
        fields.insert(fields.end(), values.begin(), values.end());
        text += line_of(fields);
      }
    }
  }
  return text;
}

}  // namespace bqsa::harness
