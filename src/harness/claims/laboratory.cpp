#include "harness/claims/laboratory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "harness/generator/generator.hpp"
#include "harness/method_spec.hpp"
#include "harness/temporary_directory.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness::claims {
namespace {

const Family& planar_family(const std::string& name) {
  for (const Family& family : families()) {
    if (family.name == name && family.planar && !family.spatial) return family;
  }
  throw InputError(fmt::format("family: expected a planar family, got {}", name));
}

}  // namespace

std::string Experiment::key() const {
  return fmt::format("{} {} {} {}", scenario, method, obstacles, refinement) +
         (moved.empty() ? ""
                        : fmt::format(" {} {} {} {}", moved, center.x(), center.y(), center.z()));
}

const Scenario& Laboratory::scenario(const std::string& name) {
  const auto found = scenarios_.find(name);
  if (found != scenarios_.end()) return found->second;
  const std::filesystem::path file = settings_.scenarios / (name + ".yaml");
  Scenario scenario = load_scenario(file);
  if (!scenario.geometry.solids.empty()) {
    throw InputError(
        fmt::format("{}: expected obstacles that are ellipsoids, got solids, which "
                    "experiments neither move nor take away",
                    file.string()));
  }
  if (scenario.self_collision) {
    throw InputError(
        fmt::format("{}: expected a scenario without self_collision, got one with it, which "
                    "experiments do not judge",
                    file.string()));
  }
  return scenarios_.emplace(name, std::move(scenario)).first->second;
}

Problem Laboratory::problem(const Experiment& experiment) {
  Problem problem = scenario(experiment.scenario).problem;
  if (!experiment.moved.empty()) {
    const auto obstacle =
        std::find_if(problem.obstacles.begin(), problem.obstacles.end(),
                     [&](const Obstacle& one) { return one.name == experiment.moved; });
    if (obstacle == problem.obstacles.end()) {
      throw InputError(fmt::format("{}: expected an obstacle of {}, got none of that name",
                                   experiment.moved, experiment.scenario));
    }
    obstacle->shape =
        Ellipsoid(experiment.center, obstacle->shape.semi_axes(), obstacle->shape.rotation());
  }
  if (!experiment.obstacles) problem.obstacles.clear();
  problem.ticks *= experiment.refinement;
  problem.dt /= experiment.refinement;
  return problem;
}

const Problem& Laboratory::generated(const std::string& family, std::uint64_t seed, int index) {
  const std::string key = fmt::format("{} {} {}", family, seed, index);
  const auto found = generated_.find(key);
  if (found != generated_.end()) return found->second;
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "problem.yaml";
  Rejections rejections;
  write_text_file(file, generate(planar_family(family), seed, index, {}, rejections).yaml);
  return generated_.emplace(key, load_scenario(file).problem).first->second;
}

MethodSpec Laboratory::method(const std::string& text) const {
  MethodSpec spec = parse_method_spec(text, methods_);
  if (spec.entry.capabilities.plans || !spec.entry.external.empty()) {
    throw InputError(
        fmt::format("{}: expected a reactive method of this program, got another", text));
  }
  return spec;
}

const RecordedRun& Laboratory::run(const Experiment& experiment) {
  const std::string key = experiment.key();
  const auto found = runs_.find(key);
  if (found != runs_.end()) return found->second;
  return runs_.emplace(key, record_run(problem(experiment), method(experiment.method)))
      .first->second;
}

const Judgement& Laboratory::judgement(const Experiment& experiment) {
  const std::string key = experiment.key();
  const auto found = judgements_.find(key);
  if (found != judgements_.end()) return found->second;
  const RecordedRun& recorded = run(experiment);
  return judgements_.emplace(key, Judge(recorded.problem).judge(recorded.trajectory)).first->second;
}

const Sweep* Laboratory::sweep(std::string_view name) const {
  const auto found = std::find_if(sweeps_.begin(), sweeps_.end(),
                                  [&](const Sweep& one) { return one.name == name; });
  return found == sweeps_.end() ? nullptr : &*found;
}

}  // namespace bqsa::harness::claims
