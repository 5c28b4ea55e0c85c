// What moves in space: one run's arm and its trail, among the obstacles as they stand at the tick.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
  type Material,
  type Sprite,
} from "three";
import { category_color, type Theme } from "../palette";
import { deepest_point, ghost_rows, link_states, point_at, row_at, tip_at, type Actor } from "./actor";
import { SpatialObstacles } from "./spatial_obstacles";
import { cross_sprite, dispose_sprite, ring_sprite, text_sprite } from "./text_sprite";

const kGhosts = 16;
const kMostTrail = 1000; ///< pieces of a trail
const kJoint = 0.99; ///< radius of a joint by that of a link, so that they do not flicker
const kUp = new Vector3(0, 1, 0);
const kNowhere = new Matrix4().makeScale(0, 0, 0);

/** Shapes that all arms share, each of size one. */
export class Shapes {
  readonly tube = new CylinderGeometry(1, 1, 1, 24, 1, true);
  readonly ball = new SphereGeometry(1, 24, 16);
  readonly thread = new CylinderGeometry(1, 1, 1, 5, 1, true);
  readonly ellipsoid: SphereGeometry;
  readonly rings = rings();

  constructor(obstacles: number) {
    this.ellipsoid = obstacles <= 10 ? new SphereGeometry(1, 40, 24) : new SphereGeometry(1, 20, 12);
  }

  dispose(): void {
    for (const shape of [this.tube, this.ball, this.thread, this.ellipsoid, this.rings]) shape.dispose();
  }
}

/** The three circles in which the coordinate planes cut the unit sphere. */
function rings(): BufferGeometry {
  const steps = 64;
  const points: number[] = [];
  for (const [i, j] of [
    [0, 1],
    [1, 2],
    [0, 2],
  ] as const) {
    for (let s = 0; s < steps; ++s) {
      for (const angle of [(2 * Math.PI * s) / steps, (2 * Math.PI * (s + 1)) / steps]) {
        const point = [0, 0, 0];
        point[i] = Math.cos(angle);
        point[j] = Math.sin(angle);
        points.push(...point);
      }
    }
  }
  return new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
}

export class SpatialArm {
  readonly group = new Group();
  readonly sprites: Sprite[] = []; ///< all but the names of obstacles
  readonly #actor: Actor;
  readonly #theme: Theme;
  readonly #links: InstancedMesh;
  readonly #joints: InstancedMesh;
  readonly #trail: InstancedMesh;
  readonly #trail_stride: number;
  readonly #ghosts: LineSegments;
  readonly #target: Sprite;
  readonly #obstacles: SpatialObstacles;
  readonly #crosses: Sprite[];
  readonly #numbers: Sprite[];
  readonly #materials: Material[] = [];
  readonly #least: number; ///< radius of links without thickness [m]
  readonly #above: number; ///< distance of a number from its link [m]

  /** `size` is the extent of the scene and `top` its highest z [m]; links without thickness get a visible one. */
  constructor(actor: Actor, shapes: Shapes, size: number, top: number, theme: Theme) {
    this.#above = size / 45;
    this.#actor = actor;
    this.#theme = theme;
    this.#least = size / 110;
    const links = actor.scene.scene.links.length;
    const lambert = (color: string) => this.#kept(new MeshLambertMaterial({ color }));
    this.#links = new InstancedMesh(shapes.tube, lambert("#ffffff"), links);
    this.#joints = new InstancedMesh(shapes.ball, lambert(theme.dark ? "#c3c9d0" : "#4a525b"), 2 * links);
    const rows = actor.replay.rows;
    this.#trail_stride = Math.ceil(rows / kMostTrail);
    this.#trail = this.#make_trail(shapes, size);
    this.#ghosts = this.#make_ghosts();
    this.#target = ring_sprite(theme.text, theme.background);
    this.#crosses = Array.from({ length: links }, () => cross_sprite(theme.text, theme.background));
    this.#numbers = actor.scene.scene.links.map(({ number }) =>
      text_sprite(String(number), theme.muted, theme.background),
    );
    this.sprites.push(this.#target, ...this.#crosses, ...this.#numbers);
    this.group.add(
      this.#links,
      this.#joints,
      this.#trail,
      this.#ghosts,
      this.#target,
      ...this.#crosses,
      ...this.#numbers,
    );
    for (const mesh of [this.#links, this.#joints, this.#trail, this.#ghosts]) mesh.frustumCulled = false;
    this.#obstacles = new SpatialObstacles(actor.scene, shapes, top, theme);
    this.group.add(this.#obstacles.group);
    this.#ghosts.visible = false;
  }

  /** Numbers of the links. */
  get numbers(): readonly Sprite[] {
    return this.#numbers;
  }

  /** Names of the obstacles. */
  get names(): readonly Sprite[] {
    return this.#obstacles.names;
  }

  set ghosts(visible: boolean) {
    this.#ghosts.visible = visible;
  }

  show(tick: number): void {
    const row = row_at(this.#actor, tick);
    this.#place_links(row, tick);
    this.#trail.count = Math.floor(row / this.#trail_stride);
    const path = this.#actor.scene.path;
    this.#target.position.fromArray(path, 3 * Math.min(tick, path.length / 3 - 1));
    this.#obstacles.place(tick);
  }

  dispose(): void {
    for (const material of this.#materials) material.dispose();
    for (const sprite of this.sprites) dispose_sprite(sprite);
    for (const mesh of [this.#links, this.#joints, this.#trail]) mesh.dispose();
    this.#ghosts.geometry.dispose();
    this.#obstacles.dispose();
  }

  #kept<M extends Material>(material: M): M {
    this.#materials.push(material);
    return material;
  }

  #make_trail(shapes: Shapes, size: number): InstancedMesh {
    const { replay } = this.#actor;
    const pieces = Math.max(Math.floor((replay.rows - 1) / this.#trail_stride), 1);
    const mesh = new InstancedMesh(
      shapes.thread,
      this.#kept(new MeshBasicMaterial({ color: this.#theme.good })),
      pieces,
    );
    for (let i = 0; i < pieces; ++i) {
      const from = tip_at(this.#actor, Math.min(i * this.#trail_stride, replay.rows - 1));
      const to = tip_at(this.#actor, Math.min((i + 1) * this.#trail_stride, replay.rows - 1));
      mesh.setMatrixAt(i, tube_between(replay.points, from, to, size / 400));
    }
    return mesh;
  }

  #make_ghosts(): LineSegments {
    const { replay, scene } = this.#actor;
    const points: number[] = [];
    for (const row of ghost_rows(this.#actor, kGhosts)) {
      for (const link of scene.scene.links) {
        for (const point of [link.start, link.end]) {
          const at = point_at(this.#actor, row, point);
          points.push(...replay.points.subarray(at, at + 3));
        }
      }
    }
    const finite = new Float32Array(points.map((value) => (Number.isFinite(value) ? value : 0)));
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(finite, 3));
    const material = new LineBasicMaterial({ color: this.#theme.text, transparent: true, opacity: 0.35 });
    return new LineSegments(geometry, this.#kept(material));
  }

  #place_links(row: number, tick: number): void {
    const { points } = this.#actor.replay;
    const color = new Color();
    const ball = new Matrix4();
    link_states(this.#actor, row).forEach((link, l) => {
      const radius = link.radius > 0 ? link.radius : this.#least;
      const joint = kJoint * radius;
      this.#links.setMatrixAt(l, tube_between(points, link.start, link.end, radius));
      this.#links.setColorAt(l, color.set(category_color(link.category, this.#theme.dark)));
      [link.start, link.end].forEach((at, end) => {
        const finite = Number.isFinite(points[at]! + points[at + 1]! + points[at + 2]!);
        ball.makeScale(joint, joint, joint).setPosition(points[at]!, points[at + 1]!, points[at + 2]!);
        this.#joints.setMatrixAt(2 * l + end, finite ? ball : kNowhere);
      });
      const middle = (k: number) => (points[link.start + k]! + points[link.end + k]!) / 2;
      this.#numbers[l]!.position.set(middle(0), middle(1), middle(2) + radius + this.#above);
      const cross = this.#crosses[l]!;
      cross.visible = link.contact && link.obstacle < this.#actor.scene.scene.obstacles.length;
      if (cross.visible) cross.position.fromArray(deepest_point(this.#actor, link, tick));
    });
    this.#links.instanceMatrix.needsUpdate = true;
    this.#joints.instanceMatrix.needsUpdate = true;
    if (this.#links.instanceColor) this.#links.instanceColor.needsUpdate = true;
  }
}

const kStart = new Vector3();
const kEnd = new Vector3();
const kTurn = new Quaternion();
const kSize = new Vector3();

/** Transform of the unit tube to one of a radius between two points; to nothing if one is not finite. */
function tube_between(points: Float32Array, from: number, to: number, radius: number): Matrix4 {
  kStart.fromArray(points, from);
  kEnd.fromArray(points, to);
  const direction = kEnd.clone().sub(kStart);
  const length = direction.length();
  if (!Number.isFinite(length)) return kNowhere;
  kTurn.setFromUnitVectors(kUp, length > 0 ? direction.divideScalar(length) : kUp);
  return new Matrix4().compose(kStart.add(kEnd).multiplyScalar(0.5), kTurn, kSize.set(radius, length, radius));
}
