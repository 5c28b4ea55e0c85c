// Where names stand in a picture, so that none covers another.

/** A text in a picture, by its middle [pixels]; y goes down. */
export interface Place {
  x: number;
  y: number;
  width: number;
  height: number;
}

const kWays = [0, -1, 1, -2, 2, -3, 3, -4, 4, -5, 5]; ///< tried in turn

const overlap = (a: Place, b: Place): boolean =>
  2 * Math.abs(a.x - b.x) < a.width + b.width && 2 * Math.abs(a.y - b.y) < a.height + b.height;

/** How far each name moves down, by its height, to cover neither those before it nor what is `taken`; 0 where there is no
 *  room up to five heights away. */
export function ways_down(names: readonly Place[], taken: readonly Place[]): number[] {
  const placed = [...taken];
  return names.map((name) => {
    const moved = (way: number): Place => ({ ...name, y: name.y + way * name.height });
    const way = kWays.find((one) => !placed.some((other) => overlap(moved(one), other))) ?? 0;
    placed.push(moved(way));
    return way;
  });
}
