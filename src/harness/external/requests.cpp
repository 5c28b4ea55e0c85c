#include "harness/external/requests.hpp"

#include <nlohmann/json.hpp>

namespace bqsa::harness {
namespace {

/// Keys in the order in which they are documented. Numbers that are not finite become null.
using Json = nlohmann::ordered_json;

template <typename Vector>
Json list_of(const Vector& vector) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < vector.size(); ++i) list.push_back(vector(i));
  return list;
}

Json rows_of(const Eigen::Matrix3d& matrix) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(list_of(matrix.row(i)));
  return rows;
}

template <typename Columns>
Json columns_of(const Columns& matrix) {
  Json columns = Json::array();
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) columns.push_back(list_of(matrix.col(k)));
  return columns;
}

/// Null for a chain that is given otherwise.
Json denavit_hartenberg(const ChainDescription& description) {
  if (description.is_placed()) return {};
  Json rows = Json::array();
  for (const DhRow& row : description.rows) {
    rows.push_back({{"a", row.a}, {"alpha", row.alpha}, {"d", row.d}, {"offset", row.offset}});
  }
  const bool standard = description.convention == DhConvention::kStandard;
  return {{"convention", standard ? "standard" : "modified"},
          {"rows", rows},
          {"R_WB", rows_of(description.R_WB)},
          {"p_WB", list_of(description.p_WB)},
          {"p_LT", list_of(description.p_LT)},
          {"R_LT", rows_of(description.R_LT)}};
}

/// Where axes and points are for q = 0: moving them by the joints, the last first, gives any pose.
Json pose_at_zero(const SerialChain& chain) {
  ChainPose pose;
  chain.forward(JointVector::Zero(chain.joints()), pose);
  Json moving_joints = Json::array();
  for (int k = 0; k < chain.points(); ++k) moving_joints.push_back(chain.moving_joints(k));
  return {{"axes", columns_of(pose.axis_W)},
          {"pivots", columns_of(pose.pivot_W)},
          {"points", columns_of(pose.p_WO)},
          {"tip_rotation", rows_of(chain.tip_rotation(pose))},
          {"moving_joints", moving_joints}};
}

Json robot_json(const SerialChain& chain) {
  Json links = Json::array();
  for (const Link& link : chain.links()) {
    links.push_back({{"number", link.number}, {"start", link.start}, {"end", link.end}});
  }
  Json types = Json::array();
  for (int j = 0; j < chain.joints(); ++j) {
    types.push_back(chain.is_prismatic(j) ? "prismatic" : "revolute");
  }
  return {{"dimension", chain.dimension()},
          {"joints", chain.joints()},
          {"joint_types", types},
          {"denavit_hartenberg", denavit_hartenberg(chain.description())},
          {"at_zero", pose_at_zero(chain)},
          {"links", links}};
}

Json obstacle_json(const Obstacle& obstacle) {
  Json motion = Json::array();
  for (const Ellipsoid& shape : obstacle.motion) {
    motion.push_back(
        {{"center", list_of(shape.center())}, {"rotation", rows_of(shape.rotation())}});
  }
  return {{"name", obstacle.name},
          {"center", list_of(obstacle.shape.center())},
          {"semi_axes", list_of(obstacle.shape.semi_axes())},
          {"rotation", rows_of(obstacle.shape.rotation())},
          {"motion", motion}};
}

/// Null where nothing is limited.
Json limit_json(const JointVector& limit) { return limit.size() > 0 ? list_of(limit) : Json(); }

const char* name_of(TaskKind kind) {
  return kind == TaskKind::kPosition ? "position" : kind == TaskKind::kAxis ? "axis" : "pose";
}

/// At the ticks; null where no orientation is desired.
Json rotations_json(const Problem& problem) {
  if (!problem.has_orientation()) return {};
  Json rotations = Json::array();
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    rotations.push_back(rows_of(problem.rotation_at(problem.time(tick))));
  }
  return rotations;
}

Json problem_json(const Problem& problem) {
  Json obstacles = Json::array();
  for (const Obstacle& obstacle : problem.obstacles) obstacles.push_back(obstacle_json(obstacle));
  Json path = Json::array();
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    path.push_back(list_of(problem.desired_tip(problem.time(tick))));
  }
  Json max_step = Json::array();
  for (int j = 0; j < problem.chain.joints(); ++j) max_step.push_back(problem.max_step(j));
  Json radii = Json::array();
  for (std::size_t i = 0; i < problem.chain.links().size(); ++i) {
    radii.push_back(problem.radius_of(i));
  }
  return {{"name", problem.name},
          {"robot", robot_json(problem.chain)},
          {"obstacles", obstacles},
          {"ticks", problem.ticks},
          {"dt", problem.dt},
          {"path", path},
          {"task", name_of(problem.task_kind)},
          {"rotations", rotations_json(problem)},
          {"start", list_of(problem.start)},
          {"limits",
           {{"lower", limit_json(problem.limits.lower)},
            {"upper", limit_json(problem.limits.upper)},
            {"max_velocity", limit_json(problem.limits.max_velocity)}}},
          {"max_step", max_step},
          {"link_radius", problem.link_radius},
          {"link_radii", radii},
          {"margin", problem.margin},
          {"tolerance", problem.tolerance},
          {"orientation_tolerance", problem.orientation_tolerance}};
}

/// Names may hold bytes that are no UTF-8; they are replaced rather than refused.
std::string one_line(const Json& request) {
  return request.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string describe_request() {
  return one_line({{"request", "describe"}, {"protocol", kMethodProtocol}});
}

std::string prepare_request(const Problem& problem,
                            const std::vector<ParameterDeclaration>& declared,
                            const ParameterValues& values) {
  Json parameters = Json::object();
  for (const ParameterDeclaration& parameter : declared) {
    const std::string& name = parameter.name;
    parameters[name] = !parameter.choices.empty() ? Json(values.choice(name))
                       : parameter.integer        ? Json(values.integer(name))
                                                  : Json(values.number(name));
  }
  return one_line(
      {{"request", "prepare"}, {"problem", problem_json(problem)}, {"parameters", parameters}});
}

std::string step_request(const StepInput& input, bool turned) {
  Json request{{"request", "step"},
               {"tick", input.tick},
               {"t", input.t},
               {"p_WT_desired", list_of(input.p_WT_desired)}};
  if (turned) request["R_WT_desired"] = rows_of(input.R_WT_desired);
  request["q"] = list_of(input.q);
  return one_line(request);
}

std::string plan_request(double budget_s, std::uint64_t seed) {
  return one_line({{"request", "plan"}, {"budget_s", budget_s}, {"seed", seed}});
}

std::string quit_request() { return one_line({{"request", "quit"}}); }

}  // namespace bqsa::harness
