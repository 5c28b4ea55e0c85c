// What the judge found of a run, what the method claims, and how things stand at the tick shown.
import { verdict_of, type Contact, type Run, type Scene, type SelfContact } from "../data";
import { h, replace, short } from "../dom";
import { counted, degrees, length, time } from "../format";
import { joint_steps, jumps } from "../jumps";
import { link_states, row_at } from "./actor";
import { run_mark } from "./selection";
import type { Shown } from "./shown";

function term(name: string, ...value: (string | HTMLElement)[]): HTMLElement[] {
  return [h("dt", {}, name), h("dd", {}, ...value)];
}

function reasons(run: Run, scene: Scene | null): HTMLElement[] {
  const contact = (link: number, other: string, c: Contact | SelfContact): string =>
    `link ${link} in ${other} from tick ${c.first_tick}${c.at_tick ? `, at ${counted(c.ticks, "tick")}` : ", between ticks only"}`;
  const texts = [
    ...run.contacts.map((c) => contact(c.link, c.obstacle.slice(0, 60), c)),
    ...run.self_contacts.map((c) => contact(c.link, `link ${c.other_link}`, c)),
    ...jumps(run, scene).map(({ size, tick }) => `a joint step of ${size} in tick ${tick ?? "?"}`),
  ];
  if (run.failures.includes("orientation"))
    texts.push(`turned away by ${degrees(run.orientation_max_rad)} at tick ${run.orientation_max_tick ?? "?"}`);
  if (run.gave_up !== "") texts.push(`gave up: ${run.gave_up}`);
  if (run.disagreement !== "") texts.push(`the judge's two distances contradict each other: ${run.disagreement}`);
  if (run.touching) texts.push("came within 0.001 mm of contact: free, flagged");
  return texts.map((text) => h("li", {}, short(text, 160)));
}

function clamped(run: Run): string {
  return run.clamped
    .map((pair) => `link ${pair.link} from ${pair.obstacle.slice(0, 40)} (${counted(pair.ticks, "tick")})`)
    .join(", ");
}

export class VerdictCard {
  readonly element: HTMLElement;
  readonly #shown: Shown;
  readonly #now = h("dl", { class: "replay-now" });

  constructor(shown: Shown, changed: string) {
    this.#shown = shown;
    const { run, letter, name } = shown;
    const verdict = verdict_of(run);
    const mark = run_mark(run);
    this.element = h(
      "section",
      { class: "replay-card", "aria-label": `Verdict on ${name.slice(0, 80)}` },
      h(
        "h3",
        {},
        letter !== "" && h("span", { class: "replay-letter" }, letter),
        short(name),
        mark !== "" && h("span", { class: "muted" }, ` ${mark}`),
      ),
      changed !== "" && h("p", { class: "muted" }, "with ", short(changed, 120)),
      h(
        "div",
        { class: "replay-card-columns" },
        run.applicable
          ? h(
              "dl",
              {},
              ...term(
                "judged",
                h(
                  "strong",
                  { class: `verdict ${verdict.kind}` },
                  `${verdict.symbol} ${run.success ? verdict.word : run.failures.join(", ") || verdict.word}`,
                ),
              ),
              ...term(
                "claimed",
                short(run.claimed, 80),
                run.claim_detail !== "" ? h("span", { class: "muted" }, " ", short(run.claim_detail, 160)) : "",
                verdict.lie ? h("strong", { class: "replay-lie" }, " ✗ the judge finds otherwise") : "",
              ),
              ...term("tip error", `${length(run.tip_error_max_m)} at most, ${length(run.tip_error_rms_m)} rms`),
              ...(run.orientation_max_rad === null
                ? []
                : term("turned away", `${degrees(run.orientation_max_rad)} at most`)),
              ...term("clearance", `${length(run.clearance_m)} at least`),
              ...term("joint step", `${joint_steps(run)} at most`),
              ...term("time", times(run)),
              ...(clamped(run) !== "" ? term("moved away", short(clamped(run), 160)) : []),
            )
          : h("p", {}, "Not applicable: ", short(run.why_not, 200)),
        h(
          "div",
          {},
          h("ul", { class: "replay-reasons" }, ...reasons(run, shown.actor?.scene.scene ?? null)),
          this.#now,
        ),
      ),
    );
  }

  move(tick: number): void {
    const { actor } = this.#shown;
    if (actor === null || this.#shown.run.replay === null) return;
    const row = row_at(actor, tick);
    const { replay, scene } = actor;
    const near = scene.scene.obstacles[replay.near_obstacle[row]!];
    const obstacle = (near && near.shape !== null ? scene.scene.solids[near.shape] : near)?.name.slice(0, 40);
    const links = link_states(actor, row);
    const touching = scene.scene.links.filter((_, l) => links[l]!.contact).map((link) => link.number);
    replace(
      this.#now,
      ...term(
        `tick ${row}`,
        tick > row ? h("strong", {}, "ended here") : `t = ${(row * actor.scenario.dt_s).toFixed(3)} s`,
      ),
      ...term(row === 0 ? "start error" : "tip error", length(replay.tip_error_m[row])),
      ...term(
        "clearance",
        length(replay.clearance_m[row]),
        obstacle === undefined ? "" : ` (link ${replay.near_link[row]}, ${obstacle})`,
      ),
      ...term(
        "in contact",
        touching.length === 0 ? "no link" : `✕ ${touching.map((number) => `link ${number}`).join(", ")}`,
      ),
    );
  }
}

function times(run: Run): string {
  if (run.plan_s !== null) return `plan ${time(run.plan_s)}`;
  if (run.step_median_s === null) return run.success ? "–" : "– (times count only of successes)";
  return `${time(run.step_median_s)} a tick, p99 ${time(run.step_p99_s)}${run.times_indicative.length > 0 ? ", indicative only" : ""}${run.includes_pipe ? ", with the pipe" : ""}`;
}
