// Where the figures come from, and what speaks against them.
import type { LedgerEntry, Origin, ReportData, Scenario } from "../data";
import { cut, h, replace, short, type Child } from "../dom";
import { count, counted, date, kNone, length, millimetres, number } from "../format";
import type { Link, View } from "../link";
import { heading, method_name } from "../parts";
import { SortedTable } from "../table";

export function provenance_view(host: HTMLElement, data: ReportData, link: Link): View {
  const tables: { dispose: () => void }[] = [];
  const scenarios = scenario_table(link);
  const parameters = parameter_table(data, link);
  const solids = solid_table(link);
  tables.push(scenarios, parameters, solids);
  host.append(
    ...present(
      warnings(data),
      source(data),
      origins(data),
      measurements(data),
      h("section", {}, heading("Scenarios"), scenarios.element),
      ledger(data, solids.element),
      h("section", {}, heading("Methods and their parameters"), parameters.element),
      seeds(data),
      licences(),
    ),
  );
  scenarios.set(data.report.scenarios);
  solids.set(solids_of(data));
  parameters.set(data.report.methods.flatMap((method, index) => (method.parameters.length > 0 ? [index] : [])));
  let sort = link.state.sort;
  return {
    update: (state) => {
      if (state.sort === sort) return;
      sort = state.sort;
      scenarios.set(data.report.scenarios);
      solids.set(solids_of(data));
    },
    dispose: () => {
      for (const table of tables) table.dispose();
    },
  };
}

const present = (...children: (Node | null)[]): Node[] => children.filter((child): child is Node => child !== null);

/** A table of names and values. */
function facts(rows: readonly (readonly [string, Child])[]): HTMLElement {
  return h(
    "dl",
    { class: "facts" },
    ...rows.flatMap(([name, value]) => (value === null || value === "" ? [] : [h("dt", {}, name), h("dd", {}, value)])),
  );
}

function warnings(data: ReportData): HTMLElement {
  const { warnings } = data.report;
  if (warnings.length === 0) {
    return h(
      "section",
      {},
      heading("Provenance"),
      h("p", { class: "fine" }, "✓ Nothing known speaks against publishing these figures."),
    );
  }
  return h(
    "section",
    {},
    heading("Provenance"),
    h(
      "div",
      { class: "problem", role: "note" },
      h("strong", {}, "⚠ What speaks against publishing these figures, or is missing"),
      h("ul", {}, ...warnings.map((warning) => h("li", {}, warning))),
    ),
  );
}

function source(data: ReportData): HTMLElement {
  const { report } = data;
  const { source } = report;
  return h(
    "section",
    {},
    h("h3", {}, "This page"),
    facts([
      ["Made by", report.program],
      ["Made on", date(report.date)],
      ["Directory", source.directory],
      ["Campaign", source.campaign ?? ""],
      ["Planned", source.planned === null ? "" : count(source.planned)],
      ["Judged runs", count(source.runs)],
      ["Pairs that do not fit (n/a)", count(source.not_applicable)],
      ["Records replaced by later ones", count(source.superseded)],
      ["Records not of the plan", count(source.stale)],
    ]),
    source.bad_lines.length > 0 &&
      h(
        "div",
        { class: "problem" },
        h("strong", {}, "Lines that are not records"),
        h("ul", {}, ...source.bad_lines.map((line) => h("li", {}, line))),
      ),
  );
}

/** Builds and machines beside each other; what differs stands out. */
function origins(data: ReportData): HTMLElement {
  const { origins } = data.report;
  const keys = [...new Set(origins.flatMap((origin) => origin.values.map(([key]) => key)))];
  const value = (origin: Origin, key: string): string => origin.values.find(([name]) => name === key)?.[1] ?? kNone;
  const runs = origins.map(
    (_, index) => data.report.runs.filter((run) => run.applicable && run.origin === index).length,
  );
  const rows = keys.map((key) => {
    const values = origins.map((origin) => value(origin, key));
    const differs = new Set(values).size > 1;
    return h(
      "tr",
      { class: differs ? "differs" : null },
      h("th", { scope: "row" }, key, differs && h("span", { class: "tag" }, "differs")),
      ...values.map((text) => h("td", {}, text)),
    );
  });
  return h(
    "section",
    {},
    h("h3", {}, origins.length > 1 ? `Builds and machines: ${origins.length} different ones` : "Build and machine"),
    h(
      "div",
      { class: "scroll", tabindex: "0", role: "region", "aria-label": "Builds and machines" },
      h(
        "table",
        { class: "origins" },
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            h("th", { scope: "col" }, ""),
            ...origins.map((origin, i) =>
              h("th", { scope: "col" }, origin.label, h("span", { class: "unit block" }, counted(runs[i] ?? 0, "run"))),
            ),
          ),
        ),
        h("tbody", {}, ...rows),
      ),
    ),
  );
}

function measurements(data: ReportData): HTMLElement | null {
  const { measurements, claims } = data.report;
  if (!measurements && !claims) return null;
  return h(
    "section",
    {},
    h("h3", {}, "Measurements and claims"),
    measurements &&
      h(
        "div",
        {},
        measurements.publishable
          ? null
          : h("p", { class: "problem" }, `⚠ Not publishable: ${measurements.against.join("; ")}`),
        facts([["File", measurements.file], ...measurements.context]),
      ),
    claims &&
      facts([
        ["Claims", claims.file],
        ["Effort", claims.effort],
        ["Judged by", claims.build],
        ["On", claims.machine],
      ]),
  );
}

function scenario_table(link: Link): SortedTable<Scenario> {
  return new SortedTable({
    name: "scenarios",
    label: "Scenarios",
    link,
    columns: [
      {
        name: "name",
        head: "Name",
        text: true,
        sort: (s) => s.name,
        cell: (s) => h("span", { title: s.description || null }, short(s.name, 40)),
      },
      { name: "file", head: "File", text: true, sort: (s) => s.file, cell: (s) => short(s.file, 60) },
      { name: "sha256", head: "SHA-256", text: true, cell: (s) => h("code", { class: "hash" }, s.sha256) },
      { name: "family", head: "Family", text: true, sort: (s) => s.family, cell: (s) => short(s.family, 30) },
      {
        name: "size",
        head: "Joints × obstacles",
        sort: (s) => s.nk,
        cell: (s) => `${s.joints} × ${s.obstacles.length}`,
      },
      { name: "ticks", head: "Ticks", sort: (s) => s.ticks, cell: (s) => count(s.ticks) },
      { name: "tolerance", head: "Tolerance", sort: (s) => s.tolerance_m, cell: (s) => length(s.tolerance_m) },
      {
        name: "scene",
        head: "Drawn",
        text: true,
        sort: (s) => s.scene_missing,
        cell: (s) => (s.scene ? "yes" : h("span", { class: "muted" }, short(s.scene_missing, 60))),
      },
    ],
  });
}

interface SolidOfScenario {
  scenario: Scenario;
  solid: LedgerEntry;
}

const solids_of = (data: ReportData): SolidOfScenario[] =>
  data.report.scenarios.flatMap((scenario) => (scenario.geometry?.solids ?? []).map((solid) => ({ scenario, solid })));

/** What it costs that methods are told of ellipsoids where obstacles are solids. */
function ledger(data: ReportData, table: HTMLElement): HTMLElement | null {
  const with_solids = data.report.scenarios.filter((scenario) => scenario.geometry !== null);
  if (with_solids.length === 0) return null;
  const lost = with_solids.map(({ name, geometry }) => {
    const excess =
      geometry!.radius_excess_m > 0 ? `, links further away by up to ${length(geometry!.radius_excess_m)}` : "";
    return h("li", {}, `${short(name, 40)}: gaps narrower by up to ${length(geometry!.gap_lost_m)}${excess}`);
  });
  return h(
    "section",
    {},
    heading("Geometry ledger"),
    h(
      "p",
      {},
      "Solids are judged as they are. Methods are told of ellipsoids around them, which reach beyond them by their inflation at most; " +
        "by how much a gap between two obstacles becomes narrower is bounded by the sum of their inflations. Methods that add " +
        "the links' radius to the ellipsoids keep links away from these by more than the radius.",
    ),
    h("ul", {}, ...lost),
    table,
  );
}

function solid_table(link: Link): SortedTable<SolidOfScenario> {
  return new SortedTable<SolidOfScenario>({
    name: "solids",
    label: "Geometry ledger",
    link,
    columns: [
      {
        name: "scenario",
        head: "Scenario",
        text: true,
        sort: ({ scenario }) => scenario.name,
        cell: ({ scenario }) => short(scenario.name, 40),
      },
      {
        name: "solid",
        head: "Solid",
        text: true,
        sort: ({ solid }) => solid.name,
        cell: ({ solid }) => short(solid.name, 40),
      },
      { name: "kind", head: "Kind", text: true, sort: ({ solid }) => solid.kind, cell: ({ solid }) => solid.kind },
      { name: "parts", head: "Parts", sort: ({ solid }) => solid.parts, cell: ({ solid }) => count(solid.parts) },
      {
        name: "ellipsoids",
        head: "Ellipsoids",
        sort: ({ solid }) => solid.ellipsoids,
        cell: ({ solid }) => count(solid.ellipsoids),
      },
      {
        name: "inflation",
        head: "Inflation",
        unit: "mm",
        about: "No ellipsoid reaches further beyond the solid",
        sort: ({ solid }) => solid.inflation_m,
        cell: ({ solid }) => millimetres(solid.inflation_m),
      },
      {
        name: "volume",
        head: "Volume ratio",
        about: "Volumes of the ellipsoids over those of the solid's parts",
        sort: ({ solid }) => solid.volume_ratio ?? Infinity,
        cell: ({ solid }) => number(solid.volume_ratio),
      },
      {
        name: "filled",
        head: "Hull over mesh",
        about: "Volumes of a mesh's parts over what it encloses",
        sort: ({ solid }) => solid.hull_over_mesh ?? 0,
        cell: ({ solid }) => number(solid.hull_over_mesh),
      },
      {
        name: "bounds",
        head: "As asked for",
        text: true,
        about: "Whether the bounds of the envelope that the scenario asks for were reached",
        sort: ({ solid }) => (solid.within_bounds ? "yes" : "no"),
        cell: ({ solid }) => (solid.within_bounds ? "yes" : h("span", { class: "bad" }, "no, larger")),
      },
    ],
  });
}

function parameter_table(data: ReportData, link: Link): SortedTable<number> {
  return new SortedTable<number>({
    name: "parameters",
    label: "Methods and their parameters",
    link,
    columns: [
      { name: "method", head: "Method", text: true, cell: (index) => method_name(data, index) },
      {
        name: "values",
        head: "Parameters, changed ones bold",
        text: true,
        cell: (index) =>
          data.method(index).parameters.flatMap((parameter, i) => {
            const unit = parameter.unit === "" || parameter.unit === "-" ? "" : ` ${parameter.unit}`;
            const text = `${parameter.name} = ${cut(parameter.value, 60)}${unit}`;
            return [
              i > 0 && " · ",
              h(parameter.changed ? "strong" : "span", { title: parameter.meaning || null }, text),
            ];
          }),
      },
    ],
  });
}

function seeds(data: ReportData): HTMLElement | null {
  const seeds = [...new Set(data.report.runs.flatMap((run) => (run.seed === null ? [] : [run.seed])))];
  if (seeds.length === 0) return null;
  const shown = seeds.slice(0, 200);
  return h(
    "section",
    {},
    heading("Seeds"),
    h(
      "p",
      { class: "seeds" },
      shown.join(", "),
      seeds.length > shown.length && ` and ${count(seeds.length - shown.length)} more`,
    ),
  );
}

function licences(): HTMLElement {
  const text = document.getElementById("licences")?.textContent ?? "";
  const host = h("pre", {});
  const element = h(
    "details",
    { class: "licences" },
    h("summary", {}, "Licences of what this page is made with"),
    host,
  );
  element.addEventListener("toggle", () => replace(host, element.open ? text.trim() : null));
  return element;
}
