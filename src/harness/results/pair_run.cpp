#include "harness/results/pair_run.hpp"

namespace bqsa::harness {

std::string run_pair(const Scenario& scenario, const Judge& judge, const MethodSpec& method,
                     const Circumstances& circumstances, ResultStore& store) {
  const Problem& problem = scenario.problem;
  const MachineState machine = machine_state();
  const std::string why_not = why_not_applicable(method.entry.capabilities, problem);
  std::string record;
  if (why_not.empty()) {
    const RunOutcome outcome =
        run_method(problem, method.entry, method.parameters, circumstances.settings);
    const std::string file =
        store.write_trajectory(problem.name, variant_name(method), outcome.trajectory);
    record = run_record(scenario, method, outcome, judge.judge(outcome.trajectory), machine,
                        circumstances, file);
  } else {
    record = not_applicable_record(scenario, method, why_not, machine, circumstances);
  }
  store.append(record);
  return record;
}

}  // namespace bqsa::harness
