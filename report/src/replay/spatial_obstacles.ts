// The obstacles in space: solids as they are, the ellipsoids around them that methods are told, and ellipsoids that are
// obstacles themselves.
import {
  BufferAttribute,
  BufferGeometry,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  type Material,
  type Sprite,
} from "three";
import type { DecodedScene } from "../data";
import type { Theme } from "../palette";
import { pose_at } from "./actor";
import type { Shapes } from "./spatial_arm";
import { dispose_sprite, text_sprite } from "./text_sprite";

const kMostNames = 12; ///< obstacles whose names are shown
const kEdge = 30; ///< least angle between the faces at an edge that is drawn [deg]

export class SpatialObstacles {
  readonly group = new Group();
  readonly names: Sprite[] = [];
  readonly #scene: DecodedScene;
  readonly #theme: Theme;
  readonly #top: number;
  readonly #ellipsoids: Group[] = [];
  readonly #solids: Mesh[] = [];
  readonly #kept: { dispose(): void }[] = [];

  /** `top` is the highest z of the scene [m], above which no name is. */
  constructor(scene: DecodedScene, shapes: Shapes, top: number, theme: Theme) {
    this.#scene = scene;
    this.#theme = theme;
    this.#top = top;
    this.#make_solids();
    this.#make_ellipsoids(shapes);
  }

  place(tick: number): void {
    const { scene } = this.#scene;
    scene.solids.forEach(({ obstacle }, s) => {
      const now = pose_at(this.#scene, obstacle, tick);
      const first = pose_at(this.#scene, obstacle, 0);
      const way = (k: number) => now.values[now.offset + 4 * k + 3]! - first.values[first.offset + 4 * k + 3]!;
      this.#solids[s]!.position.set(way(0), way(1), way(2));
    });
    this.#ellipsoids.forEach((group, o) => {
      const { values, offset } = pose_at(this.#scene, o, tick);
      const [a, b, c] = scene.obstacles[o]!.semi_axes_m as [number, number, number];
      const at = (k: number) => values[offset + k]!;
      const row = (k: number) => [a * at(k), b * at(k + 1), c * at(k + 2), at(k + 3)] as const;
      group.matrix.set(...row(0), ...row(4), ...row(8), 0, 0, 0, 1);
      group.matrixWorldNeedsUpdate = true;
      const name = group.userData["name"] as Sprite | undefined;
      name?.position.set(at(3), at(7), Math.min(at(11) + Math.hypot(a * at(8), b * at(9), c * at(10)), this.#top));
    });
  }

  dispose(): void {
    for (const name of this.names) dispose_sprite(name);
    for (const one of this.#kept) one.dispose();
  }

  #keep<T extends { dispose(): void }>(one: T): T {
    this.#kept.push(one);
    return one;
  }

  /** Seen through, so that a link within a shelf is not hidden; the edges tell its boards apart. */
  #make_solids(): void {
    const body = this.#keep(
      new MeshLambertMaterial({
        color: this.#theme.solid,
        flatShading: true,
        transparent: true,
        opacity: 0.6,
        depthWrite: false,
      }),
    );
    const edge = this.#keep(new LineBasicMaterial({ color: this.#theme.text }));
    this.#scene.scene.solids.forEach((solid, s) => {
      const { vertices, triangles } = this.#scene.solids[s]!;
      const geometry = this.#keep(new BufferGeometry());
      geometry.setAttribute("position", new BufferAttribute(vertices, 3));
      geometry.setIndex(new BufferAttribute(triangles, 1));
      const mesh = new Mesh(geometry, body);
      mesh.add(new LineSegments(this.#keep(new EdgesGeometry(geometry, kEdge)), edge));
      this.#solids.push(mesh);
      this.group.add(mesh);
      if (this.#scene.scene.solids.length > kMostNames) return;
      geometry.computeBoundingBox();
      const { min, max } = geometry.boundingBox!;
      const name = this.#name(solid.name);
      name.position.set((min.x + max.x) / 2, (min.y + max.y) / 2, Math.min(max.z, this.#top));
      mesh.add(name);
    });
  }

  #make_ellipsoids(shapes: Shapes): void {
    const { obstacles } = this.#scene.scene;
    const alone = obstacles.filter((obstacle) => obstacle.shape === null).length;
    const keep = <M extends Material>(material: M) => this.#keep(material);
    const body = keep(
      new MeshLambertMaterial({ color: this.#theme.ellipsoid, transparent: true, opacity: 0.42, depthWrite: false }),
    );
    const veil = keep(body.clone());
    veil.opacity = 0.12;
    const outline = keep(new LineBasicMaterial({ color: this.#theme.text, transparent: true, opacity: 0.5 }));
    const thread = keep(outline.clone());
    thread.opacity = 0.15;
    for (const obstacle of obstacles) {
      const group = new Group();
      group.matrixAutoUpdate = false;
      const around = obstacle.shape !== null; // a solid, which has the name
      group.add(
        new Mesh(shapes.ellipsoid, around ? veil : body),
        new LineSegments(shapes.rings, around ? thread : outline),
      );
      this.#ellipsoids.push(group);
      this.group.add(group);
      if (around || alone > kMostNames) continue;
      const name = this.#name(obstacle.name);
      group.userData["name"] = name;
      this.group.add(name);
    }
  }

  #name(name: string): Sprite {
    const shown = name.length > 24 ? `${name.slice(0, 23)}…` : name;
    const sprite = text_sprite(shown, this.#theme.text, this.#theme.background);
    this.names.push(sprite);
    return sprite;
  }
}
