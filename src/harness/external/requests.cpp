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

Json denavit_hartenberg(const ChainDescription& description) {
  Json rows = Json::array();
  for (const DhRow& row : description.rows) {
    rows.push_back({{"a", row.a}, {"alpha", row.alpha}, {"d", row.d}, {"offset", row.offset}});
  }
  const bool standard = description.convention == DhConvention::kStandard;
  return {{"convention", standard ? "standard" : "modified"},
          {"rows", rows},
          {"R_WB", rows_of(description.R_WB)},
          {"p_WB", list_of(description.p_WB)},
          {"p_LT", list_of(description.p_LT)}};
}

/// Where axes and points are for q = 0: turning them about the axes, the last first, gives any pose.
Json pose_at_zero(const SerialChain& chain) {
  ChainPose pose;
  chain.forward(JointVector::Zero(chain.joints()), pose);
  Json moving_joints = Json::array();
  for (int k = 0; k < chain.points(); ++k) moving_joints.push_back(chain.moving_joints(k));
  return {{"axes", columns_of(pose.axis_W)},
          {"pivots", columns_of(pose.pivot_W)},
          {"points", columns_of(pose.p_WO)},
          {"moving_joints", moving_joints}};
}

Json robot_json(const SerialChain& chain) {
  Json links = Json::array();
  for (const Link& link : chain.links()) {
    links.push_back({{"number", link.number}, {"start", link.start}, {"end", link.end}});
  }
  return {{"dimension", chain.dimension()},
          {"joints", chain.joints()},
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

Json problem_json(const Problem& problem) {
  Json obstacles = Json::array();
  for (const Obstacle& obstacle : problem.obstacles) obstacles.push_back(obstacle_json(obstacle));
  Json path = Json::array();
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    path.push_back(list_of(problem.desired_tip(problem.time(tick))));
  }
  Json max_step = Json::array();
  for (int j = 0; j < problem.chain.joints(); ++j) max_step.push_back(problem.max_step(j));
  return {{"name", problem.name},
          {"robot", robot_json(problem.chain)},
          {"obstacles", obstacles},
          {"ticks", problem.ticks},
          {"dt", problem.dt},
          {"path", path},
          {"start", list_of(problem.start)},
          {"limits",
           {{"lower", limit_json(problem.limits.lower)},
            {"upper", limit_json(problem.limits.upper)},
            {"max_velocity", limit_json(problem.limits.max_velocity)}}},
          {"max_step", max_step},
          {"link_radius", problem.link_radius},
          {"margin", problem.margin},
          {"tolerance", problem.tolerance}};
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

std::string step_request(const StepInput& input) {
  return one_line({{"request", "step"},
                   {"tick", input.tick},
                   {"t", input.t},
                   {"p_WT_desired", list_of(input.p_WT_desired)},
                   {"q", list_of(input.q)}});
}

std::string plan_request(double budget_s, std::uint64_t seed) {
  return one_line({{"request", "plan"}, {"budget_s", budget_s}, {"seed", seed}});
}

std::string quit_request() { return one_line({{"request", "quit"}}); }

}  // namespace bqsa::harness
