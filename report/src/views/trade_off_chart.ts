// Chart of a trade-off: variants as labelled points, the Pareto front as steps, variants of one method joined.
import { axis, common, type ChartSpec, type Option } from "../chart";
import type { ReportData } from "../data";
import { cut } from "../dom";
import { decade, percent } from "../format";
import { series_style, type Theme } from "../palette";
import { mark_words } from "../parts";
import { mark_in, value_text, type Point, type Quantity } from "./pareto";

/** Two quantities of the variants against each other, with the front. */
export function trade_off_chart(
  data: ReportData,
  all: readonly Point[],
  on_front: readonly Point[],
  least: number,
  x: Quantity,
  y: Quantity,
): ChartSpec {
  const name = (point: Point): string => cut(data.method_key(point.method), 40);
  const mark = (point: Point): string => mark_in(point, x) || mark_in(point, y);
  const at = (point: Point): [number, number] => [point.values[x.name] as number, point.values[y.name] as number];
  const label = (point: Point): string => [name(point), mark(point)].join(" ").trimEnd();
  // Labels are placed in this order: those on the front find room first.
  const points = [...on_front, ...all.filter((point) => !on_front.includes(point))];
  const about = (point: Point): string =>
    [
      name(point),
      cut(data.method(point.method).changed, 80),
      `${x.text}: ${value_text(point, x)}`,
      `${y.text}: ${value_text(point, y)}`,
      `succeeds in ${percent(point.rate)}`,
      ...mark_words(mark(point)),
    ]
      .filter((text) => text !== "")
      .join("\n");
  const line = [...on_front].sort((a, b) => at(a)[0] - at(b)[0]);
  const option = (theme: Theme, width: number): Option => ({
    ...common(theme),
    grid: { left: 66, right: width < 600 ? 20 : 110, top: 26, bottom: 52 },
    xAxis: axis(theme, {
      type: "log",
      name: axis_name(x, "→"),
      nameGap: 30,
      axisLabel: { formatter: decade },
      minorTick: { show: true },
    }),
    yAxis: axis(theme, {
      type: "log",
      name: axis_name(y, "↑"),
      nameGap: 46,
      axisLabel: { formatter: decade },
      minorTick: { show: true },
    }),
    series: [
      {
        type: "line",
        data: steps(line.map(at), x),
        symbol: "none",
        silent: true,
        lineStyle: { color: theme.text, width: 1.2, type: [5, 4] },
      },
      ...kinships(data, points).map((family) => ({
        type: "line",
        data: family.map(at),
        symbol: "none",
        silent: true,
        lineStyle: { color: series_style((family[0] as Point).method, theme.dark).color, width: 1, opacity: 0.5 },
      })),
      {
        type: "scatter",
        data: points.map((point) => {
          const style = series_style(point.method, theme.dark);
          const best = on_front.includes(point);
          return {
            value: at(point),
            symbol: style.symbol,
            symbolSize: best ? 15 : 10,
            itemStyle: {
              color: point.rate >= least ? style.color : theme.background,
              borderColor: best ? theme.text : style.color,
              borderWidth: 1.5,
            },
            label: { fontWeight: best ? "bold" : "normal" },
          };
        }),
        label: {
          show: true,
          formatter: (params: { dataIndex: number }) => label(points[params.dataIndex] as Point),
          position: "right",
          color: theme.text,
          fontSize: 11,
          textBorderColor: theme.background,
          textBorderWidth: 3,
        },
        labelLayout: label_layout(width, (index) => on_front.includes(points[index] as Point)),
        tooltip: { formatter: (params: { dataIndex: number }) => about(points[params.dataIndex] as Point) },
      },
    ],
  });
  return {
    name: `trade_off_${x.name}_${y.name}`,
    title: `${capital(y.text)} against ${x.text}`,
    label: `${capital(y.text)} against ${x.text}, both logarithmic, of ${points.length} variants. On the Pareto front: ${line.map(name).join(", ") || "none"}.`,
    height: 460,
    option,
    table: () => ({
      columns: ["variant", `${x.text} [${x.unit}]`, `${y.text} [${y.unit}]`, "success", "times", "on the front"],
      rows: points.map((point) => [
        data.method_key(point.method),
        ...at(point),
        point.rate,
        mark_words(mark(point)).join("; "),
        on_front.includes(point) ? "yes" : "no",
      ]),
    }),
  };
}

interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

const apart = (a: Box, b: Box): boolean =>
  a.x + a.width < b.x || b.x + b.width < a.x || a.y + a.height < b.y || b.y + b.height < a.y;

const kOutOfSight = -10_000; ///< [px]

/** Places each label beside its point, where none placed before is in the way; else leaves it out, if it may be. */
function label_layout(
  chart_width: number,
  needed: (index: number) => boolean,
): (params: { dataIndex: number; rect: Box; labelRect: Box }) => Record<string, unknown> {
  let placed: Box[] = [];
  return ({ dataIndex, rect, labelRect }) => {
    if (dataIndex === 0) placed = [];
    const { width, height } = labelRect;
    const left = rect.x - 6 - width;
    const right = rect.x + rect.width + 6;
    const middle = rect.y + (rect.height - height) / 2;
    const rows = [0, 1, -1, 2, -2].map((row) => middle + row * (height + 1));
    const boxes = rows
      .flatMap((y) => [right, left].map((x) => ({ x, y, width, height })))
      .filter((box) => box.x > 60 && box.x + box.width < chart_width);
    const free = boxes.find((box) => placed.every((other) => apart(box, other)));
    const box = free ?? (needed(dataIndex) ? boxes[0] : undefined);
    placed.push(rect);
    if (!box) return { x: kOutOfSight, y: 0 };
    placed.push(box);
    return { x: box.x, y: box.y + height / 2, align: "left", verticalAlign: "middle" };
  };
}

function axis_name(q: Quantity, arrow: string): string {
  const back: Record<string, string> = { "→": "←", "↑": "↓" };
  return `${q.text} [${q.unit}], better ${q.more_is_better ? arrow : back[arrow]}`;
}

const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

/** The front as steps, points by ascending x: the border of what a point of it dominates. */
function steps(points: readonly [number, number][], x: Quantity): [number, number][] {
  const out: [number, number][] = [];
  points.forEach((point, i) => {
    const before = points[i - 1];
    if (before) out.push(x.more_is_better ? [before[0], point[1]] : [point[0], before[1]]);
    out.push(point);
  });
  return out;
}

/** Variants of the same method, in the order of the report: the sweep of a parameter. */
function kinships(data: ReportData, points: readonly Point[]): Point[][] {
  const by_name = new Map<string, Point[]>();
  for (const point of points) {
    const { name } = data.method(point.method);
    by_name.set(name, [...(by_name.get(name) ?? []), point]);
  }
  return [...by_name.values()].filter((family) => family.length > 1);
}
