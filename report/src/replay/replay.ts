// The replay: watch the arm do it, with what the judge found beside it.
import "./replay.css";
import { verdict_of, type ReportData, type Run } from "../data";
import { h, replace, select } from "../dom";
import type { Change, Link, State, View } from "../link";
import { keeps_key, key_action } from "./keys";
import { Player } from "./player";
import { run_mark, select_runs, type Selection } from "./selection";

export function replayView(host: HTMLElement, data: ReportData, link: Link): View {
  return new ReplayView(host, data, link);
}

class ReplayView implements View {
  readonly #data: ReportData;
  readonly #link: Link;
  readonly #choices = h("div", { class: "replay-choices" });
  readonly #stage = h("div", {});
  readonly #listening = new AbortController();
  #selection: Selection | null = null;
  #player: Player | null = null;

  constructor(host: HTMLElement, data: ReportData, link: Link) {
    this.#data = data;
    this.#link = link;
    host.append(h("div", { class: "replay" }, this.#choices, this.#stage));
    document.addEventListener("keydown", (event) => this.#key(event), { signal: this.#listening.signal });
    this.update(link.state);
  }

  update(state: Readonly<State>): void {
    const selection = select_runs(this.#data, state);
    const before = this.#selection;
    if (
      before &&
      before.scenario === selection.scenario &&
      before.run === selection.run &&
      before.against === selection.against
    ) {
      const clock = this.#player?.clock;
      if (clock && state.tick !== null && state.tick !== clock.tick) clock.seek(state.tick);
      return;
    }
    this.#selection = selection;
    this.#show(selection, state.tick ?? 0);
  }

  dispose(): void {
    this.#listening.abort();
    this.#player?.dispose();
  }

  #show(selection: Selection, tick: number): void {
    this.#player?.dispose();
    this.#player = null;
    this.#show_choices(selection);
    if (selection.run === null) {
      replace(
        this.#stage,
        h(
          "p",
          { class: "replay-notice" },
          selection.scenario < 0 ? "The report has no runs." : "Nothing was run on this scenario.",
        ),
      );
      return;
    }
    const runs = [selection.run, ...(selection.against ? [selection.against] : [])];
    const player = new Player(this.#data, selection.scenario, runs, tick);
    this.#player = player;
    replace(this.#stage, player.element);
    player.clock.on_change(() => this.#remember(player));
  }

  /** The address follows the clock, and says what is shown even if the view chose it. */
  #remember(player: Player): void {
    if (this.#player !== player || this.#link.state.tick === player.clock.tick) return;
    this.#link.change({ ...this.#named(), tick: player.clock.tick });
  }

  #named(): Change {
    const { run, against, scenario } = this.#selection!;
    const variant = (which: Run | null) => (which ? this.#data.method_key(which.method) : "");
    return { scenario: this.#data.scenario_key(scenario), method: variant(run), against: variant(against) };
  }

  #show_choices(selection: Selection): void {
    const { report } = this.#data;
    if (selection.scenario < 0) return replace(this.#choices);
    const here = this.#data.runs_of_scenario[selection.scenario] ?? [];
    const first = new Map<number, Run>();
    for (const run of here)
      if (!first.has(run.method) || (first.get(run.method)!.replay === null && run.replay !== null))
        first.set(run.method, run);
    const methods = [...first.values()].map((run) => {
      const { symbol } = verdict_of(run);
      const variant = this.#data.method_key(run.method);
      return { value: variant, text: `${symbol} ${variant}${run.replay === null ? " (no replay)" : ""}` };
    });
    const variant = (run: Run | null) => (run ? this.#data.method_key(run.method) : "");
    const siblings = selection.run ? this.#data.runs(selection.scenario, selection.run.method) : [];
    replace(
      this.#choices,
      select(
        "Scenario",
        report.scenarios.map((_, index) => ({
          value: this.#data.scenario_key(index),
          text: this.#data.scenario_key(index),
        })),
        this.#data.scenario_key(selection.scenario),
        (scenario) => this.#link.change({ scenario, seed: "", repetition: null, tick: null }),
      ),
      select("Method", methods, variant(selection.run), (method) =>
        this.#link.change({ ...this.#named(), method, seed: "", repetition: null }),
      ),
      siblings.length > 1 &&
        select(
          "Run",
          siblings.map((run, i) => ({
            value: String(i),
            text: `${verdict_of(run).symbol} ${run_mark(run) || `run ${i + 1}`}${run.replay === null ? " (no replay)" : ""}`,
          })),
          String(siblings.indexOf(selection.run!)),
          (value) => {
            const run = siblings[Number(value)]!;
            this.#link.change({ ...this.#named(), seed: run.seed ?? "", repetition: run.repetition });
          },
        ),
      select(
        "Beside it",
        [{ value: "", text: "nothing" }, ...methods.filter((method) => method.value !== variant(selection.run))],
        variant(selection.against),
        (against) => this.#link.change({ ...this.#named(), against }),
      ),
      selection.against &&
        h(
          "button",
          {
            type: "button",
            class: "quiet",
            click: () =>
              this.#link.change({
                ...this.#named(),
                method: variant(selection.against),
                against: variant(selection.run),
              }),
          },
          "Swap",
        ),
    );
  }

  #key(event: KeyboardEvent): void {
    const action = key_action(event);
    if (!action || !this.#player || keeps_key(event.target, event.key)) return;
    event.preventDefault();
    this.#player.handle(action);
  }
}
