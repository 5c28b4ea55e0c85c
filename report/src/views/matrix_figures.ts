// Figures that the cells of the matrix can show.
import type { MethodSummary, ReportData, Run } from "../data";
import { degrees, kNone, length, median, number, percent, time } from "../format";
import { reason, time_mark } from "../parts";

/** A figure that the cells can show; the first one leaves it to the verdict. */
export interface Figure {
  name: string;
  text: string;
  of: (run: Run) => number | null;
  of_all: (entry: MethodSummary) => number | null; ///< over the runs of a family
  format: (value: number | null) => string;
}

/** Keys under which a type has numbers that may be missing. */
type Numbers<T> = { [Key in keyof T]: T[Key] extends number | null ? Key : never }[keyof T];

const figure = (
  name: string,
  text: string,
  of: Numbers<Run>,
  of_all: Numbers<MethodSummary>,
  format: Figure["format"],
): Figure => ({ name, text, of: (run) => run[of], of_all: (entry) => entry[of_all], format });

const jerk = (value: number | null): string => (value === null ? kNone : `${number(value)} rad/s³`);

export const kFigures: readonly Figure[] = [
  figure("", "overview", "step_median_s", "step_median_s", time),
  figure("time", "time per step", "step_median_s", "step_median_s", time),
  figure("p99", "p99", "step_p99_s", "step_p99_s", time),
  figure("error", "tip error", "tip_error_max_m", "tip_error_median_m", length),
  figure("clearance", "clearance", "clearance_m", "clearance_min_m", length),
  figure("jerk", "joint jerk", "jerk_rms_rad_s3", "jerk_rms_median_rad_s3", jerk),
  figure("drift", "joint drift", "closed_path_drift_rad", "closed_path_drift_median_rad", degrees),
  figure("manipulability", "manipulability", "manipulability_min", "manipulability_min_median", number),
  figure("self-motion", "self-motion", "null_space_share", "null_space_share_median", percent),
];

/** The figure of a name in the address. */
export const figure_named = (name: string): Figure =>
  kFigures.find((figure) => figure.name === name) ?? (kFigures[0] as Figure);

/** What a cell says of a run below the verdict: the figure, or why it failed. */
export function second_line(data: ReportData, run: Run, figure: Figure): string {
  if (!run.applicable) return "";
  if (figure.name === "" && !run.success) return reason(data, run);
  const value = figure.of(run);
  if (value === null && run.plan_s !== null) return `${time_mark(run)}plan ${time(run.plan_s)}`;
  const text = figure.format(value);
  return `${figure.format === time && value !== null ? time_mark(run) : ""}${text}${figure.name === "" ? " a step" : ""}`;
}

/** The same of several runs: the median of their figures. */
export function second_line_of_all(runs: readonly Run[], figure: Figure): string {
  const values = runs.map(figure.of).filter((value) => value !== null);
  if (values.length > 0)
    return `median ${figure.format === time ? time_mark(...runs) : ""}${figure.format(median(values))}`;
  const plans = runs.map((run) => run.plan_s).filter((value) => value !== null);
  return plans.length > 0 ? `median plan ${time_mark(...runs)}${time(median(plans))}` : "";
}
