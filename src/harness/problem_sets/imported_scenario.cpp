#include "harness/problem_sets/imported_scenario.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "harness/judge/judge.hpp"
#include "harness/judge/motion_check.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/temporary_directory.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLongestName = 52;
constexpr long kVisits = 1L << 16;  // of one motion of the reference

/// Lower case, with `_` for all that a name may not hold.
std::string as_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    const bool capital = c >= 'A' && c <= 'Z';
    name += letter ? c : capital ? static_cast<char>(c - 'A' + 'a') : '_';
  }
  return name.empty() ? "_" : name;
}

template <typename Numbers>
std::string list(const Numbers& numbers, double unit = 1) {
  std::string text;
  for (const double number : numbers) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", number * unit);
  }
  return "[" + text + "]";
}

std::string to_yaml(const SetObstacle& obstacle, const std::string& name, const Units& units) {
  const double unit = units.per_metre;
  std::string text = fmt::format("  - {{name: {}, ", name);
  switch (obstacle.kind) {
    case SetObstacle::Kind::kBox:
      text += fmt::format("kind: box, size: {}", list(obstacle.size, unit));
      break;
    case SetObstacle::Kind::kCylinder:
      text += fmt::format("kind: cylinder, radius: {}, length: {}", obstacle.radius * unit,
                          obstacle.length * unit);
      break;
    case SetObstacle::Kind::kSphere:
      return text + fmt::format("kind: sphere, radius: {}, center: {}}}\n", obstacle.radius * unit,
                                list(obstacle.center, unit));
  }
  return text + fmt::format(", center: {}, quaternion: {}}}\n", list(obstacle.center, unit),
                            list(obstacle.rotation));
}

std::string to_yaml(const std::vector<SetObstacle>& obstacles, const Units& units) {
  if (obstacles.empty()) return "";
  std::string text = "obstacles:\n";
  std::set<std::string> taken;
  for (const SetObstacle& obstacle : obstacles) {
    const std::string name = as_name(obstacle.name).substr(0, kLongestName);
    std::string unique = name;
    for (int k = 2; !taken.insert(unique).second; ++k) unique = fmt::format("{}_{}", name, k);
    text += to_yaml(obstacle, unique, units);
  }
  return text;
}

/// The scenario of a problem whose path is that of the tip in a motion.
class Draft {
 public:
  Draft(const PlanningProblem& problem, std::string name, std::string source,
        const RobotFile& robot, const ImportSettings& settings)
      : problem_(problem),
        name_(std::move(name)),
        source_(std::move(source)),
        robot_(robot),
        settings_(settings) {}

  /// @param clearance  of the motion, if it is known [m]
  std::string yaml(const Trajectory& motion, std::optional<double> clearance = {}) const {
    const Units& units = robot_.units;
    Eigen::VectorXd start = problem_.start;
    for (int j = 0; j < robot_.robot.chain.joints(); ++j) {
      start(j) *= robot_.robot.chain.is_prismatic(j) ? units.per_metre : 1 / units.rad_per_angle;
    }
    std::string text =
        fmt::format("schema: bqsa-scenario/1\nname: {}\ndescription: {}\n{}start: {}\n", name_,
                    quoted_yaml(source_), robot_.yaml, list(start));
    text += fmt::format(
        "task:\n  path: {{kind: waypoints, file: {}.path.csv}}\n"
        "  timing: {{duration: {}, ticks: {}, profile: linear}}\n",
        name_, motion.t.back(), motion.q.size() - 1);
    text += fmt::format("tolerance: {}\nmargin: {}\n", settings_.tolerance * units.per_metre,
                        settings_.margin * units.per_metre);
    if (clearance && std::isfinite(*clearance)) {
      text += fmt::format("reference_clearance: {}\n", *clearance * units.per_metre);
    }
    return text + to_yaml(problem_.obstacles, units);
  }

  /// The waypoints that the tip passes, at the ticks of the motion.
  std::string path_csv(const Trajectory& motion) const {
    std::string text = "t,x,y,z\n";
    ChainPose pose;
    for (std::size_t k = 0; k < motion.q.size(); ++k) {
      robot_.robot.chain.forward(motion.q[k], pose);
      const Eigen::Vector3d tip = robot_.units.per_metre * pose.tip();
      text += fmt::format("{},{},{},{}\n", motion.t[k], tip.x(), tip.y(), tip.z());
    }
    return text;
  }

  /// What the loader makes of it.
  /// @param directory  for its files; those that the robot names are there
  /// @throws InputError as load_scenario(), without the directory
  Scenario load(const Trajectory& motion, const fs::path& directory) const {
    write_text_file(directory / (name_ + ".path.csv"), path_csv(motion));
    write_text_file(directory / (name_ + ".yaml"), yaml(motion));
    try {
      return load_scenario(directory / (name_ + ".yaml"));
    } catch (const InputError& error) {
      std::string message = error.what();
      const std::string prefix = directory.string() + "/";
      for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) {
        message.erase(at, prefix.size());
      }
      throw InputError(message);
    }
  }

 private:
  const PlanningProblem& problem_;
  std::string name_;
  std::string source_;
  const RobotFile& robot_;
  const ImportSettings& settings_;
};

/// Joint motions that keep a clearance from the true obstacles, with the judge's proof.
class ClearMotions {
 public:
  ClearMotions(const Scenario& scenario, double clearance)
      : scene_(thickened(scenario.problem, clearance), scenario.truth), check_(scene_) {}

  bool operator()(const JointVector& from, const JointVector& to) const {
    const MotionVerdict verdict = check_.follow(from, to, 1, scene_.pairs(), kVisits);
    return verdict.colliding.empty() && verdict.undecided.empty() && verdict.contradiction.empty();
  }

 private:
  static Problem thickened(Problem problem, double clearance) {
    problem.link_radius += clearance;
    for (double& radius : problem.link_radii) radius += clearance;
    return problem;
  }

  LinkScene scene_;
  MotionCheck check_;
};

ImportResult failed(ImportFailure failure, std::string why) {
  return {.failure = failure, .why = std::move(why)};
}

}  // namespace

std::string imported_name(const std::string& set, const PlanningProblem& problem) {
  const std::string name = as_name(set + "_" + problem.group).substr(0, kLongestName);
  return fmt::format("{}_{:04}", name, problem.index);
}

ImportResult import_problem(const PlanningProblem& problem, const std::string& name,
                            const RobotFile& robot, const fs::path& directory,
                            const std::string& source, const ImportSettings& settings) {
  const TemporaryDirectory scratch;
  for (const std::string& file : robot.named) {
    fs::create_directories((scratch.path() / file).parent_path());
    fs::copy_file(directory / file, scratch.path() / file);
  }
  const Draft draft(problem, name, source, robot, settings);
  std::optional<Scenario> scene;  // the tip at rest
  try {
    scene = draft.load({.t = {0, 1}, .q = {problem.start, problem.start}}, scratch.path());
  } catch (const InputError& error) {
    return failed(ImportFailure::kStart, error.what());
  }
  const ClearMotions is_clear(*scene, settings.clearance);
  if (!is_clear(problem.start, problem.start)) {
    return failed(ImportFailure::kStart, "the start is nearer to an obstacle than the clearance");
  }
  std::vector<JointVector> goals;
  for (const JointVector& goal : problem.goals) {
    if (scene->problem.within_limits(goal) && is_clear(goal, goal)) goals.push_back(goal);
  }
  if (goals.empty()) {
    return failed(ImportFailure::kGoals,
                  fmt::format("none of {} goals is within the limits and keeps the clearance",
                              problem.goals.size()));
  }
  const std::vector<JointVector> corners = plan_reference(
      problem.start, goals, scene->problem.limits, std::cref(is_clear), settings.reference);
  if (corners.empty()) {
    return failed(ImportFailure::kReference,
                  fmt::format("no motion found in {} checks", settings.reference.most_checks));
  }
  const Trajectory motion = timed_reference(corners, scene->problem.limits, settings.reference);
  std::optional<Scenario> scenario;
  try {
    scenario = draft.load(motion, scratch.path());
  } catch (const InputError& error) {
    return failed(ImportFailure::kPath, error.what());
  }
  const Judgement judgement = Judge(scenario->problem, scenario->truth).judge(motion);
  if (!judgement.success()) {
    std::string faults;
    for (const Failure failure : judgement.failures) {
      faults += fmt::format("{}{}", faults.empty() ? "" : ", ", name_of(failure));
    }
    return failed(ImportFailure::kJudged, faults);
  }
  return {.scenario = ImportedScenario{.name = name,
                                       .yaml = draft.yaml(motion, judgement.clearance),
                                       .path_csv = draft.path_csv(motion),
                                       .witness = motion,
                                       .clearance = judgement.clearance}};
}

const char* name_of(ImportFailure failure) {
  switch (failure) {
    case ImportFailure::kStart:
      return "start";
    case ImportFailure::kGoals:
      return "goals";
    case ImportFailure::kReference:
      return "reference";
    case ImportFailure::kPath:
      return "path";
    case ImportFailure::kJudged:
      return "judged";
  }
  return "";
}

}  // namespace bqsa::harness
