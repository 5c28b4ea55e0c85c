// The paper's quadratic of a link and an ellipsoid (section 3.1), computed from positions.
//
// Along the link P(t) = P1 + t (P2 - P1), t in [0, 1], the level of the ellipsoid is f(t) = alpha t² + beta t + gamma,
// negative inside. The paper writes it in x; its criteria over (x_max - x_min)², as in the remade Fig. 9, are those of
// f(t), which also hold for a vertical link. The five categories are those of Fig. 3.

/** A vector of the world frame W [m]. */
export type Vector3 = readonly [number, number, number];

/** Where an ellipsoid is seen: in space (in the plane, for planar scenes), or as a shadow. */
export type Plane = "space" | "XOY" | "YOZ" | "XOZ";

/** u = rows (p - center): the point as the ellipsoid sees it, |u| = 1 on the surface. */
export interface UnitMap {
  rows: readonly Vector3[];
  center: Vector3;
}

/** What the categories are decided by, all dimensionless, and the category. */
export interface Criteria {
  /** Delta = beta² - 4 alpha gamma; the line does not enter the ellipsoid where it is <= 0. */
  discriminant: number;
  /** f(0), level of the link's first end. */
  start: number;
  /** f(1), level of the link's second end. */
  end: number;
  /** f'(0) f'(1); negative where the deepest point lies between the ends. */
  slope_product: number;
  /** t of the deepest point in the ellipsoid's own metric, in [0, 1]. */
  vertex: number;
  /** 1 to 5, Fig. 3. */
  category: number;
}

const kCoordinates: Record<Exclude<Plane, "space">, readonly [number, number]> = {
  XOY: [0, 1],
  YOZ: [1, 2],
  XOZ: [0, 2],
};

/** The unit map of an ellipsoid. `pose` is a row-major 3x4 [R | p] that starts at `offset`, and `semi_axes` are the
 *  lengths along the ellipsoid's own axes [m]. */
export function unit_map(semi_axes: readonly number[], pose: ArrayLike<number>, offset = 0): UnitMap {
  const at = (row: number, column: number) => pose[offset + 4 * row + column]!;
  const row = (k: number): Vector3 => {
    const a = semi_axes[k]!;
    return [at(0, k) / a, at(1, k) / a, at(2, k) / a];
  };
  return { rows: [row(0), row(1), row(2)], center: [at(0, 3), at(1, 3), at(2, 3)] };
}

/** The unit map of an ellipsoid's shadow on a coordinate plane (Lemma 1): the ellipse whose matrix is the inverse of
 *  the projected R diag(a²) Rᵀ, by Cholesky. */
export function shadow_map(semi_axes: readonly number[], pose: ArrayLike<number>, plane: Plane, offset = 0): UnitMap {
  const map = unit_map(semi_axes, pose, offset);
  if (plane === "space") return map;
  const [i, j] = kCoordinates[plane];
  const spread = (row: number, column: number) =>
    [0, 1, 2].reduce(
      (sum, k) => sum + pose[offset + 4 * row + k]! * pose[offset + 4 * column + k]! * semi_axes[k]! ** 2,
      0,
    );
  const l11 = Math.sqrt(spread(i, i));
  const l21 = spread(j, i) / l11;
  const l22 = Math.sqrt(spread(j, j) - l21 * l21);
  const first: [number, number, number] = [0, 0, 0];
  const second: [number, number, number] = [0, 0, 0];
  first[i] = 1 / l11;
  second[i] = -l21 / (l11 * l22);
  second[j] = 1 / l22;
  return { rows: [first, second], center: map.center };
}

/** Criteria of the link between two points, each starting at an index of `points` [m]. */
export function criteria(map: UnitMap, points: ArrayLike<number>, first: number, second: number): Criteria {
  let alpha = 0;
  let half_beta = 0;
  let start = -1;
  let end = -1;
  for (const row of map.rows) {
    let u1 = 0;
    let u2 = 0;
    for (let k = 0; k < 3; ++k) {
      u1 += row[k]! * (points[first + k]! - map.center[k]!);
      u2 += row[k]! * (points[second + k]! - map.center[k]!);
    }
    alpha += (u2 - u1) * (u2 - u1);
    half_beta += u1 * (u2 - u1);
    start += u1 * u1;
    end += u2 * u2;
  }
  const discriminant = 4 * (half_beta * half_beta - alpha * start);
  const towards = -half_beta;
  const vertex = towards <= 0 ? 0 : towards < alpha ? towards / alpha : 1;
  return {
    discriminant,
    start,
    end,
    slope_product: 4 * half_beta * (alpha + half_beta),
    vertex,
    category: category(discriminant, start, end, towards > 0 && towards < alpha),
  };
}

/** Touching counts as a hit, as in the program. */
function category(discriminant: number, start: number, end: number, vertex_within: boolean): number {
  if (start <= 0 && end <= 0) return 5;
  if (start <= 0 || end <= 0) return 4;
  if (vertex_within && discriminant >= 0) return 3;
  return discriminant <= 0 ? 1 : 2;
}
