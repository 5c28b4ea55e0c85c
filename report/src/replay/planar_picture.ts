// One pane of the plane: grid, obstacles, paths and arm at a tick.
import { category_color, type Theme } from "../palette";
import {
  deepest_point,
  ghost_rows,
  link_states,
  point_at,
  pose_at,
  row_at,
  tip_at,
  type Actor,
  type LinkState,
} from "./actor";
import { draw_grid, draw_scale_bar, kFont, screen_x, screen_y, text_with_halo, type PlanarCamera } from "./planar_grid";
import type { Rectangle } from "./stage";

/** Links without thickness are drawn this wide [pixels]. */
const kThinLink = 7;
const kGhosts = 16;
const kMostNames = 12; ///< obstacles whose names are shown
const kMostNumbers = 16; ///< links whose numbers are shown

export class PlanarPicture {
  readonly #context: CanvasRenderingContext2D;
  readonly #camera: Readonly<PlanarCamera>;
  readonly #pane: Rectangle;
  readonly #theme: Theme;
  readonly #actor: Actor;
  readonly #tick: number;

  /** The origin of the context is the pane's upper left corner. */
  constructor(
    context: CanvasRenderingContext2D,
    camera: Readonly<PlanarCamera>,
    pane: Rectangle,
    theme: Theme,
    actor: Actor,
    tick: number,
  ) {
    this.#context = context;
    this.#camera = camera;
    this.#pane = pane;
    this.#theme = theme;
    this.#actor = actor;
    this.#tick = tick;
  }

  draw(ghosts: boolean): void {
    const row = row_at(this.#actor, this.#tick);
    draw_grid(this.#context, this.#camera, this.#pane, this.#theme);
    this.#draw_obstacles();
    this.#draw_path();
    if (ghosts) for (const ghost of ghost_rows(this.#actor, kGhosts)) this.#draw_ghost(ghost);
    this.#draw_trail(row);
    this.#draw_arm(row);
    this.#draw_names();
    draw_scale_bar(this.#context, this.#camera, this.#pane, this.#theme);
  }

  #x(x: number): number {
    return screen_x(this.#camera, this.#pane, x);
  }

  #y(y: number): number {
    return screen_y(this.#camera, this.#pane, y);
  }

  #draw_obstacles(): void {
    const context = this.#context;
    this.#actor.scene.scene.obstacles.forEach((obstacle, o) => {
      const { values, offset } = pose_at(this.#actor.scene, o, this.#tick);
      const x = this.#x(values[offset + 3]!);
      const y = this.#y(values[offset + 7]!);
      const [a, b] = [obstacle.semi_axes_m[0]! * this.#camera.scale, obstacle.semi_axes_m[1]! * this.#camera.scale];
      context.beginPath();
      context.ellipse(x, y, a, b, -Math.atan2(values[offset + 4]!, values[offset]!), 0, 2 * Math.PI);
      context.fillStyle = this.#theme.text;
      context.globalAlpha = 0.16;
      context.fill();
      context.globalAlpha = 0.75;
      context.strokeStyle = this.#theme.text;
      context.lineWidth = 1.5;
      context.stroke();
      context.globalAlpha = 1;
    });
  }

  #draw_names(): void {
    const { obstacles } = this.#actor.scene.scene;
    if (obstacles.length > kMostNames) return;
    const context = this.#context;
    context.font = kFont;
    context.fillStyle = this.#theme.text;
    context.textAlign = "center";
    context.textBaseline = "middle";
    obstacles.forEach((obstacle, o) => {
      const { values, offset } = pose_at(this.#actor.scene, o, this.#tick);
      const [a, b] = obstacle.semi_axes_m.map((axis) => axis * this.#camera.scale) as [number, number];
      const name = obstacle.name.length > 24 ? `${obstacle.name.slice(0, 23)}…` : obstacle.name;
      const fits = context.measureText(name).width < 2 * Math.min(a, b);
      text_with_halo(
        this.#context,
        this.#theme,
        name,
        this.#x(values[offset + 3]!),
        this.#y(values[offset + 7]!) - (fits ? 0 : Math.max(a, b) + 9),
      );
    });
  }

  /** A line through points of three numbers each, [from, to); it breaks where one is not finite. */
  #trace(points: Float32Array, first: number, count: number, stride: number): void {
    const context = this.#context;
    context.beginPath();
    let drawing = false;
    for (let i = 0; i < count; ++i) {
      const x = this.#x(points[first + i * stride]!);
      const y = this.#y(points[first + i * stride + 1]!);
      if (!Number.isFinite(x + y)) drawing = false;
      else if (drawing) context.lineTo(x, y);
      else {
        context.moveTo(x, y);
        drawing = true;
      }
    }
    context.stroke();
  }

  #draw_path(): void {
    const context = this.#context;
    context.strokeStyle = this.#theme.text;
    context.lineWidth = 1.5;
    context.globalAlpha = 0.8;
    context.setLineDash([5, 4]);
    this.#trace(this.#actor.scene.path, 0, this.#actor.scene.path.length / 3, 3);
    context.setLineDash([]);
    context.globalAlpha = 1;
    const target = 3 * Math.min(this.#tick, this.#actor.scene.path.length / 3 - 1);
    context.beginPath();
    context.arc(
      this.#x(this.#actor.scene.path[target]!),
      this.#y(this.#actor.scene.path[target + 1]!),
      5,
      0,
      2 * Math.PI,
    );
    context.stroke();
  }

  #draw_trail(row: number): void {
    const stride = 3 * this.#actor.scene.scene.points;
    this.#context.strokeStyle = this.#theme.good;
    this.#context.lineWidth = 2.5;
    this.#trace(this.#actor.replay.points, tip_at(this.#actor, 0), row + 1, stride);
  }

  #draw_ghost(row: number): void {
    const context = this.#context;
    context.strokeStyle = this.#theme.text;
    context.lineWidth = 1;
    context.globalAlpha = 0.3;
    this.#trace(this.#actor.replay.points, point_at(this.#actor, row, 0), this.#actor.scene.scene.points, 3);
    context.globalAlpha = 1;
  }

  #draw_arm(row: number): void {
    const context = this.#context;
    const points = this.#actor.replay.points;
    const links = link_states(this.#actor, row);
    context.lineCap = "round";
    this.#draw_base(row);
    for (const link of links) {
      const true_width = 2 * link.radius * this.#camera.scale;
      const width = true_width > 0 ? true_width : kThinLink;
      const ends = [link.start, link.end].map((p) => [this.#x(points[p]!), this.#y(points[p + 1]!)] as const);
      const [[x1, y1], [x2, y2]] = ends as [readonly [number, number], readonly [number, number]];
      if (!Number.isFinite(x1 + y1 + x2 + y2)) continue;
      const stroke = (color: string, line_width: number) => {
        context.strokeStyle = color;
        context.lineWidth = line_width;
        context.beginPath();
        context.moveTo(x1, y1);
        context.lineTo(x2, y2);
        context.stroke();
      };
      if (true_width === 0 || true_width > 6) stroke(this.#theme.text, width + (link.contact ? 4 : 0));
      stroke(
        category_color(link.category, this.#theme.dark),
        true_width > 6 ? width - 2 : width - (true_width === 0 ? 2 : 0),
      );
    }
    context.lineCap = "butt";
    for (const link of links) for (const p of [link.start, link.end]) this.#draw_joint(points[p]!, points[p + 1]!);
    if (links.length <= kMostNumbers) links.forEach((link, l) => this.#draw_number(link, l));
    for (const link of links) if (link.contact) this.#draw_contact(link);
  }

  /** The number of a link, beside its middle. */
  #draw_number(link: LinkState, index: number): void {
    const { points } = this.#actor.replay;
    const [x1, y1] = [this.#x(points[link.start]!), this.#y(points[link.start + 1]!)];
    const [x2, y2] = [this.#x(points[link.end]!), this.#y(points[link.end + 1]!)];
    const length = Math.hypot(x2 - x1, y2 - y1);
    if (!(length > 24)) return;
    const away = 13 + link.radius * this.#camera.scale;
    const context = this.#context;
    context.font = kFont;
    context.fillStyle = this.#theme.muted;
    context.textAlign = "center";
    context.textBaseline = "middle";
    text_with_halo(
      this.#context,
      this.#theme,
      String(this.#actor.scene.scene.links[index]!.number),
      (x1 + x2) / 2 + (away * (y2 - y1)) / length,
      (y1 + y2) / 2 - (away * (x2 - x1)) / length,
    );
  }

  #draw_base(row: number): void {
    const base = point_at(this.#actor, row, 0);
    const x = this.#x(this.#actor.replay.points[base]!);
    const y = this.#y(this.#actor.replay.points[base + 1]!);
    if (!Number.isFinite(x + y)) return;
    this.#context.fillStyle = this.#theme.text;
    this.#context.beginPath();
    this.#context.moveTo(x, y);
    const height = 17 + (this.#actor.scene.scene.links[0]?.radius_m ?? 0) * this.#camera.scale;
    this.#context.lineTo(x - 0.65 * height, y + height);
    this.#context.lineTo(x + 0.65 * height, y + height);
    this.#context.fill();
  }

  #draw_joint(x: number, y: number): void {
    const context = this.#context;
    context.beginPath();
    context.arc(this.#x(x), this.#y(y), 3.5, 0, 2 * Math.PI);
    context.fillStyle = this.#theme.background;
    context.fill();
    context.strokeStyle = this.#theme.text;
    context.lineWidth = 1.5;
    context.stroke();
  }

  #draw_contact(link: LinkState): void {
    if (link.obstacle >= this.#actor.scene.scene.obstacles.length) return;
    const [px, py] = deepest_point(this.#actor, link, this.#tick);
    const context = this.#context;
    const x = this.#x(px);
    const y = this.#y(py);
    for (const [color, line_width] of [
      [this.#theme.background, 6],
      [this.#theme.text, 3],
    ] as const) {
      context.strokeStyle = color;
      context.lineWidth = line_width;
      context.beginPath();
      for (const sign of [-1, 1]) {
        context.moveTo(x - 8, y - 8 * sign);
        context.lineTo(x + 8, y + 8 * sign);
      }
      context.stroke();
    }
  }
}
