// The data of the page with what is looked up in them.
import type { Method, MethodSummary, Replay, Report, Run, Scenario, Scene } from "./report-data";
import { UniqueNames } from "./unique_names";

export type * from "./report-data";

/** Bytes of a base64 text. */
function bytes(base64: string): Uint8Array {
  const text = atob(base64);
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
  return out;
}

/** Little-endian single-precision numbers, on machines of either kind. */
export function f32(base64: string): Float32Array {
  const view = new DataView(bytes(base64).buffer);
  const out = new Float32Array(view.byteLength / 4);
  for (let i = 0; i < out.length; ++i) out[i] = view.getFloat32(4 * i, true);
  return out;
}

export function u8(base64: string): Uint8Array {
  return bytes(base64);
}

export function u16(base64: string): Uint16Array {
  const view = new DataView(bytes(base64).buffer);
  const out = new Uint16Array(view.byteLength / 2);
  for (let i = 0; i < out.length; ++i) out[i] = view.getUint16(2 * i, true);
  return out;
}

/** A replay with its arrays decoded; shapes as in the schema. */
export interface DecodedReplay {
  run: Run;
  rows: number;
  points: Float32Array; ///< [rows][P][3] [m]
  q: Float32Array; ///< [rows][J] [rad]
  tip_error_m: Float32Array;
  clearance_m: Float32Array;
  near_link: Uint8Array;
  near_obstacle: Uint16Array; ///< 65535: none
  hit: Uint8Array; ///< [rows][L], 1: in an obstacle as it is
  category: Uint8Array; ///< [rows][L], 255: none
  category_obstacle: Uint16Array; ///< [rows][L], 65535: none
}

/** A scene's arrays decoded. */
export interface DecodedScene {
  scene: Scene;
  path: Float32Array; ///< [ticks + 1][3] [m]
  start_points: Float32Array; ///< [P][3] [m]
  motion: (Float32Array | null)[]; ///< per obstacle [ticks + 1][12]; null: at rest
  solids: { vertices: Float32Array; triangles: Uint16Array }[]; ///< [V][3] at t = 0 [m]; [T][3]
}

/** Sort of verdict on a run, from good to bad. */
export type VerdictKind = "success" | "failure" | "no-verdict" | "crash" | "not-applicable";

export interface Verdict {
  kind: VerdictKind;
  symbol: string;
  word: string;
  lie: boolean; ///< the method claims what the judge denies; never without a verdict
}

/** What tables call the judge's failures, as the program's own table does. */
const kFailureWords: Record<string, string> = {
  disagreement: "no verdict",
  inputs_changed: "changes inputs",
  work_hidden: "hides work",
  timed_out: "timed out",
  out_of_memory: "out of memory",
  crashed: "crashed",
  not_finite: "not finite",
  incomplete: "incomplete",
  wrong_start: "wrong start",
  collision: "collides",
  self_collision: "self-collides",
  undecided: "undecided",
  jump: "jumps",
  joint_limit: "breaks joint limits",
  drift: "drifts",
  orientation: "tilts",
};

export const failure_word = (failure: string): string => kFailureWords[failure] ?? failure;

const kOfConduct = ["timed_out", "out_of_memory", "crashed", "inputs_changed", "work_hidden"];
const kBrokenOff = ["timed out", "out of memory", "crashed"]; ///< how `claimed` begins of a run that did not end by itself

export function verdict_of(run: Run): Verdict {
  if (!run.applicable) return { kind: "not-applicable", symbol: "–", word: "n/a", lie: false };
  if (run.disagreement !== "" || run.failures.includes("disagreement")) {
    return { kind: "no-verdict", symbol: "?", word: "no verdict", lie: false };
  }
  const lie = !run.claim_holds;
  if (run.success) return { kind: "success", symbol: "✓", word: "success", lie };
  const conduct = run.failures.find((failure) => kOfConduct.includes(failure));
  const broken_off = kBrokenOff.find((word) => run.claimed.startsWith(word));
  if (conduct !== undefined || broken_off !== undefined) {
    return {
      kind: "crash",
      symbol: "■",
      word: conduct !== undefined ? failure_word(conduct) : (broken_off as string),
      lie,
    };
  }
  // A method that gave up left the rest of the rows out: what it did until then tells more.
  const first = run.failures.find((failure) => failure !== "incomplete") ?? run.failures[0];
  return { kind: "failure", symbol: "✗", word: first === undefined ? "failed" : failure_word(first), lie };
}

export class ReportData {
  readonly report: Report;
  readonly runs_of_scenario: Run[][];
  readonly runs_of_method: Run[][];
  readonly families: string[];
  readonly robots: string[]; ///< names to choose from; none where there are fewer than two
  readonly #scenario_keys: UniqueNames;
  readonly #method_keys: UniqueNames;
  #replays = new Map<number, DecodedReplay>();
  #scenes = new Map<number, DecodedScene>();

  constructor(report: Report) {
    this.report = report;
    this.runs_of_scenario = report.scenarios.map(() => []);
    this.runs_of_method = report.methods.map(() => []);
    for (const run of report.runs) {
      this.runs_of_scenario[run.scenario]?.push(run);
      this.runs_of_method[run.method]?.push(run);
    }
    this.#scenario_keys = new UniqueNames(
      report.scenarios.map((scenario) => scenario.name),
      (index) => `${this.scenario(index).name}@${this.scenario(index).sha256.slice(0, 8)}`,
    );
    this.#method_keys = new UniqueNames(
      report.methods.map((method) => method.variant),
      (index, nth) => `${this.method(index).variant}~${nth}`,
    );
    this.families = [...new Set(report.scenarios.map((scenario) => scenario.family || scenario.name))];
    const robots = [...new Set(report.scenarios.map((scenario) => scenario.robot))].filter((name) => name !== "");
    this.robots = robots.length > 1 ? robots : [];
  }

  scenario(index: number): Scenario {
    return at(this.report.scenarios, index, "scenario");
  }

  method(index: number): Method {
    return at(this.report.methods, index, "method");
  }

  /** Name of a scenario, with the start of its hash where several files have the name: as the page shows and links it. */
  scenario_key(index: number): string {
    return this.#scenario_keys.of(index);
  }

  /** Name of a variant, with a number where several have the name: as the page shows and links it. */
  method_key(index: number): string {
    return this.#method_keys.of(index);
  }

  /** Index of the scenario of a key, or the last one of a name; -1 if there is none. */
  scenario_index(key: string): number {
    return this.#scenario_keys.index(key);
  }

  /** Index of the variant of a key, or the last one of a name; -1 if there is none. */
  method_index(key: string): number {
    return this.#method_keys.index(key);
  }

  /** Runs of a variant on a scenario, in the order of the report; more than one where there are repetitions. */
  runs(scenario: number, method: number): Run[] {
    return (this.runs_of_scenario[scenario] ?? []).filter((run) => run.method === method);
  }

  /** Family of a scenario; a scenario that is not generated is one of its own. */
  family(scenario: Scenario): string {
    return scenario.family || scenario.name;
  }

  /** Whether a scenario is of the family and of the robot that are chosen; empty, or no robot to choose: any. */
  of_scope(index: number, { family, robot }: { family: string; robot: string }): boolean {
    const scenario = this.scenario(index);
    return (
      (family === "" || this.family(scenario) === family) && (!this.robots.includes(robot) || scenario.robot === robot)
    );
  }

  /** What methods add up to over a family, a robot or both; null: over all. */
  summary(family: string | null, robot: string | null): MethodSummary[] {
    return this.report.summary.filter((entry) => entry.family === family && entry.robot === robot);
  }

  /** Replay of a run, decoded on first use; null if there is none. */
  replay(run: Run): DecodedReplay | null {
    if (run.replay === null) return null;
    const known = this.#replays.get(run.replay);
    if (known) return known;
    const replay = at(this.report.replays, run.replay, "replay");
    const decoded = decode_replay(replay, run);
    this.#replays.set(run.replay, decoded);
    return decoded;
  }

  /** Scene of a scenario, decoded on first use; null if there is none. */
  scene(scenario: number): DecodedScene | null {
    const known = this.#scenes.get(scenario);
    if (known) return known;
    const scene = this.scenario(scenario).scene;
    if (!scene) return null;
    const decoded: DecodedScene = {
      scene,
      path: f32(scene.path),
      start_points: f32(scene.start_points),
      motion: scene.obstacles.map((obstacle) => (obstacle.motion === null ? null : f32(obstacle.motion))),
      solids: scene.solids.map((solid) => ({ vertices: f32(solid.vertices), triangles: u16(solid.triangles) })),
    };
    this.#scenes.set(scenario, decoded);
    return decoded;
  }
}

function decode_replay(replay: Replay, run: Run): DecodedReplay {
  return {
    run,
    rows: replay.rows,
    points: f32(replay.points),
    q: f32(replay.q),
    tip_error_m: f32(replay.tip_error_m),
    clearance_m: f32(replay.clearance_m),
    near_link: u8(replay.near_link),
    near_obstacle: u16(replay.near_obstacle),
    hit: u8(replay.hit),
    category: u8(replay.category),
    category_obstacle: u16(replay.category_obstacle),
  };
}

function at<T>(array: readonly T[], index: number, what: string): T {
  const value = array[index];
  if (value === undefined) throw new Error(`the report has no ${what} ${index}`);
  return value;
}

/** The data in the page. Throws if there are none or of another format. */
export function read_data(): ReportData {
  const text = document.getElementById("report-data")?.textContent ?? "";
  if (text.trim() === "" || text.startsWith("@"))
    throw new Error("this is the empty template; `bqsa-bench report DIR` fills it in");
  const report = JSON.parse(text) as Report;
  if (report.schema !== "bqsa-report/1")
    throw new Error(`the data are of format ${String(report.schema)}, expected bqsa-report/1`);
  return new ReportData(report);
}
