// The one clock of a replay: which tick is shown, and how it advances. It shows ticks only, never a posture in
// between: the judge's figures are of ticks.

/** Calls back before the next picture. */
export interface Frames {
  request(callback: (now: number) => void): number;
  cancel(handle: number): void;
}

const kBrowserFrames: Frames = {
  request: (callback) => requestAnimationFrame(callback),
  cancel: (handle) => cancelAnimationFrame(handle),
};

/** Speeds that are offered, in multiples of the scenario's own time. */
export const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 4, 8] as const;

/** A tab that was in the background goes on where it was, not where it would be [s]. */
const kLongestPause = 0.25;

export class Clock {
  #loop = false;
  #played_tick = 0;
  #shown_tick = 0;
  #rate = 1;
  #handle: number | null = null;
  #before: number | null = null;
  readonly #frames: Frames;
  #listeners: (() => void)[] = [];

  /** `last` is the last tick, `dt` the control period [s]. */
  constructor(
    readonly last: number,
    readonly dt: number,
    frames: Frames = kBrowserFrames,
  ) {
    this.#frames = frames;
  }

  get tick(): number {
    return this.#shown_tick;
  }

  get playing(): boolean {
    return this.#handle !== null;
  }

  get loop(): boolean {
    return this.#loop;
  }

  get speed(): number {
    return this.#rate;
  }

  /** Is told of every change of tick, speed, loop and playing. */
  on_change(listener: () => void): void {
    this.#listeners.push(listener);
  }

  /** Goes to the nearest tick that there is. */
  seek(tick: number): void {
    this.#played_tick = this.#clamped(Math.round(tick));
    this.#show();
  }

  /** Pauses and goes a number of ticks on, or back. */
  step(ticks: number): void {
    this.pause();
    this.seek(this.#shown_tick + ticks);
  }

  /** Starts, from the beginning if it stands at the end. */
  play(): void {
    if (this.playing || this.last === 0) return;
    if (this.#shown_tick === this.last) this.seek(0);
    this.#before = null;
    this.#request();
    this.#tell();
  }

  pause(): void {
    if (this.#handle === null) return;
    this.#frames.cancel(this.#handle);
    this.#handle = null;
    this.#played_tick = this.#shown_tick;
    this.#tell();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  set_loop(loop: boolean): void {
    this.#loop = loop;
    this.#tell();
  }

  set_speed(speed: number): void {
    this.#rate = speed;
    this.#tell();
  }

  /** To the next of the offered speeds, faster for +1 and slower for -1. */
  change_speed(by: 1 | -1): void {
    const order = by > 0 ? kSpeeds : [...kSpeeds].reverse();
    const next = order.find((speed) => (speed - this.#rate) * by > 0);
    if (next !== undefined) this.set_speed(next);
  }

  dispose(): void {
    this.#listeners = [];
    this.pause();
  }

  #clamped(tick: number): number {
    return Math.min(Math.max(tick, 0), this.last);
  }

  #request(): void {
    this.#handle = this.#frames.request((now) => this.#advance(now));
  }

  #advance(now: number): void {
    const elapsed = this.#before === null ? 0 : Math.min((now - this.#before) / 1000, kLongestPause);
    this.#before = now;
    this.#played_tick += (elapsed * this.#rate) / this.dt;
    this.#request();
    if (this.#played_tick >= this.last + 1 && this.#loop) this.#played_tick %= this.last + 1;
    this.#show();
    if (this.#shown_tick === this.last && !this.#loop) this.pause();
  }

  #show(): void {
    const tick = this.#clamped(Math.floor(this.#played_tick));
    if (tick === this.#shown_tick) return;
    this.#shown_tick = tick;
    this.#tell();
  }

  #tell(): void {
    for (const listener of this.#listeners) listener();
  }
}
