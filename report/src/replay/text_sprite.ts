// Text in space that keeps its size on the screen.
import { CanvasTexture, LinearFilter, Sprite, SpriteMaterial, SRGBColorSpace } from "three";
import { h } from "../dom";

const kPixels = 14; ///< height of the letters on the screen
const kFineness = 3;

/** A text that faces the camera. `resize_sprite` gives it its size. */
export function text_sprite(text: string, color: string, halo: string): Sprite {
  const font = `${kPixels * kFineness}px system-ui, sans-serif`;
  const canvas = h("canvas");
  const measure = canvas.getContext("2d")!;
  measure.font = font;
  canvas.width = Math.ceil(measure.measureText(text).width) + 6 * kFineness;
  canvas.height = Math.ceil(1.5 * kPixels * kFineness);
  const context = canvas.getContext("2d")!;
  context.font = font;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.lineWidth = 3 * kFineness;
  context.strokeStyle = halo;
  context.strokeText(text, canvas.width / 2, canvas.height / 2);
  context.fillStyle = color;
  context.fillText(text, canvas.width / 2, canvas.height / 2);
  return sprite_of(canvas, canvas.height / kFineness);
}

/** The cross of a link in contact. */
export function cross_sprite(color: string, halo: string): Sprite {
  const size = 22;
  const canvas = h("canvas", { width: size * kFineness, height: size * kFineness });
  const context = canvas.getContext("2d")!;
  context.scale(kFineness, kFineness);
  for (const [stroke, width] of [
    [halo, 6],
    [color, 3],
  ] as const) {
    context.strokeStyle = stroke;
    context.lineWidth = width;
    context.beginPath();
    context.moveTo(4, 4);
    context.lineTo(size - 4, size - 4);
    context.moveTo(4, size - 4);
    context.lineTo(size - 4, 4);
    context.stroke();
  }
  return sprite_of(canvas, size);
}

/** The ring where the tip should be. */
export function ring_sprite(color: string, halo: string): Sprite {
  const size = 20;
  const canvas = h("canvas", { width: size * kFineness, height: size * kFineness });
  const context = canvas.getContext("2d")!;
  context.scale(kFineness, kFineness);
  for (const [stroke, width] of [
    [halo, 4],
    [color, 2],
  ] as const) {
    context.strokeStyle = stroke;
    context.lineWidth = width;
    context.beginPath();
    context.arc(size / 2, size / 2, size / 2 - 4, 0, 2 * Math.PI);
    context.stroke();
  }
  return sprite_of(canvas, size);
}

function sprite_of(canvas: HTMLCanvasElement, height: number): Sprite {
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  map.minFilter = LinearFilter;
  map.generateMipmaps = false;
  const sprite = new Sprite(new SpriteMaterial({ map, sizeAttenuation: false, depthTest: false, transparent: true }));
  sprite.renderOrder = 10;
  sprite.userData["height"] = height;
  sprite.userData["shape"] = canvas.width / canvas.height;
  return sprite;
}

/** Size on the screen [pixels]. */
export function sprite_size(sprite: Sprite): { width: number; height: number } {
  const height = sprite.userData["height"] as number;
  return { width: height * (sprite.userData["shape"] as number), height };
}

/** Gives a sprite its size in a pane of a height [pixels], seen with a field of view [degrees]. */
export function resize_sprite(sprite: Sprite, pane_height: number, field_of_view: number): void {
  const { width, height } = sprite_size(sprite);
  const scale = (2 * Math.tan((field_of_view * Math.PI) / 360)) / pane_height;
  sprite.scale.set(width * scale, height * scale, 1);
}

export function dispose_sprite(sprite: Sprite): void {
  sprite.material.map?.dispose();
  sprite.material.dispose();
}
