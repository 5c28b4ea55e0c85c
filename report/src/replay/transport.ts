// Buttons and scrubber of the clock, and the moments worth a look.
import { h, replace, svg } from "../dom";
import { kSpeeds, type Clock } from "./clock";
import { kKeyHelp } from "./keys";
import type { Moment } from "./moments";

/** What the buttons change about the drawing. */
export interface Picture {
  readonly ghosts: boolean;
  set_ghosts(ghosts: boolean): void;
  zoom(factor: number): void;
  reset(): void;
}

/** Outlines of the buttons' signs, 14 pixels high. */
const kSigns = {
  first: "M3 2v10M12 2v10l-7-5z",
  back: "M10 2v10l-7-5z",
  play: "M3 1.5v11l9.5-5.5z",
  pause: "M3 2h3v10h-3zM8.5 2h3v10h-3z",
  on: "M4 2v10l7-5z",
  last: "M11 2v10M2 2v10l7-5z",
} as const;

function sign(name: keyof typeof kSigns): SVGSVGElement {
  return svg(
    "svg",
    { width: 14, height: 14, viewBox: "0 0 14 14", "aria-hidden": "true" },
    svg("path", {
      d: kSigns[name],
      fill: "currentColor",
      stroke: "currentColor",
      "stroke-width": 1.4,
      "stroke-linejoin": "round",
    }),
  );
}

export class Transport {
  readonly element: HTMLElement;
  readonly #clock: Clock;
  readonly #play: HTMLButtonElement;
  readonly #scrubber: HTMLInputElement;
  readonly #reading = h("output", { class: "replay-reading" });
  readonly #speed: HTMLSelectElement;
  readonly #loop: HTMLButtonElement;
  readonly #ghosts: HTMLButtonElement;
  readonly #picture: Picture;

  constructor(clock: Clock, picture: Picture) {
    this.#clock = clock;
    this.#picture = picture;
    const button = (text: string | SVGSVGElement, title: string, action: () => void): HTMLButtonElement =>
      h("button", { type: "button", class: "quiet", title, "aria-label": title, click: action }, text);
    this.#play = button(sign("play"), "Play", () => clock.toggle());
    this.#play.classList.add("replay-play");
    this.#scrubber = h("input", {
      type: "range",
      min: 0,
      max: clock.last,
      step: 1,
      value: 0,
      "aria-label": "Tick",
      input: () => {
        clock.pause();
        clock.seek(Number(this.#scrubber.value));
      },
    });
    this.#speed = h("select", {
      title: "Speed",
      "aria-label": "Speed",
      change: () => clock.set_speed(Number(this.#speed.value)),
    });
    for (const speed of kSpeeds) this.#speed.append(h("option", { value: speed }, `${speed}×`));
    this.#loop = button("Loop", "Loop", () => clock.set_loop(!clock.loop));
    this.#ghosts = button("Ghosts", "Postures spread over the whole run", () => picture.set_ghosts(!picture.ghosts));
    this.element = h(
      "div",
      { class: "replay-transport", role: "group", "aria-label": "Playback" },
      h(
        "div",
        { class: "replay-bar" },
        h(
          "span",
          { class: "replay-buttons" },
          button(sign("first"), "First tick", () => clock.step(-clock.last)),
          button(sign("back"), "One tick back", () => clock.step(-1)),
          this.#play,
          button(sign("on"), "One tick on", () => clock.step(1)),
          button(sign("last"), "Last tick", () => clock.step(clock.last)),
        ),
        this.#scrubber,
        this.#reading,
        h("span", { class: "replay-buttons" }, this.#speed, this.#loop, this.#ghosts),
        h(
          "span",
          { class: "replay-buttons" },
          button("−", "Smaller", () => picture.zoom(0.8)),
          button("+", "Larger", () => picture.zoom(1.25)),
          button("Whole scene", "Back to the first view", () => picture.reset()),
        ),
      ),
      h(
        "p",
        { class: "replay-keys" },
        ...kKeyHelp.flatMap(([keys, what]) => [...keys.split(" ").map((key) => h("kbd", {}, key)), ` ${what} `]),
      ),
    );
    this.update();
  }

  update(): void {
    const { tick, last, dt, playing, loop, speed } = this.#clock;
    this.#scrubber.value = String(tick);
    this.#scrubber.setAttribute("aria-valuetext", `tick ${tick} of ${last}`);
    this.#reading.textContent = `tick ${tick} / ${last} · ${(tick * dt).toFixed(2)} s`;
    const title = playing ? "Pause" : "Play";
    if (this.#play.title !== title) {
      replace(this.#play, sign(playing ? "pause" : "play"));
      this.#play.title = title;
      this.#play.setAttribute("aria-label", title);
    }
    this.#speed.value = String(speed);
    this.#loop.setAttribute("aria-pressed", String(loop));
    this.#ghosts.setAttribute("aria-pressed", String(this.#picture.ghosts));
  }
}

/** Buttons that go to a run's moments. */
export function moment_buttons(
  letter: string,
  name: string,
  moments: readonly Moment[],
  go: (moment: Moment) => void,
): HTMLElement {
  return h(
    "div",
    { class: "replay-moments", role: "group", "aria-label": `Moments of ${name.slice(0, 80)}` },
    h("span", { class: "muted" }, letter === "" ? "Go to" : `${letter}: go to`),
    ...moments.map((moment) =>
      h(
        "button",
        {
          type: "button",
          class: "quiet",
          "data-moment": moment.key,
          disabled: moment.tick === null,
          title: moment.note.slice(0, 200) || null,
          click: () => go(moment),
        },
        moment.label,
        moment.tick !== null && h("span", { class: "muted" }, ` ${moment.tick}`),
      ),
    ),
  );
}
