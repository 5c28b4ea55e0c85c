// The steps of a run that its judge calls a jump.
import type { Run, Scene } from "./data";
import { degrees, length } from "./format";

export interface Jump {
  size: string; ///< with its unit
  tick: number | null;
}

/** Of a run that jumps, the largest step of the joints that turn and of those that slide, if it is beyond the limit of one
 *  of them. Which joint was too far the record does not say, so that it may be both; and without the limits, which the
 *  scene has, it is all that moved. */
export function jumps(run: Run, scene: Scene | null): Jump[] {
  if (!run.failures.includes("jump")) return [];
  const too_far = (step: number | null, slides: boolean): boolean =>
    step !== null &&
    (scene === null
      ? step > 0
      : scene.max_joint_step_rad.some((limit, joint) => scene.prismatic[joint] === slides && step > limit));
  const found: Jump[] = [];
  if (too_far(run.max_joint_step_rad, false))
    found.push({ size: degrees(run.max_joint_step_rad), tick: run.max_joint_step_tick });
  if (too_far(run.max_joint_slide_m, true))
    found.push({ size: length(run.max_joint_slide_m), tick: run.max_joint_slide_tick });
  return found;
}

/** The largest step of a joint that turns and, of an arm with joints that slide, of those. */
export const joint_steps = (run: Run, at: (tick: number | null) => string = () => ""): string =>
  `${degrees(run.max_joint_step_rad)}${at(run.max_joint_step_tick)}` +
  (run.max_joint_slide_m === null ? "" : `, ${length(run.max_joint_slide_m)}${at(run.max_joint_slide_tick)}`);
