#include "harness/results/pair_run.hpp"

#include <algorithm>
#include <vector>

namespace bqsa::harness {
namespace {

std::string why_not_run(const Problem& problem, const MethodSpec& method,
                        const Disturbance& disturbance) {
  std::string why = why_not_applicable(method.entry.capabilities, problem);
  if (why.empty() && disturbance.on() && method.entry.capabilities.plans) {
    why = "noise and latency disturb methods that answer tick by tick, this one plans";
  }
  return why;
}

std::optional<Diagnosis> diagnosis_of(const Problem& problem, const RunOutcome& outcome) {
  if (outcome.claim != Claim::kInfeasible) return std::nullopt;
  return diagnose(problem, outcome.tick, outcome.reason, outcome.trajectory.q.back());
}

/// Conduct counts as much as the trajectory: what the harness saw of it joins the failures.
void add_conduct(const RunOutcome& outcome, Judgement& judgement) {
  std::vector<Failure>& failures = judgement.failures;
  if (outcome.inputs_changed) failures.push_back(Failure::kInputsChanged);
  if (outcome.work_hidden) failures.push_back(Failure::kWorkHidden);
  if (outcome.claim == Claim::kTimedOut) failures.push_back(Failure::kTimedOut);
  if (outcome.claim == Claim::kOutOfMemory) failures.push_back(Failure::kOutOfMemory);
  if (outcome.claim == Claim::kCrashed && failures.empty()) failures.push_back(Failure::kCrashed);
  std::sort(failures.begin(), failures.end());
}

bool is_kept(KeptTrajectories kept, const Judgement& judgement) {
  return kept == KeptTrajectories::kAll ||
         (kept == KeptTrajectories::kFailures && !judgement.success());
}

RunOutcome run_outcome(const Problem& problem, const MethodSpec& method,
                       const Circumstances& circumstances) {
  const RunSettings& settings = circumstances.settings;
  if (circumstances.in_process) {
    return run_method(problem, method.entry, method.parameters, settings);
  }
  return run_isolated(problem, method.entry, method.parameters, settings, circumstances.limits);
}

}  // namespace

JudgedPair judged_pair(const Scenario& scenario, const Judge& judge, const MethodSpec& method,
                       const Circumstances& circumstances, const std::filesystem::path& directory) {
  const Problem& problem = scenario.problem;
  const MachineState machine = machine_state();
  const std::string why_not = why_not_run(problem, method, circumstances.settings.disturbance);
  JudgedPair run;
  if (!why_not.empty()) {
    run.record = not_applicable_record(scenario, method, why_not, machine, circumstances);
    return run;
  }
  const RunOutcome outcome = run_outcome(problem, method, circumstances);
  Judgement judgement = judge.judge(outcome.trajectory);
  add_conduct(outcome, judgement);
  const std::string file = trajectory_file(problem.name, run_name(method, circumstances));
  try {
    if (is_kept(circumstances.trajectories, judgement)) {
      run.trajectory =
          stage_trajectory(directory, file, outcome.trajectory, circumstances.durability);
    }
  } catch (const InputError& error) {
    run.trajectory_error = error.what();
  }
  run.claim = outcome.claim;
  run.killed = outcome.killed;
  run.record = run_record(scenario, method, outcome, diagnosis_of(problem, outcome), judgement,
                          motion_quality(problem, outcome.trajectory, judgement.rows), machine,
                          circumstances, run.trajectory ? file : "");
  return run;
}

StoredRun run_pair(const Scenario& scenario, const Judge& judge, const MethodSpec& method,
                   const Circumstances& circumstances, ResultStore& store) {
  const JudgedPair run = judged_pair(scenario, judge, method, circumstances, store.directory());
  store.append(run.record);
  if (run.trajectory) run.trajectory->commit();
  return {run.record, run.trajectory_error};
}

}  // namespace bqsa::harness
