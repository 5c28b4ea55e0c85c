// Charts of a sweep: time and counted work against size, both axes logarithmic.
import { axis, common, type ChartSpec, type Option, type Table } from "../chart";
import type { Sweep, SweepSeries } from "../data";
import { cut } from "../dom";
import { decade, number, time } from "../format";
import { series_style, type Theme } from "../palette";
import { looks } from "./scaling_series";

function log_axis(theme: Theme, name: string, gap: number): Record<string, unknown> {
  return axis(theme, {
    type: "log",
    name: cut(name, 80),
    nameGap: gap,
    axisLabel: { formatter: decade },
    minorTick: { show: true },
  });
}

/** Time at a size between those measured, on the straight line of the logarithms. */
function time_between(series: SweepSeries, x: number): number | null {
  for (let i = 1; i < series.points.length; ++i) {
    const a = series.points[i - 1];
    const b = series.points[i];
    if (!a || !b || x < a.x || x > b.x) continue;
    const share = Math.log(x / a.x) / Math.log(b.x / a.x);
    return a.time_s * (b.time_s / a.time_s) ** share;
  }
  return null;
}

interface RenderApi {
  coord(point: [number, number]): [number, number];
  value(dimension: number): number;
}

function line(series: SweepSeries, data: [number, number][], index: number, theme: Theme): Record<string, unknown> {
  const style = series_style(index, theme.dark);
  return {
    type: "line",
    name: cut(series.label, 60),
    data,
    symbol: style.symbol,
    symbolSize: 6,
    itemStyle: { color: style.color },
    lineStyle: { color: style.color, width: 2, type: style.dash.length > 0 ? style.dash : "solid" },
    emphasis: { focus: "series" },
    endLabel: {
      show: true,
      formatter: () => cut(series.label, 40),
      color: style.color,
      fontSize: 11,
      width: 140,
      overflow: "truncate",
    },
    labelLayout: { moveOverlap: "shiftY" },
  };
}

function band(series: SweepSeries, index: number, theme: Theme): Record<string, unknown> | null {
  const points = series.points.filter((point) => point.lower_s !== null && point.upper_s !== null && point.lower_s > 0);
  if (points.length < 2) return null;
  return {
    type: "custom",
    name: series.label,
    silent: true,
    data: [[points[0]?.x, points[0]?.time_s]],
    clip: true,
    tooltip: { show: false },
    renderItem: (_: unknown, api: RenderApi) => ({
      type: "polygon",
      shape: {
        points: [
          ...points.map((point) => api.coord([point.x, point.upper_s as number])),
          ...[...points].reverse().map((point) => api.coord([point.x, point.lower_s as number])),
        ],
      },
      style: { fill: series_style(index, theme.dark).color, opacity: 0.16 },
    }),
  };
}

/** The fitted power as a thin straight line over the sizes it was fitted to, through the middle of the times there. */
function fit_line(series: SweepSeries, theme: Theme): Record<string, unknown> | null {
  const { fit } = series;
  if (!fit) return null;
  const points = series.points.filter((point) => point.x >= fit.from_x);
  const first = points[0];
  const last = points[points.length - 1];
  if (!first || !last || first === last) return null;
  const mean = (value: (point: { x: number; time_s: number }) => number): number =>
    points.reduce((sum, point) => sum + Math.log(value(point)), 0) / points.length;
  const offset = mean((point) => point.time_s) - fit.exponent * mean((point) => point.x);
  const at = (x: number): [number, number] => [x, Math.exp(offset + fit.exponent * Math.log(x))];
  return {
    type: "line",
    data: [at(first.x), at(last.x)],
    symbol: "none",
    silent: true,
    tooltip: { show: false },
    lineStyle: { color: theme.text, width: 1, type: [1, 3] },
  };
}

function layout(theme: Theme, width: number, sweep: Sweep, unit: string): Option {
  return {
    ...common(theme),
    grid: { left: 62, right: width < 480 ? 100 : 150, top: 16, bottom: 48 },
    xAxis: log_axis(theme, sweep.axis_label, 28),
    yAxis: log_axis(theme, unit, 44),
  };
}

/** Times with bands, fits and crossovers. */
export function times_chart(sweep: Sweep, shown: ReadonlySet<string>): ChartSpec {
  const look = looks(sweep);
  const visible = sweep.series
    .map((series, i) => ({ series, index: look[i] ?? 0 }))
    .filter(({ series }) => shown.has(series.name));
  const option = (theme: Theme, width: number): Option => {
    const crossings = sweep.crossovers.flatMap((crossover) => {
      const a = visible.find(({ series }) => series.name === crossover.a);
      const y = a && shown.has(crossover.b) ? time_between(a.series, crossover.x) : null;
      return y === null ? [] : [{ value: [crossover.x, y], name: cut(crossover.text, 200) }];
    });
    return {
      ...layout(theme, width, sweep, sweep.of === "step" ? "time per step [s]" : "time per pass [s]"),
      series: [
        ...visible.map(({ series, index }) => band(series, index, theme)),
        ...visible.map(({ series, index }) =>
          line(
            series,
            series.points.map((point) => [point.x, point.time_s]),
            index,
            theme,
          ),
        ),
        ...visible.map(({ series }) => fit_line(series, theme)),
        {
          type: "scatter",
          data: crossings,
          symbol: "circle",
          symbolSize: 13,
          z: 5,
          itemStyle: { color: "transparent", borderColor: theme.text, borderWidth: 1.5 },
          tooltip: { formatter: (params: { name: string }) => params.name },
        },
      ].filter((series) => series !== null),
      tooltip: {
        ...(common(theme)["tooltip"] as object),
        trigger: "item",
        formatter: (params: { seriesName?: string; value: [number, number] }) =>
          `${params.seriesName ?? ""}\n${sweep.axis} = ${number(params.value[0])}: ${time(params.value[1])}`,
      },
    };
  };
  const table = (): Table => ({
    columns: ["contestant", sweep.axis, "time [s]", "95 % from [s]", "95 % to [s]"],
    rows: visible.flatMap(({ series }) =>
      series.points.map((point) => [series.label, point.x, point.time_s, point.lower_s, point.upper_s]),
    ),
  });
  const growth = visible
    .filter(({ series }) => series.fit)
    .map(({ series }) => `${series.label}: ${series.fit?.text ?? ""}`);
  return {
    name: `${sweep.name}_times`,
    title: `Time: ${cut(sweep.title, 120)}`,
    label: `Time against ${sweep.axis_label}, both logarithmic, for ${visible.length} contestants. ${growth.join("; ")}.`,
    height: 420,
    option,
    table,
  };
}

/** Counted operations. */
export function counts_chart(sweep: Sweep, shown: ReadonlySet<string>): ChartSpec {
  const look = looks(sweep);
  const visible = sweep.series
    .map((series, i) => ({ series, index: look[i] ?? 0 }))
    .filter(({ series }) => shown.has(series.name) && series.counts.length > 0);
  const what = cut([...new Set(visible.map(({ series }) => series.counted))].join(", "), 120);
  return {
    name: `${sweep.name}_counts`,
    title: `Work, counted: ${what || "none of those shown"}`,
    label: `Number of operations against ${sweep.axis_label}, both logarithmic. Counts are exact.`,
    height: 420,
    option: (theme, width) => ({
      ...layout(theme, width, sweep, "operations [-]"),
      series: visible.map(({ series, index }) =>
        line(
          series,
          series.counts.filter((c) => c.value > 0).map((c) => [c.x, c.value]),
          index,
          theme,
        ),
      ),
      tooltip: {
        ...(common(theme)["tooltip"] as object),
        formatter: (params: { seriesName?: string; seriesIndex: number; value: [number, number] }) =>
          `${params.seriesName ?? ""}\n${sweep.axis} = ${number(params.value[0])}: ${number(params.value[1])} ${visible[params.seriesIndex]?.series.counted ?? ""}`,
      },
    }),
    table: () => ({
      columns: ["contestant", sweep.axis, "number", "of"],
      rows: visible.flatMap(({ series }) => series.counts.map((c) => [series.label, c.x, c.value, series.counted])),
    }),
  };
}
