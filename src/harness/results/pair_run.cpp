#include "harness/results/pair_run.hpp"

namespace bqsa::harness {
namespace {

std::string why_not_run(const Problem& problem, const MethodSpec& method,
                        const Disturbance& disturbance) {
  std::string why = why_not_applicable(method.entry.capabilities, problem);
  if (why.empty() && disturbance.on() && !is_reactive(method.entry, method.parameters)) {
    why = "noise and latency disturb methods that answer tick by tick, this one plans";
  }
  return why;
}

std::optional<Diagnosis> diagnosis_of(const Problem& problem, const RunOutcome& outcome) {
  if (outcome.claim != Claim::kInfeasible) return std::nullopt;
  return diagnose(problem, outcome.tick, outcome.reason, outcome.trajectory.q.back());
}

}  // namespace

StoredRun run_pair(const Scenario& scenario, const Judge& judge, const MethodSpec& method,
                   const Circumstances& circumstances, ResultStore& store) {
  const Problem& problem = scenario.problem;
  const MachineState machine = machine_state();
  const std::string why_not = why_not_run(problem, method, circumstances.settings.disturbance);
  StoredRun run;
  std::unique_ptr<StagedTextFile> staged;
  if (why_not.empty()) {
    const RunOutcome outcome =
        run_method(problem, method.entry, method.parameters, circumstances.settings);
    const Judgement judgement = judge.judge(outcome.trajectory);
    const std::string file =
        ResultStore::trajectory_file(problem.name, variant_name(method, circumstances.settings));
    try {
      if (circumstances.store_trajectories) {
        staged = store.stage_trajectory(file, outcome.trajectory);
      }
    } catch (const InputError& error) {
      run.trajectory_error = error.what();
    }
    run.record = run_record(scenario, method, outcome, diagnosis_of(problem, outcome), judgement,
                            machine, circumstances, staged ? file : "");
  } else {
    run.record = not_applicable_record(scenario, method, why_not, machine, circumstances);
  }
  store.append(run.record);
  if (staged) staged->commit();
  return run;
}

}  // namespace bqsa::harness
