#include "harness/results/pair_run.hpp"

namespace bqsa::harness {

StoredRun run_pair(const Scenario& scenario, const Judge& judge, const MethodSpec& method,
                   const Circumstances& circumstances, ResultStore& store) {
  const Problem& problem = scenario.problem;
  const MachineState machine = machine_state();
  const std::string why_not = why_not_applicable(method.entry.capabilities, problem);
  StoredRun run;
  std::unique_ptr<StagedTextFile> staged;
  if (why_not.empty()) {
    const RunOutcome outcome =
        run_method(problem, method.entry, method.parameters, circumstances.settings);
    const Judgement judgement = judge.judge(outcome.trajectory);
    const std::string file = ResultStore::trajectory_file(problem.name, variant_name(method));
    try {
      staged = store.stage_trajectory(file, outcome.trajectory);
    } catch (const InputError& error) {
      run.trajectory_error = error.what();
    }
    run.record = run_record(scenario, method, outcome, judgement, machine, circumstances,
                            staged ? file : "");
  } else {
    run.record = not_applicable_record(scenario, method, why_not, machine, circumstances);
  }
  store.append(run.record);
  if (staged) staged->commit();
  return run;
}

}  // namespace bqsa::harness
