// A run on the stage: its replay in its scene, tick by tick.
import type { DecodedReplay, DecodedScene, Scenario } from "../data";
import { is_hit } from "./categories";
import { segment_distance } from "./distance";
import { criteria, unit_map, type Vector3 } from "./quadratic";

export interface Actor {
  name: string;
  scenario: Scenario;
  scene: DecodedScene;
  replay: DecodedReplay;
}

/** State of one link at a tick. */
export interface LinkState {
  start: number; ///< index of its first end's x in `replay.points`
  end: number; ///< the same of its second end
  radius: number; ///< [m]
  category: number;
  obstacle: number; ///< index of the obstacle that the category is of
  contact: boolean;
}

/** Row of a replay at a tick: a run that gave up stays where it stopped. */
export function row_at(actor: Actor, tick: number): number {
  return Math.min(Math.max(tick, 0), actor.replay.rows - 1);
}

/** Index of a point's x in `replay.points`. */
export function point_at(actor: Actor, row: number, point: number): number {
  return 3 * (row * actor.scene.scene.points + point);
}

/** Index of the tip's x in `replay.points`. */
export function tip_at(actor: Actor, row: number): number {
  return point_at(actor, row, actor.scene.scene.points - 1);
}

/** The links at a row. In contact is what the category calls a hit, and a link that touches with its radius; among
 *  solids what is in one, since the category is of the ellipsoids around them. */
export function link_states(actor: Actor, row: number): LinkState[] {
  const { scene, replay } = actor;
  return scene.scene.links.map((link, l) => {
    const cell = row * scene.scene.links.length + l;
    const state: LinkState = {
      start: point_at(actor, row, link.start),
      end: point_at(actor, row, link.end),
      radius: link.radius_m,
      category: replay.category[cell]!,
      obstacle: replay.category_obstacle[cell]!,
      contact: false,
    };
    state.contact =
      scene.scene.solids.length > 0 ? replay.hit[cell] === 1 : is_hit(state.category) || touches(actor, row, state);
    return state;
  });
}

/** Whether a link whose line is free touches the obstacle closest to it with its radius. */
function touches(actor: Actor, row: number, link: LinkState): boolean {
  const obstacle = actor.scene.scene.obstacles[link.obstacle];
  if (link.radius === 0 || !obstacle) return false;
  const { values, offset } = pose_at(actor.scene, link.obstacle, row);
  const { points } = actor.replay;
  return segment_distance(obstacle.semi_axes_m, values, offset, points, link.start, link.end) <= link.radius;
}

/** Pose of an obstacle at a tick: row-major 3x4 in `values` from `offset` on. */
export function pose_at(
  scene: DecodedScene,
  obstacle: number,
  tick: number,
): { values: ArrayLike<number>; offset: number } {
  const motion = scene.motion[obstacle];
  if (!motion) return { values: scene.scene.obstacles[obstacle]!.pose, offset: 0 };
  return { values: motion, offset: 12 * Math.min(Math.max(tick, 0), motion.length / 12 - 1) };
}

/** Where a link is deepest in an obstacle, in the obstacle's own metric [m]. */
export function deepest_point(actor: Actor, link: LinkState, tick: number): Vector3 {
  const { values, offset } = pose_at(actor.scene, link.obstacle, tick);
  const map = unit_map(actor.scene.scene.obstacles[link.obstacle]!.semi_axes_m, values, offset);
  const points = actor.replay.points;
  const t = criteria(map, points, link.start, link.end).vertex;
  const at = (k: number) => points[link.start + k]! + t * (points[link.end + k]! - points[link.start + k]!);
  return [at(0), at(1), at(2)];
}

/** Rows of about `count` postures spread over a run, first and last among them. */
export function ghost_rows(actor: Actor, count: number): number[] {
  const last = actor.replay.rows - 1;
  const steps = Math.min(count, last);
  return Array.from({ length: steps + 1 }, (_, i) => (steps === 0 ? 0 : Math.round((i * last) / steps)));
}

/** Smallest box around points, without those that are not finite. */
export interface Box {
  low: [number, number, number];
  high: [number, number, number];
}

export function empty_box(): Box {
  return { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
}

export function extend(box: Box, values: ArrayLike<number>): Box {
  for (let i = 0; i < values.length; ++i) {
    const value = values[i]!;
    if (!Number.isFinite(value)) continue;
    const k = i % 3;
    box.low[k] = Math.min(box.low[k]!, value);
    box.high[k] = Math.max(box.high[k]!, value);
  }
  return box;
}

/** What the first view shows: the arms all the way, the path, and obstacles as far as they do not reach far beyond
 *  that, nor below it in space. */
export function stage_box(actors: readonly Actor[]): Box {
  const box = empty_box();
  for (const actor of actors) extend(extend(box, actor.replay.points), actor.scene.path);
  const [low, high] = [[...box.low], [...box.high]];
  const most = Math.max(...[0, 1, 2].map((k) => high[k]! - low[k]!)) / 3;
  const { scene, scenario } = actors[0]!;
  scene.scene.obstacles.forEach((obstacle, o) => {
    const { values, offset } = pose_at(scene, o, 0);
    for (let k = 0; k < scenario.dimension; ++k) {
      const reach = Math.hypot(...[0, 1, 2].map((j) => values[offset + 4 * k + j]! * obstacle.semi_axes_m[j]!));
      const center = values[offset + 4 * k + 3]!;
      if (k < 2) box.low[k] = Math.min(box.low[k]!, Math.max(center - reach, low[k]! - most));
      box.high[k] = Math.max(box.high[k]!, Math.min(center + reach, high[k]! + most));
    }
  });
  return box;
}

/** Distance between grid lines that suits a range: 1, 2 or 5 times a power of ten, at least `range / most`. */
export function grid_step(range: number, most: number): number {
  const rough = range / most;
  const decade = 10 ** Math.floor(Math.log10(rough));
  return (rough <= decade ? 1 : rough <= 2 * decade ? 2 : rough <= 5 * decade ? 5 : 10) * decade;
}
