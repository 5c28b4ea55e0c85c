#include <fmt/core.h>

#include <ostream>

#include "harness/program/commands.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/scenario_files.hpp"

namespace bqsa::harness {

Status validate_command(const std::vector<std::filesystem::path>& named, const Console& console) {
  Status status = kOk;
  for (const std::filesystem::path& file : with_directories_opened(named)) {
    try {
      const Problem problem = load_scenario(file).problem;
      console.out << fmt::format("{}: valid: {}, joints: {}, obstacles: {}, ticks: {}\n",
                                 file.string(), problem.name, problem.chain.joints(),
                                 problem.obstacles.size(), problem.ticks);
    } catch (const InputError& error) {
      console.error(error.what());
      status = kBadInput;
    }
  }
  return status;
}

}  // namespace bqsa::harness
