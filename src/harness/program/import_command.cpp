#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <system_error>

#include "harness/problem_sets/imported_scenario.hpp"
#include "harness/program/commands.hpp"
#include "harness/text_file.hpp"
#include "harness/trajectory_csv.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

/// The problems that were asked for, in the order of the set.
std::vector<PlanningProblem> chosen(const ImportOptions& options) {
  std::vector<PlanningProblem> all = read_problem_set(options.set);
  std::vector<std::string> there;
  for (const PlanningProblem& problem : all) {
    if (there.empty() || there.back() != problem.group) there.push_back(problem.group);
  }
  for (const std::string& group : options.groups) {
    if (std::find(there.begin(), there.end(), group) == there.end()) {
      throw InputError(fmt::format("--group: expected one of {}, got {}", fmt::join(there, ", "),
                                   excerpt(group)));
    }
  }
  std::vector<PlanningProblem> some;
  int taken = 0;  // of the group
  for (const PlanningProblem& problem : all) {
    const bool first = &problem == all.data() || (&problem - 1)->group != problem.group;
    if (first) taken = 0;
    const bool wanted = options.groups.empty() ||
                        std::find(options.groups.begin(), options.groups.end(), problem.group) !=
                            options.groups.end();
    if (!wanted || (options.count > 0 && taken == options.count)) continue;
    ++taken;
    some.push_back(problem);
  }
  return some;
}

/// Nothing is begun that could not be ended.
void expect_different_names(const std::string& set, const std::vector<PlanningProblem>& problems,
                            const ImportOptions& options) {
  std::set<std::string> names;
  for (const PlanningProblem& problem : problems) {
    const std::string name = imported_name(set, problem);
    if (names.insert(name).second) continue;
    throw InputError(
        fmt::format("{}: expected problems of different names, got {} twice, at last "
                    "for {} {}",
                    options.set.string(), name, excerpt(problem.group), problem.index));
  }
}

/// One field of a CSV file.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted;
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return '"' + quoted + '"';
}

void write(const ImportedScenario& scenario, const ImportOptions& options) {
  const auto file = [&](const char* ending) {
    return options.directory / (scenario.name + ending);
  };
  write_new_text_file(file(".path.csv"), scenario.path_csv);
  write_new_text_file(file(".yaml"), scenario.yaml);
  if (options.witnesses)
    write_new_text_file(file(".witness.csv"), trajectory_text(scenario.witness));
}

}  // namespace

Status import_command(const ImportOptions& options, const Console& console) {
  const RobotFile robot = load_robot(options.robot);
  const JointVector& speeds = robot.robot.limits.max_velocity;
  if (robot.robot.chain.dimension() != 3 || speeds.size() == 0 || !speeds.allFinite()) {
    throw InputError(fmt::format(
        "{}: robot: expected a spatial arm with a velocity limit of every joint, got another one",
        options.robot.string()));
  }
  const std::vector<PlanningProblem> problems = chosen(options);
  const std::string set = options.set.stem().string();
  expect_different_names(set, problems, options);
  const Eigen::Index joints = robot.robot.chain.joints();
  for (const PlanningProblem& problem : problems) {
    if (problem.start.size() == joints) continue;
    throw InputError(fmt::format("{}: {} {}: expected {} joint values, as {} has joints, got {}",
                                 options.set.string(), excerpt(problem.group), problem.index,
                                 joints, robot.name, problem.start.size()));
  }
  std::error_code error;
  fs::create_directories(options.directory, error);
  if (!fs::is_directory(options.directory)) {
    throw InputError(
        fmt::format("{}: expected a directory that can be made, got one that cannot ({})",
                    options.directory.string(), error.message()));
  }
  const fs::path directory = options.robot.parent_path();
  for (const std::string& name : robot.named) {
    fs::create_directories((options.directory / name).parent_path());
    write_new_text_file(options.directory / name,
                        read_text_file(directory / name, std::size_t{1} << 26));
  }

  const ImportSettings settings{.clearance = options.clearance,
                                .tolerance = options.tolerance,
                                .margin = options.margin,
                                .reference = {.seed = options.seed}};
  std::string ledger = "name,group,index,outcome,clearance_m,ticks,why\n";
  std::size_t written = 0;
  for (std::size_t k = 0; k < problems.size(); ++k) {
    if (console.terminal) {
      console.err << fmt::format("\r\033[K{} of {}", k + 1, problems.size()) << std::flush;
    }
    const PlanningProblem& problem = problems[k];
    const std::string name = imported_name(set, problem);
    const std::string source =
        fmt::format("Imported from {}, {} {}, reference by seed {}",
                    options.set.filename().string(), problem.group, problem.index, options.seed);
    const ImportResult result = import_problem(problem, name, robot, directory, source, settings);
    if (result.scenario) {
      write(*result.scenario, options);
      ++written;
      const double clearance = result.scenario->clearance;
      ledger += fmt::format("{},{},{},written,{},{},\n", name, field(problem.group), problem.index,
                            std::isfinite(clearance) ? fmt::format("{}", clearance) : "",
                            result.scenario->witness.q.size() - 1);
    } else {
      ledger += fmt::format("{},{},{},{},,,{}\n", name, field(problem.group), problem.index,
                            name_of(result.failure), field(result.why));
    }
  }
  if (console.terminal) console.err << "\r\033[K" << std::flush;
  write_text_file(options.directory / "import.csv", ledger);
  console.out << fmt::format("{}: wrote {} of {} problems; import.csv says what became of each\n",
                             options.directory.string(), written, problems.size());
  return written > 0 ? kOk : kBadInput;
}

}  // namespace bqsa::harness
