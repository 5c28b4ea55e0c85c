// Grid, axes and scale bar of a pane of the plane.
import { length } from "../format";
import type { Theme } from "../palette";
import { grid_step } from "./actor";
import type { Rectangle } from "./stage";

export const kFont = "12px system-ui, sans-serif";
const kCell = 90; ///< least distance of grid lines [pixels]
const kScaleBar = 50; ///< least length of the scale bar [pixels]

/** What is in the middle of every pane [m], and pixels per metre. */
export interface PlanarCamera {
  x: number;
  y: number;
  scale: number;
}

export const screen_x = (camera: Readonly<PlanarCamera>, pane: Rectangle, x: number): number =>
  pane.width / 2 + (x - camera.x) * camera.scale;

export const screen_y = (camera: Readonly<PlanarCamera>, pane: Rectangle, y: number): number =>
  pane.height / 2 - (y - camera.y) * camera.scale;

/** Text that stays readable on whatever lies under it. */
export function text_with_halo(
  context: CanvasRenderingContext2D,
  theme: Theme,
  text: string,
  x: number,
  y: number,
): void {
  context.lineJoin = "round";
  context.lineWidth = 3;
  context.strokeStyle = theme.background;
  context.strokeText(text, x, y);
  context.fillText(text, x, y);
}

/** Lines at multiples of 1, 2 or 5 times a power of ten, with their coordinates at the left and at the bottom. */
export function draw_grid(
  context: CanvasRenderingContext2D,
  camera: Readonly<PlanarCamera>,
  pane: Rectangle,
  theme: Theme,
): void {
  const step = grid_step(kCell / camera.scale, 1);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const label = (k: number) => (k * step).toFixed(decimals).replace("-", "−");
  const lines = (center: number, size: number, draw: (k: number) => void) => {
    const reach = size / 2 / camera.scale;
    for (let k = Math.ceil((center - reach) / step); k * step <= center + reach; ++k) draw(k);
  };
  const line = (k: number, x1: number, y1: number, x2: number, y2: number) => {
    context.globalAlpha = k === 0 ? 0.3 : 0.1;
    context.beginPath();
    context.moveTo(x1, y1);
    context.lineTo(x2, y2);
    context.stroke();
    context.globalAlpha = 1;
  };
  context.font = kFont;
  context.fillStyle = theme.text;
  context.strokeStyle = theme.text;
  context.lineWidth = 1;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  lines(camera.x, pane.width, (k) => {
    const at = Math.round(screen_x(camera, pane, k * step)) + 0.5;
    line(k, at, 0, at, pane.height);
    if (at > 34 && at < pane.width - 62) context.fillText(label(k), at, pane.height - 4);
  });
  context.textAlign = "left";
  context.textBaseline = "middle";
  lines(camera.y, pane.height, (k) => {
    const at = Math.round(screen_y(camera, pane, k * step)) + 0.5;
    line(k, 0, at, pane.width, at);
    if (at > 66 && at < pane.height - 24) context.fillText(label(k), 4, at);
  });
  context.textBaseline = "bottom";
  context.fillText("y [m]", 4, 50);
  context.textAlign = "right";
  context.fillText("x [m]", pane.width - 4, pane.height - 4);
}

export function draw_scale_bar(
  context: CanvasRenderingContext2D,
  camera: Readonly<PlanarCamera>,
  pane: Rectangle,
  theme: Theme,
): void {
  const metres = grid_step(kScaleBar / camera.scale, 1);
  const width = metres * camera.scale;
  const right = pane.width - 14;
  const y = pane.height - 36;
  context.strokeStyle = theme.text;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(right - width, y - 4);
  context.lineTo(right - width, y);
  context.lineTo(right, y);
  context.lineTo(right, y - 4);
  context.stroke();
  context.font = kFont;
  context.fillStyle = theme.text;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  text_with_halo(context, theme, length(metres, 1), right - width / 2, y - 3);
}
