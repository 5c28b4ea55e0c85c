// Which runs a state of the page asks for.
import type { ReportData, Run } from "../data";
import type { State } from "../link";

export interface Selection {
  scenario: number; ///< index; -1 if the report has no scenario
  run: Run | null;
  against: Run | null;
}

const has_replay = (run: Run): boolean => run.replay !== null;

/** Of a method's runs the one of a seed and repetition, else one that can be replayed, else the first. */
function run_of(runs: readonly Run[], seed: string, repetition: number | null): Run | null {
  const asked = runs.find(
    (run) =>
      (seed !== "" || repetition !== null) &&
      (seed === "" || run.seed === seed) &&
      (repetition === null || run.repetition === repetition),
  );
  return asked ?? runs.find(has_replay) ?? runs[0] ?? null;
}

/** Where nothing is asked for: the first scenario with a replay, and there `bqsa`, else the first run with a replay. */
export function select_runs(data: ReportData, state: Readonly<State>): Selection {
  const { scenarios, runs } = data.report;
  let scenario = data.scenario_index(state.scenario);
  if (scenario < 0) scenario = runs.find(has_replay)?.scenario ?? (scenarios.length > 0 ? 0 : -1);
  if (scenario < 0) return { scenario, run: null, against: null };
  const here = data.runs_of_scenario[scenario] ?? [];
  let method = data.method_index(state.method);
  if (method < 0 || !here.some((run) => run.method === method)) {
    const bqsa = data.method_index("bqsa");
    const shown = here.find((run) => run.method === bqsa && has_replay(run)) ?? here.find(has_replay) ?? here[0];
    method = shown?.method ?? -1;
  }
  const run = run_of(data.runs(scenario, method), state.seed, state.repetition);
  const rival = data.method_index(state.against);
  const against = rival < 0 ? null : run_of(data.runs(scenario, rival), state.seed, state.repetition);
  return { scenario, run, against: against === run ? null : against };
}

/** What tells a run from others of its method on the same scenario; empty if nothing does. */
export function run_mark(run: Run): string {
  const parts = [];
  if (run.repetition !== null) parts.push(`repetition ${run.repetition}`);
  if (run.seed !== null) parts.push(`seed ${run.seed}`);
  return parts.join(", ");
}
