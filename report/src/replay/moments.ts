// The ticks of a run that are worth a look.
import type { DecodedReplay, Scene } from "../data";
import { degrees } from "../format";
import { jumps } from "../jumps";

export interface Moment {
  key: "contact" | "error" | "jump" | "tilt" | "clearance" | "slow" | "end";
  label: string;
  tick: number | null;
  /** Why there is no such tick, or what happens at it. */
  note: string;
}

/** Index of the smallest of the finite values from `from` on; null if there is none. */
function least(values: Float32Array, from: number, sign: 1 | -1): number | null {
  let best: number | null = null;
  for (let i = from; i < values.length; ++i) {
    if (!Number.isFinite(values[i]!)) continue;
    if (best === null || sign * values[i]! < sign * values[best]!) best = i;
  }
  return best;
}

/** First contact with an obstacle or of two links, largest tip error (the start's does not count), jumps, the tick at which
 *  the tip is turned away most where the task has an orientation, least clearance, slowest tick and end; all but the least
 *  clearance as the judge has them. */
export function moments(replay: DecodedReplay, scene: Scene): Moment[] {
  const { run } = replay;
  const contacts = [
    ...run.contacts.map((c) => ({ tick: c.first_tick, note: `link ${c.link} in ${c.obstacle}` })),
    ...run.self_contacts.map((c) => ({ tick: c.first_tick, note: `link ${c.link} in link ${c.other_link}` })),
  ];
  const first = contacts.sort((a, b) => a.tick - b.tick)[0];
  const end = replay.rows - 1;
  const past_start = (tick: number | null) => (tick === null || tick === 0 || end === 0 ? null : tick);
  const within = (tick: number | null) => (tick === null ? null : Math.min(tick, end));
  return [
    {
      key: "contact",
      label: "first contact",
      tick: within(first?.tick ?? null),
      note:
        first?.note ??
        (run.self_clearance_at_ticks_m === null
          ? "no link was in an obstacle"
          : "no link was in an obstacle or in another link"),
    },
    {
      key: "error",
      label: "largest tip error",
      tick: within(past_start(run.tip_error_max_tick) ?? least(replay.tip_error_m, 1, -1)),
      note: "at a tick after the start",
    },
    ...jumps(run, scene).map(({ size, tick }): Moment => ({
      key: "jump",
      label: "jump",
      tick: within(tick),
      note: size,
    })),
    ...(run.orientation_max_rad === null
      ? []
      : [
          {
            key: "tilt",
            label: "most turned away",
            tick: within(past_start(run.orientation_max_tick)),
            note: degrees(run.orientation_max_rad),
          } satisfies Moment,
        ]),
    { key: "clearance", label: "least clearance", tick: least(replay.clearance_m, 0, 1), note: "at a tick" },
    {
      key: "slow",
      label: "slowest tick",
      tick: run.step_max_s === null ? null : within(run.step_max_tick),
      note:
        run.step_max_s === null
          ? "times count only where the run is a success that was made tick by tick"
          : "the first tick apart",
    },
    { key: "end", label: run.gave_up === "" ? "end" : "end: gave up", tick: end, note: run.gave_up },
  ];
}

/** The next of several runs' moments after a tick, or the last before it; null if there is none. */
export function next_moment(all: readonly Moment[], tick: number, by: 1 | -1): Moment | null {
  let best: Moment | null = null;
  for (const moment of all) {
    if (moment.tick === null || (moment.tick - tick) * by <= 0) continue;
    if (best === null || (moment.tick - best.tick!) * by < 0) best = moment;
  }
  return best;
}
