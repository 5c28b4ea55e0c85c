// Variants as points of what they cost, and those that no other variant dominates.
import type { ReportData } from "../data";
import { degrees, length, median, number, percent, time } from "../format";
import { time_mark, time_mark_of_all } from "../parts";

/** A variant over the scenarios chosen. */
export interface Point {
  method: number;
  rate: number; ///< share of successes
  values: Record<string, number | null>;
  mark: string; ///< of its times, as tables have it
}

/** What can be traded. */
export interface Quantity {
  name: string;
  text: string;
  unit: string;
  more_is_better: boolean;
  format: (value: number | null) => string;
}

export const kQuantities: readonly Quantity[] = [
  { name: "time", text: "time per step, median", unit: "s", more_is_better: false, format: time },
  { name: "p99", text: "time per step, p99", unit: "s", more_is_better: false, format: time },
  { name: "slowest", text: "slowest step", unit: "s", more_is_better: false, format: time },
  { name: "plan", text: "time of the plan", unit: "s", more_is_better: false, format: time },
  { name: "error", text: "largest tip error", unit: "m", more_is_better: false, format: length },
  { name: "clearance", text: "least clearance", unit: "m", more_is_better: true, format: length },
  { name: "jerk", text: "joint jerk, rms", unit: "rad/s³", more_is_better: false, format: number },
  { name: "drift", text: "joint drift after a closed path", unit: "rad", more_is_better: false, format: degrees },
  { name: "manipulability", text: "least manipulability", unit: "m², m³", more_is_better: true, format: number },
  { name: "self-motion", text: "share of self-motion", unit: "–", more_is_better: false, format: percent },
];

/** Mark of a value of a point: times that are only indicative, or include a pipe, have one. */
export const mark_in = (point: Point, q: Quantity): string =>
  q.unit === "s" && (point.values[q.name] ?? null) !== null ? point.mark : "";

/** A value of a point after its mark. */
export const value_text = (point: Point, q: Quantity): string =>
  `${mark_in(point, q)}${q.format(point.values[q.name] ?? null)}`;

/** Quantities in which the front of all is sought. */
export const kOfTheFront = ["time", "error", "clearance"];

/** The quantity of a name, or another one. */
export function quantity(name: string, otherwise: string): Quantity {
  return (kQuantities.find((q) => q.name === name) ?? kQuantities.find((q) => q.name === otherwise)) as Quantity;
}

/** Whether `a` is at least as good as `b` in all quantities and better in one. Both have all of them. */
function dominates(a: Point, b: Point, quantities: readonly Quantity[]): boolean {
  let better = false;
  for (const q of quantities) {
    const sign = q.more_is_better ? -1 : 1;
    const difference = sign * ((a.values[q.name] as number) - (b.values[q.name] as number));
    if (difference > 0) return false;
    if (difference < 0) better = true;
  }
  return better;
}

/** The points that no other dominates, of those that have all quantities. */
export function front(points: readonly Point[], quantities: readonly Quantity[]): Point[] {
  const complete = points.filter((point) =>
    quantities.every((q) => point.values[q.name] !== null && point.values[q.name] !== undefined),
  );
  return complete.filter((point) => !complete.some((other) => dominates(other, point, quantities)));
}

/** Variants on one scenario: medians over successful repetitions. */
export function points_of_scenario(data: ReportData, scenario: number): Point[] {
  return data.report.methods.flatMap((_, method) => {
    const runs = data.runs(scenario, method).filter((run) => run.applicable);
    if (runs.length === 0) return [];
    const good = runs.filter((run) => run.success);
    const of = (value: (run: (typeof runs)[number]) => number | null): number | null =>
      median(good.map(value).filter((x): x is number => x !== null));
    return [
      {
        method,
        rate: good.length / runs.length,
        mark: time_mark(...good),
        values: {
          time: of((run) => run.step_median_s),
          p99: of((run) => run.step_p99_s),
          slowest: of((run) => run.step_max_s),
          plan: of((run) => run.plan_s),
          error: of((run) => run.tip_error_max_m),
          clearance: of((run) => run.clearance_m),
          jerk: of((run) => run.jerk_rms_rad_s3),
          drift: of((run) => run.closed_path_drift_rad),
          manipulability: of((run) => run.manipulability_min),
          "self-motion": of((run) => run.null_space_share),
        },
      },
    ];
  });
}

/** Variants over a family, a robot or both, or over all scenarios (null): as the program sums them up. */
export function points_of_scope(data: ReportData, family: string | null, robot: string | null): Point[] {
  return data.summary(family, robot).flatMap((entry) =>
    entry.rate === null
      ? []
      : [
          {
            method: entry.method,
            rate: entry.rate,
            mark: time_mark_of_all(data, entry),
            values: {
              time: entry.step_median_s,
              p99: entry.step_p99_s,
              slowest: entry.step_max_s,
              plan: entry.plan_median_s,
              error: entry.tip_error_median_m,
              clearance: entry.clearance_min_m,
              jerk: entry.jerk_rms_median_rad_s3,
              drift: entry.closed_path_drift_median_rad,
              manipulability: entry.manipulability_min_median,
              "self-motion": entry.null_space_share_median,
            },
          },
        ],
  );
}
