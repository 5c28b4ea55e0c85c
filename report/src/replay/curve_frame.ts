// What the charts of a replay have in common: the axis of time, curves of one run or two, tables.
import { axis, common, type Option, type Table } from "../chart";
import { number } from "../format";
import { series_style, type Theme } from "../palette";
import type { Actor } from "./actor";
import { kMargins } from "./cursor_chart";

/** A run in the charts. */
export interface Line {
  letter: string; ///< "A" or "B"; empty if there is but one run
  actor: Actor;
}

export const kHeight = 250;

export const named = (line: Line): string =>
  line.letter === "" ? line.actor.name : `${line.letter} · ${line.actor.name}`;
export const dash_of = (line: Line): number[] | "solid" => (line.letter === "B" ? [6, 4] : "solid");

/** Points [t, value] of one number a tick. */
export function curve(values: ArrayLike<number>, dt: number, scale = 1, offset = 0, stride = 1): (number | null)[][] {
  const points: (number | null)[][] = [];
  for (let row = 0; offset + row * stride < values.length; ++row) {
    const value = values[offset + row * stride]! * scale;
    points.push([row * dt, Number.isFinite(value) ? value : null]);
  }
  return points;
}

/** A curve of a run. Curves of one name are switched on and off together. */
export function series(
  line: Line,
  name: string,
  data: (number | null)[][],
  color: string,
  dash: number[] | "solid",
  more: object = {},
): object {
  return {
    id: `${line.letter}|${name}`,
    type: "line",
    name,
    data,
    showSymbol: false,
    symbol: "none",
    lineStyle: { color, width: 1.8, type: dash },
    itemStyle: { color },
    ...more,
  };
}

/** A level across the chart with a word at it. */
export function level(theme: Theme, value: number, text: string, color = theme.muted): object {
  return {
    silent: true,
    symbol: "none",
    lineStyle: { color, width: 1.2, type: [3, 3] },
    label: { formatter: text, position: "insideEndTop", color, fontSize: 11 },
    data: [{ yAxis: value }],
  };
}

interface TooltipPoint {
  seriesId: string;
  seriesName: string;
  value: (number | null)[];
}

/** Tick, time, and a line of text for each name with the values of the runs. */
function tooltip(
  points: readonly TooltipPoint[],
  lines: readonly Line[],
  value_text: (value: number) => string,
): string {
  const t = points[0]?.value[0] ?? 0;
  const texts = new Map<string, string>();
  for (const { seriesId, seriesName, value } of points) {
    const letter = seriesId.slice(0, seriesId.indexOf("|"));
    const text = value[1] === null || value[1] === undefined ? "–" : value_text(value[1]);
    const own = letter === "" || seriesName.startsWith(letter) ? text : `${letter} ${text}`;
    texts.set(seriesName, [texts.get(seriesName), own].filter((part) => part !== undefined).join(", "));
  }
  const head = `tick ${Math.round(t! / dt_of(lines))}, ${number(t)} s`;
  return [head, ...[...texts].map(([name, text]) => `${name}: ${text}`)].join("\n");
}

/** Axes, legend and tooltip over the time of the longest run. */
export function frame(
  theme: Theme,
  lines: readonly Line[],
  y: Record<string, unknown>,
  value_text: (value: number) => string,
): Option {
  const shared = common(theme);
  return {
    ...shared,
    grid: { ...kMargins, outerBoundsMode: "none" },
    legend: {
      top: 6,
      left: kMargins.left,
      right: 8,
      type: "scroll",
      pageTextStyle: { color: theme.muted },
      pageIconColor: theme.muted,
      textStyle: { color: theme.text, fontSize: 12 },
      itemWidth: 26,
      itemHeight: 8,
      itemGap: 12,
    },
    tooltip: {
      ...(shared["tooltip"] as object),
      trigger: "axis",
      axisPointer: { type: "line", lineStyle: { color: theme.muted, width: 1 } },
      formatter: (points: unknown) => tooltip(points as TooltipPoint[], lines, value_text),
    },
    xAxis: axis(theme, {
      type: "value",
      min: 0,
      max: end_of(lines),
      name: "time t [s]",
      nameGap: 26,
      axisLine: { onZero: false, lineStyle: { color: theme.muted } },
      axisLabel: { formatter: plain, showMaxLabel: false },
    }),
    yAxis: axis(theme, { type: "value", nameGap: 46, ...y }),
  };
}

/** A label of an axis: as many digits as it needs. */
export const plain = (value: number): string => String(Number(value.toPrecision(6))).replace("-", "−");

/** How two runs are told apart, where the colours are those of other things. */
export const solid_and_dashed = (lines: readonly Line[]): string => (lines.length > 1 ? " (A solid, B dashed)" : "");

const longest = (lines: readonly Line[]): number => Math.max(...lines.map((line) => line.actor.replay.rows));
const dt_of = (lines: readonly Line[]): number => lines[0]!.actor.scenario.dt_s;
/** [s]; a run of its start alone is given one tick of room. */
const end_of = (lines: readonly Line[]): number => Math.max(longest(lines) - 1, 1) * dt_of(lines);

/** Table with tick and time, and columns of each run. */
export function table(
  lines: readonly Line[],
  columns: readonly string[],
  cells: (line: Line, row: number) => (number | null)[],
): Table {
  return {
    columns: [
      "tick",
      "t [s]",
      ...lines.flatMap((line) => columns.map((column) => (line.letter === "" ? column : `${named(line)}: ${column}`))),
    ],
    rows: Array.from({ length: longest(lines) }, (_, row) => [
      row,
      row * dt_of(lines),
      ...lines.flatMap((line) => (row < line.actor.replay.rows ? cells(line, row) : columns.map(() => null))),
    ]),
  };
}

export const finite = (value: number): number | null => (Number.isFinite(value) ? value : null);

/** Colours of two runs: of their methods, or of the second run another one where these are the same. */
export function run_colors(theme: Theme, lines: readonly Line[]): string[] {
  const colors = lines.map((line) => series_style(line.actor.replay.run.method, theme.dark).color);
  if (colors[1] !== undefined && colors[1] === colors[0])
    colors[1] = series_style(lines[1]!.actor.replay.run.method + 1, theme.dark).color;
  return colors;
}
