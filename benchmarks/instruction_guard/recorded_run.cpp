#include "recorded_run.hpp"

#include <algorithm>
#include <filesystem>

#include "harness/methods.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa {

Problem paper_scene(const std::string& name) {
  const auto file = std::filesystem::path(BQSA_SOURCE_DIR) / "scenarios" / (name + ".yaml");
  return harness::load_scenario(file).problem;
}

std::unique_ptr<ReactiveMethod> prepared_method(const std::string& name, const Problem& problem) {
  const std::vector<MethodEntry>& methods = harness::methods();
  const auto entry = std::find_if(methods.begin(), methods.end(),
                                  [&](const MethodEntry& method) { return method.name == name; });
  if (entry == methods.end()) throw harness::InputError("unknown method '" + name + "'");
  std::unique_ptr<Method> made = entry->make(ParameterValues(entry->parameters));
  auto* reactive = dynamic_cast<ReactiveMethod*>(made.get());
  if (!reactive) throw harness::InputError("method '" + name + "' has no control step");
  made.release();
  std::unique_ptr<ReactiveMethod> method(reactive);
  method->prepare(problem);
  return method;
}

std::vector<RecordedTick> recorded_run(ReactiveMethod& method, const Problem& problem) {
  std::vector<RecordedTick> ticks;
  StepInput input;
  StepOutput output;
  input.q = problem.start;
  for (input.tick = 1; input.tick <= problem.ticks; ++input.tick) {
    input.t = problem.time(input.tick);
    input.p_WT_desired = problem.desired_tip(input.t);
    output = {};
    method.step(input, output);
    if (output.state == TickState::kInfeasible) break;
    ticks.push_back({input, output.q, output.clamp_count > 0});
    input.q = output.q;
  }
  return ticks;
}

}  // namespace bqsa
