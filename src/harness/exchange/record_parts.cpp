#include "harness/exchange/record_parts.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace bqsa::harness {
namespace {

std::vector<std::string> texts(const RecordValue& list) {
  std::vector<std::string> all;
  for (const RecordValue& value : list.list()) all.push_back(value.text());
  return all;
}

std::string optional_text(const RecordValue& object, const char* key) {
  return object.has(key) && !object[key].is_null() ? object[key].text() : "";
}

double optional_number(const RecordValue& object, const char* key) {
  return object.has(key) ? object[key].number() : std::numeric_limits<double>::quiet_NaN();
}

double finite(const RecordValue& value) {
  const double number = value.number();
  if (!std::isfinite(number)) value.refuse("expected a number");
  return number;
}

void read_geometry(const RecordValue& geometry, ExportedScenario& scenario) {
  for (const RecordValue& solid : geometry["solids"].list()) {
    scenario.solids.push_back({.name = solid["name"].text(),
                               .kind = solid["kind"].text(),
                               .parts = solid["parts"].integer(),
                               .ellipsoids = solid["ellipsoids"].integer(),
                               .inflation_m = finite(solid["inflation_m"]),
                               .volume_ratio = solid["volume_ratio"].number(),
                               .within_bounds = solid["within_bounds"].boolean(),
                               .hull_over_mesh = solid["hull_over_mesh"].number()});
  }
  scenario.gap_lost_m = finite(geometry["gap_lost_m"]);
  scenario.radius_excess_m = finite(geometry["radius_excess_m"]);
}

std::vector<ExportedSelfContact> read_self_contacts(const RecordValue& judged) {
  std::vector<ExportedSelfContact> contacts;
  if (!judged.has("self_collision") || judged["self_collision"].is_null()) return contacts;
  for (const RecordValue& contact : judged["self_collision"]["contacts"].list()) {
    contacts.push_back({.link = contact["link"].integer(),
                        .other_link = contact["other_link"].integer(),
                        .first_tick = contact["first_tick"].integer(),
                        .at_tick = contact["at_tick"].boolean(),
                        .ticks = contact["ticks"].integer()});
  }
  return contacts;
}

std::vector<ExportedContact> read_contacts(const RecordValue& list) {
  std::vector<ExportedContact> contacts;
  for (const RecordValue& contact : list.list()) {
    contacts.push_back({.link = contact["link"].integer(),
                        .obstacle = optional_text(contact, "obstacle"),
                        .first_tick = contact["first_tick"].integer(),
                        .at_tick = contact["at_tick"].boolean(),
                        .ticks = contact["ticks"].integer()});
  }
  return contacts;
}

std::vector<ExportedClamp> read_clamps(const RecordValue& list) {
  std::vector<ExportedClamp> clamps;
  for (const RecordValue& clamp : list.list()) {
    clamps.push_back({.link = clamp["link"].integer(),
                      .obstacle = optional_text(clamp, "obstacle"),
                      .ticks = clamp["ticks"].integer()});
  }
  return clamps;
}

}  // namespace

ExportedScenario read_scenario(const RecordValue& record) {
  const RecordValue problem = record["problem"];
  ExportedScenario scenario{
      .name = record["scenario"]["name"].text(),
      .sha256 = record["scenario"]["sha256"].text(),
      .file = record["scenario"]["file"].text(),
      .dimension = problem["dimension"].integer(),
      .joints = problem["joints"].integer(),
      .links = problem["links"].integer(),
      .obstacles = texts(problem["obstacles"]),
      .nk = problem["nk"].integer(),
      .ticks = problem["ticks"].integer(),
      .dt_s = finite(problem["dt_s"]),
      .tolerance_m = finite(problem["tolerance_m"]),
      .margin_m = finite(problem["margin_m"]),
      .link_radius_m = finite(problem["link_radius_m"]),
      .robot = optional_text(problem, "robot"),
      .orientation = optional_text(problem, "orientation"),
      .orientation_tolerance_rad = optional_number(problem, "orientation_tolerance_rad"),
      .reference_clearance_m = optional_number(record["scenario"], "reference_clearance_m")};
  if (problem.has("link_radii_m")) {
    for (const RecordValue& radius : problem["link_radii_m"].list()) {
      scenario.link_radii_m.push_back(finite(radius));
    }
  }
  if (problem.has("geometry") && !problem["geometry"].is_null()) {  // old records lack it
    read_geometry(problem["geometry"], scenario);
  }
  return scenario;
}

ExportedMethod read_method(const RecordValue& method, const nlohmann::json& json) {
  ExportedMethod read{.name = method["name"].text(),
                      .variant = method["variant"].text(),
                      .changed = method["changed"].text(),
                      .parameters = {}};
  for (const auto& [name, value] : method["parameters"].members()) {
    read.parameters.push_back({name, {}});
  }
  std::size_t i = 0;
  for (const auto& value : json["parameters"]) {
    read.parameters[i++].value = scalar_cell(value);
  }
  return read;
}

ExportedRun read_run(const RecordValue& record, const TableRow& row) {
  const RecordValue provenance = record["provenance"];
  ExportedRun run;
  run.row = row;
  run.figures = read_figures(record, row);
  if (record.has("counters")) {
    for (const auto& [name, value] : record["counters"].members()) {
      run.counters.emplace_back(name, value.whole());
    }
  }
  run.failures = row.failures;
  run.contacts = read_contacts(record["judged"]["contacts"]);
  run.self_contacts = read_self_contacts(record["judged"]);
  run.clamped = read_clamps(record["ticks"]["clamped_pairs"]);
  run.claim_obstacle = optional_text(record["claimed"], "obstacle");
  run.claim_message = optional_text(record["claimed"], "message");
  run.disagreement = row.disagreement;
  run.trajectory = optional_text(record, "trajectory");
  run.seed = provenance.has("seed") ? std::to_string(provenance["seed"].whole()) : "";
  run.date = provenance["date"].text();
  run.load_average = optional_number(provenance, "load_average");
  if (provenance.has("restarts")) run.restarts = provenance["restarts"].integer();
  run.against = texts(record["times"]["against"]);
  run.total_s = std::isfinite(row.run_s) ? row.run_s : 0;
  return run;
}

}  // namespace bqsa::harness
