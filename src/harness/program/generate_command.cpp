#include <fmt/format.h>

#include <filesystem>
#include <ostream>
#include <system_error>

#include "harness/generator/generator.hpp"
#include "harness/program/commands.hpp"
#include "harness/text_file.hpp"
#include "harness/trajectory_csv.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

const Family& chosen_family(const std::string& name) {
  if (const Family* family = find_family(name)) return *family;
  throw InputError(
      fmt::format("--family: expected one of {}, got {}", family_names(), excerpt(name)));
}

std::string counted(const Rejections& rejections, std::initializer_list<Filter> filters) {
  std::string text;
  for (const Filter filter : filters) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name_of(filter), rejections[filter]);
  }
  return text;
}

}  // namespace

Status generate_command(const GenerateOptions& options, const Console& console) {
  const Family& family = chosen_family(options.family);
  if (options.witnesses && !family.witnesses) {
    throw InputError(
        fmt::format("--witnesses: expected a family that has them, got {}", family.name));
  }
  const std::vector<Arm> arms = arms_of(family, options.robots);
  std::error_code error;
  fs::create_directories(options.directory, error);
  if (!fs::is_directory(options.directory)) {
    throw InputError(
        fmt::format("{}: expected a directory that can be made, got one that cannot ({})",
                    options.directory.string(), error.message()));
  }
  Rejections rejections;
  int there = 0;
  for (int index = 0; index < options.count; ++index) {
    const GeneratedScenario scenario = generate(family, options.seed, index, arms, rejections);
    there += !write_new_text_file(options.directory / (scenario.name + ".yaml"), scenario.yaml);
    if (options.witnesses) {
      write_new_text_file(options.directory / (scenario.name + ".witness.csv"),
                          trajectory_text(scenario.witness));
    }
    if (console.terminal) {
      console.err << fmt::format("\r\033[K{} of {}", index + 1, options.count) << std::flush;
    }
  }
  if (console.terminal) console.err << "\r\033[K" << std::flush;
  console.out << fmt::format(
      "{}: wrote {} scenarios, {} were there; rejected arms and paths: {}; obstacles: {}\n",
      options.directory.string(), options.count - there, there,
      counted(rejections, {Filter::kReach, Filter::kLimits, Filter::kTracking,
                           Filter::kWitnessMotion, Filter::kUnplaceable, Filter::kWitnessJudged}),
      counted(rejections, {Filter::kStart, Filter::kTipPath, Filter::kInnerLinks, Filter::kWitness,
                           Filter::kNoHit}));
  return kOk;
}

}  // namespace bqsa::harness
