#include "harness/measuring/measure_processes.hpp"

#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "harness/measuring/measurements.hpp"
#include "harness/temporary_directory.hpp"

namespace bqsa::harness {
namespace {

/// Waits for the end of the program and says what was wrong with it; empty if nothing.
std::string fault_of(std::vector<std::string> words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = -1;
  const int error =
      posix_spawn(&child, arguments.front(), nullptr, nullptr, arguments.data(), environ);
  if (error != 0) {
    return fmt::format("cannot start {}: {}", words.front(),
                       std::generic_category().message(error));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return "cannot be waited for";
  }
  if (WIFSIGNALED(status)) return fmt::format("ended by signal {}", WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : fmt::format("ended with status {}", WEXITSTATUS(status));
}

}  // namespace

std::vector<Sweep> measure_processes(const std::vector<std::string>& command, int processes) {
  const TemporaryDirectory scratch;
  std::vector<std::vector<Sweep>> measured;
  for (int process = 1; process <= processes; ++process) {
    const std::filesystem::path file = scratch.path() / fmt::format("{}.json", process);
    std::vector<std::string> words = command;
    for (const std::string& word :
         {std::string("--process"), std::to_string(process), std::string("--out"), file.string()}) {
      words.push_back(word);
    }
    const std::string fault = fault_of(std::move(words));
    if (!fault.empty()) {
      throw std::runtime_error(fmt::format("measuring process {} of {}: {}; nothing is kept",
                                           process, processes, fault));
    }
    measured.push_back(read_measurements(file).sweeps);
  }
  return pool(measured);
}

}  // namespace bqsa::harness
