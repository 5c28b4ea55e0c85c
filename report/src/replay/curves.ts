// Charts of clearance, tip error and joint angles.
import type { ChartSpec } from "../chart";
import type { Scene } from "../data";
import { decade, number } from "../format";
import { series_style } from "../palette";
import {
  curve,
  dash_of,
  finite,
  frame,
  kHeight,
  level,
  named,
  plain,
  run_colors,
  series,
  solid_and_dashed,
  table,
  type Line,
} from "./curve_frame";

/** A tip error of exactly 0 has no logarithm; it is shown as this [mm]. */
const kLeastError = 1e-9;

/** The smallest of the finite values and 0. */
const least = (values: Float32Array): number =>
  values.reduce((smallest, value) => (Number.isFinite(value) && value < smallest ? value : smallest), 0);

export function clearance_chart(lines: readonly Line[]): ChartSpec {
  return {
    name: "clearance",
    title: "Clearance",
    label: "Distance between links and obstacles, less the link radius, over time; at or below zero they touch.",
    height: kHeight,
    table: () => table(lines, ["clearance [mm]"], (line, row) => [finite(line.actor.replay.clearance_m[row]! * 1e3)]),
    option: (theme) => {
      const colors = run_colors(theme, lines);
      const lowest = Math.min(0, ...lines.map((line) => least(line.actor.replay.clearance_m) * 1e3));
      return {
        ...frame(
          theme,
          lines,
          { name: "clearance [mm]", axisLabel: { formatter: plain }, min: lowest < 0 ? undefined : 0 },
          (value) => `${number(value)} mm`,
        ),
        series: lines.map((line, i) =>
          series(
            line,
            named(line),
            curve(line.actor.replay.clearance_m, line.actor.scenario.dt_s, 1e3),
            colors[i]!,
            dash_of(line),
            i > 0
              ? {}
              : {
                  markLine: level(theme, 0, "contact", theme.bad),
                  markArea: {
                    silent: true,
                    itemStyle: { color: theme.bad, opacity: 0.1 },
                    data: lowest < 0 ? [[{ yAxis: lowest * 1.2 }, { yAxis: 0 }]] : [],
                  },
                },
          ),
        ),
      };
    },
  };
}

/** Without the start's error, which the tolerance does not hold for. */
export function error_chart(lines: readonly Line[]): ChartSpec {
  return {
    name: "tip_error",
    title: "Tip error",
    label:
      "Distance of the tip from its desired position over time, from tick 1 on, on a logarithmic scale, with the tolerance.",
    height: kHeight,
    table: () =>
      table(lines, ["tip error [mm]"], (line, row) => [
        row === 0 ? null : finite(line.actor.replay.tip_error_m[row]! * 1e3),
      ]),
    option: (theme) => {
      const colors = run_colors(theme, lines);
      const tolerance = lines[0]!.actor.scenario.tolerance_m * 1e3;
      return {
        ...frame(
          theme,
          lines,
          {
            type: "log",
            name: "tip error [mm]",
            axisLabel: { formatter: decade },
            max: (range: { max: number }) => next_decade(Math.max(range.max, tolerance)),
          },
          (value) => `${number(value)} mm`,
        ),
        series: lines.map((line, i) => {
          const points = curve(line.actor.replay.tip_error_m, line.actor.scenario.dt_s, 1e3).slice(1);
          for (const point of points) if (point[1] !== null) point[1] = Math.max(point[1]!, kLeastError);
          return series(
            line,
            named(line),
            points,
            colors[i]!,
            dash_of(line),
            i > 0 ? {} : { markLine: level(theme, tolerance, "tolerance") },
          );
        }),
      };
    },
  };
}

const next_decade = (value: number): number => 10 ** Math.ceil(Math.log10(value) - 1e-9);

const kDegrees = 180 / Math.PI;

/** A limit as the chart has it, with all joints that have it. */
interface Level {
  value: number;
  word: string;
  joints: number[];
  label: "insideEndTop" | "insideStartTop" | "insideMiddleTop";
}

/** Limits of joints in ascending order; those of more than two have their labels in turn at either end and in the middle, so that
 *  neighbours do not cover each other. */
function levels_of(scene: Scene, joints: readonly number[], scale: (joint: number) => number): Level[] {
  const levels: Level[] = [];
  for (const [limits, word] of [
    [scene.lower_rad, "least"],
    [scene.upper_rad, "most"],
  ] as const) {
    for (const j of joints) {
      const limit = limits?.[j] ?? null;
      if (limit === null) continue;
      const value = limit * scale(j);
      const same = levels.find((level) => level.word === word && level.value === value);
      if (same) same.joints.push(j);
      else levels.push({ value, word, joints: [j], label: "insideEndTop" });
    }
  }
  levels.sort((a, b) => a.value - b.value);
  if (levels.length > 2)
    levels.forEach(
      (level, i) => (level.label = (["insideEndTop", "insideStartTop", "insideMiddleTop"] as const)[i % 3]!),
    );
  return levels;
}

/** Joint angles of all joints, or of one (counted from 0); of those that slide lengths. */
export function joints_chart(lines: readonly Line[], only: number | null): ChartSpec {
  const joints = Array.from({ length: lines[0]!.actor.scenario.joints }, (_, j) => j).filter(
    (j) => only === null || j === only,
  );
  const { prismatic } = lines[0]!.actor.scene.scene;
  const mixed = prismatic.some((slides) => slides);
  const scale = (j: number): number => (prismatic[j] ? 1e3 : kDegrees);
  const name = (j: number): string => (prismatic[j] ? `q${j + 1} [mm]` : `q${j + 1}`);
  const levels = levels_of(lines[0]!.actor.scene.scene, joints, scale);
  return {
    name: "joint_angles",
    title: `Joint angles${solid_and_dashed(lines)}`,
    label: "Joint angles over time, with joint limits where there are any.",
    height: kHeight + 50,
    table: () =>
      table(
        lines,
        joints.map((j) => (prismatic[j] ? name(j) : `q${j + 1} [deg]`)),
        (line, row) => joints.map((j) => finite(line.actor.replay.q[row * line.actor.scenario.joints + j]! * scale(j))),
      ),
    option: (theme) => ({
      ...frame(
        theme,
        lines,
        {
          name: mixed ? "joint angle [°] or length [mm]" : "joint angle [°]",
          scale: true,
          axisLabel: { formatter: plain },
        },
        (value) => `${number(value)}${mixed ? "" : "°"}`,
      ),
      series: lines.flatMap((line, i) =>
        joints.map((j) => {
          const { color, dash } = series_style(j, theme.dark);
          const { joints: count, dt_s } = line.actor.scenario;
          const limits = i > 0 ? [] : levels.filter((level) => level.joints[0] === j);
          return series(
            line,
            name(j),
            curve(line.actor.replay.q, dt_s, scale(j), j, count),
            color,
            lines.length > 1 || dash.length === 0 ? dash_of(line) : dash,
            {
              markLine: {
                silent: true,
                symbol: "none",
                lineStyle: { width: 1, type: [2, 4] },
                label: { fontSize: 10 },
                data: limits.map(({ value, word, joints: equal, label }) => ({
                  yAxis: value,
                  lineStyle: { color: equal.length > 1 ? theme.muted : color },
                  label: {
                    position: label,
                    formatter: `${equal.map((k) => `q${k + 1}`).join(", ")} ${word}`,
                    color: equal.length > 1 ? theme.muted : color,
                  },
                })),
              },
            },
          );
        }),
      ),
    }),
  };
}
