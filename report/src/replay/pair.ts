// A link and an obstacle over a whole run.
import { pose_at, point_at, type Actor } from "./actor";
import { criteria, shadow_map, type Criteria, type Plane } from "./quadratic";

export interface PairCriteria {
  ticks: Criteria[];
}

/** Criteria of a link (index among the drawn ones) and an obstacle at every row, in space or as seen on a plane. */
export function pair_criteria(actor: Actor, link: number, obstacle: number, plane: Plane): PairCriteria {
  const { scene, replay } = actor;
  const { start, end } = scene.scene.links[link]!;
  const axes = scene.scene.obstacles[obstacle]!.semi_axes_m;
  const ticks: Criteria[] = [];
  let map = null;
  for (let row = 0; row < replay.rows; ++row) {
    if (map === null || scene.motion[obstacle]) {
      const { values, offset } = pose_at(scene, obstacle, row);
      map = shadow_map(axes, values, plane, offset);
    }
    ticks.push(criteria(map, replay.points, point_at(actor, row, start), point_at(actor, row, end)));
  }
  return { ticks };
}

/** The pair that a run is about: its first contact, else the one it had to move away most often, else the closest one.
 *  Indices among drawn links and obstacles; null without either. */
export function telling_pair(actor: Actor): { link: number; obstacle: number } | null {
  const { scene, replay } = actor;
  const { run } = replay;
  const named = (number: number, obstacle: string) => ({
    link: scene.scene.links.findIndex((link) => link.number === number),
    obstacle: scene.scene.obstacles.findIndex((candidate) => candidate.name === obstacle),
  });
  const clamped = [...run.clamped].sort((a, b) => b.ticks - a.ticks)[0];
  const told = run.contacts[0] ?? clamped;
  if (told) {
    const pair = named(told.link, told.obstacle);
    if (pair.link >= 0 && pair.obstacle >= 0) return pair;
  }
  let closest = 0;
  for (let row = 1; row < replay.rows; ++row)
    if (replay.clearance_m[row]! < replay.clearance_m[closest]!) closest = row;
  const link = scene.scene.links.findIndex((candidate) => candidate.number === replay.near_link[closest]);
  const obstacle = replay.near_obstacle[closest] ?? 65535;
  if (link >= 0 && obstacle < scene.scene.obstacles.length) return { link, obstacle };
  return scene.scene.links.length > 0 && scene.scene.obstacles.length > 0 ? { link: 0, obstacle: 0 } : null;
}
