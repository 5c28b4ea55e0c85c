// The runs that a replay shows.
import type { DecodedReplay, DecodedScene, ReportData, Run, Scenario } from "../data";
import type { Actor } from "./actor";

/** A run with the actor that shows it. */
export interface Shown {
  letter: string; ///< "A" or "B"; empty if there is but one run
  name: string; ///< of the variant
  run: Run;
  actor: Actor | null; ///< null without a scene; at its start without a replay
}

/** The arm at its start, for a run without a replay. */
function start_only(run: Run, scenario: Scenario, scene: DecodedScene): DecodedReplay {
  const links = scene.scene.links.length;
  return {
    run,
    rows: 1,
    points: scene.start_points,
    q: new Float32Array(scenario.joints).fill(NaN),
    tip_error_m: new Float32Array([NaN]),
    clearance_m: new Float32Array([NaN]),
    near_link: new Uint8Array([255]),
    near_obstacle: new Uint16Array([65535]),
    hit: new Uint8Array(links),
    category: new Uint8Array(links).fill(255),
    category_obstacle: new Uint16Array(links).fill(65535),
  };
}

/** Why a run cannot be watched; empty if it can. */
export function why_not_shown(run: Run, scenario: Scenario): string {
  if (!run.applicable) return `Not applicable: ${run.why_not}`;
  if (run.replay === null) return `No replay: ${run.no_replay || "there is no trajectory"}`;
  if (scenario.scene === null) return `No replay: ${scenario.scene_missing}`;
  return "";
}

export function shown_runs(data: ReportData, scenario_index: number, runs: readonly Run[]): Shown[] {
  const scenario = data.scenario(scenario_index);
  const scene = data.scene(scenario_index);
  return runs.map((run, i) => {
    const name = data.method_key(run.method);
    const letter = runs.length > 1 ? "AB".charAt(i) : "";
    if (scene === null) return { letter, name, run, actor: null };
    const replay = data.replay(run) ?? start_only(run, scenario, scene);
    return { letter, name, run, actor: { name: name.slice(0, 40), scenario, scene, replay } };
  });
}
