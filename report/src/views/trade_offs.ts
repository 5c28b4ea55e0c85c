// What is paid for what: time, tip error and clearance of the variants against each other.
import { Chart } from "../chart";
import type { ReportData } from "../data";
import { cut, h, redraw, select } from "../dom";
import { percent } from "../format";
import type { Link, State, View } from "../link";
import { drawn_method, heading, inner_link, mark_words, nothing, scope_choice } from "../parts";
import { SortedTable } from "../table";
import {
  front,
  kOfTheFront,
  kQuantities,
  mark_in,
  points_of_scenario,
  points_of_scope,
  quantity,
  value_text,
  type Point,
  type Quantity,
} from "./pareto";
import { trade_off_chart } from "./trade_off_chart";

const kOfTheTable = ["time", "p99", "error", "clearance"];

export function trade_offs_view(host: HTMLElement, data: ReportData, link: Link): View {
  if (!data.report.runs.some((run) => run.success)) {
    host.append(heading("Trade-offs"), nothing("No run succeeds, so there is nothing to weigh.", ""));
    return { update: () => {}, dispose: () => {} };
  }
  const view = new TradeOffs(data, link);
  host.append(view.element);
  return view;
}

const kFewScenarios = 60; ///< that are offered one by one

class TradeOffs implements View {
  readonly element: HTMLElement;
  #data: ReportData;
  #link: Link;
  #controls = h("div", { class: "filters" });
  #note = h("p", { class: "muted", role: "status" });
  #chart: Chart | null = null;
  #host = h("div");
  #table: SortedTable<Point>;
  #on_front = new Set<Point>();
  #least = 0;
  #wanted = "?";

  constructor(data: ReportData, link: Link) {
    this.#data = data;
    this.#link = link;
    this.#table = new SortedTable<Point>({
      name: "variants",
      label: "Variants",
      link,
      initial: "front",
      row_class: (point) => (point.rate < this.#least ? "faint" : ""),
      columns: [
        {
          name: "method",
          head: "Method",
          text: true,
          sort: (point) => point.method,
          cell: (point) => drawn_method(data, point.method),
        },
        {
          name: "front",
          head: "Front",
          text: true,
          about: "No other variant is at least as good in time per step, tip error and clearance, and better in one",
          sort: (point) => (this.#on_front.has(point) ? 0 : 1),
          cell: (point) => this.#on_front.has(point) && h("span", { class: "best" }, "on the front"),
        },
        {
          name: "rate",
          head: "Success",
          worst_first: true,
          sort: (point) => point.rate,
          cell: (point) => percent(point.rate),
        },
        ...kOfTheTable.map((name) => {
          const q = quantity(name, name);
          return {
            name,
            head: q.text,
            worst_first: q.more_is_better,
            sort: (point: Point) => point.values[name] ?? null,
            cell: (point: Point) => value_text(point, q),
          };
        }),
      ],
    });
    this.element = h(
      "section",
      {},
      heading("Trade-offs"),
      this.#controls,
      this.#note,
      this.#host,
      h("h3", {}, "Time, error and clearance together"),
      this.#table.element,
    );
    this.update(link.state);
  }

  update(state: Readonly<State>): void {
    const wanted = [state.scenario, state.family, state.robot, state.x, state.y, state.least, state.sort].join("\n");
    if (wanted === this.#wanted) return;
    this.#wanted = wanted;
    const { scenarios } = this.#data.report;
    const by_scenario = scenarios.length <= kFewScenarios;
    const scenario = by_scenario ? this.#data.scenario_index(state.scenario) : -1;
    const family = !by_scenario && this.#data.families.includes(state.family) ? state.family : null;
    const robot = scenario < 0 && this.#data.robots.includes(state.robot) ? state.robot : null;
    const points =
      scenario >= 0 ? points_of_scenario(this.#data, scenario) : points_of_scope(this.#data, family, robot);
    const x = quantity(state.x, "time");
    const y = quantity(state.y, "error");
    this.#least = (state.least === "" ? 90 : Number(state.least) || 0) / 100;
    this.#draw_controls(state, by_scenario, scenario, x, y);

    const enough = points.filter((point) => point.rate >= this.#least);
    this.#on_front = new Set(
      front(
        enough,
        kOfTheFront.map((name) => quantity(name, name)),
      ),
    );
    const drawn = points.filter((point) => (point.values[x.name] ?? 0) > 0 && (point.values[y.name] ?? 0) > 0);
    const missing = points.filter((point) => !drawn.includes(point));
    this.#note.textContent =
      `${scenario >= 0 ? "Of this scenario" : "Medians over successes; clearance is the least"}. ` +
      `Hollow: succeeds in less than ${percent(this.#least)}, not on the front.` +
      (missing.length > 0
        ? ` Not in the chart, for want of a value: ${missing.map((point) => cut(this.#data.method_key(point.method), 40)).join(", ")}.`
        : "") +
      mark_words(points.flatMap((point) => kQuantities.map((q) => mark_in(point, q))).join(""))
        .map((words) => ` Times: ${words}.`)
        .join("");
    const spec = trade_off_chart(
      this.#data,
      drawn,
      front(
        enough.filter((point) => drawn.includes(point)),
        [x, y],
      ),
      this.#least,
      x,
      y,
    );
    if (this.#chart) this.#chart.set(spec);
    else {
      this.#chart = new Chart(spec);
      this.#host.append(this.#chart.element);
    }
    this.#table.set(points);
  }

  dispose(): void {
    this.#chart?.dispose();
    this.#table.dispose();
  }

  #draw_controls(state: Readonly<State>, by_scenario: boolean, scenario: number, x: Quantity, y: Quantity): void {
    const { scenarios } = this.#data.report;
    const quantities = kQuantities.map((q) => ({ value: q.name, text: q.text }));
    redraw(
      this.#controls,
      by_scenario
        ? select(
            "of",
            [
              { value: "", text: "all scenarios" },
              ...scenarios.map((_, s) => ({ value: this.#data.scenario_key(s), text: this.#data.scenario_key(s) })),
            ],
            scenario >= 0 ? this.#data.scenario_key(scenario) : "",
            (value) => this.#link.change({ scenario: value }),
          )
        : scope_choice(this.#data, this.#link, "family", "all scenarios", "of"),
      scenario < 0 && scope_choice(this.#data, this.#link, "robot", "all", "robot"),
      select("across", quantities, x.name, (value) => this.#link.change({ x: value })),
      select("up", quantities, y.name, (value) => this.#link.change({ y: value })),
      select(
        "succeeds in at least",
        ["0", "50", "90", "100"].map((value) => ({ value, text: `${value} %` })),
        state.least === "" ? "90" : state.least,
        (value) => this.#link.change({ least: value }),
      ),
      scenario >= 0 && inner_link(this.#link, { view: "replay", scenario: state.scenario }, "Replay of this scenario"),
    );
  }
}
