// All that is known of a run, in words.
import { failure_word, type ReportData, type Run } from "../data";
import { h, type Child } from "../dom";
import { count, counted, degrees, length, number, percent, time } from "../format";
import { joint_steps } from "../jumps";
import { time_mark } from "../parts";

export function run_details(data: ReportData, run: Run): HTMLElement {
  const facts: [string, Child | readonly Child[]][] = [];
  const fact = (name: string, ...value: Child[]): void => {
    if (value.some((part) => part !== null && part !== "" && part !== false)) facts.push([name, value]);
  };
  const at = (tick: number | null): string => (tick === null ? "" : ` at tick ${tick}`);
  fact("Reason", run.why_not);
  fact("Judged", run.failures.map(failure_word).join(", "));
  fact("Checkers disagree", run.disagreement);
  fact("Claimed", run.applicable ? run.claimed : "", run.claim_detail && ` – ${run.claim_detail}`);
  fact("Gave up because", run.gave_up);
  fact(
    "In contact",
    run.contacts
      .map(
        (c) =>
          `link ${c.link} in ${c.obstacle} from tick ${c.first_tick}${c.at_tick ? ` (${c.ticks} ticks)` : ", between ticks only"}`,
      )
      .join("; "),
  );
  fact(
    "Links in contact",
    run.self_contacts
      .map(
        (c) =>
          `link ${c.link} in link ${c.other_link} from tick ${c.first_tick}${c.at_tick ? ` (${c.ticks} ticks)` : ", between ticks only"}`,
      )
      .join("; "),
  );
  fact("Moved away", run.clamped.map((c) => `link ${c.link} from ${c.obstacle} × ${c.ticks}`).join("; "));
  fact("Began to clear a link", run.clamp_starts ? counted(run.clamp_starts, "time") : "");
  if (run.tip_error_max_m !== null) {
    fact(
      "Tip error",
      `mean ${length(run.tip_error_mean_m)}, rms ${length(run.tip_error_rms_m)}, largest ${length(run.tip_error_max_m)}${at(run.tip_error_max_tick)}; between ticks ${length(run.tip_error_between_max_m)}; at the start ${length(run.start_error_m)}`,
    );
    if (run.orientation_max_rad !== null) {
      fact(
        "Turned away",
        `${degrees(run.orientation_max_rad)}${at(run.orientation_max_tick)}; between ticks ${degrees(run.orientation_between_max_rad)}`,
      );
    }
    fact("Clearance", `${length(run.clearance_m)}; at ticks ${length(run.clearance_at_ticks_m)}`);
    fact(
      "Clearance of links from each other",
      run.self_clearance_at_ticks_m === null ? "" : `${length(run.self_clearance_at_ticks_m)} at ticks`,
    );
    fact("Largest joint step", joint_steps(run, at));
  }
  if (run.closed_path_drift_rad !== null) {
    fact(
      "Drift after the closed path",
      `${degrees(run.closed_path_drift_rad)}; of one joint ${degrees(run.closed_path_drift_joint_rad)}`,
    );
  }
  if (run.manipulability_min !== null) {
    const unit = data.scenario(run.scenario).dimension === 2 ? "m²" : "m³";
    fact(
      "Manipulability",
      `least ${number(run.manipulability_min)}, mean ${number(run.manipulability_mean)} ${unit}; least singular value ${length(run.singular_value_min_m)}`,
    );
  }
  fact("Self-motion", run.null_space_share === null ? "" : `${percent(run.null_space_share)} of the joint motion`);
  fact("Joint jerk", run.jerk_rms_rad_s3 === null ? "" : `rms ${number(run.jerk_rms_rad_s3)} rad/s³`);
  if (run.step_median_s !== null) {
    fact(
      "Time per step",
      `${time_mark(run)}median ${time(run.step_median_s)}, p99 ${time(run.step_p99_s)}, p99.9 ${time(run.step_p999_s)}, slowest ${time(run.step_max_s)}${at(run.step_max_tick)}`,
    );
  }
  fact("Plan", run.plan_s === null ? "" : time(run.plan_s));
  fact("Whole run", run.run_s === null ? "" : time(run.run_s));
  fact("Times only indicative", run.times_indicative.join("; "));
  const counters = Object.entries(run.counters ?? {}).filter(([, value]) => (value ?? 0) > 0);
  fact("Work", counters.map(([name, value]) => `${name.replaceAll("_", " ")} ${count(value ?? 0)}`).join(", "));
  fact("Made by", data.report.origins[run.origin]?.label ?? "");
  fact("Record", `${run.record}, ${run.date}`);
  fact("No replay", run.no_replay);
  return h(
    "dl",
    { class: "facts" },
    ...facts.flatMap(([name, value]) => [
      h("dt", {}, name),
      h("dd", {}, ...(Array.isArray(value) ? (value as Child[]) : [value as Child])),
    ]),
  );
}
