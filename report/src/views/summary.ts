// Who succeeds, where, at what cost, and whether methods say the truth of themselves.
import type { ReportData } from "../data";
import { h } from "../dom";
import type { Link, State, View } from "../link";
import { at_a_glance } from "./summary_glance";
import { kFewScenarios, MatrixPart } from "./summary_matrix";
import { MethodsPart } from "./summary_methods";
import { RunsPart } from "./summary_runs";

export function summary_view(host: HTMLElement, data: ReportData, link: Link): View {
  // Rates of few scenarios say little; there the single verdicts come first.
  const methods = new MethodsPart(data, link);
  const matrix = new MatrixPart(data, link);
  const parts = [
    ...(data.report.scenarios.length <= kFewScenarios ? [matrix, methods] : [methods, matrix]),
    new RunsPart(data, link),
  ];
  host.append(at_a_glance(data, link), ...parts.map((part) => part.element), legend(data));
  return {
    update: (state: Readonly<State>) => {
      for (const part of parts) part.update(state);
    },
    dispose: () => {
      for (const part of parts) part.dispose();
    },
  };
}

function legend(data: ReportData): HTMLElement {
  return h(
    "details",
    { class: "legend" },
    h("summary", {}, "What the words mean"),
    ...data.report.success_means.map((line) => h("p", {}, line)),
    h(
      "p",
      {},
      "Times are of successes only: a run that collides, drifts or claims falsely is never fast. ~ marks times that are only indicative, ⇄ times that include the pipe to a program of its own. ",
      "Intervals are 95 %: Wilson's for rates, bootstrap for medians. “tied” means that the paired difference to the best does not exclude zero.",
    ),
  );
}
