// One line for each variant, over all scenarios, one family or one robot, with the statistics of the program.
import type { MethodSummary, ReportData } from "../data";
import { failure_word } from "../data";
import { cut, h, redraw, type Child } from "../dom";
import { count, interval, kNone, microseconds, millimetres, percent, time } from "../format";
import type { Link, State } from "../link";
import {
  drawn_method,
  heading,
  inner_link,
  marked_microseconds,
  rate_bar,
  rate_interval,
  scope_choice,
  time_mark_of_all,
} from "../parts";
import { SortedTable, type Column } from "../table";

export class MethodsPart {
  readonly element: HTMLElement;
  #data: ReportData;
  #link: Link;
  #controls = h("span", { class: "controls" });
  #table: SortedTable<MethodSummary>;
  #shown = "?";

  constructor(data: ReportData, link: Link) {
    this.#data = data;
    this.#link = link;
    this.#table = new SortedTable<MethodSummary>({
      name: "methods",
      label: "Methods",
      link,
      initial: "-rate",
      columns: this.#columns(),
      row_class: (entry) => (entry.runs === 0 ? "faint" : ""),
    });
    this.element = h("section", { id: "methods" }, heading("Methods", this.#controls), this.#table.element);
    this.update(link.state);
  }

  update(state: Readonly<State>): void {
    const wanted = `${state.family}\n${state.robot}\n${state.sort}`;
    if (wanted === this.#shown) return;
    this.#shown = wanted;
    const family = this.#data.families.includes(state.family) ? state.family : null;
    const robot = this.#data.robots.includes(state.robot) ? state.robot : null;
    redraw(
      this.#controls,
      scope_choice(this.#data, this.#link, "family", "all scenarios", "over"),
      scope_choice(this.#data, this.#link, "robot", "all", "robot"),
    );
    this.#table.set(this.#data.summary(family, robot));
  }

  dispose(): void {
    this.#table.dispose();
  }

  /** Mark of the best and of those that tie with it; none where there is too little to tell. */
  #best(entry: MethodSummary, key: "best_rate" | "best_tip_error" | "best_step"): Child {
    if (entry[key] !== true) return null;
    const rivals = key === "best_rate" ? "every other" : "every other that is best or tied by success";
    const ties = this.#data.summary(entry.family, entry.robot).filter((other) => other[key] === true).length;
    return h(
      "span",
      {
        class: "best",
        title:
          ties > 1
            ? `Best, or tied with the best: the statistics do not tell these ${ties} apart`
            : `Better than ${rivals}`,
      },
      ties > 1 ? "tied" : "best",
    );
  }

  #columns(): Column<MethodSummary>[] {
    const data = this.#data;
    const mark = (entry: MethodSummary): string => time_mark_of_all(data, entry);
    return [
      {
        name: "method",
        head: "Method",
        text: true,
        sort: (entry) => entry.method,
        cell: (entry) => drawn_method(data, entry.method),
      },
      {
        name: "rate",
        head: "Success",
        unit: "[95 %]",
        text: true,
        worst_first: true,
        about: "Share of judged runs that succeed, with Wilson's interval",
        sort: (entry) => entry.rate,
        cell: (entry) =>
          entry.runs === 0
            ? h("span", { class: "verdict not-applicable" }, "– n/a")
            : [
                rate_bar(entry),
                h("span", { class: "rate-text" }, percent(entry.rate)),
                this.#best(entry, "best_rate"),
                h(
                  "span",
                  { class: "second" },
                  `${count(entry.successes)} of ${count(entry.runs)}, ${rate_interval(entry)}`,
                ),
              ],
      },
      {
        name: "fails",
        head: "Failures",
        text: true,
        worst_first: true,
        about: "Failed runs by class; click for the list",
        sort: (entry) => (entry.runs === 0 ? null : entry.runs - entry.successes),
        cell: (entry) => this.#failures(entry),
      },
      {
        name: "wrong",
        head: "Wrong claims",
        worst_first: true,
        about: "Runs that claim what the judge denies",
        sort: (entry) => (entry.runs === 0 ? null : entry.wrong_claims),
        cell: (entry) =>
          entry.wrong_claims > 0
            ? inner_link(
                this.#link,
                { verdict: "wrong-claim", only: data.method_key(entry.method) },
                h("strong", { class: "bad" }, `! ${entry.wrong_claims}`),
              )
            : entry.runs === 0
              ? kNone
              : "0",
      },
      {
        name: "error",
        head: "Tip error",
        unit: "mm",
        about: "Median over successes of the largest tip error at ticks, with its bootstrap interval",
        sort: (entry) => entry.tip_error_median_m,
        cell: (entry) => [
          this.#best(entry, "best_tip_error"),
          millimetres(entry.tip_error_median_m),
          h(
            "span",
            { class: "second" },
            interval(entry.tip_error_median_lower_m, entry.tip_error_median_upper_m, millimetres),
          ),
        ],
      },
      {
        name: "error_max",
        head: "largest",
        unit: "mm",
        about: "Largest tip error at ticks of any success",
        sort: (entry) => entry.tip_error_max_m,
        cell: (entry) => millimetres(entry.tip_error_max_m),
      },
      {
        name: "clearance",
        head: "Clearance",
        unit: "mm",
        worst_first: true,
        about: "Least clearance of any success",
        sort: (entry) => entry.clearance_min_m,
        cell: (entry) => millimetres(entry.clearance_min_m),
      },
      {
        name: "time",
        head: "Time per step",
        unit: "µs",
        about:
          "Median over successes of the run's median time of a step, with its bootstrap interval. Planners: median time of a plan",
        sort: (entry) => entry.step_median_s,
        cell: (entry) =>
          entry.step_median_s === null
            ? entry.plan_median_s === null
              ? kNone
              : h("span", { class: "muted" }, `plan ${mark(entry)}${time(entry.plan_median_s)}`)
            : [
                this.#best(entry, "best_step"),
                marked_microseconds(mark(entry), entry.step_median_s),
                h(
                  "span",
                  { class: "second" },
                  interval(entry.step_median_lower_s, entry.step_median_upper_s, microseconds),
                ),
              ],
      },
      {
        name: "p99",
        head: "p99",
        unit: "µs",
        about: "99 % quantile of the times of all steps of all successes",
        sort: (entry) => entry.step_p99_s,
        cell: (entry) => marked_microseconds(mark(entry), entry.step_p99_s),
      },
      {
        name: "slowest",
        head: "slowest",
        unit: "µs",
        about: "Slowest step of any success",
        sort: (entry) => entry.step_max_s,
        cell: (entry) => marked_microseconds(mark(entry), entry.step_max_s),
      },
    ];
  }

  #failures(entry: MethodSummary): Child | Child[] {
    if (entry.runs === 0) return kNone;
    const failed = entry.runs - entry.successes;
    if (failed === 0) return h("span", { class: "muted" }, "none");
    const classes = Object.entries(entry.failures)
      .sort((a, b) => (b[1] ?? 0) - (a[1] ?? 0))
      .map(([name, number]) => `${failure_word(name)} ${number}`);
    const change = {
      verdict: "failed",
      only: this.#data.method_key(entry.method),
      family: entry.family ?? "",
      robot: entry.robot ?? "",
    };
    return h(
      "span",
      { class: "failures", title: cut(classes.join(", "), 500) },
      inner_link(
        this.#link,
        change,
        classes
          .slice(0, 2)
          .map((text) => cut(text, 40))
          .join(", ") || String(failed),
      ),
      classes.length > 2 && ` +${classes.length - 2} more`,
    );
  }
}
