// Which contestants of a sweep are shown at first, and how they look.
import type { Sweep, SweepSeries } from "../data";

/** The paper's two contestants are shown from the start, and of each kind of contestant the fastest. */
const kOfThePaper = ["bqsa_paper", "test_points", "test_point"];

function time_at_end(series: SweepSeries): number {
  return series.points[series.points.length - 1]?.time_s ?? Infinity;
}

/** Names of the series that are shown until somebody chooses. */
export function shown_at_first(sweep: Sweep): Set<string> {
  const fastest = new Map<string, SweepSeries>();
  for (const series of sweep.series) {
    const kind = series.name.split("_")[0] ?? "";
    const best = fastest.get(kind);
    if (!best || time_at_end(series) < time_at_end(best)) fastest.set(kind, series);
  }
  const names = new Set([...fastest.values()].map((series) => series.name));
  for (const name of kOfThePaper) if (sweep.series.some((series) => series.name === name)) names.add(name);
  return names;
}

/** Which look a series has: those shown at first come first, so that they have colours of their own. */
export function looks(sweep: Sweep): number[] {
  const first = shown_at_first(sweep);
  const order = [...sweep.series].sort((a, b) => Number(first.has(b.name)) - Number(first.has(a.name)));
  return sweep.series.map((series) => order.indexOf(series));
}
