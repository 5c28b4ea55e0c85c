// The arm in space, by three.js.
import { PerspectiveCamera, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { h } from "../dom";
import { theme } from "../palette";
import { grid_step, stage_box, type Actor, type Box } from "./actor";
import { Shapes } from "./spatial_arm";
import { Redraw, type SceneView, type Stage } from "./stage";
import { first_direction, kCells, kFieldOfView, World } from "./world";

const kRestAfter = 200; ///< without a movement, for a fine picture [ms]
const kLate = 40; ///< longest wait for a picture that is not late [ms]
const kCoarsest = 0.6; ///< pixels drawn by pixels of CSS, at least
const kFine = 2;
const kText = 44; ///< widest text of an axis [pixels]
const kRoom = 1.08; ///< around the scene in the first view

/** WebGL on a canvas. */
export interface Gl {
  context: WebGL2RenderingContext;
  software: boolean; ///< the processor computes the pictures
}

/** WebGL on a canvas, or null if the browser has none. Smooth edges are left to the graphics card where there is one;
 *  else they would cost more than all the rest. */
export function webgl_of(canvas: HTMLCanvasElement): Gl | null {
  const probe = h("canvas").getContext("webgl2");
  if (probe === null) return null;
  const info = probe.getExtension("WEBGL_debug_renderer_info");
  const name = String(probe.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : probe.RENDERER));
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  const software = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
  const context = canvas.getContext("webgl2", {
    alpha: true,
    antialias: !software,
    powerPreference: "high-performance",
  });
  return context && { context, software };
}

export class SpatialView implements SceneView {
  readonly #stage: Stage;
  readonly #actors: readonly Actor[];
  readonly #renderer: WebGLRenderer;
  readonly #camera = new PerspectiveCamera(kFieldOfView);
  readonly #controls: OrbitControls;
  readonly #redraw = new Redraw((waited) => this.#draw_moving(waited));
  readonly #listening = new AbortController();
  readonly #shapes: Shapes;
  readonly #box: Box;
  readonly #size: number;
  readonly #software: boolean;
  #still = 0; ///< timer of the fine picture
  #coarse = 1; ///< pixels drawn by pixels of CSS while something moves
  #world: World;
  #tick = 0;
  #ghosts = false;
  #fitted = false;

  /** `lost` is called if the browser takes WebGL away. */
  constructor(stage: Stage, actors: readonly Actor[], gl: Gl, lost: () => void) {
    this.#stage = stage;
    this.#actors = actors;
    const box = stage_box(actors);
    this.#size = Math.max(...[0, 1, 2].map((k) => box.high[k]! - box.low[k]!), 1e-6);
    this.#box = on_grid(box, grid_step(this.#size, kCells));
    this.#shapes = new Shapes(actors[0]!.scene.scene.obstacles.length);
    this.#renderer = new WebGLRenderer({
      canvas: stage.canvas,
      context: gl.context,
      alpha: true,
      antialias: !gl.software,
    });
    this.#renderer.setScissorTest(true);
    this.#software = gl.software;
    this.#camera.up.set(0, 0, 1);
    this.#controls = new OrbitControls(this.#camera, stage.element);
    this.#controls.addEventListener("change", () => this.#redraw.ask());
    const signal = this.#listening.signal;
    stage.element.style.touchAction = "pan-y";
    stage.element.addEventListener(
      "wheel",
      (event) => {
        this.#controls.enableZoom = stage.takes_wheel(event);
      },
      { signal, capture: true, passive: true },
    );
    stage.element.addEventListener("pointerdown", () => (this.#controls.enableZoom = true), { signal, capture: true });
    stage.element.addEventListener("dblclick", () => this.reset(), { signal });
    stage.canvas.addEventListener("webglcontextlost", lost, { signal });
    this.#world = this.#make_world();
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
    this.#fitted = false;
    this.#redraw.ask();
  }

  zoom(factor: number): void {
    const { target } = this.#controls;
    this.#camera.position.sub(target).divideScalar(factor).add(target);
    this.#controls.update();
    this.#redraw.ask();
  }

  redraw(): void {
    if (this.#world.theme !== theme()) {
      this.#world.dispose();
      this.#world = this.#make_world();
    }
    this.#redraw.ask();
  }

  dispose(): void {
    this.#listening.abort();
    clearTimeout(this.#still);
    this.#redraw.dispose();
    this.#controls.dispose();
    this.#world.dispose();
    this.#shapes.dispose();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
  }

  #make_world(): World {
    return new World(this.#actors, this.#shapes, this.#box, this.#size, theme());
  }

  /** So that the box and the texts of the axes are in the picture. */
  #fit(width: number, height: number): void {
    const low = new Vector3(...this.#box.low);
    const high = new Vector3(...this.#box.high);
    const center = low.clone().add(high).multiplyScalar(0.5);
    const direction = first_direction(this.#actors[0]!.scene.path);
    const right = new Vector3(0, 0, 1).cross(direction).normalize();
    const up = direction.clone().cross(right);
    const slope = Math.tan((kFieldOfView * Math.PI) / 360) / kRoom;
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(
      (c) => new Vector3(c & 1 ? low.x : high.x, c & 2 ? low.y : high.y, c & 4 ? low.z : high.z),
    );
    const aside = Math.max(width - kText, width / 2) / height;
    let distance = 0;
    for (const point of [...corners, ...this.#world.texts]) {
      const at = point.clone().sub(center);
      const needed = Math.max(Math.abs(at.dot(right)) / aside, Math.abs(at.dot(up))) / slope;
      distance = Math.max(distance, at.dot(direction) + needed);
    }
    this.#camera.near = distance / 100;
    this.#camera.far = distance * 50;
    this.#camera.position.copy(center).addScaledVector(direction, distance);
    this.#controls.target.copy(center);
    this.#controls.update();
    this.#fitted = true;
  }

  /** A picture that the processor computes is coarse while something moves, all the more if pictures come late, and
   *  fine when it rests. */
  #draw_moving(waited: number): void {
    const screen = Math.min(window.devicePixelRatio || 1, 2);
    if (!this.#software) return this.#draw(screen);
    if (waited > kLate) this.#coarse = Math.max(0.85 * this.#coarse, kCoarsest);
    this.#draw(this.#coarse);
    clearTimeout(this.#still);
    this.#still = window.setTimeout(() => this.#draw(kFine), kRestAfter);
  }

  /** `ratio` is pixels drawn by pixels of CSS. */
  #draw(ratio: number): void {
    const { element } = this.#stage;
    const width = element.clientWidth;
    const height = element.clientHeight;
    if (width === 0 || height === 0 || this.#renderer.getContext().isContextLost()) return;
    const { canvas } = this.#stage;
    if (canvas.width !== Math.floor(width * ratio) || canvas.height !== Math.floor(height * ratio)) {
      this.#renderer.setPixelRatio(ratio);
      this.#renderer.setSize(width, height, false);
    }
    this.#stage.rectangles().forEach((pane, i) => {
      if (pane.width === 0 || pane.height === 0) return;
      this.#camera.aspect = pane.width / pane.height;
      if (!this.#fitted) this.#fit(pane.width, pane.height);
      this.#camera.updateProjectionMatrix();
      this.#world.show(i, this.#tick, this.#ghosts, this.#camera, pane.height);
      this.#renderer.setViewport(pane.x, height - pane.y - pane.height, pane.width, pane.height);
      this.#renderer.setScissor(pane.x, height - pane.y - pane.height, pane.width, pane.height);
      this.#renderer.render(this.#world.scene, this.#camera);
    });
  }
}

/** The box extended to whole cells of a grid, and down to the floor at z = 0. */
function on_grid(box: Box, step: number): Box {
  const low = (k: number) => Math.floor((k === 2 ? Math.min(box.low[k]!, 0) : box.low[k]!) / step + 1e-9) * step;
  const high = (k: number) => Math.ceil(box.high[k]! / step - 1e-9) * step;
  return { low: [low(0), low(1), low(2)], high: [high(0), high(1), high(2)] };
}
