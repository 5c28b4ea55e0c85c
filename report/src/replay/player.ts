// One or two runs of a scenario on one clock: figure, transport, verdicts and charts.
import type { ReportData, Run } from "../data";
import { h } from "../dom";
import { on_theme } from "../palette";
import { ChartsPanel } from "./charts_panel";
import { Clock } from "./clock";
import type { Line } from "./curve_frame";
import { Figure } from "./figure";
import type { KeyAction } from "./keys";
import { legend } from "./legend";
import { moments, next_moment, type Moment } from "./moments";
import { shown_runs, why_not_shown, type Shown } from "./shown";
import { moment_buttons, Transport, type Picture } from "./transport";
import { VerdictCard } from "./verdict_card";

export class Player implements Picture {
  readonly element: HTMLElement;
  readonly clock: Clock;
  readonly #shown: Shown[];
  readonly #lines: Line[];
  readonly #moments: Moment[];
  readonly #cards: VerdictCard[];
  readonly #transport: Transport;
  readonly #figure: Figure | null;
  readonly #charts: ChartsPanel | null;
  #ghosts = matchMedia("(prefers-reduced-motion: reduce)").matches;
  readonly #end_theme: () => void;

  constructor(data: ReportData, scenario_index: number, runs: readonly Run[], tick: number) {
    const scenario = data.scenario(scenario_index);
    this.#shown = shown_runs(data, scenario_index, runs);
    this.#lines = this.#shown.flatMap(({ letter, run, actor }) =>
      run.replay !== null && actor ? [{ letter, actor }] : [],
    );
    const last = Math.max(0, ...this.#lines.map((line) => line.actor.replay.rows - 1));
    this.clock = new Clock(last, scenario.dt_s);
    this.clock.seek(tick);
    this.#cards = this.#shown.map((shown) => new VerdictCard(shown, data.method(shown.run.method).changed));
    this.#transport = new Transport(this.clock, this);
    this.#moments = this.#lines.flatMap((line) => moments(line.actor.replay, line.actor.scene.scene));
    const figure = scenario.scene === null ? null : new Figure(scenario, this.#shown);
    this.#figure = figure;
    this.#charts = this.#lines.length === 0 ? null : new ChartsPanel(this.#lines, last, (at) => this.#go(at));
    this.set_ghosts(this.#ghosts);
    this.element = h(
      "div",
      { class: "replay-player" },
      ...(figure
        ? [figure.element]
        : this.#shown.map((shown) => h("p", { class: "replay-notice" }, why_not_shown(shown.run, scenario)))),
      ...(this.#lines.length > 0 ? [this.#transport.element, ...this.#make_moments()] : []),
      figure && legend(scenario),
      h("div", { class: "replay-cards" }, ...this.#cards.map((card) => card.element)),
      this.#charts?.element,
    );
    this.#end_theme = on_theme(() => {
      figure?.redraw();
      this.element.querySelector(".replay-legend")?.replaceWith(legend(scenario));
    });
    this.clock.on_change(() => this.#update());
    this.#update();
  }

  handle(action: KeyAction): void {
    switch (action.do) {
      case "toggle":
        return this.clock.toggle();
      case "step":
        return this.clock.step(action.ticks);
      case "seek":
        return this.clock.step(action.end ? this.clock.last : -this.clock.last);
      case "speed":
        return this.clock.change_speed(action.by);
      case "loop":
        return this.clock.set_loop(!this.clock.loop);
      case "moment": {
        const moment = next_moment(this.#moments, this.clock.tick, action.by);
        if (moment) this.#go(moment.tick!);
        return;
      }
      case "ghosts":
        return this.set_ghosts(!this.#ghosts);
      case "zoom":
        return this.zoom(action.factor);
      case "reset":
        return this.reset();
    }
  }

  get ghosts(): boolean {
    return this.#ghosts;
  }

  set_ghosts(on: boolean): void {
    this.#ghosts = on;
    this.#figure?.set_ghosts(on);
    this.#transport.update();
  }

  zoom(factor: number): void {
    this.#figure?.zoom(factor);
  }

  reset(): void {
    this.#figure?.reset();
  }

  dispose(): void {
    this.clock.dispose();
    this.#end_theme();
    this.#figure?.dispose();
    this.#charts?.dispose();
  }

  #go(tick: number): void {
    this.clock.pause();
    this.clock.seek(tick);
  }

  #update(): void {
    const { tick } = this.clock;
    this.#figure?.show(tick);
    this.#transport.update();
    for (const card of this.#cards) card.move(tick);
    this.#charts?.move(tick);
  }

  #make_moments(): HTMLElement[] {
    return this.#lines.map((line) =>
      moment_buttons(line.letter, line.actor.name, moments(line.actor.replay, line.actor.scene.scene), (moment) =>
        this.#go(moment.tick!),
      ),
    );
  }
}
