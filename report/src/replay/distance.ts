// Distance between a link's line and an ellipsoid, for links that have a thickness.
import type { Vector3 } from "./quadratic";

const kGoldenSection = (Math.sqrt(5) - 1) / 2;
const kSections = 40; ///< narrow t to 4e-9
const kNewtonSteps = 60; ///< at most; far fewer are needed

/** Distance of a point, in the ellipsoid's own axes, from the solid ellipsoid [m]; 0 inside. The closest point is
 *  x = a² y / (s + a²) with the s >= 0 that puts it on the surface, found by Newton's method from the left. */
function distance_of_point(axes: readonly number[], y: Vector3): number {
  let s = 0;
  for (let step = 0; step < kNewtonSteps; ++step) {
    let level = -1;
    let slope = 0;
    for (let k = 0; k < 3; ++k) {
      const reach = s + axes[k]! ** 2;
      const share = ((axes[k]! * y[k]!) / reach) ** 2;
      level += share;
      slope -= (2 * share) / reach;
    }
    if (level <= 0) break;
    const next = s - level / slope;
    if (next <= s) break;
    s = next;
  }
  return Math.hypot(...y.map((value, k) => value - (axes[k]! ** 2 * value) / (s + axes[k]! ** 2)));
}

/** Distance of the segment between two points, each starting at an index of `points`, from the solid ellipsoid of a
 *  pose (row-major 3x4 from `offset` on) [m]. Along the segment the distance is convex: golden sections find its least. */
export function segment_distance(
  axes: readonly number[],
  pose: ArrayLike<number>,
  offset: number,
  points: ArrayLike<number>,
  first: number,
  second: number,
): number {
  const own = (at: number): Vector3 => {
    const coordinate = (k: number) =>
      [0, 1, 2].reduce((sum, i) => sum + pose[offset + 4 * i + k]! * (points[at + i]! - pose[offset + 4 * i + 3]!), 0);
    return [coordinate(0), coordinate(1), coordinate(2)];
  };
  const [p1, p2] = [own(first), own(second)];
  const at = (t: number) =>
    distance_of_point(axes, [0, 1, 2].map((k) => p1[k]! + t * (p2[k]! - p1[k]!)) as unknown as Vector3);
  let [low, high] = [0, 1];
  let [t1, t2] = [1 - kGoldenSection, kGoldenSection];
  let [d1, d2] = [at(t1), at(t2)];
  for (let section = 0; section < kSections; ++section) {
    if (d1 < d2) {
      [high, t2, d2] = [t2, t1, d1];
      t1 = high - kGoldenSection * (high - low);
      d1 = at(t1);
    } else {
      [low, t1, d1] = [t1, t2, d2];
      t2 = low + kGoldenSection * (high - low);
      d2 = at(t2);
    }
  }
  return Math.min(d1, d2, at(0), at(1));
}
