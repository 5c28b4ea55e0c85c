#include "harness/report/run_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/results/summary.hpp"

namespace bqsa::harness::report {
namespace {

/// Truth or number, null for nothing.
Json value_of(const Figure& figure) {
  struct Value {
    Json operator()(std::monostate) const { return {}; }
    Json operator()(bool truth) const { return truth; }
    Json operator()(std::int64_t whole) const { return whole; }
    Json operator()(double number) const { return number_or_null(number); }
  };
  return std::visit(Value{}, figure);
}

Json contacts_json(const std::vector<ExportedContact>& contacts) {
  Json list = Json::array();
  for (const ExportedContact& contact : contacts) {
    list.push_back({{"link", contact.link},
                    {"obstacle", contact.obstacle},
                    {"first_tick", contact.first_tick},
                    {"at_tick", contact.at_tick},
                    {"ticks", contact.ticks}});
  }
  return list;
}

Json self_contacts_json(const std::vector<ExportedSelfContact>& contacts) {
  Json list = Json::array();
  for (const ExportedSelfContact& contact : contacts) {
    list.push_back({{"link", contact.link},
                    {"other_link", contact.other_link},
                    {"first_tick", contact.first_tick},
                    {"at_tick", contact.at_tick},
                    {"ticks", contact.ticks}});
  }
  return list;
}

Json clamps_json(const std::vector<ExportedClamp>& clamps) {
  Json list = Json::array();
  for (const ExportedClamp& clamp : clamps) {
    list.push_back({{"link", clamp.link}, {"obstacle", clamp.obstacle}, {"ticks", clamp.ticks}});
  }
  return list;
}

Json counters_json(const ExportedRun& run) {
  if (run.counters.empty()) return {};
  Json counters = Json::object();
  for (const auto& [name, count] : run.counters) counters[name] = count;
  return counters;
}

/// Of methods that plan and runs that were disturbed: others do the same with any seed.
Json seed_json(const IndexedRun& run) {
  const TableRow& row = run.row();
  if (!row.seed.empty()) return row.seed;
  const bool disturbed = !row.disturbance.empty() && run.run != nullptr && !run.run->seed.empty();
  return disturbed ? Json(run.run->seed) : Json();
}

/// Keys of the schema and the columns of run_columns() that they are.
constexpr std::pair<const char*, const char*> kFigures[] = {
    {"tip_error_mean_m", "tip_error_at_ticks_mean_m"},
    {"tip_error_rms_m", "tip_error_at_ticks_rms_m"},
    {"tip_error_max_m", "tip_error_at_ticks_max_m"},
    {"tip_error_max_tick", "tip_error_at_ticks_max_tick"},
    {"tip_error_between_max_m", "tip_error_between_ticks_max_m"},
    {"orientation_max_rad", "orientation_at_ticks_max_rad"},
    {"orientation_max_tick", "orientation_at_ticks_max_tick"},
    {"orientation_between_max_rad", "orientation_between_ticks_max_rad"},
    {"start_error_m", "start_error_m"},
    {"clearance_m", "clearance_m"},
    {"clearance_at_ticks_m", "clearance_at_ticks_m"},
    {"self_clearance_at_ticks_m", "self_clearance_at_ticks_m"},
    {"max_joint_step_rad", "max_joint_step_rad"},
    {"max_joint_step_tick", "max_joint_step_tick"},
    {"max_joint_slide_m", "max_joint_slide_m"},
    {"max_joint_slide_tick", "max_joint_slide_tick"},
    {"closed_path_drift_rad", "closed_path_drift_rad"},
    {"closed_path_drift_joint_rad", "closed_path_drift_joint_rad"},
    {"manipulability_min", "manipulability_min"},
    {"manipulability_mean", "manipulability_mean"},
    {"singular_value_min_m", "singular_value_min_m"},
    {"null_space_share", "null_space_share"},
    {"jerk_rms_rad_s3", "jerk_rms_rad_s3"},
    {"clamp_starts", "clamp_starts"},
    {"step_median_s", "warm_median_s"},
    {"step_p99_s", "warm_p99_s"},
    {"step_p999_s", "warm_p999_s"},
    {"step_max_s", "warm_max_s"},
    {"step_max_tick", "warm_max_tick"},
    {"plan_s", "plan_s"},
    {"run_s", "time"},
};

std::set<std::string> changed_names(const std::string& changed) {
  std::set<std::string> names;
  for (std::size_t begin = 0; begin < changed.size();) {
    const std::size_t end = std::min(changed.find(',', begin), changed.size());
    const std::string entry = changed.substr(begin, end - begin);
    names.insert(entry.substr(0, entry.find('=')));
    begin = end + 1;
  }
  return names;
}

Json parameters_json(const ExportedMethod& method, const MethodEntry* entry) {
  const std::set<std::string> changed = changed_names(method.changed);
  Json list = Json::array();
  for (const ExportedParameter& parameter : method.parameters) {
    std::string unit, meaning;
    if (entry != nullptr) {
      for (const ParameterDeclaration& declared : entry->parameters) {
        if (declared.name != parameter.name) continue;
        unit = declared.unit;
        meaning = declared.meaning;
      }
    }
    list.push_back({{"name", parameter.name},
                    {"value", cell_text(parameter.value)},
                    {"unit", unit},
                    {"meaning", meaning},
                    {"changed", changed.contains(parameter.name)}});
  }
  return list;
}

std::string cell_words(const Cell& cell) {
  const bool* const truth = std::get_if<bool>(&cell);
  return truth == nullptr ? cell_text(cell) : *truth ? "yes" : "no";
}

/// A `Geometry` of the schema; null without solids.
Json geometry_json(const ExportedScenario& scenario) {
  if (scenario.solids.empty()) return nullptr;
  Json solids = Json::array();
  for (const ExportedSolid& solid : scenario.solids) {
    solids.push_back({{"name", solid.name},
                      {"kind", solid.kind},
                      {"parts", solid.parts},
                      {"ellipsoids", solid.ellipsoids},
                      {"inflation_m", solid.inflation_m},
                      {"volume_ratio", number_or_null(solid.volume_ratio)},
                      {"within_bounds", solid.within_bounds},
                      {"hull_over_mesh", number_or_null(solid.hull_over_mesh)}});
  }
  return {{"solids", std::move(solids)},
          {"gap_lost_m", scenario.gap_lost_m},
          {"radius_excess_m", scenario.radius_excess_m}};
}

}  // namespace

Json run_json(const IndexedRun& indexed, const ReplayPlace& replay) {
  const TableRow& row = indexed.row();
  const ExportedRun* const run = indexed.run;
  Json json = {
      {"scenario", indexed.scenario},
      {"method", indexed.method},
      {"repetition", row.repetition > 0 ? Json(row.repetition) : Json()},
      {"seed", seed_json(indexed)},
      {"applicable", row.applicable},
      {"why_not", row.applicable ? "" : row.claim_detail},
      {"success", row.success},
      {"claimed", row.claim},
      {"claim_detail", row.applicable ? row.claim_detail : ""},
      {"claim_holds", row.claim_holds},
      {"failures", row.failures},
      {"touching", row.touching},
      {"disagreement", row.disagreement},
      {"contacts", run != nullptr ? contacts_json(run->contacts) : Json::array()},
      {"self_contacts", run != nullptr ? self_contacts_json(run->self_contacts) : Json::array()},
      {"clamped", run != nullptr ? clamps_json(run->clamped) : Json::array()},
      {"gave_up", row.gave_up},
      {"rows", row.applicable ? Json(row.rows) : Json()},
      {"failure_tick", row.failure_tick >= 0 ? Json(row.failure_tick) : Json()}};
  for (const auto& [key, column] : kFigures) {
    json[key] = run != nullptr ? value_of(run->figure(column)) : Json();
  }
  json["times_indicative"] = row.against_times;
  json["includes_pipe"] = row.includes_pipe;
  json["counters"] = run != nullptr ? counters_json(*run) : Json();
  json["origin"] = indexed.origin;
  json["date"] = run != nullptr ? run->date : indexed.misfit->date;
  json["load_average"] = run != nullptr ? number_or_null(run->load_average) : Json();
  json["record"] = run != nullptr ? run->record : indexed.misfit->record;
  json["replay"] = replay.index ? Json(*replay.index) : Json();
  json["no_replay"] = replay.missing;
  return json;
}

Json method_json(const ExportedMethod& method, std::size_t index,
                 const std::vector<IndexedRun>& runs, const std::vector<MethodEntry>& known) {
  const auto entry = std::find_if(known.begin(), known.end(),
                                  [&](const MethodEntry& one) { return one.name == method.name; });
  const bool is_known = entry != known.end();
  bool plans = is_known && entry->capabilities.plans;
  bool external = is_known && !entry->external.empty();
  for (const IndexedRun& run : runs) {
    if (run.method != index) continue;
    plans = plans || !run.row().seed.empty();
    external = external || run.row().includes_pipe;
  }
  return {{"name", method.name},
          {"variant", method.variant},
          {"changed", method.changed},
          {"description", is_known ? entry->summary : ""},
          {"parameters", parameters_json(method, is_known ? &*entry : nullptr)},
          {"plans", plans},
          {"external", external}};
}

Json scenario_json(const ExportedScenario& scenario, const std::string& description, Json scene,
                   const std::string& scene_missing) {
  const std::string family = family_of(scenario.name);
  return {{"name", scenario.name},
          {"file", scenario.file},
          {"sha256", scenario.sha256},
          {"family", family == scenario.name ? "" : family},
          {"robot", scenario.robot},
          {"description", description},
          {"dimension", scenario.dimension},
          {"joints", scenario.joints},
          {"links", scenario.links},
          {"obstacles", scenario.obstacles},
          {"nk", scenario.nk},
          {"ticks", scenario.ticks},
          {"dt_s", scenario.dt_s},
          {"tolerance_m", scenario.tolerance_m},
          {"margin_m", scenario.margin_m},
          {"link_radius_m", scenario.link_radius_m},
          {"geometry", geometry_json(scenario)},
          {"scene", std::move(scene)},
          {"scene_missing", scene_missing}};
}

Json origin_json(const Origin& origin) {
  Json values = Json::array();
  const std::span<const char* const> columns = Origin::columns();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string text = cell_words(origin.values[i]);
    if (!text.empty()) values.push_back({columns[i], text});
  }
  constexpr std::size_t kCommitDigits = 10;
  return {{"label", fmt::format("bqsa-bench {} (commit {}), {}, {}", origin.text("version"),
                                origin.text("source_commit").substr(0, kCommitDigits),
                                origin.text("compiler"), origin.text("processor"))},
          {"values", std::move(values)}};
}

}  // namespace bqsa::harness::report
