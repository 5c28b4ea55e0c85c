// Time and work against the size of the problem, both axes logarithmic.
import { Chart } from "../chart";
import type { Crossover, ReportData, Sweep, SweepSeries } from "../data";
import { choice, cut, h, redraw, replace, short } from "../dom";
import { interval, kNone, number, time } from "../format";
import type { Link, State, View } from "../link";
import { heading, nothing, swatch } from "../parts";
import { SortedTable } from "../table";
import { counts_chart, times_chart } from "./scaling_charts";
import { looks, shown_at_first } from "./scaling_series";

const kSeparator = "|";

export function scaling_view(host: HTMLElement, data: ReportData, link: Link): View {
  const { measurements } = data.report;
  if (!measurements || measurements.sweeps.length === 0) {
    host.append(
      heading("Scaling"),
      nothing(
        "There are no measurements beside these results. They are made by",
        "bqsa-bench measure --out DIR/measurements.json",
      ),
    );
    return { update: () => {}, dispose: () => {} };
  }
  const scaling = new Scaling(measurements.sweeps, link);
  host.append(
    heading("Scaling"),
    measurements.publishable
      ? h("p", { class: "muted" }, `From ${measurements.file}.`)
      : h(
          "p",
          { class: "problem" },
          `⚠ These times are not publishable: ${measurements.against.join("; ") || "see Provenance"}.`,
        ),
    scaling.element,
  );
  return scaling;
}

class Scaling implements View {
  readonly element: HTMLElement;
  #sweeps: readonly Sweep[];
  #link: Link;
  #tabs = h("div", { class: "controls sweeps", role: "group", "aria-label": "Sweep" });
  #toggles = h("div", { class: "series", role: "group", "aria-label": "Contestants shown" });
  #fixed = h("p", { class: "muted" });
  #tables = h("div", { class: "columns" });
  #times: Chart | null = null;
  #counts: Chart | null = null;
  #charts = h("div", { class: "columns" });
  #fits: SortedTable<SweepSeries> | null = null;
  #wanted = "?";

  constructor(sweeps: readonly Sweep[], link: Link) {
    this.#sweeps = sweeps;
    this.#link = link;
    this.element = h("section", {}, this.#tabs, this.#fixed, this.#toggles, this.#charts, this.#tables);
    this.update(link.state);
  }

  update(state: Readonly<State>): void {
    const wanted = [state.sweep, state.show, state.sort].join("\n");
    if (wanted === this.#wanted) return;
    this.#wanted = wanted;
    const sweep = this.#sweeps.find((candidate) => candidate.name === state.sweep) ?? (this.#sweeps[0] as Sweep);
    const shown = state.show === "" ? shown_at_first(sweep) : new Set(state.show.split(kSeparator));
    redraw(
      this.#tabs,
      ...this.#sweeps.map((candidate) =>
        choice(candidate.title, candidate === sweep, () => this.#link.change({ sweep: candidate.name, show: "" })),
      ),
    );
    this.#fixed.textContent = `${sweep.of === "step" ? "One control step" : "One pass of a detector over all pairs"} against ${sweep.axis_label}${sweep.fixed ? `; ${sweep.fixed}` : ""}. Bands are 95 % intervals over processes.`;
    this.#draw_toggles(sweep, shown);
    this.#draw_charts(sweep, shown);
    this.#draw_tables(sweep, shown);
  }

  dispose(): void {
    this.#times?.dispose();
    this.#counts?.dispose();
    this.#fits?.dispose();
  }

  #draw_toggles(sweep: Sweep, shown: ReadonlySet<string>): void {
    const show = (names: readonly string[]): void => this.#link.change({ show: names.join(kSeparator) || kSeparator });
    const look = looks(sweep);
    const buttons = sweep.series.map((series, index) =>
      h(
        "button",
        {
          type: "button",
          class: "toggle",
          "aria-pressed": String(shown.has(series.name)),
          title: "Show or hide; twice: this one alone",
          click: () =>
            show(sweep.series.map((other) => other.name).filter((name) => shown.has(name) !== (name === series.name))),
          dblclick: () => show([series.name]),
        },
        swatch(look[index] ?? 0),
        cut(series.label, 40),
      ),
    );
    redraw(
      this.#toggles,
      ...buttons,
      h(
        "button",
        { type: "button", class: "quiet", click: () => show(sweep.series.map((series) => series.name)) },
        "all",
      ),
      h("button", { type: "button", class: "quiet", click: () => this.#link.change({ show: "" }) }, "a few"),
    );
  }

  #draw_charts(sweep: Sweep, shown: ReadonlySet<string>): void {
    const times = times_chart(sweep, shown);
    if (this.#times) this.#times.set(times);
    else {
      this.#times = new Chart(times);
      this.#charts.append(this.#times.element);
    }
    const counted = sweep.series.some((series) => series.counts.length > 0);
    if (!counted) {
      this.#counts?.element.remove();
      this.#counts?.dispose();
      this.#counts = null;
    } else if (this.#counts) {
      this.#counts.set(counts_chart(sweep, shown));
    } else {
      this.#counts = new Chart(counts_chart(sweep, shown));
      this.#charts.append(this.#counts.element);
    }
  }

  #draw_tables(sweep: Sweep, shown: ReadonlySet<string>): void {
    this.#fits?.dispose();
    const look = looks(sweep);
    const last = Math.max(...sweep.series.flatMap((series) => series.points.map((point) => point.x)));
    const at_last = (series: SweepSeries) => series.points.find((point) => point.x === last);
    this.#fits = new SortedTable<SweepSeries>({
      name: "fits",
      label: "Growth of the times",
      link: this.#link,
      initial: "last",
      row_class: (series) => (shown.has(series.name) ? "" : "faint"),
      columns: [
        {
          name: "series",
          head: "Contestant",
          text: true,
          sort: (series) => series.label,
          cell: (series) =>
            h(
              "span",
              { class: "drawn" },
              swatch(look[sweep.series.indexOf(series)] ?? 0),
              h("span", {}, short(series.label, 40)),
            ),
        },
        {
          name: "exponent",
          head: "Exponent",
          unit: "[95 %]",
          about: `Of time ~ ${sweep.axis}^exponent over the larger half of the sizes`,
          sort: (series) => series.fit?.exponent ?? null,
          cell: (series) =>
            series.fit
              ? h(
                  "span",
                  { title: series.fit.text },
                  `${number(series.fit.exponent)} `,
                  h("span", { class: "muted" }, interval(series.fit.lower, series.fit.upper)),
                )
              : kNone,
        },
        {
          name: "last",
          head: `at ${sweep.axis} = ${number(last)}`,
          unit: "[95 %]",
          sort: (series) => at_last(series)?.time_s ?? null,
          cell: (series) => {
            const point = at_last(series);
            return point
              ? [
                  `${time(point.time_s)} `,
                  h(
                    "span",
                    { class: "muted" },
                    point.lower_s === null ? "" : interval(point.lower_s, point.upper_s, (value) => time(value)),
                  ),
                ]
              : kNone;
          },
        },
      ],
    });
    this.#fits.set(sweep.series);
    replace(
      this.#tables,
      h("section", {}, h("h3", {}, "Growth"), this.#fits.element),
      sweep.crossovers.length > 0 &&
        h("section", {}, h("h3", {}, "Where one overtakes another"), crossover_table(sweep, shown)),
    );
  }
}

function crossover_table(sweep: Sweep, shown: ReadonlySet<string>): HTMLElement {
  const both = (crossover: Crossover): boolean => shown.has(crossover.a) && shown.has(crossover.b);
  const label = (name: string): string => cut(sweep.series.find((series) => series.name === name)?.label ?? name, 40);
  const rows = [...sweep.crossovers].sort((a, b) => Number(both(b)) - Number(both(a)));
  return h(
    "div",
    { class: "scroll short", tabindex: "0", role: "region", "aria-label": "Crossovers" },
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          h("th", { scope: "col" }, "From here on takes longer"),
          h("th", { scope: "col" }, "than"),
          h("th", { scope: "col", class: "num" }, sweep.axis, h("span", { class: "unit" }, " [95 %]")),
        ),
      ),
      h(
        "tbody",
        {},
        ...rows.map((crossover) =>
          h(
            "tr",
            { class: both(crossover) ? null : "faint", title: crossover.text },
            h("td", {}, label(crossover.a)),
            h("td", {}, label(crossover.b)),
            h(
              "td",
              { class: "num" },
              `${number(crossover.x)} `,
              h("span", { class: "muted" }, interval(crossover.lower, crossover.upper)),
            ),
          ),
        ),
      ),
    ),
  );
}
