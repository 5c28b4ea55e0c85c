// A chart over the time of a replay, with a cursor at the tick shown. The cursor is a line laid over the chart: moving
// it draws nothing anew.
import { Chart, type ChartSpec } from "../chart";
import { h } from "../dom";

/** Margins around the curves, the same in all charts of a replay [px]. */
export const kMargins = { left: 64, right: 18, top: 40, bottom: 42 };

export class CursorChart {
  readonly element: HTMLElement;
  readonly #chart: Chart;
  readonly #canvas: HTMLElement;
  readonly #cursor = h("div", { class: "replay-cursor", "aria-hidden": "true" });
  readonly #sizes: ResizeObserver;
  readonly #last: number;
  #tick = 0;

  /** `last` is the tick at the right end of the chart; `seek` is called when the chart is clicked or dragged. */
  constructor(spec: ChartSpec, last: number, seek: (tick: number) => void) {
    this.#last = last;
    this.#chart = new Chart(spec);
    this.element = this.#chart.element;
    this.#canvas = this.element.querySelector<HTMLElement>(".chart-canvas")!;
    this.#canvas.after(this.#cursor);
    this.element.classList.add("replay-chart");
    this.#sizes = new ResizeObserver(() => this.#place());
    this.#sizes.observe(this.#canvas);
    let dragging = false;
    const to_pointer = (event: PointerEvent): void => {
      const x = event.clientX - this.#canvas.getBoundingClientRect().left;
      seek(Math.round(((x - kMargins.left) / this.#width()) * this.#last));
    };
    this.#canvas.addEventListener("pointerdown", (event) => {
      const y = event.clientY - this.#canvas.getBoundingClientRect().top;
      dragging = event.button === 0 && y > kMargins.top;
      if (!dragging) return;
      this.#canvas.setPointerCapture(event.pointerId);
      to_pointer(event);
    });
    this.#canvas.addEventListener("pointermove", (event) => dragging && to_pointer(event));
    for (const name of ["pointerup", "pointercancel"] as const) {
      this.#canvas.addEventListener(name, () => (dragging = false));
    }
  }

  set(spec: ChartSpec): void {
    this.#chart.set(spec);
    this.#place();
  }

  move(tick: number): void {
    this.#tick = tick;
    const share = this.#last === 0 ? 0 : tick / this.#last;
    this.#cursor.style.transform = `translateX(${kMargins.left + share * this.#width()}px)`;
  }

  dispose(): void {
    this.#sizes.disconnect();
    this.#chart.dispose();
  }

  #width(): number {
    return Math.max(this.#canvas.clientWidth - kMargins.left - kMargins.right, 1);
  }

  #place(): void {
    this.#cursor.style.left = `${this.#canvas.offsetLeft}px`;
    this.#cursor.style.top = `${this.#canvas.offsetTop + kMargins.top}px`;
    this.#cursor.style.height = `${this.#canvas.clientHeight - kMargins.top - kMargins.bottom}px`;
    this.move(this.#tick);
  }
}
