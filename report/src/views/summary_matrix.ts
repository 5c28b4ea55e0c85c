// Verdict for each pair of method and scenario; many scenarios are gathered by family or by robot.
import type { MethodSummary, ReportData, Run } from "../data";
import { choice, cut, h, redraw, replace, select, short, type Child } from "../dom";
import { count, counted, kNone, percent, time } from "../format";
import type { Link, State } from "../link";
import {
  heading,
  inner_link,
  method_name,
  rate_bar,
  reason,
  run_change,
  time_mark_of_all,
  verdict_badge,
  verdict_of,
} from "../parts";
import { figure_named, kFigures, second_line, second_line_of_all, type Figure } from "./matrix_figures";

/** So many scenarios have a column each. */
export const kFewScenarios = 8;

const kBatch = 60; ///< rows drawn at once

export class MatrixPart {
  readonly element: HTMLElement;
  #data: ReportData;
  #link: Link;
  #controls = h("div", { class: "controls", role: "group", "aria-label": "Figure in the cells" });
  #hint = h("p", { class: "muted hint" });
  #host = h("div");
  #shown = "?";

  constructor(data: ReportData, link: Link) {
    this.#data = data;
    this.#link = link;
    this.element = h(
      "section",
      { id: "matrix" },
      heading("Method by scenario", this.#controls),
      this.#hint,
      this.#host,
    );
    this.update(link.state);
  }

  update(state: Readonly<State>): void {
    const wanted = [state.cell, state.rows, state.family, state.robot].join("\n");
    if (wanted === this.#shown) return;
    this.#shown = wanted;
    const { scenarios } = this.#data.report;
    const few = scenarios.length <= kFewScenarios;
    const { robots } = this.#data;
    const robot = robots.includes(state.robot) ? state.robot : "";
    const by_robot = state.rows === "robot" && robot === "" && robots.length > 0;
    const { families } = this.#data;
    const by_family = state.family === "" && families.length > 1 && families.length < scenarios.length;
    redraw(
      this.#controls,
      !few &&
        robot === "" &&
        robots.length > 0 &&
        select(
          "rows",
          [
            { value: "", text: by_family ? "families" : "scenarios" },
            { value: "robot", text: "robots" },
          ],
          by_robot ? "robot" : "",
          (rows) => this.#link.change({ rows }),
        ),
      ...kFigures.map((figure) =>
        choice(figure.text, figure.name === state.cell, () => this.#link.change({ cell: figure.name })),
      ),
    );
    if (few) this.#by_method(figure_named(state.cell));
    else if (by_robot)
      this.#by_group(
        "Robot",
        robots.map((one) => ({ family: state.family, robot: one })),
      );
    else if (by_family)
      this.#by_group(
        "Family",
        families.map((family) => ({ family, robot })),
      );
    else this.#by_scenario(state);
    const narrowed = [
      state.family !== "" &&
        families.length > 1 && [
          "Family ",
          h("strong", {}, short(state.family)),
          " · ",
          inner_link(this.#link, { family: "" }, "all families"),
        ],
      robot !== "" && [
        "Robot ",
        h("strong", {}, short(robot)),
        " · ",
        inner_link(this.#link, { robot: "" }, "all robots"),
      ],
    ].filter((line): line is Exclude<typeof line, false> => line !== false);
    if (!few) this.#host.prepend(...narrowed.map((line) => h("p", {}, ...line)));
    this.#hint.textContent = this.#host.querySelector(".matrix .rate")
      ? "Share of successes; each cell leads to its runs."
      : "Each cell leads to the replay; a failure to the tick where it shows.";
  }

  dispose(): void {}

  #table(head: Child[], body: HTMLElement): void {
    replace(
      this.#host,
      h(
        "div",
        { class: "scroll", tabindex: "0", role: "region", "aria-label": "Method by scenario" },
        h("table", { class: "matrix" }, h("thead", {}, h("tr", {}, ...head)), body),
      ),
    );
  }

  #by_method(figure: Figure): void {
    const { report } = this.#data;
    const head = [
      h("th", { scope: "col" }, "Method"),
      ...report.scenarios.map((scenario, index) =>
        h(
          "th",
          { scope: "col", title: scenario.description || null },
          short(this.#data.scenario_key(index), 40),
          h(
            "span",
            { class: "unit block" },
            `${scenario.dimension}-D, ${scenario.joints} joints, ${scenario.obstacles.length} obstacle${scenario.obstacles.length === 1 ? "" : "s"}`,
          ),
        ),
      ),
    ];
    const rows = report.methods.map((_, method) =>
      h(
        "tr",
        {},
        h("th", { scope: "row" }, method_name(this.#data, method)),
        ...report.scenarios.map((_s, scenario) => this.#cell(scenario, method, figure)),
      ),
    );
    this.#table(head, h("tbody", {}, ...rows));
  }

  #by_scenario(state: Readonly<State>): void {
    const { report } = this.#data;
    const indices = report.scenarios.map((_, index) => index).filter((index) => this.#data.of_scope(index, state));
    const body = h("tbody");
    const more = h("div", { class: "more" });
    let drawn = 0;
    const draw = (): void => {
      for (const index of indices.slice(drawn, drawn + kBatch)) {
        const cells = report.methods.map((_, method) => this.#cell(index, method, figure_named(state.cell)));
        body.append(h("tr", {}, h("th", { scope: "row" }, short(this.#data.scenario_key(index), 40)), ...cells));
      }
      drawn = Math.min(drawn + kBatch, indices.length);
      replace(
        more,
        drawn < indices.length &&
          h(
            "button",
            { type: "button", class: "quiet", click: draw },
            `${count(drawn)} of ${count(indices.length)} scenarios: more`,
          ),
      );
    };
    this.#table([h("th", { scope: "col" }, "Scenario"), ...this.#method_heads()], body);
    this.#host.append(more);
    draw();
  }

  #by_group(head: string, scopes: { family: string; robot: string }[]): void {
    const rows = scopes.flatMap((scope) => {
      const size = this.#data.report.scenarios.filter((_, index) => this.#data.of_scope(index, scope)).length;
      if (size === 0) return [];
      const entries = this.#data.summary(scope.family || null, scope.robot || null);
      return h(
        "tr",
        {},
        h(
          "th",
          { scope: "row" },
          inner_link(this.#link, scope, short(head === "Robot" ? scope.robot : scope.family, 40)),
          h("span", { class: "unit block" }, `${count(size)} scenario${size === 1 ? "" : "s"}`),
        ),
        ...this.#data.report.methods.map((_, method) =>
          this.#group_cell(
            entries.find((entry) => entry.method === method),
            figure_named(this.#link.state.cell),
          ),
        ),
      );
    });
    this.#table([h("th", { scope: "col" }, head), ...this.#method_heads()], h("tbody", {}, ...rows));
  }

  #method_heads(): HTMLElement[] {
    return this.#data.report.methods.map((_, method) => h("th", { scope: "col" }, method_name(this.#data, method)));
  }

  #group_cell(entry: MethodSummary | undefined, figure: Figure): HTMLElement {
    if (!entry || entry.runs === 0)
      return h("td", { class: "cell not-applicable" }, h("span", { class: "verdict not-applicable" }, "– n/a"));
    const value = figure.of_all(entry);
    const text =
      figure.name === ""
        ? `${count(entry.successes)} of ${count(entry.runs)}`
        : value === null && entry.plan_median_s !== null
          ? `${time_mark_of_all(this.#data, entry)}plan ${time(entry.plan_median_s)}`
          : `${figure.format === time && value !== null ? time_mark_of_all(this.#data, entry) : ""}${figure.format(value)}`;
    return h(
      "td",
      { class: `cell ${entry.wrong_claims > 0 ? "lies" : ""}` },
      inner_link(
        this.#link,
        { family: entry.family ?? "", robot: entry.robot ?? "", only: this.#data.method_key(entry.method) },
        h("strong", {}, percent(entry.rate)),
        rate_bar(entry),
        h("span", { class: "second" }, text),
        entry.wrong_claims > 0 && h("span", { class: "second bad" }, `! ${counted(entry.wrong_claims, "wrong claim")}`),
      ),
    );
  }

  #cell(scenario: number, method: number, figure: Figure): HTMLElement {
    const runs = this.#data.runs(scenario, method);
    const first = runs[0];
    if (!first) return h("td", { class: "cell none" }, h("span", {}, kNone));
    if (runs.length > 1) return this.#repeated(runs, figure);
    const verdict = verdict_of(first);
    const second = second_line(this.#data, first, figure);
    const title = [reason(this.#data, first), first.applicable ? `claimed: ${first.claimed}` : ""]
      .filter((text) => text !== "")
      .map((text) => cut(text, 300))
      .join("\n");
    if (!first.applicable)
      return h(
        "td",
        { class: "cell not-applicable", title },
        verdict_badge(verdict),
        h("span", { class: "second" }, short(second, 60)),
      );
    return h(
      "td",
      { class: `cell ${verdict.kind}`, title },
      inner_link(
        this.#link,
        run_change(this.#data, first),
        verdict_badge(verdict),
        h("span", { class: "second" }, short(second, 60)),
      ),
    );
  }

  /** Several runs of a pair: how many succeed; leads to the list of them. */
  #repeated(runs: readonly Run[], figure: Figure): HTMLElement {
    const successes = runs.filter((run) => run.success);
    const judged = runs.filter((run) => run.applicable).length;
    if (judged === 0)
      return h("td", { class: "cell not-applicable" }, h("span", { class: "verdict not-applicable" }, "– n/a"));
    const [first] = runs as [Run];
    const kind = successes.length === judged ? "success" : successes.length === 0 ? "failure" : "mixed";
    const symbol = { success: "✓", failure: "✗", mixed: "◐" }[kind];
    const lies = runs.filter((run) => verdict_of(run).lie).length;
    return h(
      "td",
      { class: `cell ${kind}` },
      inner_link(
        this.#link,
        { find: `"${this.#data.scenario_key(first.scenario)}"`, only: this.#data.method_key(first.method) },
        h(
          "span",
          { class: `verdict ${kind}` },
          h("span", { class: "symbol", "aria-hidden": "true" }, symbol),
          ` ${successes.length} of ${judged}`,
        ),
        h("span", { class: "second" }, second_line_of_all(successes, figure)),
        lies > 0 && h("span", { class: "second bad" }, `! ${counted(lies, "wrong claim")}`),
      ),
    );
  }
}
