// What the tests of the replay look at: the data in the page that replay_reports.sh makes, and the page itself.
import { data_of, page_file } from "./browser.mjs";

/** The report with the runs of the tests. */
export const sample = () => data_of(page_file("replay"));

const bytes = (text) => Uint8Array.from(Buffer.from(text, "base64"));
export const u8 = (text) => bytes(text);
export const u16 = (text) => new Uint16Array(bytes(text).buffer);
export const f32 = (text) => new Float32Array(bytes(text).buffer);
export const base64 = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString("base64");

/** The run of a variant on a scenario, with its scenario and replay. */
export function run_of(report, scenario_name, variant) {
  const s = report.scenarios.findIndex((scenario) => scenario.name === scenario_name);
  const m = report.methods.findIndex((method) => method.variant === variant);
  const run = report.runs.find((candidate) => candidate.scenario === s && candidate.method === m);
  if (!run) throw new Error(`the sample has no run of ${variant} on ${scenario_name}`);
  return { run, scenario: report.scenarios[s], replay: run.replay === null ? null : report.replays[run.replay] };
}

/** Opens a page of data at a fragment. `init` runs in it before its own scripts. */
export async function open_replay(browser, report, fragment, { init, ...options } = {}) {
  const { page, problems, close } = await browser.open(browser.write(report), fragment, options);
  if (init) {
    await page.addInitScript(init);
    await page.reload();
  }
  await page.waitForSelector(".replay");
  /** What went wrong; that reading pixels back from a drawing is slow is known. */
  const errors = async () => (await problems()).filter((problem) => !/GPU stall due to ReadPixels/.test(problem));
  return { page, errors, close };
}

/** The tick that the page shows. */
export const tick_of = (page) => page.locator('.replay input[type="range"]').inputValue().then(Number);

/** Moves the scrubber as a hand would. */
export const scrub = (page, tick) =>
  page.locator('.replay input[type="range"]').evaluate((element, value) => {
    element.value = String(value);
    element.dispatchEvent(new Event("input", { bubbles: true }));
  }, tick);

/** Runs in the page: notes the straight strokes and the ellipses of the last picture of each canvas. */
export function note_strokes() {
  const prototype = CanvasRenderingContext2D.prototype;
  const noted = { strokes: [], ellipses: [], pictures: 0 };
  window.noted = noted;
  let path = [];
  const wrap = (name, before) => {
    const original = prototype[name];
    prototype[name] = function (...values) {
      before.call(this, ...values);
      return original.apply(this, values);
    };
  };
  wrap("clearRect", () => {
    noted.strokes = [];
    noted.ellipses = [];
    ++noted.pictures;
  });
  wrap("beginPath", () => (path = []));
  wrap("moveTo", (x, y) => path.push([x, y]));
  wrap("lineTo", (x, y) => path.push([x, y]));
  wrap("ellipse", (x, y, a, b, turn) => noted.ellipses.push({ x, y, a, b, turn }));
  wrap("stroke", function () {
    if (path.length === 2)
      noted.strokes.push({
        color: this.strokeStyle,
        cap: this.lineCap,
        width: this.lineWidth,
        from: path[0],
        to: path[1],
      });
  });
}
