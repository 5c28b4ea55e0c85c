// Elements made from data. Text goes in as text, never as HTML.

export type Child = Node | string | number | null | undefined | false;

export interface Attributes {
  [name: string]: string | number | boolean | null | undefined | ((event: Event) => void);
}

const kSvg = "http://www.w3.org/2000/svg";

function fill(element: Element, attributes: Attributes, children: readonly Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name, value);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  append(element, children);
}

function append(element: Element, children: readonly Child[]): void {
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    element.append(child instanceof Node ? child : String(child));
  }
}

/** An HTML element. An attribute whose value is a function is a listener for the event of that name;
 *  `false` and `null` leave it out. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: readonly Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

/** An SVG element. */
export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: readonly Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(kSvg, tag) as SVGElementTagNameMap[K];
  fill(element, attributes, children);
  return element;
}

/** Replaces all that an element holds. */
export function replace(element: Element, ...children: readonly Child[]): void {
  element.replaceChildren();
  append(element, children);
}

const kControls = "button, select, input, a";

/** Replaces what a group of controls holds; the control in the same place keeps the focus. */
export function redraw(group: Element, ...controls: readonly Child[]): void {
  const place = [...group.querySelectorAll<HTMLElement>(kControls)].indexOf(document.activeElement as HTMLElement);
  replace(group, ...controls);
  if (place >= 0) group.querySelectorAll<HTMLElement>(kControls)[place]?.focus({ preventScroll: true });
}

/** A text cut to a length, with an ellipsis, never within a character. */
export function cut(text: string, length: number): string {
  return text.length <= length ? text : `${[...text.slice(0, length)].slice(0, -1).join("")}…`;
}

/** The same as an element with more of the text in its `title`. */
export function short(text: string, length = 60): HTMLElement | string {
  return text.length <= length ? text : h("span", { title: cut(text, 2000) }, cut(text, length));
}

/** A link beside the page; only a relative address becomes one, anything else stays text. */
export function relative_link(href: string, text: string): HTMLElement {
  const safe = !/^[a-z][a-z0-9+.-]*:|^\/\/|^\\/i.test(href.trim()) && !/[\u0000-\u001f]/.test(href);
  return safe ? h("a", { href }, text) : h("span", {}, text);
}

/** A button of a group of which one is chosen. */
export function choice(text: string, chosen: boolean, choose: () => void, title = ""): HTMLButtonElement {
  return h(
    "button",
    { type: "button", class: "choice", "aria-pressed": String(chosen), title: title || null, click: choose },
    cut(text, 80),
  );
}

/** A labelled drop-down list. */
export function select(
  label: string,
  options: readonly { value: string; text: string }[],
  value: string,
  choose: (value: string) => void,
): HTMLLabelElement {
  const element = h("select", { change: () => choose(element.value) });
  for (const option of options) {
    element.append(h("option", { value: option.value, selected: option.value === value }, cut(option.text, 70)));
  }
  return h("label", { class: "field" }, h("span", {}, label), element);
}

/** Offers a file for saving. */
export function save(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
