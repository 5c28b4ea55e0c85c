// The first line of the summary.
import type { ReportData } from "../data";
import { h, type Child } from "../dom";
import { count, counted } from "../format";
import type { Link } from "../link";
import { inner_link, verdict_of } from "../parts";

export function at_a_glance(data: ReportData, link: Link): HTMLElement {
  const tally = { success: 0, failure: 0, crash: 0, "no-verdict": 0, "not-applicable": 0, lies: 0 };
  for (const run of data.report.runs) {
    const verdict = verdict_of(run);
    tally[verdict.kind] += 1;
    if (verdict.lie) tally.lies += 1;
  }
  const fact = (value: number, word: string, verdict: string, kind: string): Child =>
    value > 0 &&
    h("li", { class: kind }, inner_link(link, { verdict, open: "" }, h("strong", {}, count(value)), ` ${word}`));
  const { source } = data.report;
  const missing = source.planned === null ? 0 : source.planned - data.report.runs.length;
  return h(
    "ul",
    { class: "glance", "aria-label": "At a glance" },
    fact(tally.success, tally.success === 1 ? "succeeds" : "succeed", "success", "good"),
    fact(tally.failure, tally.failure === 1 ? "fails" : "fail", "failure", "bad"),
    fact(tally.crash, tally.crash === 1 ? "crashes or misbehaves" : "crash or misbehave", "crash", "bad"),
    fact(tally["no-verdict"], "without verdict", "no-verdict", "warn"),
    tally.lies > 0
      ? fact(tally.lies, tally.lies === 1 ? "wrong claim" : "wrong claims", "wrong-claim", "bad")
      : h("li", {}, h("strong", {}, "No"), " wrong claim of a method"),
    fact(
      tally["not-applicable"],
      tally["not-applicable"] === 1 ? "pair does not fit (n/a)" : "pairs do not fit (n/a)",
      "not-applicable",
      "",
    ),
    missing > 0 &&
      h(
        "li",
        { class: "warn" },
        h("strong", {}, counted(missing, "run")),
        ` of the campaign's ${count(source.planned ?? 0)} are missing`,
      ),
  );
}
