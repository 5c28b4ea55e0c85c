// A chart with its heading, its data as a table, and what saves it: SVG, PNG, CSV.
import * as echarts from "echarts/core";
import { CustomChart, LineChart, ScatterChart } from "echarts/charts";
import {
  GridComponent,
  LegendComponent,
  MarkAreaComponent,
  MarkLineComponent,
  TitleComponent,
  TooltipComponent,
} from "echarts/components";
import { LabelLayout } from "echarts/features";
import { SVGRenderer } from "echarts/renderers";
import type { EChartsCoreOption, EChartsType } from "echarts/core";
import { h, replace, save } from "./dom";
import { kLightTheme, on_theme, theme, type Theme } from "./palette";

echarts.use([
  CustomChart,
  LineChart,
  ScatterChart,
  GridComponent,
  LegendComponent,
  MarkAreaComponent,
  MarkLineComponent,
  TitleComponent,
  TooltipComponent,
  LabelLayout,
  SVGRenderer,
]);

export type Option = EChartsCoreOption;

/** What a chart shows, as a table: its text alternative and its CSV. */
export interface Table {
  columns: string[]; ///< with units
  rows: (string | number | null)[][];
}

export interface ChartSpec {
  name: string; ///< of the files that are saved, without ending
  title: string;
  label: string; ///< what it shows, for those who do not see it
  height: number; ///< [px]
  option: (theme: Theme, width: number) => Option; ///< width of the chart [px]
  table: () => Table;
  click?: (params: unknown) => void;
}

/** Options that all charts share. Tooltips are drawn inside the SVG: no text of the data is ever read as HTML. */
export function common(theme: Theme): Option {
  return {
    animation: false,
    textStyle: { fontFamily: "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif", color: theme.text },
    tooltip: {
      renderMode: "richText",
      confine: true,
      backgroundColor: theme.background,
      borderColor: theme.line,
      textStyle: { color: theme.text, fontSize: 12 },
    },
  };
}

/** Look of an axis. */
export function axis(theme: Theme, more: Record<string, unknown>): Record<string, unknown> {
  return {
    axisLine: { show: true, lineStyle: { color: theme.muted } },
    axisTick: { lineStyle: { color: theme.muted } },
    axisLabel: { color: theme.muted, fontSize: 11, ...((more["axisLabel"] as object | undefined) ?? {}) },
    nameTextStyle: { color: theme.text, fontSize: 12 },
    nameLocation: "middle",
    splitLine: { lineStyle: { color: theme.line } },
    minorSplitLine: { show: false },
    ...Object.fromEntries(Object.entries(more).filter(([key]) => key !== "axisLabel")),
  };
}

const kExport = { width: 960, height: 600 };
const kMostRows = 500; ///< of the table on the page; the CSV has all

export class Chart {
  readonly element: HTMLElement;
  #spec: ChartSpec;
  #canvas: HTMLElement;
  #title: HTMLElement;
  #data: HTMLDetailsElement;
  #chart: EChartsType | null = null;
  #sizes: ResizeObserver;
  #end_theme: () => void;

  constructor(spec: ChartSpec) {
    this.#spec = spec;
    this.#canvas = h("div", { class: "chart-canvas", role: "img" });
    this.#title = h("span", {});
    this.#data = h("details", { class: "chart-data", toggle: () => this.#fill_table() }, h("summary", {}, "Data"));
    const button = (text: string, action: () => void): HTMLElement =>
      h("button", { type: "button", class: "quiet", title: `Save this chart as ${text}`, click: action }, text);
    this.element = h(
      "figure",
      { class: "chart" },
      h(
        "figcaption",
        {},
        this.#title,
        h(
          "span",
          { class: "chart-tools" },
          button("SVG", () => save(`${this.#spec.name}.svg`, this.svg())),
          button("PNG", () => void this.png().then((image) => save(`${this.#spec.name}.png`, image))),
          button("CSV", () => save(`${this.#spec.name}.csv`, this.csv())),
        ),
      ),
      this.#canvas,
      this.#data,
    );
    this.#sizes = new ResizeObserver(() => this.#fit());
    this.#sizes.observe(this.#canvas);
    this.#end_theme = on_theme(() => this.#draw());
    this.#describe();
  }

  /** Shows something else. */
  set(spec: ChartSpec): void {
    this.#spec = spec;
    this.#describe();
    this.#draw();
    if (this.#data.open) this.#fill_table();
  }

  /** The chart of ECharts, for cursors; null before it is first drawn. */
  get instance(): EChartsType | null {
    return this.#chart;
  }

  dispose(): void {
    this.#sizes.disconnect();
    this.#end_theme();
    this.#chart?.dispose();
    this.#chart = null;
  }

  /** The chart for papers: light, of one size, with title and legend. */
  svg(): Blob {
    const host = h("div", {
      style: `width:${kExport.width}px;height:${kExport.height}px;position:absolute;left:-9999px`,
    });
    document.body.append(host);
    const chart = echarts.init(host, null, { renderer: "svg", ...kExport });
    try {
      chart.setOption({
        ...this.#spec.option(kLightTheme, kExport.width),
        backgroundColor: kLightTheme.background,
        animation: false,
      });
      chart.setOption({ title: { text: this.#spec.title, left: "center", top: 8, textStyle: { fontSize: 15 } } });
      const drawn = host.querySelector("svg");
      if (!drawn) throw new Error("the chart was not drawn");
      drawn.setAttribute("xmlns", "http://www.w3.org/2000/svg");
      return new Blob([new XMLSerializer().serializeToString(drawn)], { type: "image/svg+xml" });
    } finally {
      chart.dispose();
      host.remove();
    }
  }

  /** The same as pixels, twice as fine. */
  async png(): Promise<Blob> {
    const url = URL.createObjectURL(this.svg());
    try {
      const image = new Image(kExport.width, kExport.height);
      image.src = url;
      await image.decode();
      const canvas = h("canvas", { width: 2 * kExport.width, height: 2 * kExport.height });
      const context = canvas.getContext("2d");
      if (!context) throw new Error("no canvas to draw on");
      context.drawImage(image, 0, 0, canvas.width, canvas.height);
      return await new Promise((done, fail) =>
        canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error("no PNG was made"))), "image/png"),
      );
    } finally {
      URL.revokeObjectURL(url);
    }
  }

  csv(): Blob {
    return new Blob([csv_of(this.#spec.table())], { type: "text/csv;charset=utf-8" });
  }

  #describe(): void {
    this.#title.textContent = this.#spec.title;
    this.#canvas.setAttribute("aria-label", `${this.#spec.label} The numbers are in the table under “Data”.`);
    this.#canvas.style.height = `${this.#spec.height}px`;
  }

  #draw(): void {
    if (this.#canvas.clientWidth === 0) return;
    if (!this.#chart) {
      this.#chart = echarts.init(this.#canvas, null, { renderer: "svg" });
      this.#chart.on("click", (params: unknown) => this.#spec.click?.(params));
    }
    this.#chart.setOption(this.#spec.option(theme(), this.#canvas.clientWidth), { notMerge: true });
  }

  #fit(): void {
    if (this.#canvas.clientWidth === 0) return;
    this.#chart?.resize();
    this.#draw();
  }

  #fill_table(): void {
    if (!this.#data.open) return;
    const table = this.#spec.table();
    const shown = table.rows.slice(0, kMostRows);
    replace(
      this.#data,
      h("summary", {}, "Data"),
      h(
        "div",
        { class: "scroll" },
        h(
          "table",
          {},
          h("thead", {}, h("tr", {}, ...table.columns.map((column) => h("th", { scope: "col" }, column)))),
          h(
            "tbody",
            {},
            ...shown.map((row) =>
              h(
                "tr",
                {},
                ...row.map((cell) => h("td", { class: typeof cell === "number" ? "num" : null }, text_of(cell))),
              ),
            ),
          ),
        ),
      ),
      table.rows.length > shown.length &&
        h("p", { class: "muted" }, `The first ${kMostRows} of ${table.rows.length} rows; the CSV has all.`),
    );
  }
}

function text_of(cell: string | number | null): string {
  if (cell === null) return "–";
  return typeof cell === "number" ? String(Number(cell.toPrecision(6))) : cell;
}

/** CSV after RFC 4180. A text that a spreadsheet would take for a formula gets an apostrophe before it. */
export function csv_of(table: Table): string {
  const field = (cell: string | number | null): string => {
    if (cell === null) return "";
    if (typeof cell === "number") return String(cell);
    const text = /^[=+\-@\t\r]/.test(cell) ? `'${cell}` : cell;
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return [table.columns, ...table.rows].map((row) => row.map(field).join(",") + "\r\n").join("");
}
