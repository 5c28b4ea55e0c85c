// A table that can be sorted by its columns and draws its rows as they are scrolled to.
import { h, replace, type Child } from "./dom";
import { count } from "./format";
import type { Link } from "./link";

export type Key = number | string | null;

export interface Column<Row> {
  name: string; ///< in the address
  head: string;
  unit?: string;
  about?: string; ///< what it means
  text?: boolean; ///< left-aligned
  sort?: (row: Row) => Key; ///< null is last in either direction
  worst_first?: boolean; ///< first click sorts from large to small
  cell: (row: Row) => Child | readonly Child[];
}

export interface TableOptions<Row> {
  name: string; ///< in the address, for its order
  label: string; ///< caption for those who do not see it
  columns: readonly Column<Row>[];
  link: Link;
  initial?: string; ///< order that nobody chose
  batch?: number; ///< rows drawn at once
  details?: (row: Row) => Node; ///< shown below a row on demand
  opened?: (row: Row) => boolean;
  row_class?: (row: Row) => string;
}

/** Order of the table of a name in the state's `sort`. */
export function order_of(sort: string, table: string): string {
  const found = sort.split("|").find((entry) => entry.startsWith(`${table}.`));
  return found ? found.slice(table.length + 1) : "";
}

/** The state's `sort` with another order of one table. */
export function with_order(sort: string, table: string, order: string): string {
  const others = sort.split("|").filter((entry) => entry !== "" && !entry.startsWith(`${table}.`));
  return [...others, `${table}.${order}`].join("|");
}

function compare(a: Key, b: Key): number {
  if (typeof a === "number" && typeof b === "number") return a - b;
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

/** Rows in the order of a column; those without a value last. Equal rows keep their order. */
export function sorted<Row>(rows: readonly Row[], key: (row: Row) => Key, descending: boolean): Row[] {
  const keyed = rows.map((row) => ({ row, key: key(row) }));
  const some = keyed.filter((entry) => entry.key !== null);
  const none = keyed.filter((entry) => entry.key === null);
  some.sort((a, b) => (descending ? compare(b.key, a.key) : compare(a.key, b.key)));
  return [...some, ...none].map((entry) => entry.row);
}

export class SortedTable<Row> {
  readonly element: HTMLElement;
  #options: TableOptions<Row>;
  #rows: readonly Row[] = [];
  #order = "";
  #shown: Row[] = [];
  #drawn = 0;
  #head = h("thead");
  #body = h("tbody");
  #more = h("div", { class: "more" });
  #watch: IntersectionObserver;

  constructor(options: TableOptions<Row>) {
    this.#options = options;
    this.element = h(
      "div",
      { class: "table" },
      h(
        "div",
        { class: "scroll", tabindex: "0", role: "region", "aria-label": options.label },
        h("table", {}, h("caption", { class: "unseen" }, options.label), this.#head, this.#body),
      ),
      this.#more,
    );
    this.#watch = new IntersectionObserver(
      (entries) => {
        if (entries.some((entry) => entry.isIntersecting)) this.#draw_more();
      },
      { rootMargin: "600px" },
    );
  }

  /** Shows rows in the order of the state. */
  set(rows: readonly Row[]): void {
    this.#rows = rows;
    this.#order = order_of(this.#options.link.state.sort, this.#options.name) || (this.#options.initial ?? "");
    const descending = this.#order.startsWith("-");
    const column = this.#options.columns.find((c) => c.name === this.#order.replace(/^-/, ""));
    this.#shown = column?.sort ? sorted(rows, column.sort, descending) : [...rows];
    this.#draw_head();
    this.#body.replaceChildren();
    this.#drawn = 0;
    this.#draw_more();
  }

  dispose(): void {
    this.#watch.disconnect();
  }

  #draw_head(): void {
    const { columns, details } = this.#options;
    const cells = columns.map((column) => {
      const name = this.#order.replace(/^-/, "");
      const direction = name !== column.name ? "none" : this.#order.startsWith("-") ? "descending" : "ascending";
      const mark = direction === "none" ? "" : direction === "ascending" ? " ▲" : " ▼";
      const text: Child[] = [column.head, column.unit ? h("span", { class: "unit" }, ` ${column.unit}`) : null, mark];
      return h(
        "th",
        {
          scope: "col",
          class: column.text ? null : "num",
          "aria-sort": column.sort ? direction : null,
          title: column.about ?? null,
        },
        column.sort
          ? h("button", { type: "button", class: "sort", click: () => this.#sort_by(column) }, ...text)
          : h("span", {}, ...text),
      );
    });
    replace(
      this.#head,
      h("tr", {}, details ? h("th", { class: "opener" }, h("span", { class: "unseen" }, "Details")) : null, ...cells),
    );
  }

  #sort_by(column: Column<Row>): void {
    const { link, name } = this.#options;
    const first = column.worst_first ? `-${column.name}` : column.name;
    const other = column.worst_first ? column.name : `-${column.name}`;
    link.change({ sort: with_order(link.state.sort, name, this.#order === first ? other : first) });
    [...this.#head.querySelectorAll<HTMLElement>("button.sort")]
      .find((button) => button.textContent?.startsWith(column.head))
      ?.focus();
  }

  #draw_more(): void {
    const batch = this.#options.batch ?? 100;
    for (const row of this.#shown.slice(this.#drawn, this.#drawn + batch)) this.#draw_row(row);
    this.#drawn = Math.min(this.#drawn + batch, this.#shown.length);
    this.#watch.disconnect();
    if (this.#drawn < this.#shown.length) {
      replace(
        this.#more,
        h("span", { class: "muted" }, `${count(this.#drawn)} of ${count(this.#rows.length)} rows `),
        h("button", { type: "button", class: "quiet", click: () => this.#draw_more() }, "More"),
      );
      this.#watch.observe(this.#more);
    } else {
      replace(this.#more);
    }
  }

  #draw_row(row: Row): void {
    const { columns, details, opened, row_class } = this.#options;
    const cells = columns.map((column) => {
      const cell = column.cell(row);
      return h(
        "td",
        { class: column.text ? null : "num", "data-head": [column.head, column.unit].filter(Boolean).join(" ") },
        ...(Array.isArray(cell) ? (cell as Child[]) : [cell as Child]),
      );
    });
    const line = h("tr", { class: row_class?.(row) || null }, ...cells);
    this.#body.append(line);
    if (!details) return;
    let below: HTMLElement | null = null;
    const opener = h(
      "button",
      {
        type: "button",
        class: "quiet opener",
        "aria-expanded": "false",
        "aria-label": "Details",
        click: () => toggle(),
      },
      "▸",
    );
    const toggle = (): void => {
      if (below) {
        below.remove();
        below = null;
      } else {
        below = h("tr", { class: "details" }, h("td", { colspan: columns.length + 1 }, details(row)));
        line.after(below);
      }
      opener.setAttribute("aria-expanded", String(below !== null));
      opener.textContent = below ? "▾" : "▸";
    };
    line.prepend(h("td", { class: "opener" }, opener));
    if (opened?.(row)) toggle();
  }
}
