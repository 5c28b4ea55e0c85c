#include "harness/results/run_record.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/results/provenance_json.hpp"

namespace bqsa::harness {
namespace {

/// Keeps the order of keys in which they are written here and documented. Numbers that are not
/// finite become null.
using Json = nlohmann::ordered_json;

Json scenario_json(const Scenario& scenario) {
  return {{"name", scenario.problem.name},
          {"file", scenario.file.string()},
          {"sha256", scenario.sha256},
          {"reference_clearance_m",
           scenario.reference_clearance ? Json(*scenario.reference_clearance) : Json()}};
}

/// null if all obstacles are ellipsoids.
Json geometry_json(const GeometryLedger& ledger) {
  if (ledger.solids.empty()) return nullptr;
  Json solids = Json::array();
  for (const LedgerEntry& entry : ledger.solids) {
    solids.push_back(
        {{"name", entry.name},
         {"kind", entry.kind},
         {"parts", entry.parts},
         {"ellipsoids", entry.ellipsoids},
         {"inflation_m", entry.inflation},
         {"volume_ratio", entry.volume_ratio},
         {"within_bounds", entry.within_bounds},
         {"hull_over_mesh", entry.hull_over_mesh ? Json(*entry.hull_over_mesh) : Json()}});
  }
  return {{"solids", solids},
          {"gap_lost_m", ledger.gap_lost},
          {"radius_excess_m", ledger.radius_excess}};
}

Json problem_json(const Scenario& scenario) {
  const Problem& problem = scenario.problem;
  const std::size_t links = problem.chain.links().size();
  Json obstacles = Json::array();
  for (const Obstacle& obstacle : problem.obstacles) obstacles.push_back(obstacle.name);
  Json json{{"robot", scenario.robot_name.empty() ? Json() : Json(scenario.robot_name)},
            {"dimension", problem.dimension()},
            {"joints", problem.chain.joints()},
            {"links", links},
            {"obstacles", obstacles},
            {"nk", links * problem.obstacles.size()},
            {"ticks", problem.ticks},
            {"dt_s", problem.dt},
            {"tolerance_m", problem.tolerance},
            {"margin_m", problem.margin},
            {"link_radius_m", problem.link_radius},
            {"geometry", geometry_json(scenario.geometry)}};
  if (!problem.link_radii.empty()) json["link_radii_m"] = problem.link_radii;
  if (problem.has_orientation()) {
    json["orientation"] = problem.task_kind == TaskKind::kAxis ? "axis" : "pose";
    json["orientation_tolerance_rad"] = problem.orientation_tolerance;
  }
  return json;
}

Json method_json(const MethodSpec& method, const Circumstances& circumstances) {
  Json parameters = Json::object();
  for (const ParameterDeclaration& declared : method.entry.parameters) {
    if (declared.choices.empty()) {
      parameters[declared.name] = method.parameters.number(declared.name);
    } else {
      parameters[declared.name] = method.parameters.choice(declared.name);
    }
  }
  return {{"name", method.entry.name},
          {"variant", variant_name(method, circumstances)},
          {"changed", changed_parameters(method.parameters)},
          {"seed", method.entry.capabilities.plans ? Json(circumstances.settings.seed) : Json()},
          {"parameters", parameters}};
}

/// Name of an obstacle, null for an index that names none.
Json obstacle_json(const Problem& problem, int index) {
  if (index < 0 || index >= static_cast<int>(problem.obstacles.size())) return nullptr;
  return problem.obstacles[static_cast<std::size_t>(index)].name;
}

Json claimed_json(const Problem& problem, const RunOutcome& outcome,
                  const std::optional<Diagnosis>& diagnosis) {
  Json claimed = {{"status", name_of(outcome.claim)}};
  if (outcome.claim == Claim::kInfeasible) {
    claimed["tick"] = outcome.tick;
    claimed["reason"] = name_of(outcome.reason);
    claimed["link"] = outcome.link > 0 ? Json(outcome.link) : Json();
    claimed["obstacle"] = obstacle_json(problem, outcome.obstacle);
    if (diagnosis) {
      claimed["class"] = name_of(diagnosis->failure);
      claimed["nearest_free_rad"] = diagnosis->nearest_free;
    }
  } else if (outcome.claim == Claim::kCrashed || outcome.claim == Claim::kTimedOut ||
             outcome.claim == Claim::kOutOfMemory) {
    claimed["tick"] = outcome.tick;
    claimed["message"] = outcome.message;
  }
  return claimed;
}

/// Pairs of bin and count.
Json histogram_json(const LogHistogram& histogram) {
  Json pairs = Json::array();
  for (const auto& [bin, count] : histogram.counts()) pairs.push_back(Json::array({bin, count}));
  return pairs;
}

Json ticks_json(const Problem& problem, const RunOutcome& outcome) {
  Json pairs = Json::array();
  for (const ClampedPair& pair : outcome.clamped_pairs) {
    pairs.push_back({{"link", pair.link},
                     {"obstacle", obstacle_json(problem, pair.obstacle)},
                     {"ticks", pair.ticks}});
  }
  return {{"free", outcome.free_ticks},
          {"clamped", outcome.clamped_ticks},
          {"unclaimed", outcome.unclaimed_ticks},
          {"clamped_pairs", pairs},
          {"clamp_starts", outcome.clamp_starts},
          {"increments_total", outcome.increments_total},
          {"increments_max", outcome.increments_max},
          {"increments_tick_mean", outcome.increments.mean},
          {"increments_tick_median", outcome.increments.median},
          {"increments_tick_p99", outcome.increments.p99},
          {"increments_tick_max", outcome.increments.max},
          {"increments_tick_histogram", histogram_json(outcome.increments.histogram)},
          {"guard_fired", outcome.guard_fired}};
}

Json tip_error_json(const TipError& error) {
  return {{"mean_m", error.mean},
          {"rms_m", error.rms},
          {"max_m", error.max},
          {"max_x_m", error.max_per_axis.x()},
          {"max_y_m", error.max_per_axis.y()},
          {"max_z_m", error.max_per_axis.z()},
          {"max_tick", error.max_tick}};
}

/// null if no pair of links was judged.
Json self_collision_json(const Judgement& judgement) {
  if (!std::isfinite(judgement.self_clearance_at_ticks)) return nullptr;
  Json contacts = Json::array();
  for (const SelfContact& contact : judgement.self_contacts) {
    contacts.push_back({{"link", contact.first},
                        {"other_link", contact.second},
                        {"first_tick", contact.first_tick},
                        {"at_tick", contact.at_tick},
                        {"ticks", contact.ticks}});
  }
  return {{"contacts", contacts}, {"clearance_at_ticks_m", judgement.self_clearance_at_ticks}};
}

Json orientation_json(const OrientationError& error) {
  return {{"mean_rad", error.mean}, {"max_rad", error.max}, {"max_tick", error.max_tick}};
}

Json judged_json(const Problem& problem, const Judgement& judgement) {
  Json failures = Json::array();
  for (const Failure failure : judgement.failures) failures.push_back(name_of(failure));
  Json contacts = Json::array();
  for (const Contact& contact : judgement.contacts) {
    contacts.push_back({{"link", contact.link},
                        {"obstacle", contact.obstacle},
                        {"first_tick", contact.first_tick},
                        {"at_tick", contact.at_tick},
                        {"ticks", contact.ticks}});
  }
  Json json{{"success", judgement.success()},
            {"failures", failures},
            {"rows", judgement.rows},
            {"contacts", contacts},
            {"self_collision", self_collision_json(judgement)},
            {"disagreement", judgement.disagreement},
            {"touching", judgement.touching},
            {"clearance_at_ticks_m", judgement.clearance_at_ticks},
            {"clearance_m", judgement.clearance},
            {"tip_error_at_ticks", tip_error_json(judgement.at_ticks)},
            {"tip_error_between_ticks", tip_error_json(judgement.between_ticks)},
            {"start_error_m", judgement.start_error},
            {"max_joint_step_rad", judgement.max_joint_step},
            {"max_joint_step_tick", judgement.max_joint_step_tick}};
  if (problem.chain.has_prismatic_joints()) {
    json["max_joint_slide_m"] = judgement.max_joint_slide;
    json["max_joint_slide_tick"] = judgement.max_joint_slide_tick;
  }
  if (problem.has_orientation()) {
    json["orientation_at_ticks"] = orientation_json(judgement.orientation_at_ticks);
    json["orientation_between_ticks"] = orientation_json(judgement.orientation_between_ticks);
  }
  return json;
}

Json motion_json(const MotionQuality& motion) {
  return {{"closed_path_drift_rad", motion.closed_path_drift},
          {"closed_path_drift_joint_rad", motion.closed_path_drift_joint},
          {"manipulability_min", motion.manipulability_min},
          {"manipulability_mean", motion.manipulability_mean},
          {"singular_value_min_m", motion.singular_value_min},
          {"null_space_share", motion.null_space_share},
          {"jerk_rms_rad_s3", motion.jerk_rms}};
}

Json counters_json(const WorkCounters& counters) {
  return {
      {"quadratics", counters.quadratics},       {"bounds", counters.bounds},
      {"point_pairs", counters.point_pairs},     {"distance_queries", counters.distance_queries},
      {"kinematics", counters.kinematics},       {"jacobians", counters.jacobians},
      {"linear_solves", counters.linear_solves}, {"iterations", counters.iterations}};
}

Json times_json(const RunTimes& times, bool success, bool external, const MachineState& machine) {
  std::vector<std::string> against = reasons_against_times(build_info(), machine);
  if (!success) against.insert(against.begin(), kNotASuccess);
  Json worst_q = Json::array();
  for (const double angle : times.warm_max_q) worst_q.push_back(angle);
  return {{"valid", success},
          {"publishable", against.empty()},
          {"against", against},
          {"includes_pipe", external},
          {"construct_s", times.construct_s},
          {"prepare_s", times.prepare_s},
          {"plan_s", times.plan_s},
          {"first_step_s", times.first_step_s},
          {"warm_steps", times.warm_steps},
          {"warm_median_s", times.warm_median_s},
          {"warm_p99_s", times.warm_p99_s},
          {"warm_p999_s", times.warm_p999_s},
          {"warm_max_s", times.warm_max_s},
          {"warm_max_tick", times.warm_max_tick},
          {"warm_max_q_rad", worst_q},
          {"warm_histogram", histogram_json(times.warm_histogram)},
          {"run_s", times.run_s},
          {"cpu_s", times.cpu_s},
          {"hidden_cpu_s", times.hidden_cpu_s}};
}

Json provenance_json(const MethodEntry& method, const MachineState& machine,
                     const Circumstances& circumstances) {
  Json provenance = build_json(build_info());
  provenance.update(machine_json(machine));
  provenance.update(Json{{"host", host_name()},
                         {"restarts", restart_count()},
                         {"jobs", circumstances.jobs},
                         {"seed", circumstances.settings.seed},
                         {"plan_budget_s", circumstances.settings.plan_budget_s},
                         {"isolated", !circumstances.in_process},
                         {"wall_limit_s", circumstances.limits.wall_s},
                         {"memory_limit_bytes", circumstances.limits.memory_bytes},
                         {"command_line", circumstances.command_line},
                         {"out_of_tree", circumstances.out_of_tree},
                         {"external", method.external.empty() ? Json() : Json(method.external)}});
  return provenance;
}

Json disturbance_json(const Disturbance& disturbance) {
  return {{"joint_noise_rad", disturbance.joint_noise},
          {"latency_ticks", disturbance.latency_ticks}};
}

/// null for a run that is not of a campaign.
Json campaign_json(const std::optional<CampaignPlace>& place) {
  if (!place) return nullptr;
  return {{"name", place->campaign}, {"key", place->key}, {"repetition", place->repetition}};
}

Json head_json(const Scenario& scenario, const MethodSpec& method,
               const Circumstances& circumstances) {
  return {{"schema", "bqsa-run/1"},
          {"scenario", scenario_json(scenario)},
          {"problem", problem_json(scenario)},
          {"method", method_json(method, circumstances)},
          {"campaign", campaign_json(circumstances.place)},
          {"disturbance", disturbance_json(circumstances.settings.disturbance)}};
}

/// Text that is not UTF-8, in a path say, is replaced rather than refused.
std::string one_line(const Json& record) {
  return record.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string variant_name(const MethodSpec& method, const Circumstances& circumstances) {
  const RunSettings& settings = circumstances.settings;
  if (circumstances.place) return campaign_variant_name(method, settings.disturbance);
  return variant_name(method) + suffix_of(settings.disturbance, settings.seed);
}

std::string campaign_variant_name(const MethodSpec& method, const Disturbance& disturbance) {
  return variant_name(method) + suffix_of(disturbance, std::nullopt);
}

std::string run_name(const MethodSpec& method, const Circumstances& circumstances) {
  constexpr std::size_t kKeyDigits = 16;
  const std::string name = variant_name(method, circumstances);
  if (circumstances.place) {
    return fmt::format("{}+{}", name, circumstances.place->key.substr(0, kKeyDigits));
  }
  const std::uint64_t seed = circumstances.settings.seed;
  const bool seeded = method.entry.capabilities.plans && seed != RunSettings{}.seed;
  return seeded ? fmt::format("{}+seed={}", name, seed) : name;
}

std::string run_record(const Scenario& scenario, const MethodSpec& method,
                       const RunOutcome& outcome, const std::optional<Diagnosis>& diagnosis,
                       const Judgement& judgement, const MotionQuality& motion,
                       const MachineState& machine, const Circumstances& circumstances,
                       const std::string& trajectory_file) {
  const bool success = judgement.success();
  Json record = head_json(scenario, method, circumstances);
  record["claimed"] = claimed_json(scenario.problem, outcome, diagnosis);
  record["judged"] = judged_json(scenario.problem, judgement);
  record["motion"] = motion_json(motion);
  record["claim_holds"] = claim_holds(outcome.claim, success);
  record["ticks"] = ticks_json(scenario.problem, outcome);
  record["counters"] = counters_json(outcome.counters);
  record["times"] = times_json(outcome.times, success, !method.entry.external.empty(), machine);
  record["trajectory"] = trajectory_file.empty() ? Json() : Json(trajectory_file);
  record["provenance"] = provenance_json(method.entry, machine, circumstances);
  return one_line(record);
}

std::string not_applicable_record(const Scenario& scenario, const MethodSpec& method,
                                  const std::string& why, const MachineState& machine,
                                  const Circumstances& circumstances) {
  Json record = head_json(scenario, method, circumstances);
  record["claimed"] = {{"status", "not applicable"}, {"message", why}};
  record["judged"] = nullptr;
  record["trajectory"] = nullptr;
  record["provenance"] = provenance_json(method.entry, machine, circumstances);
  return one_line(record);
}

}  // namespace bqsa::harness
