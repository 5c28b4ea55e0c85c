// Every run, to be filtered, sorted and opened.
import { type ReportData, type Run, type Verdict } from "../data";
import { h, replace, select, short, type Child } from "../dom";
import { count, degrees, kNone, millimetres } from "../format";
import type { Link, State } from "../link";
import {
  heading,
  inner_link,
  marked_microseconds,
  method_name,
  reason,
  run_change,
  run_time,
  scope_choice,
  time_mark,
  verdict_badge,
  verdict_of,
} from "../parts";
import { SortedTable, type Column } from "../table";
import { run_details } from "./run_details";

interface Row {
  run: Run;
  verdict: Verdict;
  text: string; ///< what is searched, in lower case
}

const kVerdicts: { value: string; text: string; holds: (row: Row) => boolean }[] = [
  { value: "", text: "any", holds: () => true },
  { value: "success", text: "success", holds: (row) => row.verdict.kind === "success" },
  { value: "failed", text: "any failure", holds: (row) => row.run.applicable && !row.run.success },
  { value: "failure", text: "failure of the motion", holds: (row) => row.verdict.kind === "failure" },
  { value: "crash", text: "crash or misconduct", holds: (row) => row.verdict.kind === "crash" },
  { value: "wrong-claim", text: "wrong claim", holds: (row) => row.verdict.lie },
  { value: "no-verdict", text: "no verdict", holds: (row) => row.verdict.kind === "no-verdict" },
  { value: "not-applicable", text: "n/a", holds: (row) => row.verdict.kind === "not-applicable" },
];

const kOrder: Record<Verdict["kind"], number> = {
  success: 0,
  failure: 1,
  crash: 2,
  "no-verdict": 3,
  "not-applicable": 4,
};

/** Words of a search; what stands in quotes is one word, to be found as a whole. */
export function words(find: string): string[] {
  return [...find.toLowerCase().matchAll(/"([^"]*)"?|[^\s"]+/g)]
    .map((match) => match[1] ?? match[0])
    .filter((word) => word !== "");
}

export class RunsPart {
  readonly element: HTMLElement;
  #data: ReportData;
  #link: Link;
  #rows: Row[];
  #table: SortedTable<Row>;
  #find = h("input", { type: "search", placeholder: "scenario, method, reason …", "aria-label": "Find runs" });
  #filters = h("div", { class: "filters" });
  #number = h("p", { class: "muted", role: "status" });
  #shown = "?";
  #timer = 0;

  constructor(data: ReportData, link: Link) {
    this.#data = data;
    this.#link = link;
    this.#rows = data.report.runs.map((run) => {
      const verdict = verdict_of(run);
      const text = [
        data.scenario_key(run.scenario),
        data.method_key(run.method),
        data.scenario(run.scenario).robot,
        verdict.word,
        ...run.failures,
        run.claimed,
        reason(data, run),
        run.record,
      ]
        .map((part) => part.slice(0, 200))
        .join("\n")
        .toLowerCase();
      return { run, verdict, text };
    });
    this.#find.addEventListener("input", () => {
      clearTimeout(this.#timer);
      this.#timer = window.setTimeout(() => link.change({ find: this.#find.value }), 120);
    });
    this.#table = new SortedTable<Row>({
      name: "runs",
      label: "Runs",
      link,
      columns: this.#columns(),
      details: (row) => run_details(data, row.run),
      opened: (row) => link.state.open !== "" && row.run.record === link.state.open,
    });
    this.element = h("section", { id: "runs" }, heading("Runs"), this.#filters, this.#number, this.#table.element);
    this.update(link.state);
  }

  update(state: Readonly<State>): void {
    const wanted = [state.find, state.verdict, state.family, state.robot, state.only, state.sort, state.open].join(
      "\n",
    );
    if (wanted === this.#shown) return;
    const first = this.#shown === "?";
    this.#shown = wanted;
    this.#draw_filters(state);
    const chosen = kVerdicts.find((verdict) => verdict.value === state.verdict) ?? kVerdicts[0];
    const needles = words(state.find);
    const only = this.#data.method_index(state.only);
    const rows = this.#rows.filter(
      (row) =>
        (state.open === "" || row.run.record === state.open) &&
        (chosen?.holds(row) ?? true) &&
        (state.only === "" || row.run.method === only) &&
        this.#data.of_scope(row.run.scenario, state) &&
        needles.every((word) => row.text.includes(word)),
    );
    this.#number.textContent =
      rows.length === this.#rows.length
        ? `${count(rows.length)} runs`
        : `${count(rows.length)} of ${count(this.#rows.length)} runs`;
    this.#table.set(rows);
    const narrowed = state.verdict !== "" || state.only !== "" || state.open !== "";
    if (narrowed && !first && !this.element.contains(document.activeElement))
      this.element.scrollIntoView({ block: "start" });
    if (first && state.open !== "") requestAnimationFrame(() => this.element.scrollIntoView({ block: "start" }));
  }

  dispose(): void {
    clearTimeout(this.#timer);
    this.#table.dispose();
  }

  #draw_filters(state: Readonly<State>): void {
    if (document.activeElement !== this.#find) this.#find.value = state.find;
    const { link, data } = { link: this.#link, data: this.#data };
    const only = data.method_index(state.only);
    const filtered = [state.find, state.verdict, state.only, state.family, state.robot, state.open].some(
      (filter) => filter !== "",
    );
    const focused = this.#filters.contains(document.activeElement)
      ? [...this.#filters.querySelectorAll("select")].indexOf(document.activeElement as HTMLSelectElement)
      : -1;
    const selects: Child[] = [
      select("verdict", kVerdicts, state.verdict, (verdict) => link.change({ verdict, open: "" })),
      select(
        "method",
        [
          { value: "", text: "all" },
          ...data.report.methods.map((_, method) => ({
            value: data.method_key(method),
            text: data.method_key(method),
          })),
        ],
        only < 0 ? state.only : data.method_key(only),
        (only) => link.change({ only, open: "" }),
      ),
      scope_choice(data, link, "family", "all", "family"),
      scope_choice(data, link, "robot", "all", "robot"),
      filtered &&
        h(
          "button",
          {
            type: "button",
            class: "quiet",
            click: () => {
              this.#find.value = "";
              link.change({ find: "", verdict: "", only: "", family: "", robot: "", open: "" });
            },
          },
          "Clear filters",
        ),
    ];
    if (!this.#find.isConnected || this.#find.parentElement?.parentElement !== this.#filters) {
      replace(this.#filters, h("label", { class: "field" }, h("span", {}, "find"), this.#find));
    }
    while (this.#filters.childNodes.length > 1) this.#filters.lastChild?.remove();
    this.#filters.append(...selects.filter((child): child is Node => child instanceof Node));
    if (focused >= 0) this.#filters.querySelectorAll("select")[focused]?.focus();
  }

  #columns(): Column<Row>[] {
    const data = this.#data;
    const several = data.report.runs.some((run) => run.seed !== null || run.repetition !== null);
    const columns: Column<Row>[] = [
      {
        name: "verdict",
        head: "Judged",
        text: true,
        sort: (row) => kOrder[row.verdict.kind],
        cell: (row) => [verdict_badge(row.verdict), h("span", { class: "second" }, short(reason(data, row.run), 72))],
      },
      {
        name: "replay",
        head: "",
        text: true,
        cell: (row) =>
          row.run.replay !== null &&
          inner_link(
            this.#link,
            run_change(data, row.run),
            h("span", { "aria-hidden": "true" }, "▶"),
            h("span", { class: "unseen" }, "Replay"),
          ),
      },
      {
        name: "scenario",
        head: "Scenario",
        text: true,
        sort: (row) => data.scenario_key(row.run.scenario),
        cell: (row) => [
          short(data.scenario_key(row.run.scenario), 36),
          data.robots.length > 0 && h("span", { class: "second" }, short(data.scenario(row.run.scenario).robot, 36)),
        ],
      },
      {
        name: "method",
        head: "Method",
        text: true,
        sort: (row) => row.run.method,
        cell: (row) => method_name(data, row.run.method),
      },
    ];
    if (several) {
      columns.push({
        name: "run",
        head: "Seed",
        text: true,
        about: "Random seed; repetition of a campaign",
        sort: (row) => row.run.repetition ?? row.run.seed,
        cell: (row) => [
          row.run.seed === null ? null : short(row.run.seed, 12),
          row.run.repetition === null ? null : h("span", { class: "muted" }, ` #${row.run.repetition}`),
        ],
      });
    }
    return [
      ...columns,
      {
        name: "error",
        head: "Tip error",
        unit: "mm",
        worst_first: true,
        about: "Largest at ticks",
        sort: (row) => row.run.tip_error_max_m,
        cell: (row) => millimetres(row.run.tip_error_max_m),
      },
      {
        name: "clearance",
        head: "Clearance",
        unit: "mm",
        about: "Least, at and between ticks; negative inside an obstacle",
        sort: (row) => row.run.clearance_m,
        cell: (row) => [
          millimetres(row.run.clearance_m),
          row.run.touching && h("span", { title: "Within 0.001 mm of contact" }, " T"),
        ],
      },
      {
        name: "step",
        head: "Joint step",
        unit: "°",
        worst_first: true,
        about: "Largest of one joint that turns in one tick",
        sort: (row) => row.run.max_joint_step_rad,
        cell: (row) => degrees(row.run.max_joint_step_rad).replace("°", ""),
      },
      {
        name: "time",
        head: "Time per step",
        unit: "µs",
        about: "Median; of successes only",
        sort: (row) => row.run.step_median_s,
        cell: (row) => run_time(row.run),
      },
      {
        name: "p99",
        head: "p99",
        unit: "µs",
        worst_first: true,
        sort: (row) => row.run.step_p99_s,
        cell: (row) => marked_microseconds(time_mark(row.run), row.run.step_p99_s),
      },
      {
        name: "slowest",
        head: "slowest",
        unit: "µs",
        worst_first: true,
        sort: (row) => row.run.step_max_s,
        cell: (row) => this.#worst(row.run),
      },
      {
        name: "claimed",
        head: "Claimed",
        text: true,
        sort: (row) => row.run.claimed,
        cell: (row) =>
          !row.run.applicable
            ? kNone
            : h(
                "span",
                { class: row.verdict.lie ? "bad" : row.run.claimed === "nothing" ? "muted" : null },
                row.run.claimed === "nothing" ? "no claim" : short(row.run.claimed, 40),
              ),
      },
    ];
  }

  /** Slowest step, leading to its tick. */
  #worst(run: Run): Child {
    if (run.step_max_s === null) return kNone;
    const text = marked_microseconds(time_mark(run), run.step_max_s);
    if (run.replay === null || run.step_max_tick === null) return text;
    return inner_link(this.#link, { ...run_change(this.#data, run), tick: run.step_max_tick }, text);
  }
}
