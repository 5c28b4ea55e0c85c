#include <fmt/core.h>

#include <ostream>

#include "harness/generator/generator.hpp"
#include "harness/program/commands.hpp"
#include "harness/program/external_methods.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/scenario_files.hpp"

namespace bqsa::harness {
namespace {

constexpr const char* kDefaultDirectory = "scenarios";

std::string abilities(const MethodEntry& method) {
  const Capabilities& can = method.capabilities;
  std::string text;
  for (const auto& [able, name] :
       {std::pair(can.planar, "planar"), std::pair(can.spatial, "spatial"),
        std::pair(can.link_radius, "link radius"), std::pair(can.margin, "margin"),
        std::pair(can.moving, "moving obstacles"), std::pair(can.prismatic, "prismatic joints"),
        std::pair(can.orientation, "orientation")}) {
    if (able) text += (text.empty() ? "" : ", ") + std::string(name);
  }
  return text;
}

std::string range_of(const ParameterDeclaration& parameter) {
  if (parameter.choices.empty()) {
    return fmt::format("{}{:.6g} to {:.6g}", parameter.integer ? "whole, " : "", parameter.minimum,
                       parameter.maximum);
  }
  std::string text;
  for (const std::string& choice : parameter.choices) text += (text.empty() ? "" : " | ") + choice;
  return text;
}

void print_method(const MethodEntry& method, std::ostream& out) {
  out << fmt::format("  {:<17} {}\n  {:<17} {}\n  {:<17} for {}{}\n", method.name, method.summary,
                     "", method.source, "", abilities(method),
                     method.out_of_tree ? "; out of tree" : "");
  if (!method.external.empty()) out << fmt::format("  {:<17} external: {}\n", "", method.external);
  const ParameterValues defaults(method.parameters);
  const auto values = defaults.as_text();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ParameterDeclaration& parameter = method.parameters[i];
    out << fmt::format("    {:<24}{:>10} {:<8} ({}) {}\n", parameter.name, values[i].second,
                       parameter.unit, range_of(parameter), parameter.meaning);
  }
}

}  // namespace

Status list_command(const std::vector<MethodEntry>& methods, const std::filesystem::path& scenarios,
                    const Console& console) {
  console.out << "methods (parameter, default, unit, range, meaning)\n";
  for (const MethodEntry& method : methods) print_method(method, console.out);

  console.out << "\nfamilies of random scenarios, for generate\n";
  for (const Family& family : families()) {
    console.out << fmt::format("  {:<17} {}\n", family.name, family.summary);
  }

  const std::filesystem::path directory = scenarios.empty() ? kDefaultDirectory : scenarios;
  if (scenarios.empty() && !std::filesystem::exists(directory)) {
    console.out << "\nno ./scenarios here; name a directory with --scenarios DIR\n";
    return kOk;
  }
  Status status = kOk;
  console.out << fmt::format("\nscenarios in {}\n", directory.string());
  for (const std::filesystem::path& file : yaml_files(directory)) {
    try {
      const Scenario scenario = load_scenario(file);
      console.out << fmt::format("  {:<23} {}\n", scenario.problem.name, scenario.description);
    } catch (const InputError& error) {
      console.error(error.what());
      status = kBadInput;
    }
  }
  return status;
}

}  // namespace bqsa::harness
