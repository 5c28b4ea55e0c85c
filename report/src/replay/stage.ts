// Where the arm is drawn: one canvas under as many panes as there are runs, which share a camera.
import { h } from "../dom";

/** A part of the canvas, in CSS pixels from its upper left corner. */
export interface Rectangle {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** A drawing of the arm. It draws when something has changed, before the next picture. */
export interface SceneView {
  show(tick: number): void;
  set_ghosts(ghosts: boolean): void;
  /** Back to the first view. */
  reset(): void;
  /** Larger by a factor. */
  zoom(factor: number): void;
  /** Size, colours or what is shown have changed. */
  redraw(): void;
  dispose(): void;
}

export class Stage {
  readonly canvas = h("canvas", { "aria-hidden": "true" });
  readonly panes: readonly HTMLElement[];
  readonly element: HTMLElement;
  readonly #observer: ResizeObserver;

  /** `resized` is called after every change of size, the first one included. */
  constructor(panes: readonly HTMLElement[], description: string, resized: () => void) {
    this.panes = panes;
    this.element = h(
      "div",
      { class: "stage", tabindex: "0", role: "img", "aria-label": description, "data-panes": panes.length },
      this.canvas,
      ...panes,
    );
    this.#observer = new ResizeObserver(resized);
    this.#observer.observe(this.element);
  }

  rectangles(): Rectangle[] {
    return this.panes.map((pane) => ({
      x: pane.offsetLeft,
      y: pane.offsetTop,
      width: pane.clientWidth,
      height: pane.clientHeight,
    }));
  }

  /** The rectangle that a point of the window is in, or the first one. */
  rectangle_at(client_x: number, client_y: number): Rectangle {
    const bounds = this.element.getBoundingClientRect();
    const x = client_x - bounds.left;
    const y = client_y - bounds.top;
    const all = this.rectangles();
    return all.find((r) => x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height) ?? all[0]!;
  }

  /** Whether the wheel belongs to the drawing: it has been clicked, or the key for zooming is held. Else the page scrolls. */
  takes_wheel(event: WheelEvent): boolean {
    return event.ctrlKey || event.metaKey || this.element.contains(document.activeElement);
  }

  dispose(): void {
    this.#observer.disconnect();
  }
}

/** Calls a function once before the next picture, however often it is asked to, with how long that took [ms]. */
export class Redraw {
  #handle = 0;
  readonly #draw: (waited: number) => void;

  constructor(draw: (waited: number) => void) {
    this.#draw = draw;
  }

  ask(): void {
    if (this.#handle !== 0) return;
    const asked = performance.now();
    this.#handle = requestAnimationFrame(() => {
      this.#handle = 0;
      this.#draw(performance.now() - asked);
    });
  }

  dispose(): void {
    cancelAnimationFrame(this.#handle);
    this.#handle = 0;
  }
}
