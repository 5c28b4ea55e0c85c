// Addresses, numbers, orders and decoded data, without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { module_of } from "./modules.mjs";

const { parse, fragment, kViews } = await module_of("link");
const format = await module_of("format");
const { f32, u16, verdict_of, ReportData } = await module_of("data");
const { reason, run_change, telling_tick } = await module_of("parts");
const { points_of_scenario, points_of_scope, quantity, value_text } = await module_of("views/pareto");
const { select_runs } = await module_of("replay/selection");

test("a state comes back from its address, whatever the names", () => {
  const names = ["bqsa@1a2b3c4d", "a&b=c#d%20+ e", '"<script>', "🤖 äß", "x|y", "\u2028"];
  for (const name of names) {
    const state = {
      ...parse(""),
      view: "replay",
      scenario: name,
      method: name,
      against: name,
      find: name,
      show: `${name}|b`,
      seed: "18446744073709551615",
      repetition: 3,
      tick: 0,
    };
    assert.deepEqual(parse(fragment(state)), state);
  }
});

test("what cannot be read in an address is as if it were not there", () => {
  assert.deepEqual(parse("#view=nonsense&tick=-1&repetition=1e3&unknown=1&tick"), parse(""));
  assert.equal(parse("#tick=99999999999999999999").tick, null);
  assert.equal(parse("#view=trade-offs").view, "trade-offs");
  assert.equal(kViews.length, 6);
});

test("numbers have three significant digits and the unit that suits them", () => {
  const cases = [
    [format.number(0.0012345), "0.00123"],
    [format.number(0.00012345), "1.23·10⁻⁴"],
    [format.number(9.996), "10.0"],
    [format.number(99.96), "100"],
    [format.number(12345.6), "12300"],
    [format.number(123456), "123\u202f456"],
    [format.number(123456.7), "1.23·10⁵"],
    [format.number(-4), "−4"],
    [format.number(-84.27), "−84.3"],
    [format.number(1794), "1794"],
    [format.number(0), "0"],
    [format.number(null), "–"],
    [format.number(Infinity), "∞"],
    [format.time(5.43e-6), "5.43 µs"],
    [format.time(0.0745), "74.5 ms"],
    [format.time(9.9996e-7), "1.00 µs"],
    [format.time(120), "2 min"],
    [format.length(1.91e-6), "1.91 µm"],
    [format.length(0.419), "419 mm"],
    [format.millimetres(-0.0842779), "−84.3"],
    [format.degrees(Math.PI / 2), "90°"],
    [format.percent(0.9345), "93.5 %"],
    [format.percent(1), "100 %"],
    [format.decade(1e-6), "10⁻⁶"],
    [format.decade(2e-6), ""],
    [format.decade(1000), "10³"],
    [format.count(19998), "19\u202f998"],
    [format.interval(1.2, null), "[1.20, ∞]"],
    [format.interval(null, null), ""],
  ];
  for (const [got, expected] of cases) assert.equal(got, expected);
});

test("a rounded number is within half a unit of its third digit", () => {
  let seed = 7;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  for (let i = 0; i < 2000; ++i) {
    const value = (random() - 0.5) * 10 ** Math.floor(random() * 24 - 12);
    const text = format.number(value);
    const match = /^(−?)([\d.]+)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?$/.exec(text);
    assert.ok(match, text);
    const digits = [...(match[3] ?? "")].map((c) => (c === "⁻" ? "-" : "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c))).join("");
    const read = (match[1] ? -1 : 1) * Number(match[2]) * 10 ** Number(digits || 0);
    assert.ok(Math.abs(read - value) <= 0.005001 * Math.abs(value), `${value} is written ${text}`);
  }
});

test("bulk data are little-endian", () => {
  const bytes = Buffer.from([0, 0, 128, 63, 0, 0, 32, 193, 0, 0, 128, 127]);
  assert.deepEqual([...f32(bytes.toString("base64"))], [1, -10, Infinity]);
  assert.deepEqual([...u16(Buffer.from([1, 2, 255, 255]).toString("base64"))], [0x0201, 0xffff]);
});

test("a verdict tells crash, no verdict, failure, success and pairs that do not fit apart", () => {
  const run = {
    applicable: true,
    success: false,
    claimed: "nothing",
    claim_holds: true,
    failures: [],
    disagreement: "",
  };
  const of = (change) => {
    const { kind, word, lie } = verdict_of({ ...run, ...change });
    return [kind, word, lie];
  };
  assert.deepEqual(of({ success: true }), ["success", "success", false]);
  assert.deepEqual(of({ applicable: false }), ["not-applicable", "n/a", false]);
  assert.deepEqual(of({ failures: ["incomplete", "collision"] }), ["failure", "collides", false]);
  assert.deepEqual(of({ failures: ["incomplete"] }), ["failure", "incomplete", false]);
  assert.deepEqual(of({ failures: ["drift"], claimed: "crashed at tick 50" }), ["crash", "crashed", false]);
  assert.deepEqual(of({ failures: ["collision", "work_hidden"] }), ["crash", "hides work", false]);
  assert.deepEqual(of({ failures: ["drift"], claimed: "success", claim_holds: false }), ["failure", "drifts", true]);
  assert.deepEqual(of({ success: true, disagreement: "far apart" }), ["no-verdict", "no verdict", false]);
  const denied = { failures: ["disagreement"], disagreement: "far apart", claimed: "success", claim_holds: false };
  assert.deepEqual(of(denied), ["no-verdict", "no verdict", false]);
  assert.deepEqual(of({ ...denied, disagreement: "" }), ["no-verdict", "no verdict", false]);
});

/** A report of scenarios [name, hash], variants and runs. */
const report_of = (scenarios, variants, runs) =>
  new ReportData({
    scenarios: scenarios.map(([name, sha256]) => ({ name, sha256, family: "", robot: "" })),
    methods: variants.map((variant) => ({ name: variant, variant, external: variant === "external" })),
    runs: runs.map((run) => ({ applicable: true, success: true, seed: null, repetition: null, replay: 0, ...run })),
    replays: [],
    summary: [],
  });

test("scenarios and variants of the same name are told apart, and each is reached by its address", () => {
  const hashes = ["0123456789abcdef", "fedcba9876543210"];
  const scenarios = [
    ["a", hashes[0]],
    ["b", hashes[0]],
    ["a", hashes[1]],
    ["a@fedcba98", hashes[0]],
    ["a", hashes[0]],
  ];
  const variants = ["bqsa", "qp", "bqsa", "bqsa~2"];
  const runs = scenarios.flatMap((_, scenario) => variants.map((_v, method) => ({ scenario, method })));
  const data = report_of(scenarios, variants, runs);
  const keys = scenarios.map((_, index) => data.scenario_key(index));
  assert.deepEqual(keys, ["a@01234567", "b", "a@fedcba98~2", "a@fedcba98", "a@01234567~2"]);
  assert.deepEqual(
    variants.map((_, index) => data.method_key(index)),
    ["bqsa~1", "qp", "bqsa~2~2", "bqsa~2"],
  );
  for (const run of data.report.runs) {
    const state = parse(fragment({ ...parse(""), ...run_change(data, run) }));
    assert.equal(select_runs(data, state).run, run, `${state.scenario}, ${state.method}`);
  }
  assert.equal(data.scenario_index("a"), 4, "of a plain name the last");
  assert.equal(data.method_index("bqsa"), 2);
  assert.equal(data.scenario_index("c"), -1);
  assert.equal(data.method_index(""), -1);
});

test("times of trade-offs have the mark of what speaks against them, other quantities have none", () => {
  const times = { step_median_s: 2e-6, step_p99_s: 3e-6, step_max_s: 4e-6, plan_s: null, tip_error_max_m: 1e-6 };
  const good = { ...times, scenario: 0, method: 0, times_indicative: [], includes_pipe: false, clearance_m: 0.1 };
  const texts = (point) => ["time", "p99", "slowest", "plan", "error"].map((q) => value_text(point, quantity(q, q)));
  const marked = (mark) => [`${mark}2 µs`, `${mark}3 µs`, `${mark}4 µs`, "–", "1 µm"];
  const runs = [good, { ...good, times_indicative: ["busy"] }, { ...good, method: 1, includes_pipe: true }];
  const failed = { ...good, method: 2, success: false, times_indicative: ["busy"] };
  const data = report_of([["a", "0"]], ["bqsa", "external", "qp"], [...runs, failed, { ...good, method: 2 }]);
  assert.deepEqual(points_of_scenario(data, 0).map(texts), [marked("~"), marked("⇄"), marked("")]);
  const entry = {
    ...times,
    family: null,
    robot: null,
    rate: 1,
    plan_median_s: null,
    tip_error_median_m: 1e-6,
    clearance_min_m: 0.1,
    times_publishable: true,
  };
  data.report.summary.push({ ...entry, method: 0 }, { ...entry, method: 1, times_publishable: false });
  assert.deepEqual(points_of_scope(data, null, null).map(texts), [marked(""), marked("~⇄")]);
});

test("why a run failed is told with tick and figure, of what its verdict names", () => {
  // Joints 0 and 2 turn, 1 and 3 slide.
  const scene = { prismatic: [false, true, false, true], max_joint_step_rad: [0.1, 0.02, 0.3, 0.05] };
  const base = {
    ...{ scenario: 0, method: 0, applicable: true, success: false, claimed: "nothing", claim_holds: true },
    ...{ claim_detail: "", gave_up: "", disagreement: "", contacts: [], self_contacts: [], failure_tick: null },
    ...{ tip_error_max_m: 0.012, tip_error_max_tick: 90, orientation_max_rad: 0.5, orientation_max_tick: 80 },
    ...{ max_joint_step_rad: 0, max_joint_step_tick: 0, max_joint_slide_m: null, max_joint_slide_tick: null },
  };
  const told = (change, of_scene = scene) => {
    const run = { ...base, ...change };
    const data = report_of([["a", "0"]], ["bqsa"], [run]);
    data.report.scenarios[0].scene = of_scene;
    return [reason(data, run), telling_tick(data, run)];
  };
  const steps = (rad, m) => ({
    ...{ failures: ["jump", "drift", "orientation"], max_joint_step_rad: rad, max_joint_step_tick: 5 },
    ...{ max_joint_slide_m: m, max_joint_slide_tick: 9 },
  });
  const [turn, slide] = ["9° in tick 5", "40 mm in tick 9"];
  assert.deepEqual(told(steps(Math.PI / 20, 0.01)), [turn, 5]); // 9 degrees are 0.157
  assert.deepEqual(told(steps(0.05, 0.04)), [slide, 9]);
  assert.deepEqual(told(steps(Math.PI / 20, 0.04)), [`${turn}, ${slide}`, 5], "either may have been it");
  assert.deepEqual(told(steps(Math.PI / 20, 0.01), null), [`${turn}, 10 mm in tick 9`, 5], "without limits");
  assert.deepEqual(told(steps(0, 0.04), null), [slide, 9]);
  const alone = { prismatic: [false], max_joint_step_rad: [0.1] };
  assert.deepEqual(told({ ...steps(Math.PI / 20, null), failure_tick: 5 }, alone), [turn, 5]);

  assert.deepEqual(told({ failures: ["drift", "orientation"], failure_tick: 90 }), ["12 mm at tick 90", 90]);
  assert.deepEqual(told({ failures: ["orientation"], failure_tick: 80 }), ["turned away by 28.6° at tick 80", 80]);
  const self_contacts = [{ link: 2, other_link: 6, first_tick: 33 }];
  const entangled = { ...steps(0.05, 0.04), failures: ["self_collision", "jump"], self_contacts, failure_tick: 33 };
  assert.deepEqual(told(entangled), ["link 2 in link 6, tick 33", 33]);
});
