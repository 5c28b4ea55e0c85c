// The page: header, tabs, and the view that the address asks for.
import "./style.css";
import { read_data, type ReportData } from "./data";
import { cut, h, replace } from "./dom";
import { counted, date } from "./format";
import { kViews, Link, type View, type ViewName } from "./link";
import { choose_theme, is_dark } from "./palette";
import { replayView } from "./replay/replay";
import { claims_view } from "./views/claims";
import { provenance_view } from "./views/provenance";
import { scaling_view } from "./views/scaling";
import { summary_view } from "./views/summary";
import { trade_offs_view } from "./views/trade_offs";

type MakeView = (host: HTMLElement, data: ReportData, link: Link) => View;

const kTabs: Record<ViewName, { text: string; make: MakeView }> = {
  summary: { text: "Summary", make: summary_view },
  scaling: { text: "Scaling", make: scaling_view },
  replay: { text: "Replay", make: replayView },
  claims: { text: "Claims", make: claims_view },
  "trade-offs": { text: "Trade-offs", make: trade_offs_view },
  provenance: { text: "Provenance", make: provenance_view },
};

/** The warnings in red, the first of them at once. */
function warnings(data: ReportData, link: Link): HTMLElement | null {
  const [first, ...others] = data.report.warnings;
  if (first === undefined) return null;
  const head = [
    h("strong", {}, "⚠ Read with care: "),
    cut(first, 200),
    others.length > 0 && ` – and ${others.length} more`,
  ];
  return h(
    "details",
    { class: "warnings", role: "note" },
    h("summary", {}, ...head),
    others.length > 0 && h("ul", {}, ...others.map((warning) => h("li", {}, warning))),
    h("p", {}, h("a", { href: link.href({ view: "provenance" }) }, "Provenance"), " has the details."),
  );
}

function header(data: ReportData, link: Link): HTMLElement {
  const { report } = data;
  const toggle = h("button", {
    type: "button",
    class: "quiet theme",
    click: () => {
      choose_theme(is_dark() ? "light" : "dark");
      name_toggle();
    },
  });
  const name_toggle = (): void => {
    toggle.textContent = is_dark() ? "☀ Light" : "☾ Dark";
  };
  name_toggle();
  return h(
    "header",
    {},
    h("div", { class: "title" }, h("h1", {}, report.title), toggle),
    h(
      "p",
      { class: "muted" },
      [
        counted(report.source.runs, "judged run"),
        counted(report.scenarios.length, "scenario"),
        counted(report.methods.length, "method variant"),
        date(report.date),
      ].join(" · "),
    ),
    warnings(data, link),
  );
}

function tab_list(link: Link): { element: HTMLElement; update: (view: ViewName) => void } {
  const buttons = kViews.map((view) =>
    h(
      "button",
      {
        type: "button",
        role: "tab",
        id: `tab-${view}`,
        "aria-controls": "view",
        click: () => link.change({ view }),
      },
      kTabs[view].text,
    ),
  );
  const move = (event: Event): void => {
    const key = (event as KeyboardEvent).key;
    const from = kViews.indexOf(link.state.view);
    const to =
      key === "ArrowRight" ? from + 1 : key === "ArrowLeft" ? from - 1 : key === "Home" ? 0 : key === "End" ? -1 : null;
    if (to === null) return;
    event.preventDefault();
    const view = kViews[(to + kViews.length) % kViews.length] as ViewName;
    link.change({ view });
    document.getElementById(`tab-${view}`)?.focus();
  };
  const element = h("div", { class: "tabs", role: "tablist", "aria-label": "Views", keydown: move }, ...buttons);
  return {
    element,
    update: (view) => {
      buttons.forEach((button, i) => {
        const chosen = kViews[i] === view;
        button.setAttribute("aria-selected", String(chosen));
        button.tabIndex = chosen ? 0 : -1;
        if (chosen) element.scrollLeft = button.offsetLeft - (element.clientWidth - button.offsetWidth) / 2;
      });
    },
  };
}

function start(page: HTMLElement): void {
  const data = read_data();
  const link = new Link();
  document.title = `${cut(data.report.title, 80)} – bqsa-bench`;
  const tabs = tab_list(link);
  const host = h("div", { id: "view", role: "tabpanel", tabindex: "-1" });
  replace(page, header(data, link), tabs.element, h("main", {}, host));

  let shown: ViewName | null = null;
  let view: View | null = null;
  const show = (): void => {
    if (link.state.view === shown) {
      view?.update(link.state);
      return;
    }
    view?.dispose();
    shown = link.state.view;
    tabs.update(shown);
    host.setAttribute("aria-labelledby", `tab-${shown}`);
    host.replaceChildren();
    view = kTabs[shown].make(host, data, link);
  };
  link.listen(show);
  show();
}

const page = document.getElementById("page") as HTMLElement;
try {
  start(page);
} catch (error) {
  console.error(error);
  replace(
    page,
    h(
      "p",
      { class: "problem", role: "alert" },
      "This report cannot be shown: ",
      error instanceof Error ? error.message : String(error),
    ),
  );
}
