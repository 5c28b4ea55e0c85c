// Chart of what the categories of a link and an obstacle are decided by (paper, Figs. 9 and 16).
import type { ChartSpec } from "../chart";
import { number, power_of_ten } from "../format";
import { category_color, series_style, type Theme } from "../palette";
import { category_words } from "./categories";
import { dash_of, finite, frame, kHeight, level, series, solid_and_dashed, table, type Line } from "./curve_frame";
import type { PairCriteria } from "./pair";

/** Away from zero logarithmic, near it linear, so that signs can be seen: the scale of the paper figures. */
const kSmallest = 1e-4;
const signed_log = (value: number): number => Math.asinh(value / (2 * kSmallest)) / Math.LN10;

function signed_decade(scaled: number): string {
  if (Math.abs(scaled) < 1e-9) return "0";
  const exponent = Math.round(Math.abs(scaled) + Math.log10(kSmallest));
  return `${scaled < 0 ? "−" : ""}${exponent === 0 ? "1" : power_of_ten(exponent)}`;
}

const kCriteria = [
  { key: "discriminant", text: "Δ" },
  { key: "start", text: "f(0)" },
  { key: "end", text: "f(1)" },
  { key: "slope_product", text: "f′(0) f′(1)" },
] as const;

/** Spans of ticks of one category as areas in a strip of the chart. */
function category_strip(theme: Theme, pair: PairCriteria, dt: number, from: number, to: number): object {
  const spans: object[][] = [];
  for (let row = 0; row < pair.ticks.length;) {
    const { category } = pair.ticks[row]!;
    let last = row;
    while (last + 1 < pair.ticks.length && pair.ticks[last + 1]!.category === category) ++last;
    spans.push([
      { xAxis: Math.max(row - 0.5, 0) * dt, yAxis: from, itemStyle: { color: category_color(category, theme.dark) } },
      { xAxis: Math.min(last + 0.5, pair.ticks.length - 1) * dt, yAxis: to },
    ]);
    row = last + 1;
  }
  return { silent: true, itemStyle: { opacity: 0.9 }, data: spans };
}

/** What the categories of one link and obstacle are decided by, a pair for each run. */
export function criteria_chart(lines: readonly Line[], pairs: readonly PairCriteria[], title: string): ChartSpec {
  return {
    name: "category_criteria",
    title: `${title}${solid_and_dashed(lines)}`,
    label:
      "Discriminant, levels at the link's ends and product of the slopes there over time, with the category that follows from them.",
    height: kHeight + 50,
    table: () =>
      table(lines, [...kCriteria.map(({ text }) => `${text} [-]`), "category"], (line, row) => {
        const tick = pairs[lines.indexOf(line)]!.ticks[row]!;
        return [...kCriteria.map(({ key }) => finite(tick[key])), tick.category];
      }),
    option: (theme) => {
      let largest = 1;
      for (const { ticks } of pairs) {
        for (const tick of ticks) {
          for (const { key } of kCriteria)
            if (Number.isFinite(tick[key])) largest = Math.max(largest, Math.abs(tick[key]));
        }
      }
      const limit = Math.ceil(signed_log(largest) / 2) * 2;
      const strip = limit / 14;
      return {
        ...frame(
          theme,
          lines,
          {
            name: "criteria [–]",
            min: -limit,
            max: limit + strip * 1.3 * lines.length,
            interval: 2,
            axisLabel: { formatter: (v: number) => (v > limit + 1e-9 ? "" : signed_decade(v)), showMaxLabel: false },
          },
          (value) => number(2 * kSmallest * Math.sinh(value * Math.LN10)),
        ),
        series: lines.flatMap((line, i) =>
          kCriteria.map(({ key, text }, c) => {
            const { color } = series_style(c, theme.dark);
            const data = pairs[i]!.ticks.map((tick, row) => [
              row * line.actor.scenario.dt_s,
              finite(signed_log(tick[key])),
            ]);
            const top = limit + strip * 1.3 * (lines.length - i);
            return series(
              line,
              text,
              data,
              color,
              dash_of(line),
              c > 0
                ? {}
                : {
                    markLine: level(theme, 0, ""),
                    markArea: category_strip(theme, pairs[i]!, line.actor.scenario.dt_s, top - strip, top),
                  },
            );
          }),
        ),
      };
    },
  };
}

/** The criteria of a tick in words. */
export function criteria_text(pair: PairCriteria, row: number): string {
  const tick = pair.ticks[Math.min(row, pair.ticks.length - 1)]!;
  const { name, meaning } = category_words(tick.category);
  return `${kCriteria.map(({ key, text }) => `${text} = ${number(tick[key])}`).join(", ")}: ${name} (${meaning})`;
}
