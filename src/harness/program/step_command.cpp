#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <numbers>
#include <ostream>

#include "harness/campaign/stored_rows.hpp"
#include "harness/program/commands.hpp"
#include "harness/program/external_methods.hpp"
#include "harness/results/run_record.hpp"
#include "harness/results/table_row.hpp"
#include "harness/results/text_table.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/statistics/estimates.hpp"
#include "harness/text_file.hpp"
#include "harness/trajectory_csv.hpp"

namespace bqsa::harness {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRepetitions = 1000;
constexpr double kLongEnough = 10;  ///< of all repetitions together [s]

/// The tick to repeat and the joint angles before it.
struct Replay {
  int tick = 0;
  JointVector q;
};

JointVector joint_angles(const std::vector<double>& angles, const Problem& problem,
                         const std::string& source) {
  const int joints = problem.chain.joints();
  if (static_cast<int>(angles.size()) != joints) {
    throw InputError(
        fmt::format("{}: expected {} joint angles, got {}", source, joints, angles.size()));
  }
  return Eigen::Map<const Eigen::VectorXd>(angles.data(), joints);
}

JointVector parse_angles(std::string_view text, const Problem& problem) {
  std::vector<double> angles;
  for (bool more = true; more;) {
    const std::size_t comma = text.find(',');
    const std::string_view word = text.substr(0, comma);
    more = comma != std::string_view::npos;
    if (more) text.remove_prefix(comma + 1);
    double angle = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), angle);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(angle)) {
      throw InputError(fmt::format(
          "--state: expected q1,...,qn [rad] or a trajectory file, got '{}'", excerpt(word)));
    }
    angles.push_back(angle);
  }
  return joint_angles(angles, problem, "--state");
}

Replay given_tick(const StepOptions& options, const Problem& problem) {
  if (options.tick < 1 || options.tick > problem.ticks || options.state.empty()) {
    throw InputError(
        fmt::format("expected --slowest DIR, or --tick from 1 to {} with --state", problem.ticks));
  }
  std::error_code unknown;
  if (!std::filesystem::exists(options.state, unknown)) {
    return {options.tick, parse_angles(options.state, problem)};
  }
  const Trajectory trajectory = read_trajectory(options.state, problem.chain.joints());
  const auto row = static_cast<std::size_t>(options.tick) - 1;
  if (row >= trajectory.q.size() || !trajectory.q[row].allFinite()) {
    throw InputError(fmt::format("{}: no joint angles before tick {}, it has {} rows",
                                 options.state, options.tick, trajectory.q.size()));
  }
  return {options.tick, trajectory.q[row]};
}

/// The runs of a method on this scenario file: the last undisturbed one; of a campaign all repetitions,
/// whatever disturbed them, but for those that are no longer of its plan.
std::vector<TableRow> stored_runs(const std::filesystem::path& directory, const Scenario& scenario,
                                  const std::string& variant) {
  std::vector<TableRow> rows;
  for (const TableRow& row : stored_rows(directory).rows) {  // `show` reports lines that are broken
    const bool in_campaign = !row.key.empty();
    const bool same_file = row.scenario == scenario.problem.name && row.sha256 == scenario.sha256;
    const bool same_method =
        row.variant == variant || (in_campaign && row.variant.starts_with(variant + '+'));
    if (same_file && same_method) rows.push_back(row);
  }
  return last_runs(rows);
}

Replay slowest_tick(const std::filesystem::path& directory, const Scenario& scenario,
                    const MethodSpec& spec) {
  const std::filesystem::path file = runs_file(directory);
  const std::string variant = variant_name(spec);
  const std::string name = scenario.problem.name;
  TableRow found;
  for (const TableRow& row : stored_runs(directory, scenario, variant)) {
    const bool slower = found.slowest_q.empty() || row.slowest_s > found.slowest_s;
    if (!row.slowest_q.empty() && slower) found = row;
  }
  if (found.slowest_q.empty()) {
    throw InputError(fmt::format("{}: holds no slowest tick of {} on this file of {}",
                                 file.string(), variant, name));
  }
  const std::string source = fmt::format("{}: times.warm_max_q_rad", file.string());
  const JointVector q = joint_angles(found.slowest_q, scenario.problem, source);
  if (found.slowest_tick < 1 || found.slowest_tick > scenario.problem.ticks || !q.allFinite()) {
    throw InputError(fmt::format("{}: times.warm_max_tick: expected a tick of the problem, got {}",
                                 file.string(), found.slowest_tick));
  }
  return {found.slowest_tick, q};
}

std::string angles_text(const JointVector& q) {
  std::string text;
  for (const double angle : q) text += fmt::format("{}{}", text.empty() ? "" : ",", angle);
  return text;
}

/// What one step added to the counters.
std::string work_text(const WorkCounters& before, const WorkCounters& after) {
  return fmt::format(
      "{} quadratics, {} bounds, {} point pairs, {} distance queries, {} forward kinematics, "
      "{} Jacobians, {} linear solves, {} iterations",
      after.quadratics - before.quadratics, after.bounds - before.bounds,
      after.point_pairs - before.point_pairs, after.distance_queries - before.distance_queries,
      after.kinematics - before.kinematics, after.jacobians - before.jacobians,
      after.linear_solves - before.linear_solves, after.iterations - before.iterations);
}

void print_answer(const StepOutput& output, const Problem& problem, std::ostream& out) {
  const auto name = [&problem](int obstacle) {
    return obstacle >= 0 ? problem.obstacles.at(static_cast<std::size_t>(obstacle)).name : "-";
  };
  out << fmt::format("state: {}\n", name_of(output.state));
  if (output.state == TickState::kInfeasible) {
    out << fmt::format("reason: {}", name_of(output.reason));
    if (output.link > 0) out << fmt::format(", ({}, {})", output.link, name(output.obstacle));
    out << '\n';
  }
  int increments = 0;
  for (int i = 0; i < output.clamp_count; ++i) {
    const Clamp& clamp = output.clamps.at(static_cast<std::size_t>(i));
    increments += clamp.increments;
    out << fmt::format("clamp: ({}, {}), anchor {}, offset {:.4g} deg, {} increments\n", clamp.link,
                       name(clamp.obstacle), clamp.anchor, clamp.offset * 180 / std::numbers::pi,
                       clamp.increments);
  }
  out << fmt::format("increments: {}\n", increments);
  if (output.guard_fired) out << "guard fired\n";
  out << fmt::format("q after [rad]: {}\n", angles_text(output.q));
}

bool same_answer(const StepOutput& a, const StepOutput& b) {
  return a.state == b.state && a.reason == b.reason && a.q == b.q;
}

}  // namespace

Status step_command(const std::vector<MethodEntry>& methods, const StepOptions& options,
                    const Console& console) {
  const MethodSpec spec = parse_method_spec(options.method, methods);
  const Scenario scenario = load_scenario(options.scenario, options.load);
  const Problem& problem = scenario.problem;
  const std::string why_not = why_not_applicable(spec.entry.capabilities, problem);
  if (!why_not.empty()) throw InputError(fmt::format("{}: {}", spec.entry.name, why_not));
  const Replay replay = options.slowest.empty() ? given_tick(options, problem)
                                                : slowest_tick(options.slowest, scenario, spec);

  const std::unique_ptr<Method> made = spec.entry.make(spec.parameters);
  auto* method = dynamic_cast<ReactiveMethod*>(made.get());
  if (method == nullptr) throw InputError(spec.entry.name + ": plans, and makes no single steps");
  method->prepare(problem);

  StepInput input;
  input.tick = replay.tick;
  input.t = problem.time(replay.tick);
  input.p_WT_desired = problem.desired_tip(input.t);
  input.R_WT_desired = problem.rotation_at(input.t);
  input.q = replay.q;
  StepOutput first;
  const WorkCounters before = method->counters();
  method->step(input, first);
  const WorkCounters after = method->counters();

  bool constant = true;
  std::vector<double> times;
  const Clock::time_point begin = Clock::now();
  while (times.size() < kRepetitions &&
         Clock::now() - begin < std::chrono::duration<double>(kLongEnough)) {
    StepOutput output;
    const Clock::time_point start = Clock::now();
    method->step(input, output);
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    constant = constant && same_answer(first, output);
  }
  std::sort(times.begin(), times.end());

  console.out << fmt::format("scenario: {}\nmethod: {}\ntick: {} of {}, to t = {:.6g} s\n",
                             problem.name, variant_name(spec), replay.tick, problem.ticks, input.t);
  console.out << fmt::format("q before [rad]: {}\n", angles_text(replay.q));
  print_answer(first, problem, console.out);
  console.out << fmt::format("work: {}\n", work_text(before, after));
  console.out << fmt::format("time of {} repetitions [us]: median {}, p99 {}, max {}\n",
                             times.size(), figure(median_of(times)),
                             figure(quantile_of(times, 0.99)), figure(times.back()));
  if (!constant) {
    console.out << "the repetitions answer differently: this method remembers earlier ticks, and "
                   "may have done something else in its run\n";
  }
  return kOk;
}

}  // namespace bqsa::harness
