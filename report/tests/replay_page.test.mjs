// The replay as a reader uses it. The figures expected are computed here from the report's JSON.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { start_browser } from "./browser.mjs";
import { base64, f32, note_strokes, open_replay, run_of, sample, scrub, tick_of, u16, u8 } from "./replay_helpers.mjs";

let browser;
before(async () => (browser = await start_browser()));
after(async () => browser.close());

const planar = "#view=replay&scenario=planar_7r";
const puma = "#view=replay&scenario=puma560_ellipsoid";

/** Index of the smallest, or with -1 the largest, finite value from an index on. */
function least(values, from = 0, sign = 1) {
  let best = -1;
  for (let i = from; i < values.length; ++i)
    if (Number.isFinite(values[i]) && (best < 0 || sign * values[i] < sign * values[best])) best = i;
  return best;
}

const moment = (page, key, row = 0) => page.locator(".replay-moments").nth(row).locator(`[data-moment="${key}"]`);

test("play advances to the end and stops, and the address follows without new history", async () => {
  const { page, errors, close } = await open_replay(browser, sample(), `${planar}&method=bqsa&tick=380`, {
    init: note_strokes,
  });
  const entries = await page.evaluate(() => history.length);
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForFunction(() => document.querySelector('.replay input[type="range"]').value === "400");
  await page.getByRole("button", { name: "Play" }).waitFor();
  await page.waitForFunction(() => location.hash.includes("tick=400"));
  assert.ok((await page.evaluate(() => window.noted.pictures)) > 2, "the arm was drawn on the way");
  assert.equal(await page.evaluate(() => history.length), entries);
  assert.deepEqual(await errors(), []);
  await close();
});

test("a deep link restores scenario, methods and tick, and so does the address that the page writes", async () => {
  const { page, close } = await open_replay(browser, sample(), `${planar}&method=none&against=bqsa&tick=164`);
  const check = async (tick) => {
    assert.equal(await tick_of(page), tick);
    assert.equal(await page.getByLabel("Scenario").inputValue(), "planar_7r");
    assert.equal(await page.getByLabel("Method").inputValue(), "none");
    assert.equal(await page.getByLabel("Beside it").inputValue(), "bqsa");
  };
  await check(164);
  await scrub(page, 211);
  await page.waitForFunction(() => location.hash.includes("tick=211"));
  const address = page.url();
  await page.goto("about:blank");
  await page.goto(address);
  await page.waitForSelector(".replay");
  await check(211);
  await close();
});

test("a page opened without a choice makes one and names it in the address", async () => {
  const { page, close } = await open_replay(browser, sample(), "#view=replay");
  await scrub(page, 5);
  await page.waitForFunction(
    () =>
      /scenario=[^&]+/.test(location.hash) && /method=[^&]+/.test(location.hash) && location.hash.includes("tick=5"),
  );
  await close();
});

test("scrubbing shows the figures of the tick, of both runs on one clock", async () => {
  const report = sample();
  const { page, errors, close } = await open_replay(
    browser,
    report,
    `${planar}&method=none&against=weighted_least_norm`,
  );
  assert.equal(await page.locator(".replay-pane").count(), 2);
  const runs = ["none", "weighted_least_norm"].map((variant) => run_of(report, "planar_7r", variant));
  const rows = runs.map(({ replay }) => replay.rows);
  assert.ok(rows[1] < rows[0], "one of them gave up");
  for (const tick of [100, rows[1] - 1, rows[0] - 1]) {
    await scrub(page, tick);
    for (const [i, { replay, scenario }] of runs.entries()) {
      const row = Math.min(tick, replay.rows - 1);
      const text = await page.locator(".replay-now").nth(i).innerText();
      assert.match(text, new RegExp(`tick ${row}\\b`));
      assert.equal(/ended here/.test(text), tick > row);
      const clearance = f32(replay.clearance_m)[row] * 1e3;
      const [, sign, digits, unit] = /clearance\s+(−?)([\d.]+) (mm|µm|nm)/.exec(text);
      const shown = (sign ? -1 : 1) * Number(digits) * { mm: 1, µm: 1e-3, nm: 1e-6 }[unit];
      assert.ok(
        Math.abs(shown - clearance) <= 0.006 * Math.abs(clearance),
        `clearance at ${tick}: ${shown} mm, expected ${clearance} mm`,
      );
      assert.ok(
        text.includes(`link ${u8(replay.near_link)[row]}, ${scenario.obstacles[u16(replay.near_obstacle)[row]]}`),
      );
    }
  }
  assert.deepEqual(await errors(), []);
  await close();
});

test("the tip error at tick 0 is called the start's", async () => {
  const { page, close } = await open_replay(browser, sample(), `${planar}&method=bqsa&tick=0`);
  const names = () => page.locator(".replay-now dt").allTextContents();
  assert.ok((await names()).includes("start error") && !(await names()).includes("tip error"));
  await scrub(page, 1);
  assert.ok((await names()).includes("tip error") && !(await names()).includes("start error"));
  await close();
});

test("a scenario that was edited and run again is shown beside the one before, and each can be chosen", async () => {
  const report = sample();
  const first = report.scenarios.findIndex((scenario) => scenario.name === "planar_7r");
  const { run } = run_of(report, "planar_7r", "none");
  const again = report.scenarios.length;
  report.scenarios.push({ ...structuredClone(report.scenarios[first]), sha256: `fedcba98${"0".repeat(56)}` });
  report.runs.push({ ...structuredClone(run), scenario: again, record: "again:1" });
  const { page, errors, close } = await open_replay(browser, report, `${planar}&method=none&tick=3`);
  const keys = [`planar_7r@${report.scenarios[first].sha256.slice(0, 8)}`, "planar_7r@fedcba98"];
  const methods = () => page.getByLabel("Method").locator("option").count();
  assert.equal(await page.getByLabel("Scenario").inputValue(), keys[1], "of a plain name the last");
  assert.equal(await methods(), 1);
  await page.getByLabel("Scenario").selectOption(keys[0]);
  assert.ok((await methods()) > 1);
  await scrub(page, 7);
  await page.waitForFunction((key) => new URLSearchParams(location.hash.slice(1)).get("scenario") === key, keys[0]);
  assert.equal(await page.getByLabel("Scenario").inputValue(), keys[0]);
  await page.getByLabel("Scenario").selectOption(keys[1]);
  assert.equal(await methods(), 1);
  assert.deepEqual(await errors(), []);
  await close();
});

test("buttons go to the moments that the data have", async () => {
  const report = sample();
  for (const [scenario, variant] of [
    ["planar_7r", "none"],
    ["planar_7r", "bqsa"],
    ["planar_7r", "weighted_least_norm"],
    ["puma560_ellipsoid", "none"],
  ]) {
    const { run, replay } = run_of(report, scenario, variant);
    const expected = {
      contact: run.contacts.length > 0 ? Math.min(...run.contacts.map((c) => c.first_tick)) : null,
      error: least(f32(replay.tip_error_m), 1, -1),
      clearance: least(f32(replay.clearance_m)),
      slow: run.step_max_s === null ? null : run.step_max_tick,
      end: replay.rows - 1,
    };
    const { page, close } = await open_replay(browser, report, `#view=replay&scenario=${scenario}&method=${variant}`);
    for (const [key, tick] of Object.entries(expected)) {
      assert.equal(await moment(page, key).isDisabled(), tick === null, `${scenario}, ${variant}, ${key}`);
      if (tick === null) continue;
      await moment(page, key).click();
      const shown = await tick_of(page);
      if (key === "error")
        assert.equal(f32(replay.tip_error_m)[shown], f32(replay.tip_error_m)[tick], `${scenario}, ${variant}, ${key}`);
      else assert.equal(shown, tick, `${scenario}, ${variant}, ${key}`);
    }
    await close();
  }
});

test("the keyboard plays, steps, jumps and changes the speed, but not while another control has the focus", async () => {
  const report = sample();
  const { page, close } = await open_replay(browser, report, `${planar}&method=none&tick=50`);
  const press = async (key, tick) => {
    await page.keyboard.press(key);
    assert.equal(await tick_of(page), tick, key);
  };
  await press("ArrowRight", 51);
  await press("ArrowLeft", 50);
  await press("Shift+ArrowRight", 60);
  await press("Shift+ArrowLeft", 50);
  await press("End", 400);
  await press("Home", 0);
  const { run, replay } = run_of(report, "planar_7r", "none");
  const moments = [
    ...run.contacts.map((c) => c.first_tick).slice(0, 1),
    run.tip_error_max_tick,
    least(f32(replay.clearance_m)),
    400,
  ].sort((a, b) => a - b);
  for (const tick of new Set(moments)) await press("j", tick);
  await press("k", [...new Set(moments)].at(-2));
  const speed = page.getByLabel("Speed");
  await page.keyboard.press("]");
  assert.equal(await speed.inputValue(), "2");
  await page.keyboard.press("[");
  await page.keyboard.press("[");
  assert.equal(await speed.inputValue(), "0.5");
  await page.keyboard.press("Home");
  await page.keyboard.press("Space");
  await page.getByRole("button", { name: "Pause" }).waitFor();
  await page.waitForFunction(() => Number(document.querySelector('.replay input[type="range"]').value) > 2);
  await page.keyboard.press("Space");
  await page.getByRole("button", { name: "Play" }).waitFor();
  const stopped = await tick_of(page);
  await speed.focus();
  await press("End", stopped);
  await page.getByRole("tab", { name: "Replay" }).focus();
  await page.keyboard.press("Shift+ArrowRight");
  await page.locator('.replay input[type="range"]').first().waitFor({ state: "detached" });
  await close();
});

test("links have the colour of the data's category, in equal units, and a cross where they hit", async () => {
  const report = sample();
  const colors = { 1: "#56b4e9", 2: "#0072b2", 3: "#e69f00", 4: "#d55e00", 5: "#a0206a" };
  const met = new Set();
  for (const variant of ["none", "weighted_least_norm"]) {
    const { replay, scenario } = run_of(report, "planar_7r", variant);
    const { points: P, links } = scenario.scene;
    const [points, category] = [f32(replay.points), u8(replay.category)];
    const { page, close } = await open_replay(browser, report, `${planar}&method=${variant}`, { init: note_strokes });
    for (let row = 0; row < replay.rows; row += 9) {
      const pictures = await page.evaluate(() => window.noted.pictures);
      if (row > 0) {
        await scrub(page, row);
        await page.waitForFunction((count) => window.noted.pictures > count, pictures);
      } else await page.waitForFunction(() => window.noted.pictures > 0);
      const strokes = await page.evaluate(() => window.noted.strokes);
      const drawn = strokes.filter((stroke) => stroke.cap === "round" && Object.values(colors).includes(stroke.color));
      assert.equal(drawn.length, links.length, `links at tick ${row}`);
      let scale = null;
      drawn.forEach((stroke, l) => {
        const expected = category[row * links.length + l];
        assert.equal(stroke.color, colors[expected], `${variant}, tick ${row}, link ${links[l].number}`);
        met.add(expected);
        const at = (point, k) => points[3 * (row * P + point) + k];
        const world = [0, 1].map((k) => at(links[l].end, k) - at(links[l].start, k));
        const screen = [stroke.to[0] - stroke.from[0], -(stroke.to[1] - stroke.from[1])];
        scale ??= Math.hypot(...screen) / Math.hypot(...world);
        for (const k of [0, 1])
          assert.ok(
            Math.abs(screen[k] - scale * world[k]) < 0.05,
            `direction of link ${links[l].number} at tick ${row}`,
          );
      });
      const hits = category
        .subarray(row * links.length, (row + 1) * links.length)
        .filter((c) => c >= 3 && c <= 5).length;
      const text = await page.locator(".replay-now").innerText();
      assert.equal((text.match(/✕/g) ?? []).length > 0, hits > 0 || f32(replay.clearance_m)[row] <= 0, `tick ${row}`);
    }
    await close();
  }
  for (const category of [1, 2, 3, 4]) assert.ok(met.has(category), `category ${category} was met`);
});

test("an obstacle that moves is drawn where it is at the tick, one at rest stays", async () => {
  const report = sample();
  const scenario = report.scenarios.find((s) => s.dimension === 2 && s.scene.obstacles.some((o) => o.motion !== null));
  const moving = scenario.scene.obstacles.findIndex((o) => o.motion !== null);
  const obstacle = scenario.scene.obstacles[moving];
  const motion = f32(obstacle.motion);
  scenario.scene.obstacles.push({ ...obstacle, name: "at rest", motion: null });
  const resting = scenario.scene.obstacles.length - 1;
  const { page, close } = await open_replay(browser, report, `#view=replay&scenario=${scenario.name}&method=none`, {
    init: note_strokes,
  });
  const place = async (tick) => {
    const pictures = await page.evaluate(() => window.noted.pictures);
    await scrub(page, tick);
    await page.waitForFunction((count) => window.noted.pictures > count, pictures);
    return page.evaluate(() => window.noted.ellipses);
  };
  const [start, later] = [await place(1), await place(120)];
  const scale = start[moving].a / obstacle.semi_axes_m[0];
  const by = [3, 7].map((k) => motion[12 * 120 + k] - motion[12 + k]);
  assert.ok(Math.hypot(...by) > 0.05, "the obstacle moves at all");
  assert.ok(Math.abs(later[moving].x - start[moving].x - by[0] * scale) < 0.01);
  assert.ok(Math.abs(later[moving].y - start[moving].y + by[1] * scale) < 0.01);
  assert.deepEqual(later[resting], start[resting]);
  assert.ok(Math.abs(start[moving].b / obstacle.semi_axes_m[1] - scale) < 1e-6 * scale, "equal units");
  const turn = Math.atan2(motion[12 * 120 + 4], motion[12 * 120]);
  assert.ok(Math.abs(Math.sin(later[moving].turn + turn)) < 1e-6, "turned as it is");
  await close();
});

test("a link with a thickness is drawn with it, and in contact when its surface is", async () => {
  const report = sample();
  const { replay, scenario } = run_of(report, "thick_planar", "none");
  const L = scenario.scene.links.length;
  const [category, clearance] = [u8(replay.category), f32(replay.clearance_m)];
  const { page, close } = await open_replay(browser, report, "#view=replay&scenario=thick_planar&method=none", {
    init: note_strokes,
  });
  const met = { free: 0, surface: 0, line: 0 };
  for (let row = 100; row < replay.rows; row += 5) {
    const pictures = await page.evaluate(() => window.noted.pictures);
    await scrub(page, row);
    await page.waitForFunction((count) => window.noted.pictures > count, pictures);
    const text = await page.locator(".replay-now").innerText();
    const line = category.subarray(row * L, (row + 1) * L).some((c) => c >= 3 && c <= 5);
    assert.equal(text.includes("✕"), clearance[row] <= 0, `tick ${row}, clearance ${clearance[row]}`);
    ++met[clearance[row] > 0 ? "free" : line ? "line" : "surface"];
  }
  for (const [what, count] of Object.entries(met)) assert.ok(count > 2, `${what} was met ${count} times`);
  const strokes = (await page.evaluate(() => window.noted.strokes)).filter((stroke) => stroke.cap === "round");
  const points = f32(replay.points);
  const P = scenario.scene.points;
  const row = await tick_of(page);
  const [{ start, end }] = scenario.scene.links;
  const length = Math.hypot(...[0, 1].map((k) => points[3 * (row * P + end) + k] - points[3 * (row * P + start) + k]));
  const scale = Math.hypot(strokes[0].to[0] - strokes[0].from[0], strokes[0].to[1] - strokes[0].from[1]) / length;
  assert.ok(Math.abs(strokes[0].width - 2 * scenario.link_radius_m * scale) < 0.1);
  await close();
});

test("in the plane a drag moves the picture, and the wheel zooms about the pointer once it has been clicked", async () => {
  const { page, close } = await open_replay(browser, sample(), `${planar}&method=none`, { init: note_strokes });
  await page.waitForFunction(() => window.noted.pictures > 0);
  const links = async (action) => {
    const pictures = await page.evaluate(() => window.noted.pictures);
    await action();
    await page.waitForFunction((count) => window.noted.pictures > count, pictures);
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    const strokes = await page.evaluate(() => window.noted.strokes);
    return strokes.filter((stroke) => stroke.cap === "round").map((stroke) => stroke.from);
  };
  const stage = await page.locator(".stage").boundingBox();
  const [x, y] = [stage.x + 400, stage.y + 200];
  const first = await links(() => scrub(page, 1));
  await page.mouse.move(x, y);
  await page.mouse.wheel(0, 60);
  await page.waitForFunction(() => window.scrollY > 0);
  assert.deepEqual(await links(() => scrub(page, 2).then(() => scrub(page, 1))), first, "the wheel scrolls the page");
  await page.evaluate(() => window.scrollTo(0, 0));
  const dragged = await links(async () => {
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 60, y + 25, { steps: 4 });
    await page.mouse.up();
  });
  first.forEach(([a, b], i) => {
    assert.ok(
      Math.abs(dragged[i][0] - a - 60) < 1e-6 && Math.abs(dragged[i][1] - b - 25) < 1e-6,
      `point ${i} is dragged along`,
    );
  });
  const zoomed = await links(() => page.mouse.wheel(0, -400));
  const [px, py] = [x + 60 - stage.x, y + 25 - stage.y];
  const factor = (zoomed[0][0] - px) / (dragged[0][0] - px);
  assert.ok(factor > 1.2, `larger by ${factor}`);
  dragged.forEach(([a, b], i) => {
    const expected = [px + factor * (a - px), py + factor * (b - py)];
    assert.ok(
      Math.hypot(zoomed[i][0] - expected[0], zoomed[i][1] - expected[1]) < 2,
      `point ${i} moves away from the pointer`,
    );
  });
  const whole = await links(() => page.getByRole("button", { name: "Back to the first view" }).click());
  first.forEach(([a, b], i) => assert.ok(Math.hypot(whole[i][0] - a, whole[i][1] - b) < 1e-6));
  await close();
});

test("the criteria in words are of the category that the data have, for every link", async () => {
  const names = { 1: "no collision 1", 2: "no collision 2", 3: "crossing", 4: "one end inside", 5: "contained" };
  const report = sample();
  const met = new Set();
  const moves = (s) => s.scene.obstacles.some((obstacle) => obstacle.motion !== null);
  for (const name of ["planar_7r", ...report.scenarios.filter(moves).map((s) => s.name)]) {
    const { replay, scenario } = run_of(report, name, "none");
    const { links, obstacles } = scenario.scene;
    const [category, nearest] = [u8(replay.category), u16(replay.category_obstacle)];
    const { page, close } = await open_replay(browser, report, `#view=replay&scenario=${name}&method=none`);
    for (const row of [70, 100, 140, 180, 350].filter((tick) => tick < replay.rows)) {
      await scrub(page, row);
      for (const [l, link] of links.entries()) {
        const cell = row * links.length + l;
        await page
          .locator("label", { hasText: /^Link/ })
          .locator("select")
          .selectOption({ value: String(l) });
        await page
          .locator("label", { hasText: /^Obstacle/ })
          .locator("select")
          .selectOption({ value: String(nearest[cell]) });
        const text = await page.locator(".replay-criteria-now").first().innerText();
        assert.ok(text.includes(`: ${names[category[cell]]} (`), `tick ${row}, link ${link.number}: ${text}`);
        const title = await page.locator(".replay-chart figcaption").last().innerText();
        assert.ok(title.includes(`link ${link.number} and ${obstacles[nearest[cell]].name}`));
        met.add(category[cell]);
      }
    }
    await close();
  }
  assert.ok(met.size >= 4, `categories met: ${[...met]}`);
});

test("a click on a chart moves the clock, and the cursor is at the tick", async () => {
  const { page, close } = await open_replay(browser, sample(), `${planar}&method=none&tick=100`);
  const chart = page.locator(".replay-chart").first();
  await chart.scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelectorAll(".replay-chart svg path").length > 4);
  const cursor = async () => {
    const box = await chart.locator(".replay-cursor").boundingBox();
    return box.x + box.width / 2;
  };
  const at_100 = await cursor();
  await page.keyboard.press("Shift+ArrowRight");
  const at_110 = await cursor();
  const box = await chart.locator(".chart-canvas").boundingBox();
  await page.mouse.click(at_100 + 8 * (at_110 - at_100), box.y + box.height / 2);
  assert.ok(Math.abs((await tick_of(page)) - 180) <= 1);
  await page.mouse.move(at_100, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(at_110, box.y + box.height / 2, { steps: 3 });
  await page.mouse.up();
  assert.ok(Math.abs((await tick_of(page)) - 110) <= 1);
  await close();
});

test("the cursor stands where the curves have the tick, in every chart", async () => {
  const { page, close } = await open_replay(browser, sample(), `${planar}&method=none&tick=0`);
  await page.waitForFunction(() => document.querySelectorAll(".replay-chart svg").length === 4);
  const error = 1; // this chart begins at tick 1
  for (const [tick, side, of] of [
    [0, "left", (i) => i !== error],
    [1, "left", (i) => i === error],
    [400, "right", () => true],
  ]) {
    await scrub(page, tick);
    const found = await page.locator(".replay-chart").evaluateAll(
      (charts, side) =>
        charts.map((chart) => {
          const cursor = chart.querySelector(".replay-cursor").getBoundingClientRect();
          const curves = [...chart.querySelectorAll('svg path[fill="none"]')].map((path) =>
            path.getBoundingClientRect(),
          );
          const widest = curves.reduce((a, b) => (b.width > a.width && b.height > 3 ? b : a), { width: 0 });
          return { cursor: (cursor.left + cursor.right) / 2, curve: widest[side] };
        }),
      side,
    );
    assert.equal(found.length, 4);
    for (const [i, { cursor, curve }] of found.entries()) {
      if (!of(i)) continue;
      assert.ok(Math.abs(cursor - curve) < 1.5, `chart ${i}, tick ${tick}: cursor at ${cursor}, curve at ${curve}`);
    }
  }
  await close();
});

/** Pixels of the stage that are not its background, by copying the drawing just after it is made. */
const drawn_pixels = (page) =>
  page.evaluate(
    () =>
      new Promise((done) => {
        const scrubber = document.querySelector('.replay input[type="range"]');
        scrubber.value = String(Number(scrubber.value) + (scrubber.value === scrubber.max ? -1 : 1));
        scrubber.dispatchEvent(new Event("input", { bubbles: true }));
        requestAnimationFrame(() => {
          const source = document.querySelector(".stage > canvas");
          const copy = new OffscreenCanvas(source.width, source.height).getContext("2d");
          copy.drawImage(source, 0, 0);
          const { data } = copy.getImageData(0, 0, source.width, source.height);
          let count = 0;
          for (let i = 3; i < data.length; i += 4) if (data[i] > 0) ++count;
          done(count);
        });
      }),
  );

test("in space the arm is drawn, of both runs", async () => {
  const { page, errors, close } = await open_replay(browser, sample(), `${puma}&method=none&against=bqsa&tick=100`);
  await page.waitForFunction(() => document.querySelector(".stage > canvas").width > 600);
  assert.ok((await drawn_pixels(page)) > 5000);
  assert.equal(await page.locator(".replay-pane").count(), 2);
  assert.deepEqual(await errors(), []);
  await close();
});

test("in space a drag turns the picture", async () => {
  const { page, errors, close } = await open_replay(browser, sample(), `${puma}&method=none&tick=100`);
  await page.waitForFunction(() => document.querySelector(".stage > canvas").width > 600);
  const stage = await page.locator(".stage").boundingBox();
  const picture = () =>
    page
      .locator(".stage")
      .screenshot()
      .then((image) => image.toString("base64"));
  await page.waitForTimeout(600);
  const [first, again] = [await picture(), await picture()];
  assert.equal(again, first, "nothing moves by itself");
  await page.mouse.move(stage.x + 300, stage.y + 200);
  await page.mouse.down();
  await page.mouse.move(stage.x + 420, stage.y + 200, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(600);
  assert.notEqual(await picture(), first);
  assert.deepEqual(await errors(), []);
  await close();
});

const without_webgl = () => {
  const original = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
    return /webgl/.test(kind) ? null : original.call(this, kind, ...more);
  };
};

test("without WebGL a message stands in for the arm in space, and all else works", async () => {
  const { page, errors, close } = await open_replay(browser, sample(), `${puma}&method=none`, { init: without_webgl });
  await page.getByText("offers no WebGL").waitFor();
  await page.waitForFunction(() => document.querySelectorAll(".replay-chart svg").length === 4);
  await page.keyboard.press("Shift+ArrowRight");
  assert.equal(await tick_of(page), 10);
  assert.match(await page.locator(".replay-now").innerText(), /tick 10\b/);
  assert.deepEqual(await errors(), []);
  await close();
});

test("without WebGL the arm in the plane is drawn as ever", async () => {
  const { page, errors, close } = await open_replay(browser, sample(), `${planar}&method=none`, {
    init: without_webgl,
  });
  await page.waitForFunction(() => document.querySelector(".stage > canvas").width > 600);
  assert.ok((await drawn_pixels(page)) > 5000);
  assert.equal(await page.getByText("offers no WebGL").count(), 0);
  assert.deepEqual(await errors(), []);
  await close();
});

test("runs that cannot be watched say why", async () => {
  const report = sample();
  const none = run_of(report, "planar_7r", "none");
  const bqsa = run_of(report, "planar_7r", "bqsa");
  Object.assign(none.run, {
    replay: null,
    no_replay: "left out to keep the page small",
    success: false,
    failures: ["crashed"],
    claimed: "crashed",
    claim_detail: "signal 11",
  });
  Object.assign(run_of(report, "planar_7r", "weighted_least_norm").run, {
    applicable: false,
    why_not: "needs a spatial problem",
    replay: null,
  });
  let opened = await open_replay(browser, report, `${planar}&method=none&against=weighted_least_norm`);
  await opened.page.getByText("left out to keep the page small").waitFor();
  await opened.page.locator(".replay-pane").getByText("needs a spatial problem").waitFor();
  await opened.page.getByText("signal 11").waitFor();
  assert.equal(await opened.page.locator(".replay-chart").count(), 0);
  await opened.close();

  opened = await open_replay(browser, report, `${planar}&method=bqsa&against=none&tick=30`);
  assert.equal(await tick_of(opened.page), 30);
  await opened.page.getByText("left out to keep the page small").waitFor();
  assert.deepEqual(await opened.errors(), []);
  await opened.close();

  Object.assign(bqsa.scenario, { scene: null, scene_missing: "the scenario file has changed since" });
  opened = await open_replay(browser, report, `${planar}&method=bqsa`);
  await opened.page.getByText("the scenario file has changed since").first().waitFor();
  assert.deepEqual(await opened.errors(), []);
  await opened.close();
});

test("rows that are not finite are left out of the picture and the charts", async () => {
  const report = sample();
  for (const [scenario, fragment] of [
    ["planar_7r", planar],
    ["puma560_ellipsoid", puma],
  ]) {
    const { replay } = run_of(report, scenario, "none");
    for (const key of ["points", "q", "tip_error_m", "clearance_m"]) {
      const values = f32(replay[key]);
      values.fill(NaN, Math.floor(values.length / 2));
      replay[key] = base64(values);
    }
    const { page, errors, close } = await open_replay(browser, report, `${fragment}&method=none&tick=10`);
    await page.waitForFunction(() => document.querySelectorAll(".replay-chart svg").length === 4);
    await page.keyboard.press("End");
    assert.ok((await drawn_pixels(page)) > 1000);
    assert.deepEqual(await errors(), []);
    await close();
  }
});

test("names that would be HTML stay text, and long ones do not widen the page", async () => {
  const report = sample();
  const bad = `</script><img src=x onerror="window.hacked=1"><b>{a|b}</b>\u{1F916}"'&`;
  const { scenario, run } = run_of(report, "planar_7r", "none");
  const method = report.methods[run.method];
  method.variant = bad + "x".repeat(10_000);
  method.changed = bad;
  scenario.name = bad + "y".repeat(10_000);
  scenario.obstacles = scenario.obstacles.map((name) => bad + name);
  for (const obstacle of scenario.scene.obstacles) obstacle.name = bad + obstacle.name;
  for (const contact of run.contacts) contact.obstacle = bad + contact.obstacle;
  run.claim_detail = bad + "z".repeat(10_000);
  const query = new URLSearchParams({ view: "replay", scenario: scenario.name, method: method.variant });
  const { page, errors, close } = await open_replay(browser, report, `#${query}`);
  await page.waitForFunction(() => document.querySelectorAll(".replay-chart svg").length === 4);
  await page.mouse.move(400, 700);
  const chart = await page.locator(".replay-chart .chart-canvas").first().boundingBox();
  await page.locator(".replay-chart").first().scrollIntoViewIfNeeded();
  await page.mouse.move(chart.x + 200, 500);
  assert.equal(await page.evaluate(() => window.hacked), undefined);
  assert.equal(await page.locator(".replay img, .replay-card b").count(), 0);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
  assert.deepEqual(await errors(), []);
  await close();
});

/** Runs in the page: keeps what getContext gives for drawing in space. */
const keep_contexts = () => {
  window.contexts = [];
  const original = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
    const context = original.call(this, kind, ...more);
    if (/webgl/.test(kind) && context) window.contexts.push(context);
    return context;
  };
};

test("leaving the view leaves nothing behind, however often", async () => {
  const { page, errors, close } = await open_replay(browser, sample(), `${puma}&method=none&tick=345`, {
    init: keep_contexts,
  });
  for (let i = 0; i < 4; ++i) {
    await page.getByRole("tab", { name: "Claims" }).click();
    await page.getByRole("tab", { name: "Replay" }).click();
  }
  await page.waitForFunction(() => document.querySelector(".stage > canvas").width > 600);
  assert.equal(await tick_of(page), 345);
  await page.getByRole("button", { name: "Play" }).click();
  await page.getByRole("tab", { name: "Claims" }).click();
  const address = page.url();
  const contexts = await page.evaluate(() => window.contexts.map((context) => context.isContextLost()));
  assert.ok(contexts.length >= 5);
  assert.ok(
    contexts.every((lost) => lost),
    "all drawings in space are given back",
  );
  const taken = await page.evaluate(
    () => !document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "End", bubbles: true, cancelable: true })),
  );
  assert.equal(taken, false, "the keys of the replay are no longer its own");
  await page.waitForTimeout(1000);
  assert.equal(page.url(), address, "the clock stands");
  assert.deepEqual(await errors(), []);
  await close();
});

test("with reduced motion nothing starts by itself, and ghosts show the run", async () => {
  const { page, close } = await open_replay(browser, sample(), `${planar}&method=none`, { reducedMotion: "reduce" });
  assert.equal(
    await page.getByRole("button", { name: "Postures spread over the whole run" }).getAttribute("aria-pressed"),
    "true",
  );
  assert.equal(await tick_of(page), 0);
  await close();
});

test("on a phone the page is as wide as the screen, and panes stand one above the other", async () => {
  const { page, errors, close } = await open_replay(browser, sample(), `${puma}&method=none&against=bqsa`, {
    viewport: { width: 390, height: 844 },
    hasTouch: true,
    isMobile: true,
  });
  await page.waitForFunction(() => document.querySelectorAll(".replay-chart svg").length === 4);
  const panes = await Promise.all([0, 1].map((i) => page.locator(".replay-pane").nth(i).boundingBox()));
  assert.ok(panes[1].y >= panes[0].y + panes[0].height - 1);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
  assert.deepEqual(await errors(), []);
  await close();
});
