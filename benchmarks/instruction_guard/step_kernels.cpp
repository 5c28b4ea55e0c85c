#include <memory>

#include "guarded_kernels.hpp"
#include "harness/input_error.hpp"
#include "recorded_run.hpp"

namespace bqsa {
namespace {

/// Ticks of a run as they differ in work.
enum class TickKind {
  kFree,      ///< nothing is in the way
  kClearing,  ///< links are moved away from obstacles
};

/// A repetition is the first ticks of one kind in a run, with the inputs of that run.
Repetition steps(const std::string& name, const std::string& scene, TickKind kind) {
  constexpr std::size_t kTicks = 40;
  struct Run {
    Problem problem;
    std::unique_ptr<ReactiveMethod> method;
    std::vector<StepInput> inputs;
    StepOutput output;
  };
  const auto run = std::make_shared<Run>(Run{paper_scene(scene), nullptr, {}, {}});
  run->method = prepared_method(name, run->problem);
  for (const RecordedTick& tick : recorded_run(*run->method, run->problem)) {
    if (tick.cleared != (kind == TickKind::kClearing)) continue;
    if (run->inputs.size() < kTicks) run->inputs.push_back(tick.input);
  }
  if (run->inputs.empty()) {
    throw harness::InputError("method '" + name + "' has no such tick on " + scene);
  }
  return [run] {
    double sum = 0;
    for (const StepInput& input : run->inputs) {
      run->method->step(input, run->output);
      sum += run->output.q(0);
    }
    return sum;
  };
}

}  // namespace

std::vector<GuardedKernel> step_kernels() {
  std::vector<GuardedKernel> kernels;
  const auto add = [&](const std::string& method, const std::string& scene, TickKind kind) {
    const char* of_kind = kind == TickKind::kFree ? "/free" : "/clearing";
    kernels.push_back(
        {"step/" + method + '/' + scene + of_kind, [=] { return steps(method, scene, kind); }});
  };
  const auto add_both = [&](const std::string& method, const std::string& scene) {
    add(method, scene, TickKind::kFree);
    add(method, scene, TickKind::kClearing);
  };
  for (const char* method : {"bqsa", "bqsa_lookahead"}) {
    add_both(method, "planar_7r");
    add_both(method, "puma560_ellipsoid");
    add_both(method, "puma560_wall");
  }
  add_both("bqsa_paper", "planar_7r");
  add_both("bqsa_projection", "puma560_ellipsoid");
  add_both("bqsa_escape", "planar_7r");
  add("bqsa_escape", "puma560_ellipsoid", TickKind::kFree);
  for (const char* method : {"maciejewski_klein", "qp", "compact_qp"}) {
    add_both(method, "planar_7r");
    add_both(method, "puma560_ellipsoid");
  }
  for (const char* method : {"potential_field", "weighted_least_norm", "extended_jacobian"}) {
    add(method, "planar_7r", TickKind::kClearing);
  }
  return kernels;
}

}  // namespace bqsa
