// The arm in the plane, on a two-dimensional canvas: equal units in x and y, sharp at any resolution.
import { theme } from "../palette";
import { stage_box, type Actor } from "./actor";
import type { PlanarCamera } from "./planar_grid";
import { PlanarPicture } from "./planar_picture";
import { Redraw, type Rectangle, type SceneView, type Stage } from "./stage";

const kScales = [1e-6, 1e7] as const; ///< least and most [pixels per metre]

export class PlanarView implements SceneView {
  readonly #stage: Stage;
  readonly #actors: readonly Actor[];
  readonly #context: CanvasRenderingContext2D;
  readonly #redraw = new Redraw(() => this.#draw());
  readonly #pointers = new Map<number, PointerEvent>();
  readonly #listening = new AbortController();
  #tick = 0;
  #ghosts = false;
  /** Scale 0: the first view is yet to be found. */
  #camera: PlanarCamera = { x: 0, y: 0, scale: 0 };

  constructor(stage: Stage, actors: readonly Actor[]) {
    this.#stage = stage;
    this.#actors = actors;
    this.#context = stage.canvas.getContext("2d")!;
    const signal = this.#listening.signal;
    stage.element.style.touchAction = "pan-y";
    stage.element.addEventListener("pointerdown", (event) => this.#press(event), { signal });
    stage.element.addEventListener("pointermove", (event) => this.#move(event), { signal });
    for (const name of ["pointerup", "pointercancel"] as const) {
      stage.element.addEventListener(name, (event) => this.#pointers.delete(event.pointerId), { signal });
    }
    stage.element.addEventListener("wheel", (event) => this.#wheel(event), { signal, passive: false });
    stage.element.addEventListener("dblclick", () => this.reset(), { signal });
  }

  show(tick: number): void {
    this.#tick = tick;
    this.#redraw.ask();
  }

  set_ghosts(ghosts: boolean): void {
    this.#ghosts = ghosts;
    this.#redraw.ask();
  }

  reset(): void {
    this.#camera.scale = 0;
    this.#redraw.ask();
  }

  zoom(factor: number): void {
    if (this.#camera.scale === 0) return;
    this.#camera.scale = Math.min(Math.max(this.#camera.scale * factor, kScales[0]), kScales[1]);
    this.#redraw.ask();
  }

  redraw(): void {
    this.#redraw.ask();
  }

  dispose(): void {
    this.#listening.abort();
    this.#redraw.dispose();
  }

  #fit(rectangle: Rectangle): void {
    const { low, high } = stage_box(this.#actors);
    const room = { left: 46, right: 22, top: 34, bottom: 40 };
    const width = Math.max(rectangle.width - room.left - room.right, 20);
    const height = Math.max(rectangle.height - room.top - room.bottom, 20);
    const scale = Math.min(width / Math.max(high[0] - low[0], 1e-9), height / Math.max(high[1] - low[1], 1e-9));
    this.#camera = {
      x: (low[0] + high[0]) / 2 - (room.left - room.right) / 2 / scale,
      y: (low[1] + high[1]) / 2 + (room.top - room.bottom) / 2 / scale,
      scale,
    };
  }

  #press(event: PointerEvent): void {
    if (event.button !== 0) return;
    this.#pointers.set(event.pointerId, event);
    this.#stage.element.setPointerCapture(event.pointerId);
  }

  /** One pointer moves the picture, two also stretch it. */
  #move(event: PointerEvent): void {
    const before = this.#pointers.get(event.pointerId);
    if (!before || this.#camera.scale === 0) return;
    const other = [...this.#pointers.values()].find((pointer) => pointer.pointerId !== event.pointerId);
    const share = other ? 0.5 : 1;
    this.#camera.x -= (share * (event.clientX - before.clientX)) / this.#camera.scale;
    this.#camera.y += (share * (event.clientY - before.clientY)) / this.#camera.scale;
    if (other) {
      const distance = (pointer: PointerEvent) =>
        Math.hypot(pointer.clientX - other.clientX, pointer.clientY - other.clientY);
      if (distance(before) > 0) this.zoom(distance(event) / distance(before));
    }
    this.#pointers.set(event.pointerId, event);
    this.#redraw.ask();
  }

  #wheel(event: WheelEvent): void {
    if (!this.#stage.takes_wheel(event) || this.#camera.scale === 0) return;
    event.preventDefault();
    const rectangle = this.#stage.rectangle_at(event.clientX, event.clientY);
    const bounds = this.#stage.element.getBoundingClientRect();
    const dx = event.clientX - bounds.left - rectangle.x - rectangle.width / 2;
    const dy = event.clientY - bounds.top - rectangle.y - rectangle.height / 2;
    const factor = Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015));
    this.#camera.x += (dx / this.#camera.scale) * (1 - 1 / factor);
    this.#camera.y -= (dy / this.#camera.scale) * (1 - 1 / factor);
    this.zoom(factor);
  }

  #draw(): void {
    const { canvas, element } = this.#stage;
    const ratio = window.devicePixelRatio || 1;
    const width = Math.round(element.clientWidth * ratio);
    const height = Math.round(element.clientHeight * ratio);
    if (width === 0 || height === 0) return;
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const colors = theme();
    const context = this.#context;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, element.clientWidth, element.clientHeight);
    this.#stage.rectangles().forEach((rectangle, i) => {
      if (this.#camera.scale === 0) this.#fit(rectangle);
      context.save();
      context.beginPath();
      context.rect(rectangle.x, rectangle.y, rectangle.width, rectangle.height);
      context.clip();
      context.translate(rectangle.x, rectangle.y);
      new PlanarPicture(context, this.#camera, rectangle, colors, this.#actors[i]!, this.#tick).draw(this.#ghosts);
      context.restore();
    });
  }
}
