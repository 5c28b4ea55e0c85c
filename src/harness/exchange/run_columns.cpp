#include "harness/exchange/run_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bqsa/method.hpp"
#include "harness/failure_class.hpp"
#include "harness/judge/judge.hpp"
#include "harness/runner.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using enum FigureSource;

constexpr bool kOfSuccesses = true;

constexpr std::array kColumns{
    RunColumn{"time", kReal, "times.run_s", kOfSuccesses},
    RunColumn{"solved", kBoolean, "judged.success"},
    RunColumn{"status", kStatus, "judged.failures"},
    RunColumn{"claim", kEnum, "claimed.status"},
    RunColumn{"claim_holds", kBoolean, "claim_holds"},
    RunColumn{"claim_tick", kInteger, "claimed.tick"},
    RunColumn{"claim_link", kInteger, "claimed.link"},
    RunColumn{"gave_up_because", kEnum, "claimed.reason"},
    RunColumn{"gave_up_class", kEnum, "claimed.class"},
    RunColumn{"nearest_free_rad", kReal, "claimed.nearest_free_rad"},
    RunColumn{"seed", kInteger, "provenance.seed"},
    RunColumn{"repetition", kInteger, "campaign.repetition"},
    RunColumn{"joint_noise_rad", kReal, "disturbance.joint_noise_rad"},
    RunColumn{"latency_ticks", kInteger, "disturbance.latency_ticks"},
    RunColumn{"judged_rows", kInteger, "judged.rows"},
    RunColumn{"touching", kBoolean, "judged.touching"},
    RunColumn{"contact_pairs", kCount, "judged.contacts"},
    RunColumn{"self_contact_pairs", kCount, "judged.self_collision.contacts"},
    RunColumn{"self_clearance_at_ticks_m", kReal, "judged.self_collision.clearance_at_ticks_m"},
    RunColumn{"clearance_m", kReal, "judged.clearance_m"},
    RunColumn{"clearance_at_ticks_m", kReal, "judged.clearance_at_ticks_m"},
    RunColumn{"tip_error_at_ticks_mean_m", kReal, "judged.tip_error_at_ticks.mean_m"},
    RunColumn{"tip_error_at_ticks_rms_m", kReal, "judged.tip_error_at_ticks.rms_m"},
    RunColumn{"tip_error_at_ticks_max_m", kReal, "judged.tip_error_at_ticks.max_m"},
    RunColumn{"tip_error_at_ticks_max_x_m", kReal, "judged.tip_error_at_ticks.max_x_m"},
    RunColumn{"tip_error_at_ticks_max_y_m", kReal, "judged.tip_error_at_ticks.max_y_m"},
    RunColumn{"tip_error_at_ticks_max_z_m", kReal, "judged.tip_error_at_ticks.max_z_m"},
    RunColumn{"tip_error_at_ticks_max_tick", kInteger, "judged.tip_error_at_ticks.max_tick"},
    RunColumn{"tip_error_between_ticks_mean_m", kReal, "judged.tip_error_between_ticks.mean_m"},
    RunColumn{"tip_error_between_ticks_rms_m", kReal, "judged.tip_error_between_ticks.rms_m"},
    RunColumn{"tip_error_between_ticks_max_m", kReal, "judged.tip_error_between_ticks.max_m"},
    RunColumn{"tip_error_between_ticks_max_x_m", kReal, "judged.tip_error_between_ticks.max_x_m"},
    RunColumn{"tip_error_between_ticks_max_y_m", kReal, "judged.tip_error_between_ticks.max_y_m"},
    RunColumn{"tip_error_between_ticks_max_z_m", kReal, "judged.tip_error_between_ticks.max_z_m"},
    RunColumn{"tip_error_between_ticks_max_tick", kInteger,
              "judged.tip_error_between_ticks.max_tick"},
    RunColumn{"orientation_at_ticks_mean_rad", kReal, "judged.orientation_at_ticks.mean_rad"},
    RunColumn{"orientation_at_ticks_max_rad", kReal, "judged.orientation_at_ticks.max_rad"},
    RunColumn{"orientation_at_ticks_max_tick", kInteger, "judged.orientation_at_ticks.max_tick"},
    RunColumn{"orientation_between_ticks_mean_rad", kReal,
              "judged.orientation_between_ticks.mean_rad"},
    RunColumn{"orientation_between_ticks_max_rad", kReal,
              "judged.orientation_between_ticks.max_rad"},
    RunColumn{"orientation_between_ticks_max_tick", kInteger,
              "judged.orientation_between_ticks.max_tick"},
    RunColumn{"start_error_m", kReal, "judged.start_error_m"},
    RunColumn{"max_joint_step_rad", kReal, "judged.max_joint_step_rad"},
    RunColumn{"max_joint_step_tick", kInteger, "judged.max_joint_step_tick"},
    RunColumn{"max_joint_slide_m", kReal, "judged.max_joint_slide_m"},
    RunColumn{"max_joint_slide_tick", kInteger, "judged.max_joint_slide_tick"},
    RunColumn{"closed_path_drift_rad", kReal, "motion.closed_path_drift_rad"},
    RunColumn{"closed_path_drift_joint_rad", kReal, "motion.closed_path_drift_joint_rad"},
    RunColumn{"manipulability_min", kReal, "motion.manipulability_min"},
    RunColumn{"manipulability_mean", kReal, "motion.manipulability_mean"},
    RunColumn{"singular_value_min_m", kReal, "motion.singular_value_min_m"},
    RunColumn{"null_space_share", kReal, "motion.null_space_share"},
    RunColumn{"jerk_rms_rad_s3", kReal, "motion.jerk_rms_rad_s3"},
    RunColumn{"free_ticks", kInteger, "ticks.free"},
    RunColumn{"clamped_ticks", kInteger, "ticks.clamped"},
    RunColumn{"unclaimed_ticks", kInteger, "ticks.unclaimed"},
    RunColumn{"clamp_starts", kInteger, "ticks.clamp_starts"},
    RunColumn{"increments_total", kInteger, "ticks.increments_total"},
    RunColumn{"increments_max", kInteger, "ticks.increments_max"},
    RunColumn{"increments_tick_mean", kReal, "ticks.increments_tick_mean"},
    RunColumn{"increments_tick_median", kReal, "ticks.increments_tick_median"},
    RunColumn{"increments_tick_p99", kReal, "ticks.increments_tick_p99"},
    RunColumn{"increments_tick_max", kInteger, "ticks.increments_tick_max"},
    RunColumn{"guard_fired_ticks", kInteger, "ticks.guard_fired"},
    RunColumn{"quadratics", kInteger, "counters.quadratics"},
    RunColumn{"bounds", kInteger, "counters.bounds"},
    RunColumn{"point_pairs", kInteger, "counters.point_pairs"},
    RunColumn{"distance_queries", kInteger, "counters.distance_queries"},
    RunColumn{"kinematics", kInteger, "counters.kinematics"},
    RunColumn{"jacobians", kInteger, "counters.jacobians"},
    RunColumn{"linear_solves", kInteger, "counters.linear_solves"},
    RunColumn{"iterations", kInteger, "counters.iterations"},
    RunColumn{"times_publishable", kBoolean, "times.publishable"},
    RunColumn{"includes_pipe", kBoolean, "times.includes_pipe"},
    RunColumn{"construct_s", kReal, "times.construct_s", kOfSuccesses},
    RunColumn{"prepare_s", kReal, "times.prepare_s", kOfSuccesses},
    RunColumn{"plan_s", kReal, "times.plan_s", kOfSuccesses},
    RunColumn{"first_step_s", kReal, "times.first_step_s", kOfSuccesses},
    RunColumn{"warm_steps", kInteger, "times.warm_steps"},
    RunColumn{"warm_median_s", kReal, "times.warm_median_s", kOfSuccesses},
    RunColumn{"warm_p99_s", kReal, "times.warm_p99_s", kOfSuccesses},
    RunColumn{"warm_p999_s", kReal, "times.warm_p999_s", kOfSuccesses},
    RunColumn{"warm_max_s", kReal, "times.warm_max_s", kOfSuccesses},
    RunColumn{"warm_max_tick", kInteger, "times.warm_max_tick", kOfSuccesses},
    RunColumn{"cpu_s", kReal, "times.cpu_s", kOfSuccesses},
    RunColumn{"hidden_cpu_s", kReal, "times.hidden_cpu_s", kOfSuccesses},
};

constexpr const char* kSuccess = "success";

/// Names of the values of an enumeration type from `first` on.
template <class Enum>
std::vector<std::string> names(Enum first, Enum last) {
  std::vector<std::string> all;
  for (int value = static_cast<int>(first); value <= static_cast<int>(last); ++value) {
    all.emplace_back(name_of(static_cast<Enum>(value)));
  }
  return all;
}

std::vector<Enumeration> make_enumerations() {
  std::vector<std::string> status = names(Failure::kDisagreement, Failure::kOrientation);
  status.insert(status.begin(), kSuccess);
  return {{"status", status},
          {"claim", names(Claim::kSuccess, Claim::kOutOfMemory)},
          {"gave_up_because", names(Infeasible::kNoFreeConfiguration, Infeasible::kDiverged)},
          {"gave_up_class", names(FailureClass::kSingular, FailureClass::kBranch)}};
}

std::int64_t index_in(const std::vector<std::string>& values, const std::string& text,
                      const RecordValue& where) {
  const auto found = std::find(values.begin(), values.end(), text);
  if (found == values.end()) {
    where.refuse(fmt::format("expected one of {}, got {}", fmt::join(values, ", "), excerpt(text)));
  }
  return found - values.begin();
}

/// Whole numbers that SQL has no place for, of seeds say, are left out.
Figure whole_figure(const RecordValue& value) {
  const std::uint64_t whole = value.whole();
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  return whole <= kLargest ? Figure(static_cast<std::int64_t>(whole)) : Figure();
}

Figure real_figure(const RecordValue& value) {
  const double number = value.number();
  return std::isfinite(number) ? Figure(number) : Figure();
}

Figure figure_at(const RecordValue& value, const RunColumn& column, const TableRow& row) {
  if (value.is_null()) return {};
  switch (column.source) {
    case kBoolean:
      return value.boolean();
    case kInteger:
      return whole_figure(value);
    case kReal:
      return real_figure(value);
    case kCount:
      return static_cast<std::int64_t>(value.list().size());
    case kEnum:
      return index_in(values_of(column), value.text(), value);
    case kStatus:
      return index_in(values_of(column), row.success ? kSuccess : row.failures.front(), value);
  }
  assert(false && "no such source");
  return {};
}

/// @param key  with a point between the keys of objects in objects
Figure read_figure(const RecordValue& object, std::string_view key, const RunColumn& column,
                   const TableRow& row) {
  const std::size_t point = key.find('.');
  const std::string first(key.substr(0, point));
  if (!object.has(first.c_str())) return {};
  const RecordValue value = object[first.c_str()];
  if (point == std::string_view::npos) return figure_at(value, column, row);
  return read_figure(value, key.substr(point + 1), column, row);
}

}  // namespace

Cell cell_of(const Figure& figure) {
  return std::visit([](const auto& value) { return Cell(value); }, figure);
}

Cell scalar_cell(const nlohmann::json& json) {
  if (json.is_boolean()) return json.get<bool>();
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  if (json.is_number_unsigned() && json.get<std::uint64_t>() > kLargest) return json.get<double>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return printable(json.get_ref<const std::string&>());
  return {};
}

std::string cell_text(const Cell& cell) {
  struct Text {
    std::string operator()(std::monostate) const { return ""; }
    std::string operator()(bool truth) const { return truth ? "1" : "0"; }
    std::string operator()(std::int64_t whole) const { return fmt::format("{}", whole); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(const std::string& text) const { return text; }
  };
  return std::visit(Text{}, cell);
}

const char* RunColumn::sql_type() const {
  switch (source) {
    case kBoolean:
      return "BOOLEAN";
    case kInteger:
    case kCount:
      return "INTEGER";
    case kReal:
      return "REAL";
    case kEnum:
    case kStatus:
      return "ENUM";
  }
  assert(false && "no such source");
  return "";
}

std::span<const RunColumn> run_columns() { return kColumns; }

const std::vector<Enumeration>& enumerations() {
  static const std::vector<Enumeration> kAll = make_enumerations();
  return kAll;
}

const std::vector<std::string>& values_of(const RunColumn& column) {
  const auto found =
      std::find_if(enumerations().begin(), enumerations().end(),
                   [&column](const Enumeration& known) { return known.name == column.name; });
  assert(found != enumerations().end());
  return found->values;
}

std::vector<Figure> read_figures(const RecordValue& record, const TableRow& row) {
  std::vector<Figure> figures;
  figures.reserve(kColumns.size());
  for (const RunColumn& column : kColumns) {
    const bool left_out = column.of_successes && !row.success;
    figures.push_back(left_out ? Figure() : read_figure(record, column.key, column, row));
  }
  return figures;
}

}  // namespace bqsa::harness
