// The arm of each run, in the plane or in space; a message where the browser cannot draw in space.
import type { Scenario } from "../data";
import { h } from "../dom";
import type { Actor } from "./actor";
import { PlanarView } from "./planar_view";
import { why_not_shown, type Shown } from "./shown";
import { SpatialView, webgl_of } from "./spatial_view";
import { Stage, type SceneView } from "./stage";

export class Figure {
  readonly #stage: Stage;
  #view: SceneView | null = null;

  /** All of `shown` have actors. */
  constructor(scenario: Scenario, shown: readonly Shown[]) {
    const dimension = scenario.dimension === 2 ? "in the plane" : "in space";
    const names = shown.map(({ name }) => name.slice(0, 80)).join(" and ");
    const description = `The arm ${dimension}, moved by ${names}. What is shown is in figures below.`;
    this.#stage = new Stage(
      shown.map((run) => pane(run, scenario)),
      description,
      () => this.#view?.redraw(),
    );
    this.#view = this.#make_view(
      scenario,
      shown.map(({ actor }) => actor!),
    );
  }

  get element(): HTMLElement {
    return this.#stage.element;
  }

  show(tick: number): void {
    this.#view?.show(tick);
  }

  set_ghosts(on: boolean): void {
    this.#view?.set_ghosts(on);
  }

  zoom(factor: number): void {
    this.#view?.zoom(factor);
  }

  reset(): void {
    this.#view?.reset();
  }

  redraw(): void {
    this.#view?.redraw();
  }

  dispose(): void {
    this.#view?.dispose();
    this.#stage.dispose();
  }

  #make_view(scenario: Scenario, actors: readonly Actor[]): SceneView | null {
    if (scenario.dimension === 2) return new PlanarView(this.#stage, actors);
    const gl = webgl_of(this.#stage.canvas);
    if (gl)
      return new SpatialView(this.#stage, actors, gl, () => this.#without_webgl("The browser has taken WebGL away"));
    this.#without_webgl("This browser offers no WebGL");
    return null;
  }

  #without_webgl(why: string): void {
    this.#view?.dispose();
    this.#view = null;
    this.element.classList.add("replay-no-webgl");
    this.element.prepend(
      h(
        "p",
        { class: "replay-notice", role: "status" },
        `${why}, so the arm cannot be drawn in space. Clock, verdicts and charts work all the same.`,
      ),
    );
  }
}

/** The part of the stage that a run has, with its name, and with the reason if it cannot be watched. */
function pane(shown: Shown, scenario: Scenario): HTMLElement {
  const why = why_not_shown(shown.run, scenario);
  return h(
    "div",
    { class: "replay-pane" },
    h(
      "div",
      { class: "replay-pane-name" },
      shown.letter !== "" && h("span", { class: "replay-letter" }, shown.letter),
      shown.name.slice(0, 60),
    ),
    why !== "" &&
      h(
        "p",
        { class: "replay-notice" },
        `${why.slice(0, 400)}.`,
        h("span", { class: "muted" }, " The arm stands at its start."),
      ),
  );
}
