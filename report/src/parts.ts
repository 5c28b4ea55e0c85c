// Pieces that several views show: verdicts, names of methods and scenarios, figures of runs, addresses of replays.
import { verdict_of, type MethodSummary, type ReportData, type Run, type Verdict } from "./data";
import { h, select, short, svg, type Child } from "./dom";
import { degrees, interval, kNone, length, microseconds, time } from "./format";
import { jumps, type Jump } from "./jumps";
import type { Change, Link } from "./link";
import { series_style } from "./palette";

/** Symbol and word of a verdict; a false claim is marked in addition. */
export function verdict_badge(verdict: Verdict): HTMLElement {
  return h(
    "span",
    { class: `verdict ${verdict.kind}` },
    h("span", { class: "symbol", "aria-hidden": "true" }, verdict.symbol),
    ` ${verdict.word}`,
    verdict.lie &&
      h("span", { class: "lie", title: "What the method claims and what was judged differ" }, " ! wrong claim"),
  );
}

/** The line and symbol by which charts show a series. */
export function swatch(index: number): SVGSVGElement {
  const { symbol, dash, color } = series_style(index, false);
  const shapes: Record<string, string> = {
    circle: "M8 6a4 4 0 1 0 8 0a4 4 0 1 0 -8 0",
    rect: "M8.5 2.5h7v7h-7z",
    triangle: "M12 1.5l4.5 8h-9z",
    diamond: "M12 1l4.5 5l-4.5 5l-4.5 -5z",
    roundRect: "M10 2.5h4a2 2 0 0 1 2 2v3a2 2 0 0 1 -2 2h-4a2 2 0 0 1 -2 -2v-3a2 2 0 0 1 2 -2z",
  };
  return svg(
    "svg",
    {
      class: "swatch",
      width: 24,
      height: 12,
      viewBox: "0 0 24 12",
      "aria-hidden": "true",
      style: `--light: ${color}; --dark: ${series_style(index, true).color}`,
    },
    svg("path", { d: "M0 6H24", "stroke-width": 2, "stroke-dasharray": dash.join(" ") || null }),
    svg("path", { d: shapes[symbol] ?? "", class: "symbol" }),
  );
}

/** Name of a variant with what it changes. */
export function method_name(data: ReportData, index: number): HTMLElement {
  const method = data.method(index);
  return h(
    "span",
    { class: "method", title: method.description || null },
    h("strong", {}, short(data.method_key(index), 44)),
    method.plans && h("span", { class: "tag", title: "Plans the whole motion ahead; has no time per step" }, "planner"),
    method.external && h("span", { class: "tag", title: "A program of its own, answering through a pipe" }, "external"),
    method.changed !== "" && h("span", { class: "changed" }, short(method.changed, 90)),
  );
}

/** The same with the look that charts give it. */
export const drawn_method = (data: ReportData, index: number): HTMLElement =>
  h("span", { class: "drawn" }, swatch(index), method_name(data, index));

/** State that shows a run: its replay if there is one, at the tick that tells most. */
export function run_change(data: ReportData, run: Run): Change {
  const place = {
    scenario: data.scenario_key(run.scenario),
    method: data.method_key(run.method),
    seed: run.seed ?? "",
    repetition: run.repetition,
    against: "",
  };
  if (run.replay === null) return { ...place, view: "summary", open: run.record };
  return { ...place, view: "replay", tick: run.success ? null : telling_tick(data, run), open: "" };
}

const jumps_of = (data: ReportData, run: Run): Jump[] => jumps(run, data.scenario(run.scenario).scene);

/** Tick at which a failure shows: the collision, the jump, or the largest error. */
export function telling_tick(data: ReportData, run: Run): number | null {
  return run.failure_tick ?? jumps_of(data, run)[0]?.tick ?? run.tip_error_max_tick;
}

/** In a few words why a run failed, beginning with what its verdict names; empty for a success. */
export function reason(data: ReportData, run: Run): string {
  if (!run.applicable) return run.why_not;
  if (run.success) return "";
  const told = [run.claimed, run.claim_detail || run.gave_up].filter((text) => text !== "").join(": ");
  if (verdict_of(run).kind === "crash") return told;
  const contact = run.contacts[0];
  if (contact) return `link ${contact.link} in ${contact.obstacle}, tick ${contact.first_tick}`;
  const self = run.self_contacts[0];
  if (self) return `link ${self.link} in link ${self.other_link}, tick ${self.first_tick}`;
  const far = jumps_of(data, run);
  if (far.length > 0) return far.map(({ size, tick }) => `${size} in tick ${tick ?? "?"}`).join(", ");
  if (run.failures.includes("drift") && run.tip_error_max_m !== null) {
    return `${length(run.tip_error_max_m)} at tick ${run.tip_error_max_tick ?? "?"}`;
  }
  if (run.failures.includes("orientation") && run.orientation_max_rad !== null) {
    return `turned away by ${degrees(run.orientation_max_rad)} at tick ${run.orientation_max_tick ?? "?"}`;
  }
  if (run.disagreement !== "") return run.disagreement;
  return told;
}

const mark_of = (indicative: boolean, pipe: boolean): string => (indicative ? "~" : "") + (pipe ? "⇄" : "");

/** Mark before times that are only indicative, or that include a pipe: of one of the runs at least. */
export const time_mark = (...runs: readonly Run[]): string =>
  mark_of(
    runs.some((run) => run.times_indicative.length > 0),
    runs.some((run) => run.includes_pipe),
  );

/** The same of what the program sums up. */
export const time_mark_of_all = (data: ReportData, entry: MethodSummary): string =>
  mark_of(!entry.times_publishable, data.method(entry.method).external);

/** What the signs in a mark mean, one entry each. */
export function mark_words(mark: string): string[] {
  const words = [];
  if (mark.includes("~")) words.push("~ only indicative");
  if (mark.includes("⇄")) words.push("⇄ includes the pipe to a program of its own");
  return words;
}

/** A time in microseconds after its mark, for columns. */
export const marked_microseconds = (mark: string, seconds: number | null): string =>
  seconds === null ? kNone : `${mark}${microseconds(seconds)}`;

/** Time per step, or of the plan. */
export function run_time(run: Run): string {
  if (run.plan_s !== null) return `${time_mark(run)}plan ${time(run.plan_s)}`;
  return marked_microseconds(time_mark(run), run.step_median_s);
}

/** A bar from 0 to 100 % with its interval. */
export function rate_bar(entry: MethodSummary): SVGSVGElement {
  const at = (share: number): number => 2 + 76 * share;
  const { rate, rate_lower, rate_upper } = entry;
  return svg(
    "svg",
    { class: "rate", width: 80, height: 14, viewBox: "0 0 80 14", "aria-hidden": "true" },
    svg("rect", { x: 2, y: 4, width: 76, height: 6, class: "rate-all" }),
    rate !== null && svg("rect", { x: 2, y: 4, width: 76 * rate, height: 6, class: "rate-good" }),
    rate_lower !== null &&
      rate_upper !== null &&
      svg("path", {
        class: "rate-interval",
        d: `M${at(rate_lower)} 7H${at(rate_upper)}M${at(rate_lower)} 3V11M${at(rate_upper)} 3V11`,
      }),
  );
}

/** Wilson's interval of a rate [%]. */
export function rate_interval(entry: MethodSummary): string {
  const digits = entry.runs < 200 ? 0 : 1;
  return interval(entry.rate_lower, entry.rate_upper, (share) => (100 * share).toFixed(digits));
}

/** A heading with what belongs beside it. */
export function heading(text: string, ...beside: Child[]): HTMLElement {
  return h("div", { class: "heading" }, h("h2", {}, text), ...beside);
}

/** A choice among the families or the robots of the report; nothing where there is one. */
export function scope_choice(data: ReportData, link: Link, key: "family" | "robot", all: string, label: string): Child {
  const names = key === "family" ? data.families : data.robots;
  return (
    names.length > 1 &&
    select(
      label,
      [{ value: "", text: all }, ...names.map((name) => ({ value: name, text: name }))],
      link.state[key],
      (value) => link.change({ [key]: value, open: "" }),
    )
  );
}

/** What stands in the place of a view that has no data. */
export function nothing(text: string, command: string): HTMLElement {
  return h("p", { class: "nothing" }, text, " ", h("code", {}, command));
}

/** A link within the page. */
export function inner_link(link: Link, change: Change, ...children: Child[]): HTMLAnchorElement {
  return h(
    "a",
    {
      href: link.href(change),
      click: (event) => {
        const mouse = event as MouseEvent;
        if (mouse.ctrlKey || mouse.metaKey || mouse.shiftKey || mouse.button !== 0) return;
        event.preventDefault();
        link.change(change);
      },
    },
    ...children,
  );
}

export { verdict_of };
