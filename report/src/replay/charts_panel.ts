// The charts under a replay, with what can be chosen of them.
import type { ChartSpec } from "../chart";
import { h, replace, select } from "../dom";
import { row_at } from "./actor";
import { criteria_chart, criteria_text } from "./criteria_chart";
import { CursorChart } from "./cursor_chart";
import type { Line } from "./curve_frame";
import { clearance_chart, error_chart, joints_chart } from "./curves";
import { pair_criteria, telling_pair, type PairCriteria } from "./pair";
import type { Plane } from "./quadratic";

export class ChartsPanel {
  readonly element: HTMLElement;
  readonly #lines: readonly Line[];
  readonly #last: number;
  readonly #seek: (tick: number) => void;
  readonly #charts: CursorChart[] = [];
  readonly #criteria_now = h("p", { class: "muted replay-criteria-now" });
  #pairs: PairCriteria[] = [];
  #tick = 0;

  /** At least one line. `last` is the last tick; `seek` is called when a chart is clicked or dragged. */
  constructor(lines: readonly Line[], last: number, seek: (tick: number) => void) {
    this.#lines = lines;
    this.#last = Math.max(last, 1);
    this.#seek = seek;
    const clearance = this.#add(clearance_chart(lines));
    const error = this.#add(error_chart(lines));
    const joints = this.#add(joints_chart(lines, null));
    const joint_choice = select(
      "Joint",
      [
        { value: "", text: "all" },
        ...Array.from({ length: lines[0]!.actor.scenario.joints }, (_, j) => ({ value: String(j), text: `q${j + 1}` })),
      ],
      "",
      (value) => joints.set(joints_chart(lines, value === "" ? null : Number(value))),
    );
    this.element = h(
      "div",
      { class: "replay-charts" },
      clearance.element,
      error.element,
      h("div", {}, h("div", { class: "replay-choices" }, joint_choice), joints.element),
      this.#make_criteria(),
    );
  }

  move(tick: number): void {
    this.#tick = tick;
    for (const chart of this.#charts) chart.move(tick);
    this.#show_criteria();
  }

  dispose(): void {
    for (const chart of this.#charts) chart.dispose();
  }

  #add(spec: ChartSpec): CursorChart {
    const chart = new CursorChart(spec, this.#last, this.#seek);
    this.#charts.push(chart);
    return chart;
  }

  #make_criteria(): HTMLElement | false {
    const lines = this.#lines;
    const { scene } = lines[0]!.actor.scene;
    const told = lines.map((line) => telling_pair(line.actor)).find((pair) => pair !== null);
    if (!told) return false;
    const chosen = { ...told, plane: "space" as Plane };
    const spec = () => {
      this.#pairs = lines.map((line) => pair_criteria(line.actor, chosen.link, chosen.obstacle, chosen.plane));
      const seen = chosen.plane === "space" ? "" : `, projected on ${chosen.plane}`;
      const obstacle = scene.obstacles[chosen.obstacle]!.name.slice(0, 40);
      return criteria_chart(
        lines,
        this.#pairs,
        `Category criteria of link ${scene.links[chosen.link]!.number} and ${obstacle}${seen}`,
      );
    };
    const chart = this.#add(spec());
    const choose = (change: Partial<typeof chosen>): void => {
      Object.assign(chosen, change);
      chart.set(spec());
      this.#show_criteria();
    };
    const planes: readonly Plane[] = ["space", "XOY", "YOZ", "XOZ"];
    return h(
      "div",
      {},
      h(
        "div",
        { class: "replay-choices" },
        select(
          "Link",
          scene.links.map((link, l) => ({ value: String(l), text: String(link.number) })),
          String(chosen.link),
          (value) => choose({ link: Number(value) }),
        ),
        select(
          "Obstacle",
          scene.obstacles.map((obstacle, o) => ({ value: String(o), text: obstacle.name })),
          String(chosen.obstacle),
          (value) => choose({ obstacle: Number(value) }),
        ),
        lines[0]!.actor.scenario.dimension === 3 &&
          select(
            "Seen in",
            planes.map((plane) => ({ value: plane, text: plane === "space" ? "space" : `projection on ${plane}` })),
            "space",
            (value) => choose({ plane: value as Plane }),
          ),
      ),
      chart.element,
      this.#criteria_now,
      h(
        "p",
        { class: "muted replay-criteria-now" },
        `f(t) is the obstacle's level along the link, t from 0 to 1: the paper's criteria over (x_max − x_min)². The ${lines.length > 1 ? "strips show the categories, A above B" : "strip shows the category"}.`,
      ),
    );
  }

  #show_criteria(): void {
    replace(
      this.#criteria_now,
      ...this.#pairs.map((pair, i) => {
        const line = this.#lines[i]!;
        return h(
          "span",
          {},
          line.letter !== "" && h("span", { class: "replay-letter" }, line.letter),
          criteria_text(pair, row_at(line.actor, this.#tick)),
        );
      }),
    );
  }
}
