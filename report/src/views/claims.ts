// What is claimed, what was measured, and the verdict.
import type { Claim, ClaimFigure, PaperFigure, ReportData } from "../data";
import { choice, h, redraw, relative_link, replace, type Child } from "../dom";
import { interval, kNone, number } from "../format";
import type { Link, State, View } from "../link";
import { heading, nothing } from "../parts";
import { words } from "./summary_runs";

const kVerdicts: Record<string, { symbol: string; kind: string }> = {
  confirmed: { symbol: "✓", kind: "success" },
  "confirmed with correction": { symbol: "✓", kind: "corrected" },
  refuted: { symbol: "✗", kind: "failure" },
  "not decidable": { symbol: "?", kind: "no-verdict" },
};

const look_of = (verdict: string): { symbol: string; kind: string } =>
  kVerdicts[verdict] ?? { symbol: "?", kind: "no-verdict" };

function badge(verdict: string): HTMLElement {
  const { symbol, kind } = look_of(verdict);
  return h(
    "span",
    { class: `verdict ${kind}` },
    h("span", { class: "symbol", "aria-hidden": "true" }, symbol),
    ` ${verdict}`,
  );
}

function unit_of(figure: ClaimFigure): string {
  return figure.unit === "-" || figure.unit === "" ? "" : ` ${figure.unit}`;
}

/** The figures that the bounds speak of; without bounds the first one. */
function telling_figures(claim: Claim): ClaimFigure[] {
  const names = new Set(bounds_of(claim).map((bound) => bound.figure));
  const told = claim.figures.filter((figure) => names.has(figure.name));
  return told.length > 0 ? told : claim.figures.slice(0, 1);
}

function bounds_of(claim: Claim): Claim["as_stated"] {
  return claim.corrected.length > 0 && claim.verdict.startsWith("confirmed with") ? claim.corrected : claim.as_stated;
}

function measured(claim: Claim): Child[] {
  const figures = telling_figures(claim);
  if (figures.length === 0) return [kNone];
  const asked = (figure: ClaimFigure): string =>
    bounds_of(claim).find((bound) => bound.figure === figure.name)?.bound ?? "";
  return figures.slice(0, 4).map((figure) => {
    const range = interval(figure.lower, figure.upper);
    return h(
      "span",
      { class: "block" },
      figures.length > 1 && h("span", { class: "muted" }, `${spaced(figure.name)} `),
      h("strong", {}, number(figure.value)),
      unit_of(figure),
      range !== "" && h("span", { class: "muted" }, ` ${range}`),
      asked(figure) !== "" && h("span", { class: "asked" }, ` asked: ${asked(figure)}`),
    );
  });
}

const spaced = (name: string): string => name.replaceAll("_", " ");

function bounds(title: string, list: Claim["as_stated"]): Child {
  if (list.length === 0) return null;
  const mark: Record<string, string> = { holds: "✓", fails: "✗" };
  return h(
    "div",
    {},
    h("h4", {}, title),
    h(
      "ul",
      {},
      ...list.map((bound) =>
        h(
          "li",
          {},
          `${spaced(bound.figure)} ${bound.bound}: `,
          h(
            "span",
            {
              class: `verdict ${bound.outcome === "holds" ? "success" : bound.outcome === "fails" ? "failure" : "no-verdict"}`,
            },
            `${mark[bound.outcome] ?? "?"} ${bound.outcome}`,
          ),
        ),
      ),
    ),
  );
}

function details(claim: Claim): HTMLElement {
  return h(
    "div",
    { class: "claim-details" },
    claim.reason !== "" && h("p", {}, h("strong", {}, "Reason: "), claim.reason),
    claim.correction !== "" && h("p", {}, h("strong", {}, "Correction: "), claim.correction),
    claim.note !== "" && h("p", {}, claim.note),
    ...claim.remarks.map((remark) => h("p", { class: "muted" }, remark)),
    h("div", { class: "columns" }, bounds("As stated", claim.as_stated), bounds("As corrected", claim.corrected)),
    claim.figures.length > 0 &&
      h(
        "div",
        { class: "scroll" },
        h(
          "table",
          {},
          h(
            "thead",
            {},
            h(
              "tr",
              {},
              h("th", { scope: "col" }, "Figure"),
              h("th", { scope: "col", class: "num" }, "Value"),
              h("th", { scope: "col" }, "Unit"),
              h("th", { scope: "col", class: "num" }, "Interval"),
              h("th", { scope: "col" }, "Meaning"),
            ),
          ),
          h(
            "tbody",
            {},
            ...claim.figures.map((figure) =>
              h(
                "tr",
                {},
                h("td", {}, spaced(figure.name)),
                h("td", { class: "num" }, number(figure.value, 4)),
                h("td", {}, figure.unit),
                h(
                  "td",
                  { class: "num" },
                  interval(figure.lower, figure.upper, (value) => number(value, 4)),
                ),
                h("td", {}, figure.meaning),
              ),
            ),
          ),
        ),
      ),
    h("p", { class: "muted" }, "Proven again by ", h("code", {}, `bqsa-bench claims --only ${claim.id}`)),
  );
}

function paper_figures(figures: readonly PaperFigure[]): HTMLElement | null {
  if (figures.length === 0) return null;
  return h(
    "section",
    {},
    heading("Figures of the paper, drawn again"),
    h("p", { class: "muted" }, "By gnuplot, beside this page; each with its data and script."),
    h(
      "ul",
      { class: "figures" },
      ...figures.map((figure) =>
        h(
          "li",
          {},
          h("span", { class: "unit" }, figure.paper === "-" ? "" : `${figure.paper} `),
          figure.title,
          " ",
          ...figure.files.flatMap((file) => [relative_link(file.href, file.label), " "]),
        ),
      ),
    ),
  );
}

export function claims_view(host: HTMLElement, data: ReportData, link: Link): View {
  const { claims, figures } = data.report;
  const figure_list = paper_figures(figures);
  if (!claims || claims.claims.length === 0) {
    host.append(
      heading("Claims"),
      nothing("No claims were judged beside these results. They are judged by", "bqsa-bench claims --out DIR/claims"),
    );
    if (figure_list) host.append(figure_list);
    return { update: () => {}, dispose: () => {} };
  }
  const filters = h("div", { class: "controls", role: "group", "aria-label": "Verdict" });
  const find = h("input", { type: "search", placeholder: "words", "aria-label": "Find claims" });
  const list = h("div", { class: "claims" });
  let wanted = "?";
  const update = (state: Readonly<State>): void => {
    const now = [state.verdict, state.find].join("\n");
    if (now === wanted) {
      const asked = state.open === "" ? null : document.getElementById(`claim-${state.open}`);
      if (asked instanceof HTMLDetailsElement) asked.open = true;
      return;
    }
    wanted = now;
    const known = ["", "paper", "surprise", ...new Set(claims.claims.map((claim) => claim.verdict))];
    const verdict = known.includes(state.verdict) ? state.verdict : "";
    const holds = (claim: Claim, value: string): boolean =>
      value === "" ||
      claim.verdict === value ||
      (value === "paper" && claim.paper) ||
      (value === "surprise" && claim.standing !== "as expected");
    const texts: Record<string, string> = { "": "all", paper: "of the paper", surprise: "not as expected" };
    redraw(
      filters,
      ...known
        .map((value) => ({ value, size: claims.claims.filter((claim) => holds(claim, value)).length }))
        .filter(({ size, value }) => size > 0 || value === "")
        .map(({ value, size }) =>
          choice(
            `${kVerdicts[value] ? `${look_of(value).symbol} ` : ""}${texts[value] ?? value} ${size}`,
            value === verdict,
            () => link.change({ verdict: value }),
          ),
        ),
    );
    if (document.activeElement !== find) find.value = state.find;
    const needles = words(state.find);
    const chosen = claims.claims.filter(
      (claim) =>
        holds(claim, verdict) &&
        needles.every((word) =>
          `${claim.id} ${claim.statement} ${claim.source} ${claim.note}`.toLowerCase().includes(word),
        ),
    );
    replace(
      list,
      ...chosen.map((claim) => claim_element(claim, claim.id === state.open, link)),
      chosen.length === 0 && h("p", { class: "muted" }, "No claim is like that."),
    );
  };
  find.addEventListener("input", () => link.change({ find: find.value }));
  host.append(
    heading("Claims"),
    h(
      "p",
      { class: "muted" },
      `Statements of the paper and of this project, judged with ${claims.effort} effort from ${claims.file}. ${claims.build}; ${claims.machine}.`,
    ),
    h("div", { class: "filters" }, filters, find),
    list,
  );
  if (figure_list) host.append(figure_list);
  update(link.state);
  if (link.state.open !== "") document.getElementById(`claim-${link.state.open}`)?.scrollIntoView({ block: "center" });
  return { update, dispose: () => {} };
}

function claim_element(claim: Claim, open: boolean, link: Link): HTMLElement {
  const surprising = claim.standing !== "as expected";
  const element = h(
    "details",
    { class: `claim ${look_of(claim.verdict).kind}`, open, id: `claim-${claim.id}` },
    h(
      "summary",
      {},
      h(
        "span",
        { class: "claim-verdict" },
        badge(claim.verdict),
        surprising && h("span", { class: "tag bad", title: `expected: ${claim.expected}` }, claim.standing),
      ),
      h(
        "span",
        { class: "claim-statement" },
        claim.statement,
        " ",
        h("span", { class: "muted source" }, claim.source === "none" ? "" : claim.source),
      ),
      h("span", { class: "claim-measured" }, ...measured(claim)),
    ),
  );
  const fill = (): void => {
    if (element.open && element.childElementCount === 1) element.append(details(claim));
  };
  element.addEventListener("toggle", () => {
    fill();
    if (!element.isConnected) return;
    if (element.open && link.state.open !== claim.id) link.change({ open: claim.id });
    if (!element.open && link.state.open === claim.id) link.change({ open: "" });
  });
  fill();
  return element;
}
