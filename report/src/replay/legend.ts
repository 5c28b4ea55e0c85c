// What the colours and signs of a replay mean.
import type { Scenario } from "../data";
import { h } from "../dom";
import { millimetres } from "../format";
import { category_color, is_dark, theme } from "../palette";
import { category_words, kCategories } from "./categories";

const sign = (name: string, ...what: (string | HTMLElement)[]): HTMLElement =>
  h("li", {}, h("span", { class: `replay-sign ${name}`, "aria-hidden": "true" }), ...what);

const colored = (item: HTMLElement, color: string): HTMLElement => {
  (item.firstElementChild as HTMLElement).style.setProperty("--color", color);
  return item;
};

/** Which obstacles the judge goes by, and which methods; nothing where both go by the same ellipsoids. */
function obstacle_signs(scenario: Scenario): HTMLElement[] {
  const { scene } = scenario;
  if (scene === null || scene.solids.length === 0) return [];
  const { solid, ellipsoid } = theme();
  const signs = [
    colored(sign("solid", h("b", {}, "solid"), " as the judge has it"), solid),
    colored(sign("around", h("b", {}, "ellipsoid around it"), " as methods are told"), ellipsoid),
  ];
  if (scene.obstacles.some((obstacle) => obstacle.shape === null))
    signs.push(colored(sign("alone", h("b", {}, "ellipsoid"), " to both"), ellipsoid));
  return signs;
}

/** Colours and signs in words. */
export function legend(scenario: Scenario): HTMLElement {
  const same = scenario.scene?.links.every((link) => link.radius_m === scenario.link_radius_m) ?? true;
  const thin =
    scenario.link_radius_m === 0
      ? "Links have no thickness in this scenario; they are drawn with one."
      : `Links are drawn with their radius, ${millimetres(scenario.link_radius_m)} mm${same ? "" : " or less"}.`;
  return h(
    "div",
    { class: "replay-legend" },
    h(
      "ul",
      {},
      ...kCategories.map((category) => {
        const { name, meaning } = category_words(category);
        return colored(sign("link", h("b", {}, name), ` ${meaning}`), category_color(category, is_dark()));
      }),
      ...obstacle_signs(scenario),
      sign("cross", h("b", {}, "in contact"), " at the link's deepest point"),
      sign("path", "desired path; a ring where the tip should be"),
      sign("trail", "path of the tip"),
    ),
    h(
      "p",
      { class: "muted" },
      "A link has the colour of its category (paper, Fig. 3) to the obstacle closest to it. ",
      thin,
      scenario.geometry === null ? "" : " Categories are of the ellipsoids, contacts of the solids.",
      scenario.dimension === 2 ? " Drag to move the picture" : " Drag to turn the picture",
      "; click it, and the wheel zooms; a double click shows the whole scene.",
    ),
  );
}
