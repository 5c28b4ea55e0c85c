// State of the page in the fragment of its address, so that every view of it can be passed on.

export const kViews = ["summary", "scaling", "replay", "claims", "trade-offs", "provenance"] as const;
export type ViewName = (typeof kViews)[number];

/** What is shown. Empty text and null: not chosen, the view decides. */
export interface State {
  view: ViewName;
  scenario: string; ///< key of a scenario, its name where no other has it
  method: string; ///< key of a variant
  against: string; ///< variant shown beside it
  seed: string; ///< of the run, for methods that draw random numbers
  repetition: number | null; ///< of the run, in a campaign
  tick: number | null;
  family: string; ///< filter: family of scenarios
  robot: string; ///< filter: robot of scenarios
  verdict: string; ///< filter: verdict of runs or claims
  only: string; ///< filter: variant
  find: string; ///< filter: words
  sort: string; ///< column of each sorted table, `runs.-time|methods.rate`; "-": descending
  cell: string; ///< figure in the cells of the matrix
  rows: string; ///< what the rows of the matrix gather, `robot`; else families
  least: string; ///< success rate that trade-offs ask for [%]
  sweep: string; ///< sweep of the scaling view
  show: string; ///< series shown, separated by "|"
  x: string; ///< quantity of the x axis of trade-offs
  y: string;
  open: string; ///< claim or run that is opened
}

const kInitial: State = {
  view: "summary",
  scenario: "",
  method: "",
  against: "",
  seed: "",
  repetition: null,
  tick: null,
  family: "",
  robot: "",
  verdict: "",
  only: "",
  find: "",
  sort: "",
  cell: "",
  rows: "",
  least: "",
  sweep: "",
  show: "",
  x: "",
  y: "",
  open: "",
};

type Key = keyof State;
const kKeys = Object.keys(kInitial) as Key[];
const kNumbers: readonly Key[] = ["repetition", "tick"];

/** State of a fragment; what cannot be read is as if it were not there. */
export function parse(fragment: string): State {
  const fields = new URLSearchParams(fragment.replace(/^#/, ""));
  const state: Record<string, string | number | null> = { ...kInitial };
  for (const key of kKeys) {
    const text = fields.get(key);
    if (text === null) continue;
    if (kNumbers.includes(key)) state[key] = /^\d{1,9}$/.test(text) ? Number(text) : null;
    else if (key !== "view" || kViews.includes(text as ViewName)) state[key] = text;
  }
  return state as unknown as State;
}

/** Fragment of a state, with what differs from the initial one. */
export function fragment(state: State): string {
  const fields = new URLSearchParams();
  for (const key of kKeys) {
    const value = state[key];
    if (key === "view" || (value !== null && value !== "")) fields.set(key, String(value));
  }
  return `#${fields.toString()}`;
}

export type Change = Partial<State>;

/** The state, kept in step with the address. A new view is a new entry of the history; other changes
 *  replace the entry, and the address follows them with a delay, so that scrubbing does not flood it. */
export class Link {
  #state: State;
  #listeners: ((state: State) => void)[] = [];
  #timer = 0;

  constructor() {
    this.#state = parse(location.hash);
    addEventListener("hashchange", () => {
      clearTimeout(this.#timer);
      if (fragment(this.#state) === fragment(parse(location.hash))) return;
      this.#state = parse(location.hash);
      this.#tell();
    });
    addEventListener("pagehide", () => this.#write());
  }

  get state(): Readonly<State> {
    return this.#state;
  }

  /** Changes the state and tells all listeners. */
  change(change: Change): void {
    const view_changes = change.view !== undefined && change.view !== this.#state.view;
    if (view_changes) this.#write();
    this.#state = { ...this.#state, ...change };
    clearTimeout(this.#timer);
    if (view_changes) history.pushState(null, "", fragment(this.#state));
    else this.#timer = window.setTimeout(() => this.#write(), 150);
    this.#tell();
  }

  /** Address of the state after a change, for a link to it. */
  href(change: Change): string {
    return fragment({ ...this.#state, ...change });
  }

  listen(listener: (state: State) => void): void {
    this.#listeners.push(listener);
  }

  #write(): void {
    clearTimeout(this.#timer);
    if (location.hash !== fragment(this.#state)) history.replaceState(null, "", fragment(this.#state));
  }

  #tell(): void {
    for (const listener of this.#listeners) listener(this.#state);
  }
}

/** A part of the page that shows the state. `update` is called after every change of it, cheap ones included
 *  (60 a second while a replay plays); `dispose` when another view takes the place. */
export interface View {
  update(state: Readonly<State>): void;
  dispose(): void;
}
