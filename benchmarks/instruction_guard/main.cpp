// Runs one kernel a number of times and nothing else, for tools/instruction_guard.py, which counts
// instructions under callgrind. Batches run with AVX2, the most that valgrind knows; their instruction set is part of the
// toolchain. Kernels whose code depends on the processor in another way (vector clones) are left out.

#include <fmt/core.h>
#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>

#include "bqsa/batch/instruction_set.hpp"
#include "guarded_kernels.hpp"
#include "harness/input_error.hpp"
#include "harness/results/provenance.hpp"

namespace bqsa {

/// What is counted: callgrind is told the name, and leaves out all that happens outside.
/// @param answer  of every repetition
/// @param inject  share of the repetitions that are done twice, spread evenly [%]
/// @throws std::logic_error if the answer is another
[[gnu::noinline]] void counted_repetitions(const GuardedKernel& kernel, const Repetition& repeat,
                                           double answer, int repetitions, int inject) {
  const auto repeat_and_check = [&] {
    if (repeat() != answer) {
      throw std::logic_error(fmt::format("kernel '{}' does not repeat its answer", kernel.name));
    }
  };
  for (long k = 0; k < repetitions; ++k) {
    repeat_and_check();
    if ((k + 1) * inject / 100 > k * inject / 100) repeat_and_check();
  }
}

namespace {

std::vector<GuardedKernel> all_kernels() {
  std::vector<GuardedKernel> kernels = geometry_kernels();
  for (const auto& more : {batch_kernels(), motion_kernels(), step_kernels()}) {
    kernels.insert(kernels.end(), more.begin(), more.end());
  }
  return kernels;
}

/// What was built: under `toolchain` all that may change the number of instructions of the same sources.
void print_build() {
  const harness::BuildInfo& build = harness::build_info();
  utsname machine{};
  uname(&machine);
  nlohmann::ordered_json toolchain = {{"architecture", machine.machine},
                                      {"compiler", build.compiler},
                                      {"flags", build.flags},
                                      {"glibc", gnu_get_libc_version()},
                                      {"libstdc++", std::to_string(__GLIBCXX__)}};
  for (const auto& [library, version] : build.libraries) {
    const bool has_code_in_kernels =
        library == "Eigen" || library == "Highway" || library == "FCL" || library == "libccd";
    if (has_code_in_kernels) toolchain[library] = version;
  }
  toolchain["instruction_set"] = instruction_set().name;
  const nlohmann::ordered_json text = {
      {"commit", build.commit}, {"modified", build.dirty}, {"toolchain", toolchain}};
  fmt::print("{}\n", text.dump(2));
}

/// Not more than valgrind knows. A processor with less has counts of its own.
void choose_instructions() {
  for (const InstructionSet& set : instruction_sets()) {
    if (set.name == "AVX3") continue;
    use_instruction_set(set.name);
    return;
  }
}

void run_kernel(const std::string& name, int repetitions, int inject) {
  const std::vector<GuardedKernel> kernels = all_kernels();
  const auto kernel = std::find_if(kernels.begin(), kernels.end(),
                                   [&](const GuardedKernel& k) { return k.name == name; });
  if (kernel == kernels.end()) {
    throw harness::InputError(fmt::format("unknown kernel '{}'; --list names them", name));
  }
  const Repetition repeat = kernel->prepare();
  repeat();  // from here on a method remembers what a repetition leaves behind
  const double answer = repeat();
  counted_repetitions(*kernel, repeat, answer, repetitions, inject);
}

int run(int argc, char** argv) {
  CLI::App app("Runs one hot path of the project a number of times.", "instruction_guard");
  bool list = false, build = false;
  std::string kernel;
  int repetitions = 0, inject = 0;
  app.add_flag("--list", list, "names of the kernels");
  app.add_flag("--build", build, "what this program was built from and with, as JSON");
  CLI::Option* of_kernel = app.add_option("--kernel", kernel, "name of one kernel");
  CLI::Option* of_repetitions =
      app.add_option("--repetitions", repetitions, "after those that warm up")
          ->needs(of_kernel)
          ->check(CLI::Range(0, 1'000'000));
  of_kernel->needs(of_repetitions);
  app.add_option("--inject", inject, "share of the repetitions that are done twice [%]")
      ->needs(of_kernel)
      ->check(CLI::Range(0, 100));
  try {
    app.parse(argc, argv);
    if (!list && !build && !*of_kernel) throw CLI::CallForHelp();
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  if (list) {
    for (const GuardedKernel& each : all_kernels()) fmt::print("{}\n", each.name);
  }
  if (build) print_build();
  if (*of_kernel) run_kernel(kernel, repetitions, inject);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace bqsa

int main(int argc, char** argv) {
  try {
    bqsa::choose_instructions();
    return bqsa::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "instruction_guard: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
