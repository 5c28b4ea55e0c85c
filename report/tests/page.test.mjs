// The page as a reader uses it, in a real browser, on pages that the program made. What is expected is computed
// here from the data in the page.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { data_of, kTemplate, page_file, start_browser } from "./browser.mjs";

let browser;
before(async () => (browser = await start_browser()));
after(async () => browser.close());

const paper_file = page_file("paper");
const paper = data_of(paper_file);
const odd_file = page_file("odd");
const odd = data_of(odd_file);
const big_file = page_file("big");
const big = data_of(big_file);
const robots_file = page_file("robots");
const robots = data_of(robots_file);
const solids_file = page_file("solids");
const solids = data_of(solids_file);

const kViews = ["summary", "scaling", "replay", "claims", "trade-offs", "provenance"];
const run_of = (data, scenario, variant) =>
  data.runs.find(
    (run) => data.scenarios[run.scenario].name === scenario && data.methods[run.method].variant === variant,
  );
const texts = (locator) => locator.evaluateAll((elements) => elements.map((element) => element.textContent));
const cell_of = (page, data, scenario, variant) => {
  const column = data.scenarios.findIndex((s) => s.name === scenario);
  const row = data.methods.findIndex((m) => m.variant === variant);
  return page.locator("#matrix tbody tr").nth(row).locator("td").nth(column);
};

/** Goes over the symbols of the first chart; how many of them tell a figure. */
async function tooltips_of(page) {
  const chart = page.locator(".chart-canvas").first();
  const symbols = await chart.locator("svg path").evaluateAll((paths) =>
    paths
      .map((path) => path.getBoundingClientRect())
      .filter((box) => box.width > 3 && box.width < 20 && box.height > 3 && box.height < 20)
      .map((box) => [box.x + box.width / 2, box.y + box.height / 2]),
  );
  let told = 0;
  for (const [x, y] of symbols.slice(0, 40)) {
    await page.mouse.move(x, y);
    if (/: [\d.]+ (ns|µs|ms|nm|µm|mm)/.test(await chart.evaluate((element) => element.textContent))) told += 1;
  }
  return told;
}

test("every view opens from a file with no request, no error and nothing against its policy", async () => {
  for (const view of kViews) {
    const { page, problems, close } = await browser.open(paper_file, `#view=${view}`);
    assert.equal(await page.locator('[role="tab"][aria-selected="true"]').getAttribute("id"), `tab-${view}`);
    assert.equal(await page.locator("h1").textContent(), paper.title);
    assert.ok((await page.locator("#view").innerText()).length > 200, `${view} shows something`);
    assert.deepEqual(await problems(), []);
    await close();
  }
});

test("the policy in the page forbids every request", async () => {
  const { page, close } = await browser.open(paper_file);
  const violation = await page.evaluate(
    () =>
      new Promise((done) => {
        document.addEventListener("securitypolicyviolation", (event) => done(event.violatedDirective));
        fetch("https://example.invalid/").catch(() => setTimeout(() => done("none"), 500));
      }),
  );
  assert.equal(violation, "connect-src");
  await close();
});

test("the matrix has the judge's verdict for each pair, and leads to the tick where a failure shows", async () => {
  const { page, problems, close } = await browser.open(paper_file);
  const words = { collision: "collides", drift: "drifts", incomplete: "incomplete" };
  let failures = 0;
  for (const run of paper.runs) {
    const cell = cell_of(page, paper, paper.scenarios[run.scenario].name, paper.methods[run.method].variant);
    const text = await cell.innerText();
    const expected = !run.applicable
      ? "n/a"
      : run.success
        ? "success"
        : words[run.failures.find((failure) => failure !== "incomplete") ?? "incomplete"];
    assert.ok(text.includes(expected), `${run.record}: expected ${expected}, got ${text}`);
    assert.equal(/ a step|plan /.test(text), run.success, `${run.record}: a time only if it succeeds`);
    if (!run.applicable || run.success) continue;
    failures += 1;
    const [contact] = run.contacts;
    const reason = contact
      ? `link ${contact.link} in ${contact.obstacle}, tick ${contact.first_tick}`
      : run.failures.includes("drift")
        ? `at tick ${run.tip_error_max_tick}`
        : run.claim_detail;
    assert.ok(text.includes(reason), `${run.record}: expected ${reason}, got ${text}`);
  }
  assert.ok(failures > 3, "there are failures to look at");
  const none = run_of(paper, "planar_7r", "none");
  await cell_of(page, paper, "planar_7r", "none").locator("a").click();
  await page.waitForSelector("#tab-replay[aria-selected=true]");
  assert.match(page.url(), new RegExp(`scenario=planar_7r&method=none&tick=${none.failure_tick}$`));
  await page.goBack();
  await page.waitForSelector("#tab-summary[aria-selected=true]");
  assert.deepEqual(await problems(), []);
  await close();
});

test("the first line counts the verdicts, and leads to those runs", async () => {
  const { page, close } = await browser.open(odd_file);
  const judged = odd.runs.filter((run) => run.applicable);
  const facts = (await texts(page.locator(".glance li"))).map((text) => text.replace(/\s+/g, " "));
  const crashed = judged.filter((run) => run.claimed.startsWith("crashed")).length;
  const successes = judged.filter((run) => run.success).length;
  const lies = judged.filter((run) => !run.claim_holds).length;
  assert.deepEqual(facts, [
    `${successes} succeed`,
    `${judged.length - successes - crashed} fail`,
    `${crashed} crash or misbehave`,
    `${lies} wrong claims`,
    "1 pair does not fit (n/a)",
  ]);
  await page.locator(".glance a", { hasText: "wrong claims" }).click();
  assert.equal(await page.locator("#runs [role=status]").textContent(), `${lies} of ${odd.runs.length} runs`);
  await close();
});

test("a crash, a wrong claim, a pair that does not fit and repetitions are shown as such", async () => {
  const { page, problems, close } = await browser.open(odd_file);
  const text = (variant) => cell_of(page, odd, "puma560_wall", variant).innerText();
  assert.match(await text("crasher"), /crashed.*tick 50/s);
  assert.match(await text("still"), /drifts.*wrong claim/s);
  assert.match(await text("bqsa_paper"), /n\/a/);
  const plans = odd.runs.map((run) => run.plan_s).filter((value) => value !== null);
  const [, middle] = plans.sort((a, b) => a - b);
  const [, told] = /3 of 3\s+median plan ~?([\d.]+) ms/.exec(await cell_of(page, odd, "planar_7r", "ompl").innerText());
  assert.equal(plans.length, 3);
  assert.ok(Math.abs(Number(told) - 1e3 * middle) < 0.0051 * 1e3 * middle, `median of the plans, got ${told} ms`);
  assert.equal((await cell_of(page, odd, "puma560_wall", "ompl").innerText()).trim(), "–");
  const rows = page.locator("#runs tbody tr");
  const heads = await texts(page.locator("#runs thead th"));
  const time = heads.findIndex((head) => head.startsWith("Time per step"));
  for (let i = 0; i < odd.runs.length; ++i) {
    const cell = await rows.nth(i).locator("td").nth(time).innerText();
    assert.equal(cell === "–", !odd.runs[i].success, `${odd.runs[i].record}: time ${cell}`);
  }
  await page.locator("#runs tbody tr", { hasText: "crasher" }).first().getByRole("button").click();
  assert.match(await page.locator("#runs tr.details").innerText(), /killed by signal/);
  assert.deepEqual(await problems(), []);
  await close();
});

test("a run without a verdict is no wrong claim, alone or among repetitions", async () => {
  const data = structuredClone(odd);
  const undecided = { success: false, failures: ["disagreement"], disagreement: "far apart", claimed: "success" };
  const plans = data.runs.filter((run) => data.methods[run.method].variant === "ompl" && run.applicable);
  const bqsa = run_of(data, "planar_7r", "bqsa");
  for (const run of [plans[0], bqsa]) Object.assign(run, undecided, { claim_holds: false });
  const { page, problems, close } = await browser.open(browser.write(data));
  const repeated = await cell_of(page, data, "planar_7r", "ompl").innerText();
  assert.match(repeated, /2 of 3/);
  assert.doesNotMatch(repeated, /wrong claim/);
  const alone = await cell_of(page, data, "planar_7r", "bqsa").innerText();
  assert.match(alone, /no verdict/);
  assert.doesNotMatch(alone, /wrong claim/);
  const lies = odd.runs.filter((run) => run.applicable && !run.claim_holds).length;
  const facts = (await texts(page.locator(".glance li"))).map((text) => text.replace(/\s+/g, " "));
  assert.ok(facts.includes("2 without verdict") && facts.includes(`${lies} wrong claims`), facts.join("; "));
  assert.deepEqual(await problems(), []);
  await close();
});

test("all times that are only indicative or include a pipe are marked, and the marks have words", async () => {
  const data = structuredClone(paper);
  const bqsa = data.methods.findIndex((method) => method.variant === "bqsa");
  for (const run of data.runs) {
    run.times_indicative = run.method === bqsa ? ["something else ran"] : [];
    run.includes_pipe = run.method === bqsa;
  }
  data.methods[bqsa].external = true;
  for (const entry of data.summary) entry.times_publishable = entry.method !== bqsa;
  const { page, problems, close } = await browser.open(browser.write(data));
  const check = async (part, columns) => {
    const heads = (await texts(page.locator(`${part} thead th`))).map((head) => head.trim());
    const places = columns.map((column) => heads.findIndex((head) => head.toLowerCase().startsWith(column)));
    assert.ok(!places.includes(-1), `${columns.join(", ")} are among ${heads.join(", ")}`);
    const rows = await page
      .locator(`${part} tbody tr`)
      .evaluateAll((all) =>
        all.map((row) => [row.querySelector(".method strong")?.textContent, [...row.cells].map((c) => c.textContent)]),
      );
    let marked = 0;
    for (const [name, cells] of rows) {
      for (const place of places) {
        const text = cells[place];
        if (name === "bqsa" && text !== "–") marked += 1;
        assert.equal(text.includes("~⇄"), name === "bqsa" && text !== "–", `${part}, ${name}: ${text}`);
        assert.equal(/[~⇄]/.test(text), name === "bqsa" && text !== "–", `${part}, ${name}: ${text}`);
      }
    }
    assert.ok(marked >= columns.length, `${part}: ${marked} marked`);
  };
  await check("#methods", ["time per step", "p99", "slowest"]);
  await check("#runs", ["time per step", "p99", "slowest"]);
  await page.getByRole("tab", { name: "Trade-offs" }).click();
  const note = page.locator("#view p[role=status]");
  for (const scenario of ["", "planar_7r"]) {
    await page.locator("#view .filters select").first().selectOption(scenario);
    await check("#view section > .table", ["time per step, median", "time per step, p99"]);
    assert.match(await note.textContent(), /~ only indicative.*⇄ includes the pipe/);
  }
  const plain = await browser.open(
    browser.write({
      ...data,
      summary: data.summary.map((entry) => ({ ...entry, times_publishable: true })),
      methods: data.methods.map((method) => ({ ...method, external: false })),
    }),
    "#view=trade-offs",
  );
  assert.doesNotMatch(await plain.page.locator("#view p[role=status]").textContent(), /~|⇄/);
  await plain.close();
  assert.deepEqual(await problems(), []);
  await close();
});

test("methods are sorted by a click, those without the figure last either way, and the address keeps the order", async () => {
  const { page, close } = await browser.open(paper_file);
  const times = new Map(
    paper.summary
      .filter((entry) => entry.family === null && entry.step_median_s !== null)
      .map((entry) => [paper.methods[entry.method].variant, entry.step_median_s]),
  );
  const ascending = [...times.values()].sort((a, b) => a - b);
  const names = async () => (await texts(page.locator("#methods tbody .method strong"))).slice(0, times.size);
  const shown = async () => (await names()).map((name) => times.get(name)); // equal times in any order
  const head = page.locator("#methods thead th", { hasText: "Time per step" });
  await head.getByRole("button").click();
  assert.deepEqual(await shown(), ascending);
  assert.equal(await head.getAttribute("aria-sort"), "ascending");
  await head.getByRole("button").press("Enter");
  assert.deepEqual(await shown(), [...ascending].reverse());
  await page.waitForFunction(() => location.hash.includes("sort=methods.-time"));
  const before = await names();
  const address = page.url();
  await page.goto("about:blank");
  await page.goto(address);
  await page.waitForSelector("#methods tbody tr");
  assert.deepEqual(await names(), before);
  await close();
});

const kMarks = [
  ["best_rate", 1],
  ["best_tip_error", 4],
  ["best_step", 7],
];

test("what the program's statistics call best or tied is marked so, and nothing else", async () => {
  const words = new Set();
  for (const family of new Set(big.summary.map((entry) => entry.family))) {
    const { page, close } = await browser.open(big_file, family ? `#family=${family}` : "");
    const all = big.summary.filter((entry) => entry.family === family);
    for (const [key, column] of kMarks) {
      const best = all.filter((entry) => entry[key] === true);
      const word = best.length > 1 ? "tied" : "best";
      for (const entry of all) {
        const { variant } = big.methods[entry.method];
        const row = page.locator("#methods tbody tr").filter({ has: page.locator(`strong:text-is("${variant}")`) });
        const tags = await texts(row.locator("td").nth(column).locator(".best"));
        assert.deepEqual(tags, best.includes(entry) ? [word] : [], `${family}, ${variant}, ${key}`);
        tags.forEach((tag) => words.add(tag));
      }
    }
    await close();
  }
  assert.deepEqual([...words].sort(), ["best", "tied"]);
});

test("of three scenarios nothing is called best", async () => {
  const { page, close } = await browser.open(paper_file);
  for (const entry of paper.summary) for (const [key] of kMarks) assert.notEqual(entry[key], true);
  assert.equal(await page.locator("#methods tbody tr").count(), paper.methods.length);
  assert.equal(await page.locator("#methods .best").count(), 0);
  await close();
});

test("runs are filtered by verdict, method and words", async () => {
  const { page, close } = await browser.open(paper_file);
  const number = () => page.locator("#runs [role=status]").textContent();
  const failed = paper.runs.filter((run) => run.applicable && !run.success);
  await page.locator("#runs").getByLabel("verdict").selectOption("failed");
  assert.equal(await number(), `${failed.length} of ${paper.runs.length} runs`);
  await page.locator("#runs").getByLabel("method").selectOption("none");
  assert.equal(
    await number(),
    `${failed.filter((run) => paper.methods[run.method].variant === "none").length} of ${paper.runs.length} runs`,
  );
  await page.getByLabel("Find runs").fill('"puma560_wall" collides');
  await page.waitForFunction(() => location.hash.includes("find="));
  assert.equal(await number(), `1 of ${paper.runs.length} runs`);
  await page.getByRole("button", { name: "Clear filters" }).click();
  assert.equal(await number(), `${paper.runs.length} runs`);
  assert.equal(await page.getByLabel("Find runs").inputValue(), "");
  await close();
});

test("what is shown is narrowed to a robot, and robots stand beside each other", async () => {
  const names = [...new Set(robots.scenarios.map((scenario) => scenario.robot))];
  assert.equal(names.length, 5);
  const of = (family, robot) =>
    robots.runs.filter(({ scenario: index }) => {
      const scenario = robots.scenarios[index];
      return (family === "" || scenario.family === family) && (robot === "" || scenario.robot === robot);
    });
  const share = (runs, method) => {
    const judged = runs.filter((run) => run.method === method && run.applicable);
    return judged.length === 0 ? "n/a" : `${judged.filter((run) => run.success).length} of ${judged.length}`;
  };
  const { page, problems, close } = await browser.open(robots_file, "#rows=robot");
  const row = (name) => page.locator("#matrix tbody tr", { has: page.locator(`th a:text-is("${name}")`) });
  const check = async (family) => {
    assert.equal(await page.locator("#matrix tbody tr").count(), names.length);
    for (const name of names) {
      const cells = await texts(row(name).locator("td"));
      cells.forEach((text, method) => assert.ok(text.endsWith(share(of(family, name), method)), `${name}: ${text}`));
    }
  };
  await check("");
  await page.locator("#methods").getByLabel("over").selectOption("corridor");
  await check("corridor");
  await row(names[1]).locator("th a").click();
  const shown = of("corridor", names[1]);
  const number = () => page.locator("#runs [role=status]").textContent();
  assert.equal(await number(), `${shown.length} of ${robots.runs.length} runs`);
  for (const [index, method] of robots.methods.entries()) {
    const line = page.locator("#methods tbody tr", { has: page.locator(`strong:text-is("${method.variant}")`) });
    assert.ok((await line.innerText()).includes(share(shown, index)), method.variant);
  }
  await page.waitForFunction(() => location.hash.includes("robot="));
  await page.reload();
  assert.equal(await number(), `${shown.length} of ${robots.runs.length} runs`);
  assert.equal(await page.locator("#runs").getByLabel("robot").inputValue(), names[1]);
  await page.getByRole("link", { name: "all families" }).click();
  assert.equal(await number(), `${of("", names[1]).length} of ${robots.runs.length} runs`);
  assert.equal(await page.locator("#matrix tbody tr").count(), 2, "the families of this robot");
  await page.getByRole("link", { name: "all robots" }).click();
  await check("");
  await page.getByLabel("Find runs").fill(`"${names[2]}"`);
  await page.waitForFunction(() => location.hash.includes("find="));
  assert.equal(await number(), `${of("", names[2]).length} of ${robots.runs.length} runs`);
  await page.locator("#tab-trade-offs").click();
  await page.getByLabel("robot").selectOption(names[4]);
  const bqsa = robots.methods.findIndex((method) => method.variant === "bqsa");
  const rate = robots.summary.find(
    (entry) => entry.family === null && entry.robot === names[4] && entry.method === bqsa,
  ).rate;
  const line = page.locator("#view tbody tr", { has: page.locator('strong:text-is("bqsa")') }).first();
  assert.ok((await line.innerText()).includes(`${(100 * rate).toFixed(rate > 0 && rate < 1 ? 1 : 0)} %`));
  assert.deepEqual(await problems(), []);
  await close();
});

test("scaling shows the sweep of the address, its fits and crossovers; series go and come", async () => {
  const sweep = paper.measurements.sweeps.find((candidate) => candidate.name === "plane_nm");
  const { page, problems, close } = await browser.open(
    paper_file,
    `#view=scaling&sweep=plane_nm&show=test_points%7Cbqsa`,
  );
  assert.deepEqual(
    await texts(page.locator(".series [aria-pressed=true]")),
    sweep.series.filter((series) => ["test_points", "bqsa"].includes(series.name)).map((series) => series.label),
  );
  const points = sweep.series.find((series) => series.name === "test_points");
  const row = page
    .locator("tbody tr", { has: page.locator("td", { hasText: new RegExp(`^${points.label}$`) }) })
    .first();
  assert.ok(
    (await row.innerText()).includes(String(Number(points.fit.exponent.toPrecision(3)))),
    "the fitted exponent",
  );
  const crossover = sweep.crossovers.find((candidate) => candidate.a === "test_points" && candidate.b === "bqsa");
  assert.ok(crossover, "test points are overtaken");
  const rows = page.locator("[aria-label=Crossovers] tbody tr");
  assert.equal(await rows.count(), sweep.crossovers.length);
  assert.ok((await rows.first().innerText()).includes(points.label), "what is shown comes first");
  const chart = page.locator(".chart-canvas").first();
  const drawn = () => texts(chart.locator("svg text"));
  assert.ok((await drawn()).includes(points.label));
  await page.locator(".series button", { hasText: new RegExp(`^${points.label}$`) }).click();
  assert.ok(!(await drawn()).includes(points.label));
  await page.getByRole("button", { name: "all", exact: true }).click();
  assert.equal(await page.locator(".series [aria-pressed=true]").count(), sweep.series.length);
  assert.ok(
    (await drawn()).some((text) => /^10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+$/.test(text)),
    "axes are labelled 10^k",
  );
  assert.deepEqual(await problems(), []);
  await close();
});

test("the data of a chart are a table on the page and a CSV; SVG and PNG are valid", async () => {
  const { page, problems, close } = await browser.open(paper_file, "#view=scaling&sweep=plane_nm&show=bqsa");
  const series = paper.measurements.sweeps
    .find((sweep) => sweep.name === "plane_nm")
    .series.find((candidate) => candidate.name === "bqsa");
  const figure = page.locator("figure").first();
  await figure.locator("details summary").click();
  await figure.locator("details tbody tr").first().waitFor();
  assert.equal(await figure.locator("details tbody tr").count(), series.points.length);

  const saved = async (kind) => {
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      figure.getByRole("button", { name: kind }).click(),
    ]);
    assert.equal(download.suggestedFilename(), `plane_nm_times.${kind.toLowerCase()}`);
    return readFileSync(await download.path());
  };
  const lines = (await saved("CSV")).toString().trimEnd().split("\r\n");
  assert.equal(lines[0], "contestant,NM,time [s],95 % from [s],95 % to [s]");
  assert.deepEqual(
    lines.slice(1).map((line) => line.split(",").slice(1, 3).map(Number)),
    series.points.map((point) => [point.x, point.time_s]),
  );
  const svg = (await saved("SVG")).toString();
  const parsed = await page.evaluate((text) => {
    const root = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
    return {
      name: root.tagName,
      broken: root.querySelector("parsererror") !== null,
      scripts: root.querySelectorAll("script, foreignObject").length,
      text: root.textContent,
      paths: root.querySelectorAll("path").length,
    };
  }, svg);
  assert.deepEqual([parsed.name, parsed.broken, parsed.scripts], ["svg", false, 0]);
  assert.ok(parsed.text.includes(series.label) && parsed.paths > 10);
  const png = await saved("PNG");
  assert.equal(png.subarray(1, 4).toString(), "PNG");
  assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], [1920, 1200]);
  const seen = await page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const pixels = context.getImageData(0, 0, image.width, image.height).data;
    const inked = (from, to) => {
      let number = 0;
      for (let i = 4 * from; i < 4 * to; i += 4) if (pixels[i] < 200) number += 1;
      return number;
    };
    const half = (image.width * image.height) / 2;
    return { corner: [...pixels.slice(-4)], upper: inked(0, half), lower: inked(half, 2 * half) };
  }, png.toString("base64"));
  assert.deepEqual(seen.corner, [255, 255, 255, 255], "opaque to the last corner");
  assert.ok(seen.upper > 1000 && seen.lower > 1000, `drawn all over, got ${seen.upper} and ${seen.lower} dark pixels`);
  assert.deepEqual(await problems(), []);
  await close();
});

test("claims are counted by verdict, opened by the address, and show figures with bounds", async () => {
  const { claims } = paper.claims;
  const chosen = claims.find((claim) => claim.verdict === "confirmed with correction");
  const { page, problems, close } = await browser.open(paper_file, `#view=claims&open=${chosen.id}`);
  assert.equal(await page.locator(".claim").count(), claims.length);
  assert.equal(await page.locator(".claim[open]").count(), 1);
  const opened = await page.locator(`#claim-${chosen.id}`).innerText();
  for (const text of [chosen.statement, chosen.source, chosen.note].filter((text) => text !== ""))
    assert.ok(opened.replace(/\s+/g, " ").includes(text.replace(/\s+/g, " ")), text);
  assert.equal(await page.locator(`#claim-${chosen.id} tbody tr`).count(), chosen.figures.length);
  for (const verdict of new Set(claims.map((claim) => claim.verdict))) {
    const number = claims.filter((claim) => claim.verdict === verdict).length;
    await page.getByRole("button", { name: new RegExp(`${verdict} ${number}$`) }).click();
    assert.equal(await page.locator(".claim").count(), number, verdict);
  }
  assert.deepEqual(await problems(), []);
  await close();
});

test("trade-offs mark the front that no other variant dominates", async () => {
  const { page, problems, close } = await browser.open(paper_file, "#view=trade-offs&scenario=planar_7r&least=100");
  const candidates = paper.runs.filter(
    (run) => paper.scenarios[run.scenario].name === "planar_7r" && run.success && run.step_median_s !== null,
  );
  const cost = (run) => [run.step_median_s, run.tip_error_max_m, -run.clearance_m];
  const beaten = (run) =>
    candidates.some(
      (other) =>
        other !== run &&
        cost(other).every((value, i) => value <= cost(run)[i]) &&
        cost(other).some((value, i) => value < cost(run)[i]),
    );
  const expected = candidates.filter((run) => !beaten(run)).map((run) => paper.methods[run.method].variant);
  const marked = await texts(page.locator("#view tbody tr", { has: page.locator(".best") }).locator(".method strong"));
  assert.deepEqual(marked.sort(), expected.sort());
  assert.ok(expected.length < candidates.length || candidates.length < 3, "some variant is dominated");
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "CSV" }).click(),
  ]);
  const lines = readFileSync(await download.path(), "utf8")
    .trimEnd()
    .split("\r\n");
  assert.equal(lines.length - 1, candidates.length);
  const flat = lines
    .slice(1)
    .map((line) => line.split(","))
    .filter((fields) => fields.at(-1) === "yes")
    .map((fields) => fields[0]);
  const beaten_in_two = (run) =>
    candidates.some(
      (other) =>
        other.step_median_s <= run.step_median_s &&
        other.tip_error_max_m <= run.tip_error_max_m &&
        (other.step_median_s < run.step_median_s || other.tip_error_max_m < run.tip_error_max_m),
    );
  assert.deepEqual(
    flat.sort(),
    candidates
      .filter((run) => !beaten_in_two(run))
      .map((run) => paper.methods[run.method].variant)
      .sort(),
  );
  assert.deepEqual(await problems(), []);
  await close();
});

test("figures of the motion can be traded, and stand in the matrix and the details", async () => {
  const good = paper.runs.filter(
    (run) => paper.scenarios[run.scenario].name === "planar_7r" && run.success && run.step_median_s !== null,
  );
  const { page, problems, close } = await browser.open(paper_file, "#view=trade-offs&scenario=planar_7r&y=jerk");
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "CSV" }).click(),
  ]);
  const lines = readFileSync(await download.path(), "utf8")
    .trimEnd()
    .split("\r\n");
  const jerks = lines.slice(1).map((line) => Number(line.split(",")[2]));
  const expected = good.map((run) => run.jerk_rms_rad_s3);
  assert.ok(expected.length > 3 && expected.every((jerk) => jerk > 0), `${expected}`);
  assert.deepEqual(jerks.sort(), expected.sort());
  assert.deepEqual(await problems(), []);
  await close();

  const summary = await browser.open(paper_file, "#cell=jerk");
  const run = good.find((one) => paper.methods[one.method].variant === "bqsa");
  const cell = await cell_of(summary.page, paper, "planar_7r", "bqsa").innerText();
  const [, told] = /([\d.,\u202f]+) rad\/s³/.exec(cell);
  assert.ok(Math.abs(Number(told.replace(/[,\u202f]/g, "")) / run.jerk_rms_rad_s3 - 1) < 0.006, cell);
  await summary.close();

  const details = await browser.open(paper_file, `#open=${encodeURIComponent(run.record)}`);
  const facts = await details.page.locator("dl.facts").first().innerText();
  assert.match(facts, /Manipulability\s+least [\d.]+, mean [\d.]+ m²; least singular value/);
  assert.match(facts, /Self-motion\s+[\d.]+ % of the joint motion/);
  assert.deepEqual(await details.problems(), []);
  await details.close();
});

test("provenance has warnings, hashes, parameters, what differs between builds, and the licences", async () => {
  const data = structuredClone(paper);
  data.warnings = ["load average 9 on 2 cores"];
  data.source.bad_lines = ["runs.jsonl:99: not JSON"];
  data.origins.push({
    label: "another",
    values: data.origins[0].values.map(([key, value]) => [key, key === "compiler" ? "other 1.0" : value]),
  });
  const { page, problems, close } = await browser.open(browser.write(data), "#view=provenance");
  const text = await page.locator("#view").innerText();
  for (const expected of [
    data.warnings[0],
    data.source.bad_lines[0],
    data.program,
    ...data.scenarios.map((scenario) => scenario.sha256),
  ])
    assert.ok(text.includes(expected), expected);
  assert.deepEqual(await texts(page.locator("tr.differs th")), ["compilerdiffers"]);
  const color = await page
    .locator(".problem strong")
    .first()
    .evaluate((element) => getComputedStyle(element).color);
  const [red, green, blue] = color.match(/\d+/g).map(Number);
  assert.ok(red > 1.5 * green && red > 1.5 * blue, `warnings are red, got ${color}`);
  await page.locator(".licences summary").click();
  await page.locator(".licences pre", { hasText: "echarts" }).waitFor();
  const licences = await page.locator(".licences pre").innerText();
  for (const name of [/^echarts \d/m, /^zrender \d/m, /^three \d/m, /^tslib \d/m, /Apache License/, /MIT License/])
    assert.match(licences, name);
  assert.deepEqual(await problems(), []);
  await close();
});

test("the geometry ledger has each solid with what its ellipsoids cost, and is not there without solids", async () => {
  const { geometry } = solids.scenarios.find((s) => s.name === "ur5e_shelf");
  assert.equal(solids.scenarios.find((s) => s.name === "puma560_ellipsoid").geometry, null);
  const { page, problems, close } = await browser.open(solids_file, "#view=provenance");
  const section = page.locator("section").filter({ has: page.getByRole("heading", { name: "Geometry ledger" }) });
  const rows = await section
    .locator("tbody tr")
    .evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  assert.deepEqual(
    rows.map(([scenario, name, kind, parts, ellipsoids]) => [scenario, name, kind, parts, ellipsoids]),
    geometry.solids.map((s) => ["ur5e_shelf", s.name, s.kind, String(s.parts), String(s.ellipsoids)]),
  );
  geometry.solids.forEach((solid, i) => {
    assert.ok(Math.abs(parseFloat(rows[i][5]) - 1e3 * solid.inflation_m) < 0.06, rows[i][5]);
    assert.ok(Math.abs(parseFloat(rows[i][6]) - solid.volume_ratio) < 0.006, rows[i][6]);
    assert.equal(rows[i][7], "–");
    assert.equal(rows[i][8], solid.within_bounds ? "yes" : "no, larger");
  });
  const lost = await section.locator("li").textContent();
  const [, gap] = lost.match(/gaps narrower by up to ([\d.]+) mm/);
  assert.ok(Math.abs(parseFloat(gap) - 1e3 * geometry.gap_lost_m) < 0.5, lost); // three digits
  assert.deepEqual(await problems(), []);
  await close();
  const without = await browser.open(paper_file, "#view=provenance");
  assert.equal(await without.page.getByRole("heading", { name: "Geometry ledger" }).count(), 0);
  await without.close();
});

test("a shelf is replayed as it is, within its ellipsoids", async () => {
  const scenario = solids.scenarios.findIndex((s) => s.name === "ur5e_shelf");
  const { scene } = solids.scenarios[scenario];
  assert.deepEqual(
    scene.solids.map((solid) => [solid.name, scene.obstacles[solid.obstacle].shape]),
    ["floor", "top", "left", "right", "back", "post"].map((name, s) => [name, s]),
  );
  const { page, problems, close } = await browser.open(solids_file, "#view=replay&scenario=ur5e_shelf");
  await page.locator("canvas").first().waitFor();
  const legend = await page.locator(".replay-legend").innerText();
  assert.match(legend, /solid as the judge has it/);
  assert.match(legend, /ellipsoid around it as methods are told/);
  assert.doesNotMatch(legend, /ellipsoid to both/, "there is none in this scene");
  const [, near] = (await page.locator(".replay-now").innerText()).match(/\(link \d+, (.*)\)/);
  assert.ok(
    scene.solids.some(({ name }) => name === near),
    `${near} is a solid, not an ellipsoid around it`,
  );
  const other = (await problems()).filter((problem) => !problem.includes("GPU stall due to ReadPixels"));
  assert.deepEqual(other, []);
  await close();
});

test("a jump of a prismatic joint is told in metres with its tick, in the matrix and the replay", async () => {
  const file = page_file("slide");
  const data = data_of(file);
  const run = run_of(data, "rail_arm", "jumper");
  assert.deepEqual(run.failures.slice(0, 1), ["jump"]);
  assert.equal(run.max_joint_slide_tick, 7);
  const { page, problems, close } = await browser.open(file);
  const cell = cell_of(page, data, "rail_arm", "jumper");
  assert.match(await cell.innerText(), /jumps[^\n]*\n300 mm in tick 7/);
  await cell.locator("a").click();
  await page.waitForSelector("#tab-replay[aria-selected=true]");
  assert.match(page.url(), /tick=7$/);
  assert.equal(await page.locator("[data-moment=jump]").innerText(), "jump 7");
  assert.match(await page.locator(".replay-card").innerText(), /a joint step of 300 mm in tick 7/);
  const other = (await problems()).filter((problem) => !problem.includes("GPU stall due to ReadPixels"));
  assert.deepEqual(other, []);
  await close();
});

test("tabs are moved through by keys, and Back leads to the view before", async () => {
  const { page, close } = await browser.open(paper_file);
  const chosen = () => page.locator('[role="tab"][aria-selected="true"]').textContent();
  await page.locator("#tab-summary").focus();
  await page.keyboard.press("ArrowRight");
  assert.equal(await chosen(), "Scaling");
  assert.equal(await page.evaluate(() => document.activeElement.id), "tab-scaling");
  await page.keyboard.press("End");
  assert.equal(await chosen(), "Provenance");
  await page.keyboard.press("ArrowRight");
  assert.equal(await chosen(), "Summary");
  await page.goBack();
  await page.waitForSelector("#tab-provenance[aria-selected=true]");
  assert.equal(await page.locator("[role=tab][tabindex='0']").count(), 1);
  await close();
});

test("no view is wider than a phone, and dark is dark", async () => {
  for (const view of kViews) {
    const { page, problems, close } = await browser.open(paper_file, `#view=${view}`, {
      viewport: { width: 390, height: 844 },
      colorScheme: "dark",
      hasTouch: true,
    });
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390, `${view} fits`);
    const tab = await page.locator("[role=tab][aria-selected=true]").boundingBox();
    assert.ok(tab.x >= 0 && tab.x + tab.width <= 390, `the tab of ${view} is seen`);
    const luminance = await page.evaluate(() => {
      const [r, g, b] = getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number);
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    });
    assert.ok(luminance < 50, `${view} is dark`);
    assert.deepEqual(await problems(), []);
    await close();
  }
});

test("text has a contrast of at least 4.5 to its background, light and dark", async () => {
  for (const colorScheme of ["light", "dark"]) {
    const { page, close } = await browser.open(odd_file, "", { colorScheme });
    const least = await page.evaluate(() => {
      const channels = (color) => (color.match(/[\d.]+/g) ?? []).map(Number);
      const luminance = (color) => {
        const [r, g, b] = color.map((value) =>
          value / 255 <= 0.03928 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4,
        );
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const background = (element) => {
        for (let e = element; e; e = e.parentElement) {
          const color = channels(getComputedStyle(e).backgroundColor);
          if (color.length === 3 || color[3] === 1) return color.slice(0, 3);
        }
        return [255, 255, 255];
      };
      let worst = { ratio: Infinity, text: "" };
      let looked = 0;
      for (const element of document.querySelectorAll("#page *")) {
        const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim() !== "");
        const style = getComputedStyle(element);
        if (
          !own ||
          element.closest("svg, .faint, .unseen") ||
          !style.color.startsWith("rgb") ||
          element.getClientRects().length === 0
        )
          continue;
        const [a, b] = [luminance(channels(style.color)), luminance(background(element))];
        const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        looked += 1;
        if (ratio < worst.ratio) worst = { ratio, text: `${element.className} "${element.textContent.slice(0, 40)}"` };
      }
      return { ...worst, looked };
    });
    assert.ok(least.looked > 100);
    assert.ok(least.ratio >= 4.5, `${colorScheme}: ${least.ratio} at ${least.text}`);
    await close();
  }
});

test("the theme is changed by its button, charts and their legend alike", async () => {
  const { page, problems, close } = await browser.open(paper_file, "#view=scaling&sweep=plane_nm&show=bqsa", {
    colorScheme: "light",
  });
  const rgb = (hex) => `rgb(${[1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)).join(", ")})`;
  const colors = async () => {
    const line = await page.locator(".chart-canvas svg path[stroke-width='2']").first().getAttribute("stroke");
    const legend = await page
      .locator(".series [aria-pressed=true] .swatch")
      .evaluate((swatch) => getComputedStyle(swatch).stroke);
    assert.equal(legend, rgb(line), "legend and line");
    return [line, await page.locator(".chart-canvas svg text").first().getAttribute("fill")];
  };
  const light = await colors();
  await page.getByRole("button", { name: /Dark/ }).click();
  const dark = await colors();
  assert.ok(dark[0] !== light[0] && dark[1] !== light[1], `${dark} after ${light}`);
  await page.getByRole("button", { name: /Light/ }).click();
  assert.deepEqual(await colors(), light);
  assert.deepEqual(await problems(), []);
  await close();
});

test("on paper the page is light, charts included, and has nothing to click", async () => {
  const { page, problems, close } = await browser.open(paper_file, "#view=scaling", { colorScheme: "dark" });
  const look = () =>
    page.evaluate(() => ({
      background: getComputedStyle(document.body).backgroundColor,
      chart: document.querySelector(".chart-canvas svg text").getAttribute("fill"),
    }));
  const screen = await look();
  const themed = (name) => page.waitForFunction((theme) => document.documentElement.dataset.theme === theme, name);
  await page.emulateMedia({ media: "print" });
  await themed("light");
  const paper_look = await look();
  assert.equal(paper_look.background, "rgb(255, 255, 255)");
  assert.notEqual(paper_look.chart, screen.chart);
  const left = await texts(
    page.locator("#page .quiet:visible, #page .choice:visible, #page [aria-pressed=false]:visible"),
  );
  assert.deepEqual(left, [], "controls");
  await page.emulateMedia({ media: "screen" });
  await themed("dark");
  assert.deepEqual(await look(), screen);
  assert.deepEqual(await problems(), []);
  await close();
});

test("hostile names neither break nor script the page, in any view", async () => {
  const hostile = [
    "</script><script>window.hacked = 1</script>",
    '"><img src=x onerror="window.hacked = 2">',
    "<!-- <marquee>'\"`${window.hacked = 3}`",
    '=HYPERLINK("https://example.invalid")',
    `${"🤖\u202e\u2028".repeat(20)}`,
    "x".repeat(10_000),
    "javascript:window.hacked = 4",
    "{b|rich} {@[0]} {c} %s __proto__",
    "constructor",
  ];
  const data = structuredClone(paper);
  let next = 0;
  const name = () => hostile[next++ % hostile.length];
  data.title = name();
  data.scenarios.forEach((scenario, i) =>
    Object.assign(scenario, {
      name: `${hostile[i]}${i}`,
      description: name(),
      file: name(),
      family: hostile[i + 3],
      robot: hostile[i + 4],
      obstacles: scenario.obstacles.map(name),
    }),
  );
  data.scenarios.forEach((scenario) => scenario.scene?.obstacles.forEach((obstacle) => (obstacle.name = name())));
  data.methods.forEach((method, i) =>
    Object.assign(method, {
      name: name(),
      variant: `${hostile[i % hostile.length]}${i}`,
      changed: name(),
      description: name(),
      parameters: [{ name: name(), value: name(), unit: name(), meaning: name(), changed: true }],
    }),
  );
  for (const run of data.runs) {
    Object.assign(run, {
      claimed: name(),
      claim_detail: name(),
      record: run.record,
      why_not: run.applicable ? "" : name(),
      no_replay: run.replay === null ? name() : "",
    });
    for (const contact of run.contacts) contact.obstacle = name();
    for (const clamped of run.clamped) clamped.obstacle = name();
  }
  data.summary.forEach((entry) => {
    if (entry.family !== null)
      entry.family =
        data.scenarios[paper.scenarios.findIndex((scenario) => scenario.name === entry.family)]?.family ?? name();
    entry.failures = { [name()]: 1, [name()]: 2 };
  });
  data.origins.forEach((origin) => Object.assign(origin, { label: name(), values: [[name(), name()]] }));
  const long = hostile.find((text) => text.length === 10_000);
  data.measurements.sweeps.forEach((sweep) => {
    Object.assign(sweep, { title: long, axis_label: name(), fixed: long });
    sweep.series.forEach((series, i) =>
      Object.assign(series, { label: `${hostile[i % hostile.length]}${i}`, counted: long }),
    );
    sweep.crossovers.forEach((crossover) => (crossover.text = name()));
  });
  data.claims.claims.forEach((claim) =>
    Object.assign(claim, { statement: name(), source: name(), reason: name(), note: name(), remarks: [name()] }),
  );
  data.figures = [
    {
      name: name(),
      title: name(),
      paper: name(),
      files: [
        { label: name(), href: "javascript:window.hacked = 5" },
        { label: "svg", href: "figures/a%20b.svg" },
        { label: name(), href: "//example.invalid/x" },
      ],
    },
  ];
  data.warnings = [...hostile];
  data.success_means = [...hostile];
  data.source.bad_lines = [...hostile];
  const file = browser.write(data);
  for (const view of kViews) {
    const { page, problems, close } = await browser.open(
      file,
      `#view=${view}&find=%3Cimg%20src%3Dx%20onerror%3Dalert(1)%3E`,
    );
    assert.equal(await page.locator("h1").textContent(), data.title);
    if (view !== "summary" && view !== "claims")
      assert.ok((await page.locator("#view").innerText()).length > 100, view);
    if (view === "scaling" || view === "trade-offs") {
      await page.locator(".chart-canvas").first().scrollIntoViewIfNeeded();
      assert.ok((await tooltips_of(page)) > 3, `${view}: tooltips are shown`);
    }
    for (const closed of await page.locator("details:not([open]) > summary").all())
      if (await closed.isVisible()) await closed.click();
    assert.equal(await page.evaluate(() => window.hacked), undefined, view);
    assert.equal(await page.locator("#page img, #page script, #page marquee, #page iframe").count(), 0, view);
    const links = await page
      .locator("#page a")
      .evaluateAll((elements) =>
        elements.map((element) => element.getAttribute("href")).filter((href) => !href.startsWith("#")),
      );
    assert.deepEqual(links, view === "claims" ? ["figures/a%20b.svg"] : []);
    assert.ok(
      (await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0,
      `${view} is not wider than the window`,
    );
    assert.deepEqual(await problems(), []);
    await close();
  }
  const { page, close } = await browser.open(file, "#view=trade-offs");
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "CSV" }).click(),
  ]);
  const csv = readFileSync(await download.path(), "utf8");
  assert.ok(!/(^|,)"?[=+@-][A-Z]/m.test(csv), "no cell of the CSV is a formula");
  await close();
});

test("20 scenarios by 10 methods open, in less than 25 MB", async (t) => {
  const size = readFileSync(big_file).length;
  assert.ok(size < 25e6, `${size} bytes`);
  const begin = performance.now();
  const { page, problems, close } = await browser.open(big_file);
  t.diagnostic(`${(size / 1e6).toFixed(1)} MB, open after ${(performance.now() - begin).toFixed(0)} ms`);
  assert.deepEqual(await problems(), []);
  assert.equal(await page.locator("#runs [role=status]").textContent(), "200 runs");
  await close();
});

test("20,000 runs are drawn as they are looked at, and filtered", async (t) => {
  const data = structuredClone(big);
  const runs = data.runs;
  const scenarios = data.scenarios.map((scenario) => ({ ...scenario, scene: null, scene_missing: "left out" }));
  data.scenarios = [];
  data.runs = [];
  data.replays = [];
  for (let copy = 0; copy < 100; ++copy) {
    data.scenarios.push(...scenarios.map((scenario) => ({ ...scenario, name: `${scenario.name}_${copy}` })));
    data.runs.push(
      ...runs.map((run) => ({
        ...run,
        scenario: run.scenario + scenarios.length * copy,
        record: `runs.jsonl:${data.runs.length + 1}`,
        replay: null,
        no_replay: "left out",
      })),
    );
  }
  assert.equal(data.runs.length, 20_000);
  const file = browser.write(data);
  const begin = performance.now();
  const { page, problems, close } = await browser.open(file);
  t.diagnostic(`open after ${(performance.now() - begin).toFixed(0)} ms`);
  const drawn = () => page.locator("#runs tbody tr").count();
  const at_first = await drawn();
  assert.ok(at_first <= 300, `${at_first} rows at first`);
  await page.locator("#runs .more").scrollIntoViewIfNeeded();
  await page.waitForFunction((before) => document.querySelectorAll("#runs tbody tr").length > before, at_first);
  const name = `${scenarios[3].name}_77`;
  await page.getByLabel("Find runs").fill(`"${name}"`);
  await page.waitForFunction(() => document.querySelector("#runs [role=status]").textContent.startsWith("10 of"));
  const clicked = performance.now();
  await page.locator("#runs thead button", { hasText: "Tip error" }).click();
  await page.getByRole("button", { name: "Clear filters" }).click();
  assert.equal((await page.locator("#runs [role=status]").textContent()).replace(/\s/g, ""), "20000runs");
  t.diagnostic(`sorted all after ${(performance.now() - clicked).toFixed(0)} ms`);
  assert.ok((await page.locator("*").count()) < 30_000, "the page stays small");
  assert.deepEqual(await problems(), []);
  await close();
});

test("the template is small, and says so when it is empty", async () => {
  assert.ok(readFileSync(kTemplate).length <= 2_000_000);
  const { page, close } = await browser.open(kTemplate);
  assert.match(await page.locator(".problem").innerText(), /empty template/);
  await close();
});
