// What the camera looks at in space: floor, axes, paths, and the arms.
import {
  BufferAttribute,
  BufferGeometry,
  ConeGeometry,
  DirectionalLight,
  HemisphereLight,
  Line,
  LineBasicMaterial,
  LineDashedMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  type PerspectiveCamera,
  Scene,
  Vector3,
  type Object3D,
  type Sprite,
} from "three";
import type { Theme } from "../palette";
import { grid_step, type Actor, type Box } from "./actor";
import { SpatialArm, type Shapes } from "./spatial_arm";
import { ways_down, type Place } from "./name_places";
import { dispose_sprite, resize_sprite, sprite_size, text_sprite } from "./text_sprite";

export const kFieldOfView = 32; ///< vertical [deg]
const kLetters = 0.75; ///< height of letters by that of their sprite
export const kCells = 8; ///< of the grid along the longest side of the scene, at most

/** All that is in space, in the colours of a theme. */
export class World {
  readonly scene = new Scene();
  /** Where texts of the axes stand: the first view has them in it. */
  readonly texts: Vector3[] = [];
  readonly theme: Theme;
  readonly #sun = new DirectionalLight("#ffffff", 1.5);
  readonly #arms: SpatialArm[];
  readonly #sprites: Sprite[] = [];
  readonly #own: { geometry: BufferGeometry; material: { dispose(): void } }[] = [];

  constructor(actors: readonly Actor[], shapes: Shapes, box: Box, size: number, colors: Theme) {
    this.theme = colors;
    this.scene.add(this.#sun, new HemisphereLight("#ffffff", "#d8d8d8", 2.1));
    this.#add_ground(box, size, first_direction(actors[0]!.scene.path));
    this.#add_path(actors[0]!.scene.path, size);
    this.#add_base(actors[0]!.scene.start_points, size);
    this.#arms = actors.map((actor) => new SpatialArm(actor, shapes, size, box.high[2], colors));
    for (const arm of this.#arms) this.scene.add(arm.group);
  }

  /** Makes one run's arm the one that is seen, at a tick, with the light behind the camera. */
  show(index: number, tick: number, ghosts: boolean, camera: PerspectiveCamera, pane_height: number): void {
    this.#sun.position.copy(camera.position).addScaledVector(camera.up, camera.position.length() / 2);
    this.#arms.forEach((arm, i) => (arm.group.visible = i === index));
    const arm = this.#arms[index]!;
    arm.ghosts = ghosts;
    arm.show(tick);
    for (const sprite of [...this.#sprites, ...arm.sprites, ...arm.names])
      resize_sprite(sprite, pane_height, kFieldOfView);
    spread_names(arm, camera, pane_height);
  }

  dispose(): void {
    for (const arm of this.#arms) arm.dispose();
    for (const sprite of this.#sprites) dispose_sprite(sprite);
    for (const { geometry, material } of this.#own) {
      geometry.dispose();
      material.dispose();
    }
  }

  #add<T extends Object3D & { geometry: BufferGeometry; material: { dispose(): void } }>(object: T): T {
    this.#own.push(object);
    this.scene.add(object);
    return object;
  }

  #add_text(text: string, x: number, y: number, z: number): void {
    const sprite = text_sprite(text, this.theme.muted, this.theme.background);
    sprite.position.set(x, y, z);
    this.texts.push(sprite.position);
    this.#sprites.push(sprite);
    this.scene.add(sprite);
  }

  /** A grid on the floor with the units along the two sides that face the first camera, and an axis up at its left. */
  #add_ground(box: Box, size: number, camera: Vector3): void {
    const step = grid_step(size, kCells);
    const [x1, y1, floor] = box.low;
    const [x2, y2, top] = box.high;
    const [near_x, out_x] = camera.x > 0 ? [x2, 1] : [x1, -1];
    const [near_y, out_y] = camera.y > 0 ? [y2, 1] : [y1, -1];
    const left_x = camera.y > 0 ? x2 : x1;
    const left_y = camera.x > 0 ? y1 : y2;
    const aside = new Vector3(camera.y, -camera.x, 0).setLength(step / 2);
    const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const text = (value: number) => (Math.abs(value) < step / 2 ? 0 : value).toFixed(decimals).replace("-", "−");
    const lines: number[] = [];
    const steps = (low: number, high: number, draw: (at: number, labelled: boolean) => void) => {
      for (let k = Math.round(low / step); k <= Math.round(high / step); ++k) draw(k * step, k % 2 === 0);
    };
    steps(x1, x2, (x, labelled) => {
      lines.push(x, y1, floor, x, y2, floor);
      if (labelled) this.#add_text(text(x), x, near_y + (out_y * step) / 2.5, floor);
    });
    steps(y1, y2, (y, labelled) => {
      lines.push(x1, y, floor, x2, y, floor);
      if (labelled) this.#add_text(text(y), near_x + (out_x * step) / 2.5, y, floor);
    });
    steps(floor, top, (z, labelled) => {
      lines.push(left_x, left_y, z, left_x + Math.sign((x1 + x2) / 2 - left_x) * (step / 5), left_y, z);
      if (labelled && z > floor) this.#add_text(text(z), left_x + aside.x, left_y + aside.y, z);
    });
    lines.push(left_x, left_y, floor, left_x, left_y, top);
    this.#add_text("x [m]", (x1 + x2) / 2, near_y + 1.3 * out_y * step, floor);
    this.#add_text("y [m]", near_x + 1.5 * out_x * step, (y1 + y2) / 2, floor);
    this.#add_text("z [m]", left_x, left_y, top + step / 2);
    const material = new LineBasicMaterial({ color: this.theme.muted, transparent: true, opacity: 0.45 });
    this.#add(new LineSegments(geometry_of(new Float32Array(lines)), material));
  }

  #add_path(path: Float32Array, size: number): void {
    const material = new LineDashedMaterial({ color: this.theme.text, dashSize: size / 70, gapSize: size / 110 });
    this.#add(new Line(geometry_of(path), material)).computeLineDistances();
  }

  #add_base(points: Float32Array, size: number): void {
    const base = this.#add(
      new Mesh(new ConeGeometry(size / 28, size / 22, 24), new MeshLambertMaterial({ color: this.theme.muted })),
    );
    base.rotation.x = Math.PI / 2;
    base.position.set(points[0]!, points[1]!, points[2]! + size / 70);
  }
}

/** Moves names up and down, so that they cover neither each other nor the numbers of links. */
function spread_names(arm: SpatialArm, camera: PerspectiveCamera, pane_height: number): void {
  arm.group.updateMatrixWorld();
  camera.updateMatrixWorld();
  const place = (sprite: Sprite): Place => {
    const at = sprite.getWorldPosition(new Vector3()).project(camera);
    const { width, height } = sprite_size(sprite);
    return {
      x: (at.x * camera.aspect * pane_height) / 2,
      y: (-at.y * pane_height) / 2,
      width,
      height: height * kLetters,
    };
  };
  const ways = ways_down(arm.names.map(place), arm.numbers.map(place));
  arm.names.forEach((name, i) => name.center.setY(0.5 + ways[i]! * kLetters));
}

/** Where the camera first is: beside the arm, somewhat to the front and above. */
export function first_direction(path: Float32Array): Vector3 {
  const ahead = path.length >= 3 ? Math.atan2(path[1]!, path[0]!) : 0;
  const azimuth = ahead - (58 * Math.PI) / 180;
  const elevation = (20 * Math.PI) / 180;
  return new Vector3(
    Math.cos(azimuth) * Math.cos(elevation),
    Math.sin(azimuth) * Math.cos(elevation),
    Math.sin(elevation),
  );
}

function geometry_of(positions: Float32Array): BufferGeometry {
  return new BufferGeometry().setAttribute("position", new BufferAttribute(positions, 3));
}
