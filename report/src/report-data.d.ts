// Made from bqsa-report-1.schema.json by generate_types.mjs (npm run types); do not edit.

/**
 * The data of a report page, made by `bqsa-bench report`. SI units; keys end in the unit; numbers that do not exist are null. Bulk data are base64 of little-endian arrays: f32[a][b] is a rows of b IEEE 754 single-precision numbers, u8 and u16 are unsigned.
 */
export interface Report {
  /**
   * Name and version of this format.
   */
  schema: "bqsa-report/1";
  /**
   * Name of the campaign or directory.
   */
  title: string;
  /**
   * Program that made the page, with version and commit.
   */
  program: string;
  /**
   * When it was made, ISO 8601 UTC.
   */
  date: string;
  source: Source;
  /**
   * What a success is, in sentences.
   */
  success_means: string[];
  /**
   * In order of first appearance.
   */
  scenarios: Scenario[];
  /**
   * Variants, in order of first appearance.
   */
  methods: Method[];
  /**
   * By scenario, then variant.
   */
  runs: Run[];
  /**
   * Trajectories.
   */
  replays: Replay[];
  /**
   * What runs share.
   */
  origins: Origin[];
  /**
   * All scenarios first, then each family; then, where two or more robots have names, the same of each robot. Variants in the order of `methods`.
   */
  summary: MethodSummary[];
  /**
   * Null if there are none.
   */
  measurements: Measurements | null;
  /**
   * Null if there are none.
   */
  claims: Claims | null;
  /**
   * Empty if there are none.
   */
  figures: PaperFigure[];
  /**
   * Why figures are not publishable, and what is missing from the page.
   */
  warnings: string[];
}
/**
 * Where the runs come from, and what of the records is not in them.
 */
export interface Source {
  /**
   * The results directory as it was named.
   */
  directory: string;
  /**
   * Name of the campaign; null for single runs.
   */
  campaign: string | null;
  /**
   * Runs and pairs that do not fit in the campaign's plan; null without a plan.
   */
  planned: number | null;
  /**
   * Judged runs in `runs`.
   */
  runs: number;
  /**
   * Pairs of method and scenario in `runs` that do not fit each other.
   */
  not_applicable: number;
  /**
   * Records that a later run of the same replaces.
   */
  superseded: number;
  /**
   * Records that are not of the campaign's plan.
   */
  stale: number;
  /**
   * Lines that are not records: file, line number and why. Longer lists are cut, the last entry then says how many follow.
   */
  bad_lines: string[];
}
/**
 * A scenario file as the records describe it, with its scene where the file was found unchanged.
 */
export interface Scenario {
  /**
   * Name of the scenario.
   */
  name: string;
  /**
   * Path of its file as recorded.
   */
  file: string;
  /**
   * Of the file and the files it names.
   */
  sha256: string;
  /**
   * Family of generated scenarios; empty for others.
   */
  family: string;
  /**
   * Name of the robot; empty if it has none.
   */
  robot: string;
  /**
   * What the file says of it; empty if it says nothing or was not found.
   */
  description: string;
  /**
   * 2 in the plane, 3 in space.
   */
  dimension: number;
  /**
   * Number n of joints.
   */
  joints: number;
  /**
   * Number of links.
   */
  links: number;
  /**
   * Names of the ellipsoids that methods are told, in the order that `obstacle` indices count.
   */
  obstacles: string[];
  /**
   * Links times obstacles.
   */
  nk: number;
  /**
   * Number of control steps.
   */
  ticks: number;
  /**
   * Control period [s].
   */
  dt_s: number;
  /**
   * Largest tip error of a success at a tick [m].
   */
  tolerance_m: number;
  /**
   * Distance that methods are asked to keep [m].
   */
  margin_m: number;
  /**
   * Radius of all links, or of the thickest [m].
   */
  link_radius_m: number;
  /**
   * What the ellipsoids around solids cost; null if all obstacles are ellipsoids.
   */
  geometry: Geometry | null;
  /**
   * What is drawn; null if the file is missing or has changed since.
   */
  scene: Scene | null;
  /**
   * Why there is no scene; empty if there is one.
   */
  scene_missing: string;
}
/**
 * The geometry ledger of a scenario.
 */
export interface Geometry {
  /**
   * In the order of the scenario file.
   */
  solids: LedgerEntry[];
  /**
   * Bound of how much narrower the ellipsoids make a gap between two obstacles or parts: the largest sum of two inflations [m].
   */
  gap_lost_m: number;
  /**
   * Bound of how much further than the links' radius methods stay away that add it to the ellipsoids [m].
   */
  radius_excess_m: number;
}
/**
 * What the ellipsoids around one solid cost.
 */
export interface LedgerEntry {
  /**
   * Name of the obstacle.
   */
  name: string;
  /**
   * box, cylinder, capsule, mesh or points.
   */
  kind: string;
  /**
   * Convex ones.
   */
  parts: number;
  /**
   * Around all parts.
   */
  ellipsoids: number;
  /**
   * None of them reaches further beyond the solid [m].
   */
  inflation_m: number;
  /**
   * Volumes of the ellipsoids over those of the parts [-].
   */
  volume_ratio: number | null;
  /**
   * Whether the bounds that the scenario asks for were reached.
   */
  within_bounds: boolean;
  /**
   * Volumes of a mesh's hulls over that of the mesh [-]; null for other solids and meshes not closed.
   */
  hull_over_mesh: number | null;
}
/**
 * What is drawn of a scenario, in SI units and the world frame W.
 */
export interface Scene {
  /**
   * Number P of points of the chain: the base, each joint frame's origin, and the tip of a tool if there is one. The last one is the tip.
   */
  points: number;
  /**
   * Links, base to tip.
   */
  links: Link[];
  /**
   * What methods are told: ellipsoids in the order of the scenario file, those around one solid after each other.
   */
  obstacles: SceneObstacle[];
  /**
   * Obstacles as they are, of those that are no ellipsoids; the judge goes by these.
   */
  solids: SceneSolid[];
  /**
   * f32[ticks + 1][3]: desired tip x_d at each tick [m].
   */
  path: string;
  /**
   * f32[P][3]: points of the chain at the scenario's start angles [m]; what is drawn without a replay.
   */
  start_points: string;
  /**
   * Whether each joint slides, so that its values are metres; else it turns.
   */
  prismatic: boolean[];
  /**
   * Lower joint limits [rad], null where a joint has none; null if no joint has.
   */
  lower_rad: (number | null)[] | null;
  /**
   * Upper joint limits [rad; m of one that slides], likewise.
   */
  upper_rad: (number | null)[] | null;
  /**
   * The judge's limit of each joint's step in one tick [rad; m of one that slides].
   */
  max_joint_step_rad: number[];
}
/**
 * A link of positive length, drawn as a capsule between two points of the chain.
 */
export interface Link {
  /**
   * Number of the link as in the paper: its Denavit-Hartenberg row, from 1; a tool is one more.
   */
  number: number;
  /**
   * Index of its first end among the points.
   */
  start: number;
  /**
   * Index of its second end among the points.
   */
  end: number;
  /**
   * Its radius [m].
   */
  radius_m: number;
}
/**
 * A solid ellipsoid that envelops an obstacle.
 */
export interface SceneObstacle {
  /**
   * Name of the obstacle.
   */
  name: string;
  /**
   * Semi-axes along the ellipsoid's own x, y and z [m]. Of a planar scene the third is made up: the scene lies in z = 0.
   *
   * @minItems 3
   * @maxItems 3
   */
  semi_axes_m: [number, number, number];
  /**
   * Pose of the ellipsoid in the world frame W: the upper 3x4 of the homogeneous transform, row-major [r11 r12 r13 x, r21 r22 r23 y, r31 r32 r33 z]; rotation [-], position [m]. At t = 0.
   *
   * @minItems 12
   * @maxItems 12
   */
  pose: [number, number, number, number, number, number, number, number, number, number, number, number];
  /**
   * f32[ticks + 1][12]: such a pose at each tick; null if the obstacle is at rest.
   */
  motion: string | null;
  /**
   * Index into the scene's solids of the one that the ellipsoid, perhaps with others, is around; null if the obstacle is the ellipsoid itself.
   */
  shape: number | null;
}
/**
 * A solid as triangles, counterclockwise from outside.
 */
export interface SceneSolid {
  /**
   * Name of the obstacle.
   */
  name: string;
  /**
   * Index of the first ellipsoid around it, with which it moves.
   */
  obstacle: number;
  /**
   * f32[V][3]: corners in W at t = 0 [m].
   */
  vertices: string;
  /**
   * u16[T][3]: indices of corners.
   */
  triangles: string;
}
/**
 * A variant of a method: a method with parameter values, and what disturbed it.
 */
export interface Method {
  /**
   * Name of the method.
   */
  name: string;
  /**
   * Name of the variant, `bqsa` or `bqsa@1a2b3c4d`: what tables show.
   */
  variant: string;
  /**
   * Parameters that differ from their defaults, `key=value,...`; empty if none does.
   */
  changed: string;
  /**
   * One line about the method; empty if not known to this program.
   */
  description: string;
  /**
   * All parameters.
   */
  parameters: Parameter[];
  /**
   * Whether it plans the whole motion ahead; else it answers tick by tick.
   */
  plans: boolean;
  /**
   * Whether it is a program of its own, answering through a pipe.
   */
  external: boolean;
}
/**
 * A parameter of a method as recorded.
 */
export interface Parameter {
  /**
   * Name.
   */
  name: string;
  /**
   * Value, all digits, or name of a choice.
   */
  value: string;
  /**
   * Unit, `-` for dimensionless; empty if not known to this program.
   */
  unit: string;
  /**
   * What it means; empty if not known to this program.
   */
  meaning: string;
  /**
   * Whether it differs from the default.
   */
  changed: boolean;
}
/**
 * A judged run; or a pair of method and scenario that do not fit, of which only the first fields count.
 */
export interface Run {
  /**
   * Index into `scenarios`.
   */
  scenario: number;
  /**
   * Index into `methods`.
   */
  method: number;
  /**
   * Repetition in a campaign, from 1; null for single runs.
   */
  repetition: number | null;
  /**
   * Random seed, all digits, of a method that plans or a run that was disturbed; null otherwise.
   */
  seed: string | null;
  /**
   * Whether the method can be asked this problem.
   */
  applicable: boolean;
  /**
   * Why not; empty if it can.
   */
  why_not: string;
  /**
   * As judged.
   */
  success: boolean;
  /**
   * What the method claims: `success`, `gave up at tick 7`, `nothing`, `crashed`, ...
   */
  claimed: string;
  /**
   * Why, if the method says so, or what the system says of a crash; else empty.
   */
  claim_detail: string;
  /**
   * Whether claim and verdict agree; of a method that claims nothing they do.
   */
  claim_holds: boolean;
  /**
   * Names of the judge's failures, the most telling first; empty for a success.
   */
  failures: string[];
  /**
   * Came within 1e-6 m of contact: free, flagged.
   */
  touching: boolean;
  /**
   * Where the judge's two distances contradict each other; else empty.
   */
  disagreement: string;
  /**
   * Links in obstacles, by first tick.
   */
  contacts: Contact[];
  /**
   * Links in other links, by first tick; empty too if self-collision was not judged.
   */
  self_contacts: SelfContact[];
  /**
   * Pairs that the method says it kept apart.
   */
  clamped: Clamped[];
  /**
   * Name of the reason why the method gave up; else empty.
   */
  gave_up: string;
  /**
   * Rows of the trajectory, the start included.
   */
  rows: number | null;
  /**
   * Tick of the first collision, or at which the method gave up; null if there is none.
   */
  failure_tick: number | null;
  /**
   * Mean tip error at the ticks [m].
   */
  tip_error_mean_m: number | null;
  /**
   * Root mean square tip error at the ticks [m].
   */
  tip_error_rms_m: number | null;
  /**
   * Largest tip error at the ticks [m].
   */
  tip_error_max_m: number | null;
  /**
   * Tick of it.
   */
  tip_error_max_tick: number | null;
  /**
   * Largest tip error between ticks, on the straight joint motion [m].
   */
  tip_error_between_max_m: number | null;
  /**
   * Largest angle at the ticks by which the tip is turned away from what is desired [rad]; null where the task has no orientation.
   */
  orientation_max_rad: number | null;
  /**
   * Tick of it.
   */
  orientation_max_tick: number | null;
  /**
   * The same between ticks [rad].
   */
  orientation_between_max_rad: number | null;
  /**
   * Tip error of the start [m]; it does not count against the method.
   */
  start_error_m: number | null;
  /**
   * Least clearance of a link, with its radius, from an obstacle, at and between ticks [m]; negative in a collision.
   */
  clearance_m: number | null;
  /**
   * The same at the ticks only [m].
   */
  clearance_at_ticks_m: number | null;
  /**
   * Least clearance at the ticks of a link from another, with their radii, of the pairs that are judged [m]; null if self-collision was not judged.
   */
  self_clearance_at_ticks_m: number | null;
  /**
   * Largest step in one tick of a joint that turns [rad].
   */
  max_joint_step_rad: number | null;
  /**
   * Tick of it.
   */
  max_joint_step_tick: number | null;
  /**
   * Largest step in one tick of a joint that slides [m]; null if none does.
   */
  max_joint_slide_m: number | null;
  /**
   * Tick of it.
   */
  max_joint_slide_tick: number | null;
  /**
   * Joint drift after a closed path, |q(T) - q(0)| [rad]; null for an open one, an unfinished run or a start beside the path.
   */
  closed_path_drift_rad: number | null;
  /**
   * The same of the joint that drifts most [rad].
   */
  closed_path_drift_joint_rad: number | null;
  /**
   * Least manipulability sqrt(det(J J')) of the position Jacobian at a tick from 1 on [m², in space m³]; like all figures of the motion from here on null in older records.
   */
  manipulability_min: number | null;
  /**
   * Its mean over the ticks [m², in space m³].
   */
  manipulability_mean: number | null;
  /**
   * Least singular value of the position Jacobian at a tick [m].
   */
  singular_value_min_m: number | null;
  /**
   * Part of the squared joint motion that does not move the tip, from 0 to 1.
   */
  null_space_share: number | null;
  /**
   * Root mean square over joints and ticks of the joints' jerk [rad/s³].
   */
  jerk_rms_rad_s3: number | null;
  /**
   * Times that the method, by its own account, began to clear a link of an obstacle.
   */
  clamp_starts: number | null;
  /**
   * Median time of a control step [s]. Null unless the run was judged a success: an invalid run is never fast.
   */
  step_median_s: number | null;
  /**
   * 99 % quantile of the same [s]. Null unless the run was judged a success: an invalid run is never fast.
   */
  step_p99_s: number | null;
  /**
   * 99.9 % quantile of the same [s]. Null unless the run was judged a success: an invalid run is never fast.
   */
  step_p999_s: number | null;
  /**
   * Slowest control step, the first apart [s]. Null unless the run was judged a success: an invalid run is never fast.
   */
  step_max_s: number | null;
  /**
   * Tick of it.
   */
  step_max_tick: number | null;
  /**
   * Time of planning [s]. Null unless the run was judged a success: an invalid run is never fast.
   */
  plan_s: number | null;
  /**
   * Wall time of the whole run [s]. Null unless the run was judged a success: an invalid run is never fast.
   */
  run_s: number | null;
  /**
   * Why its times are only indicative; empty if they can be published.
   */
  times_indicative: string[];
  /**
   * Its times include the pipe to an external program.
   */
  includes_pipe: boolean;
  /**
   * Work that the run took, by name (quadratics, point_pairs, distance_queries, kinematics, jacobians, linear_solves, iterations ...); null if it is not known.
   */
  counters: {
    [k: string]: number | undefined;
  } | null;
  /**
   * Index into `origins`.
   */
  origin: number;
  /**
   * When it began, ISO 8601 UTC.
   */
  date: string;
  /**
   * Of the machine when it began.
   */
  load_average: number | null;
  /**
   * File and line of its record, `runs.jsonl:7`.
   */
  record: string;
  /**
   * Index into `replays`; null if there is none.
   */
  replay: number | null;
  /**
   * Why there is no replay; empty if there is one, or the pair does not fit.
   */
  no_replay: string;
}
/**
 * A link that the judge found in an obstacle.
 */
export interface Contact {
  /**
   * Number of the link.
   */
  link: number;
  /**
   * Name of the obstacle.
   */
  obstacle: string;
  /**
   * First tick at whose end, or in the motion to which, they are in contact.
   */
  first_tick: number;
  /**
   * Seen at a tick, not only between two.
   */
  at_tick: boolean;
  /**
   * Number of ticks at which they are in contact.
   */
  ticks: number;
}
/**
 * Two links that the judge found in each other.
 */
export interface SelfContact {
  /**
   * Number of the link nearer to the base.
   */
  link: number;
  /**
   * Number of the other one, nearer to the tip.
   */
  other_link: number;
  /**
   * First tick at whose end, or in the motion to which, they are in contact.
   */
  first_tick: number;
  /**
   * Seen at a tick, not only between two.
   */
  at_tick: boolean;
  /**
   * Number of ticks at which they are in contact.
   */
  ticks: number;
}
/**
 * A pair for which the method says that it had to move a link away.
 */
export interface Clamped {
  /**
   * Number of the link.
   */
  link: number;
  /**
   * Name of the obstacle.
   */
  obstacle: string;
  /**
   * Number of ticks.
   */
  ticks: number;
}
/**
 * A trajectory as the judge sees it. R rows, row 0 being the start; P points, L links and J joints of the scenario. Numbers that are not finite in the trajectory are not finite here.
 */
export interface Replay {
  /**
   * Index into `runs`.
   */
  run: number;
  /**
   * Number R of rows.
   */
  rows: number;
  /**
   * f32[R][P][3]: points of the chain by the judge's kinematics [m].
   */
  points: string;
  /**
   * f32[R][J]: joint angles [rad].
   */
  q: string;
  /**
   * f32[R]: distance of the tip from x_d [m].
   */
  tip_error_m: string;
  /**
   * f32[R]: exact distance between links and obstacles as they are, less the link radius [m], negative inside; +infinity without obstacles.
   */
  clearance_m: string;
  /**
   * u8[R]: number of the link that it belongs to; 255 without obstacles.
   */
  near_link: string;
  /**
   * u16[R]: index of the obstacle that it belongs to, of a solid that of its ellipsoid nearest to the link; 65535 without obstacles.
   */
  near_obstacle: string;
  /**
   * u8[R][L]: 1 for a link that is, with its radius, in an obstacle as it is; else 0.
   */
  hit: string;
  /**
   * u8[R][L]: category 1 to 5 of the paper's quadratic, of each link with the obstacle nearest to it; 255 without obstacles. 1 and 2 are free; 3, 4 and 5 are hits of the link's line (not of its radius).
   */
  category: string;
  /**
   * u16[R][L]: index of that obstacle; 65535 without obstacles. The criteria of any pair follow from `points` and the obstacle's pose: with u(p) = diag(1 / semi_axes) R' (p - centre), S11 = |u1|^2 - 1, S22 = |u2|^2 - 1 (levels of the two ends: negative inside), S12 = u1.u2 - 1 and Delta / 4 = S12^2 - S11 S22 (positive where the link's line enters).
   */
  category_obstacle: string;
}
/**
 * Build, machine and limits that runs share.
 */
export interface Origin {
  /**
   * Short name: program, compiler, processor.
   */
  label: string;
  /**
   * Name and value of each fact, as text.
   */
  values: [string, string][];
}
/**
 * What the runs of a variant add up to over all scenarios, or over one family, one robot or both. Statistics as the program's own summary has them.
 */
export interface MethodSummary {
  /**
   * Family; a scenario that is not generated is one of its own; null: all scenarios.
   */
  family: string | null;
  /**
   * Robot; null: all of them, and those without a name.
   */
  robot: string | null;
  /**
   * Index into `methods`.
   */
  method: number;
  /**
   * Judged runs.
   */
  runs: number;
  /**
   * Pairs that do not fit.
   */
  not_applicable: number;
  /**
   * Runs that are not repetitions of each other: what the interval of the rate rests on.
   */
  problems: number;
  /**
   * Runs judged a success.
   */
  successes: number;
  /**
   * Share of successes; null without runs.
   */
  rate: number | null;
  /**
   * Wilson's 95 % interval of it.
   */
  rate_lower: number | null;
  /**
   * Wilson's 95 % interval of it.
   */
  rate_upper: number | null;
  /**
   * Runs whose claim the judge contradicts.
   */
  wrong_claims: number;
  /**
   * Number of failed runs by class, as the program's summary names them.
   */
  failures: {
    [k: string]: number | undefined;
  };
  /**
   * Median over successes of the largest tip error at ticks [m].
   */
  tip_error_median_m: number | null;
  /**
   * Bootstrap 95 % interval of it [m].
   */
  tip_error_median_lower_m: number | null;
  /**
   * Bootstrap 95 % interval of it [m].
   */
  tip_error_median_upper_m: number | null;
  /**
   * The largest of them [m].
   */
  tip_error_max_m: number | null;
  /**
   * Least clearance of the successes [m].
   */
  clearance_min_m: number | null;
  /**
   * Median over the successes that have one of the joint drift after a closed path [rad]; null if none has.
   */
  closed_path_drift_median_rad: number | null;
  /**
   * Median over the successes of their least manipulability [m², in space m³].
   */
  manipulability_min_median: number | null;
  /**
   * Median over the successes of the part of the squared joint motion that does not move the tip.
   */
  null_space_share_median: number | null;
  /**
   * Median over the successes of the root mean square of the joints' jerk [rad/s³].
   */
  jerk_rms_median_rad_s3: number | null;
  /**
   * Median over successes of the run's median time of a control step [s]; null where there is none.
   */
  step_median_s: number | null;
  /**
   * Bootstrap 95 % interval of it [s].
   */
  step_median_lower_s: number | null;
  /**
   * Bootstrap 95 % interval of it [s].
   */
  step_median_upper_s: number | null;
  /**
   * 99 % quantile of the times of all their steps [s].
   */
  step_p99_s: number | null;
  /**
   * Slowest of them [s].
   */
  step_max_s: number | null;
  /**
   * Median time of a plan over successes [s].
   */
  plan_median_s: number | null;
  /**
   * Nothing speaks against these times.
   */
  times_publishable: boolean;
  /**
   * True: has the highest success rate of the scope, of equal ones that of more runs, or ties with it, and every other variant with runs is decided. False: worse than it. Null: too little to tell, no other variant to compare with, or without runs. Decided by the 95 % bootstrap interval of the mean difference, paired by scenario file over those that both ran, with seeds and repetitions averaged: a tie if it contains 0; not decided below 6 pairs, if the variant does better there than the leader, or if it ties without a success.
   */
  best_rate: boolean | null;
  /**
   * The same of the median tip error among those with true `best_rate`, by the median difference over the scenario files on which both succeed, of each the median over its successes; null for all others.
   */
  best_tip_error: boolean | null;
  /**
   * The same of the median time per step, by ratios; null for all if one of these times is only indicative.
   */
  best_step: boolean | null;
}
/**
 * What `measure` found, without sweeps of one size.
 */
export interface Measurements {
  /**
   * File they were read from.
   */
  file: string;
  /**
   * Whether the times can be published.
   */
  publishable: boolean;
  /**
   * Why not.
   */
  against: string[];
  /**
   * Name and value of each fact about build and machine.
   */
  context: [string, string][];
  /**
   * In order of measuring.
   */
  sweeps: Sweep[];
}
/**
 * Times over a range of sizes.
 */
export interface Sweep {
  /**
   * Name of the sweep, `plane_nm`.
   */
  name: string;
  /**
   * For people.
   */
  title: string;
  /**
   * Quantity of the axis: test points of a link times those of an obstacle, or links times obstacles.
   */
  axis: "NM" | "nk";
  /**
   * For people.
   */
  axis_label: string;
  /**
   * What is the same at all sizes, `nk = 27`.
   */
  fixed: string;
  /**
   * Whether times are of one pass of a detector over all pairs, or of one control step.
   */
  of: "pass" | "step";
  /**
   * Contestants.
   */
  series: SweepSeries[];
  /**
   * Those that there are.
   */
  crossovers: Crossover[];
}
/**
 * A contestant of a sweep.
 */
export interface SweepSeries {
  /**
   * Name of the detector or method.
   */
  name: string;
  /**
   * The same for people.
   */
  label: string;
  /**
   * By size; sizes at which it was not measured are left out.
   */
  points: SweepPoint[];
  /**
   * What `counts` counts; empty if nothing.
   */
  counted: string;
  /**
   * By size; empty if nothing is counted.
   */
  counts: {
    /**
     * Quantity of the axis [-].
     */
    x: number;
    /**
     * Number of operations.
     */
    value: number;
  }[];
  /**
   * time ~ axis^exponent over the larger half of the sizes; null if there are too few.
   */
  fit: PowerFit | null;
}
/**
 * Time at one size.
 */
export interface SweepPoint {
  /**
   * Quantity of the axis [-].
   */
  x: number;
  /**
   * Geometric mean over processes of the median time of a pass, or of a control step [s].
   */
  time_s: number;
  /**
   * 95 % interval over processes [s]; null from one process.
   */
  lower_s: number | null;
  /**
   * 95 % interval over processes [s]; null from one process.
   */
  upper_s: number | null;
}
/**
 * A power fitted to times.
 */
export interface PowerFit {
  /**
   * Exponent [-].
   */
  exponent: number;
  /**
   * 95 % interval over processes.
   */
  lower: number | null;
  /**
   * 95 % interval over processes.
   */
  upper: number | null;
  /**
   * From this size on.
   */
  from_x: number;
  /**
   * The same in words.
   */
  text: string;
}
/**
 * Where the first of two series starts to take longer than the second and goes on to.
 */
export interface Crossover {
  /**
   * Name of a series.
   */
  a: string;
  /**
   * Name of a series.
   */
  b: string;
  /**
   * Quantity of the axis [-].
   */
  x: number;
  /**
   * 95 % interval.
   */
  lower: number | null;
  /**
   * 95 % interval.
   */
  upper: number | null;
  /**
   * The same in words.
   */
  text: string;
}
/**
 * What `claims` found.
 */
export interface Claims {
  /**
   * File they were read from.
   */
  file: string;
  /**
   * `quick` or `full`.
   */
  effort: string;
  /**
   * Program and compiler.
   */
  build: string;
  /**
   * Machine and date.
   */
  machine: string;
  /**
   * In the order of the claims file.
   */
  claims: Claim[];
}
/**
 * A claim of the paper or of this project, judged.
 */
export interface Claim {
  /**
   * Identifier.
   */
  id: string;
  /**
   * What is claimed.
   */
  statement: string;
  /**
   * Where.
   */
  source: string;
  /**
   * Whether it is the paper's.
   */
  paper: boolean;
  /**
   * What was found.
   */
  verdict: string;
  /**
   * Verdict that is expected.
   */
  expected: string;
  /**
   * Whether the verdict is the one expected.
   */
  standing: string;
  /**
   * Why the verdict cannot be reached, or what differs; may be empty.
   */
  reason: string;
  /**
   * Numbers found.
   */
  figures: ClaimFigure[];
  /**
   * The claim as it stands.
   */
  as_stated: ClaimBound[];
  /**
   * The claim as corrected, in words; empty if there is no correction.
   */
  correction: string;
  /**
   * Its bounds; empty if there is no correction.
   */
  corrected: ClaimBound[];
  /**
   * What else there is to say.
   */
  remarks: string[];
  /**
   * Explanation; may be empty.
   */
  note: string;
}
/**
 * A number that a claim rests on.
 */
export interface ClaimFigure {
  /**
   * Name.
   */
  name: string;
  /**
   * Value in its unit; null if there is none.
   */
  value: number | null;
  /**
   * Interval, null where unbounded or absent.
   */
  lower: number | null;
  /**
   * Interval, null where unbounded or absent.
   */
  upper: number | null;
  /**
   * Unit, `-` for dimensionless.
   */
  unit: string;
  /**
   * What it is.
   */
  meaning: string;
}
/**
 * A bound that a claim states, and what came of it.
 */
export interface ClaimBound {
  /**
   * Name of the figure.
   */
  figure: string;
  /**
   * The bound in words, `at most 0.001`.
   */
  bound: string;
  /**
   * `holds`, `fails` or `undecided`.
   */
  outcome: string;
}
/**
 * A figure that `figures` drew, beside the page.
 */
export interface PaperFigure {
  /**
   * Name of its files.
   */
  name: string;
  /**
   * What it shows.
   */
  title: string;
  /**
   * Where it stands in the paper, `Fig. 8`; `-` if it does not.
   */
  paper: string;
  /**
   * At least one.
   */
  files: {
    /**
     * `svg`, `png`, `csv`, `gp` or name of a part of the data.
     */
    label: string;
    /**
     * Address relative to the page, percent-encoded.
     */
    href: string;
  }[];
}
