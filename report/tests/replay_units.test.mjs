// The replay's arithmetic: the quadratic against the paper's own form and against sampling, the clock, the moments.
import assert from "node:assert/strict";
import { test } from "node:test";
import { module_of } from "./modules.mjs";
import { f32, sample, u16, u8 } from "./replay_helpers.mjs";

const { criteria, unit_map, shadow_map } = await module_of("replay/quadratic");
const { segment_distance } = await module_of("replay/distance");
const { Clock, kSpeeds } = await module_of("replay/clock");
const { moments, next_moment } = await module_of("replay/moments");
const { ways_down } = await module_of("replay/name_places");
const { key_action } = await module_of("replay/keys");
const { error_chart, joints_chart } = await module_of("replay/curves");
const { kLightTheme } = await module_of("palette");

/** Random numbers in [0, 1), the same in every run (mulberry32). */
function random_numbers(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** Rotation matrix of a random unit quaternion. */
function random_rotation(random) {
  const q = Array.from({ length: 4 }, () => random() - 0.5);
  const [w, x, y, z] = q.map((value) => value / Math.hypot(...q));
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
  ];
}

const pose_of = (R, c) => R.flatMap((row, k) => [...row, c[k]]);

/** Level of a point, straight from the definition: the sum of squares along the ellipsoid's own axes, less one. */
function level(R, c, axes, p) {
  return [0, 1, 2].reduce(
    (sum, k) => sum + ([0, 1, 2].reduce((dot, i) => dot + R[i][k] * (p[i] - c[i]), 0) / axes[k]) ** 2,
    -1,
  );
}

/** Category by looking at the link and at its line, point by point; null where the answer hangs on the sampling. */
function sampled_category(level_at) {
  const band = 2e-3;
  const inside = [level_at(0), level_at(1)].map((value) => (Math.abs(value) < band ? null : value < 0));
  if (inside.includes(null)) return null;
  if (inside[0] && inside[1]) return 5;
  if (inside[0] || inside[1]) return 4;
  const least = (from, to, steps) => {
    let best = Infinity;
    for (let i = 0; i <= steps; ++i) best = Math.min(best, level_at(from + ((to - from) * i) / steps));
    return best;
  };
  const within = least(0, 1, 500);
  if (Math.abs(within) < band) return null;
  if (within < 0) return 3;
  const beyond = least(-30, 31, 3000);
  if (Math.abs(beyond) < 0.05) return null;
  return beyond < 0 ? 2 : 1;
}

test("the category is the one that sampling the link and its line finds", () => {
  const random = random_numbers(7);
  const found = [0, 0, 0, 0, 0, 0];
  for (let n = 0; n < 3000; ++n) {
    const axes = [0.1 + random(), 0.1 + random(), 0.1 + random()];
    const R = random_rotation(random);
    const c = [random() - 0.5, random() - 0.5, random() - 0.5];
    const size = n % 2 === 0 ? 1 : 3;
    const points = Array.from({ length: 6 }, () => size * (random() - 0.5));
    const at = (t) =>
      level(
        R,
        c,
        axes,
        [0, 1, 2].map((k) => points[k] + t * (points[3 + k] - points[k])),
      );
    const expected = sampled_category(at);
    if (expected === null) continue;
    const result = criteria(unit_map(axes, pose_of(R, c)), points, 0, 3);
    assert.equal(result.category, expected, `case ${n}`);
    assert.ok(Math.abs(result.start - at(0)) < 1e-9 * (1 + Math.abs(at(0))), `f(0), case ${n}`);
    assert.ok(Math.abs(result.end - at(1)) < 1e-9 * (1 + Math.abs(at(1))), `f(1), case ${n}`);
    let deepest = 0;
    for (let i = 0; i <= 1000; ++i) if (at(i / 1000) < at(deepest)) deepest = i / 1000;
    assert.ok(Math.abs(result.vertex - deepest) <= 1.1e-3, `deepest point, case ${n}`);
    const slope = (t) => (at(t + 1e-5) - at(t - 1e-5)) / 2e-5;
    assert.ok(
      Math.abs(result.slope_product - slope(0) * slope(1)) < 1e-4 * (1 + Math.abs(slope(0) * slope(1))),
      `slopes, case ${n}`,
    );
    ++found[expected];
  }
  for (const category of [1, 2, 3, 4, 5])
    assert.ok(found[category] > 30, `category ${category} was met ${found[category]} times`);
});

/** The paper's criteria, Eqs. (19) to (22), from the level of the ellipse along the link as a function of x. */
function paper_criteria(R, c, axes, p1, p2) {
  const m = [0, 1].map((i) =>
    [0, 1].map((j) => (R[i][0] * R[j][0]) / axes[0] ** 2 + (R[i][1] * R[j][1]) / axes[1] ** 2),
  );
  const conic = (x, y) =>
    m[0][0] * (x - c[0]) ** 2 + 2 * m[0][1] * (x - c[0]) * (y - c[1]) + m[1][1] * (y - c[1]) ** 2 - 1;
  const [left, right] = p1[0] <= p2[0] ? [p1, p2] : [p2, p1];
  const width = right[0] - left[0];
  const f = (x) => width ** 2 * conic(x, left[1] + ((x - left[0]) / width) * (right[1] - left[1]));
  const [f0, f1, f2] = [f(left[0] - 1), f(left[0]), f(left[0] + 1)];
  const alpha = (f0 - 2 * f1 + f2) / 2;
  const slope_left = (f2 - f0) / 2;
  const slope_right = slope_left + 2 * alpha * width;
  const discriminant = slope_left ** 2 - 4 * alpha * f1;
  return {
    discriminant: discriminant / width ** 2,
    left: f1 / width ** 2,
    right: f(right[0]) / width ** 2,
    slopes: (slope_left * slope_right) / width ** 2,
  };
}

test("the criteria are the paper's, over (x_max - x_min)²", () => {
  const random = random_numbers(11);
  let tried = 0;
  for (let n = 0; n < 500; ++n) {
    const turn = 2 * Math.PI * random();
    const R = [
      [Math.cos(turn), -Math.sin(turn), 0],
      [Math.sin(turn), Math.cos(turn), 0],
      [0, 0, 1],
    ];
    const axes = [0.2 + random(), 0.2 + random(), 1];
    const c = [random() - 0.5, random() - 0.5, 0];
    const points = [3 * (random() - 0.5), 3 * (random() - 0.5), 0, 3 * (random() - 0.5), 3 * (random() - 0.5), 0];
    if (Math.abs(points[3] - points[0]) < 0.2) continue;
    const expected = paper_criteria(R, c, axes, points.slice(0, 2), points.slice(3, 5));
    const result = criteria(unit_map(axes, pose_of(R, c)), points, 0, 3);
    const [at_left, at_right] = points[0] <= points[3] ? [result.start, result.end] : [result.end, result.start];
    const close = (a, b, what) =>
      assert.ok(Math.abs(a - b) < 1e-6 * (1 + Math.abs(b)), `${what}, case ${n}: ${a}, expected ${b}`);
    close(result.discriminant, expected.discriminant, "discriminant");
    close(at_left, expected.left, "f(x_min)");
    close(at_right, expected.right, "f(x_max)");
    close(result.slope_product, expected.slopes, "f'(x_min) f'(x_max)");
    ++tried;
  }
  assert.ok(tried > 400);
});

test("a vertical link through the ellipse is a hit, unlike in the paper's form", () => {
  const map = unit_map(
    [1, 0.5, 1],
    pose_of(
      [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ],
      [0, 0, 0],
    ),
  );
  assert.equal(criteria(map, [0.2, -2, 0, 0.2, 2, 0], 0, 3).category, 3);
  assert.equal(criteria(map, [1.2, -2, 0, 1.2, 2, 0], 0, 3).category, 1);
  assert.equal(criteria(map, [0.2, 2, 0, 0.2, 3, 0], 0, 3).category, 2);
});

test("touching counts as a hit, and a link of no length has a category", () => {
  const map = unit_map(
    [1, 1, 1],
    pose_of(
      [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ],
      [0, 0, 0],
    ),
  );
  assert.equal(criteria(map, [-1, 1, 0, 1, 1, 0], 0, 3).category, 3);
  assert.equal(criteria(map, [1, 0, 0, 3, 0, 0], 0, 3).category, 4);
  assert.equal(criteria(map, [2, 0, 0, 2, 0, 0], 0, 3).category, 1);
  assert.equal(criteria(map, [0, 0, 0, 0, 0, 0], 0, 3).category, 5);
});

test("a shadow holds the projections of the ellipsoid's points and no more", () => {
  const random = random_numbers(3);
  const coordinates = { XOY: [0, 1], YOZ: [1, 2], XOZ: [0, 2] };
  for (let n = 0; n < 60; ++n) {
    const axes = [0.1 + random(), 0.1 + random(), 0.1 + random()];
    const R = random_rotation(random);
    const c = [random(), random(), random()];
    for (const [plane, [i, j]] of Object.entries(coordinates)) {
      const map = shadow_map(axes, pose_of(R, c), plane);
      let largest = -Infinity;
      for (let s = 0; s <= 90; ++s) {
        for (let t = 0; t < 180; ++t) {
          const [polar, around] = [(Math.PI * s) / 90, (2 * Math.PI * t) / 180];
          const own = [
            axes[0] * Math.sin(polar) * Math.cos(around),
            axes[1] * Math.sin(polar) * Math.sin(around),
            axes[2] * Math.cos(polar),
          ];
          const p = [0, 0, 0];
          for (const k of [i, j]) p[k] = c[k] + own.reduce((sum, value, axis) => sum + R[k][axis] * value, 0);
          largest = Math.max(largest, criteria(map, [...p, ...p], 0, 3).start);
        }
      }
      assert.ok(largest < 1e-9 && largest > -0.02, `case ${n}, ${plane}: ${largest}`);
    }
  }
});

/** Frames that a test lets pass. */
function frames() {
  let next = null;
  return {
    request: (callback) => ((next = callback), 1),
    cancel: () => (next = null),
    waiting: () => next !== null,
    pass: (now) => {
      const callback = next;
      next = null;
      callback?.(now);
    },
  };
}

test("the clock plays the ticks of its time, and stops at the end", () => {
  const picture = frames();
  const clock = new Clock(40, 0.025, picture);
  const seen = [];
  clock.on_change(() => seen.push(clock.tick));
  clock.play();
  for (let ms = 0; ms <= 500; ms += 20) picture.pass(ms);
  assert.equal(clock.tick, 20);
  clock.set_speed(2);
  for (let ms = 520; ms <= 680; ms += 20) picture.pass(ms);
  assert.equal(clock.tick, 34);
  for (let ms = 700; ms <= 1200; ms += 20) picture.pass(ms);
  assert.equal(clock.tick, 40);
  assert.equal(clock.playing, false);
  assert.equal(picture.waiting(), false);
  assert.ok(seen.every((tick, i) => i === 0 || tick >= seen[i - 1]));
  clock.play();
  assert.equal(clock.tick, 0, "from the beginning again");
});

test("the clock in a loop begins again, and a pause keeps the tick", () => {
  const picture = frames();
  const clock = new Clock(9, 0.1, picture);
  clock.set_loop(true);
  clock.play();
  for (let ms = 0; ms <= 1170; ms += 90) picture.pass(ms);
  assert.equal(clock.tick, 1);
  clock.pause();
  assert.equal(picture.waiting(), false);
  clock.step(-3);
  assert.equal(clock.tick, 0);
  clock.step(100);
  assert.equal(clock.tick, 9);
  clock.dispose();
});

test("the clock goes through its speeds one by one", () => {
  const clock = new Clock(9, 0.1, frames());
  const up = [];
  for (let i = 0; i < kSpeeds.length; ++i) {
    clock.change_speed(1);
    up.push(clock.speed);
  }
  assert.deepEqual(up, [2, 4, 8, 8, 8, 8, 8]);
  for (let i = 0; i < 20; ++i) clock.change_speed(-1);
  assert.equal(clock.speed, kSpeeds[0]);
});

test("moments are where the arrays and the judge say", () => {
  const replay = {
    rows: 6,
    tip_error_m: new Float32Array([9, 1, 2, 5, NaN, 3]),
    clearance_m: new Float32Array([0.3, 0.2, -0.1, 0.4, NaN, 0.5]),
    run: {
      contacts: [
        { link: 5, obstacle: "b", first_tick: 4 },
        { link: 6, obstacle: "a", first_tick: 2 },
      ],
      tip_error_max_tick: null,
      step_max_s: null,
      step_max_tick: 0,
      gave_up: "",
      failures: ["collision"],
      self_contacts: [],
      self_clearance_at_ticks_m: null,
      orientation_max_rad: null,
    },
  };
  const scene = { prismatic: [true], max_joint_step_rad: [0.02] };
  const ticks = Object.fromEntries(moments(replay, scene).map(({ key, tick }) => [key, tick]));
  assert.deepEqual(ticks, { contact: 2, error: 3, clearance: 2, slow: null, end: 5 });
  replay.run = {
    ...replay.run,
    contacts: [],
    tip_error_max_tick: 4,
    step_max_s: 1e-3,
    step_max_tick: 1,
    gave_up: "joint step too large",
  };
  const others = moments(replay, scene);
  assert.deepEqual(Object.fromEntries(others.map(({ key, tick }) => [key, tick])), {
    contact: null,
    error: 4,
    clearance: 2,
    slow: 1,
    end: 5,
  });
  assert.match(others.at(-1).label, /gave up/);
  assert.equal(next_moment(others, 2, 1).tick, 4);
  assert.equal(next_moment(others, 2, -1).tick, 1);
  assert.equal(next_moment(others, 5, 1), null);
  replay.run = {
    ...replay.run,
    failures: ["self_collision", "jump", "orientation"],
    self_contacts: [{ link: 1, other_link: 3, first_tick: 3 }],
    ...{ max_joint_step_rad: 0, max_joint_step_tick: 0, max_joint_slide_m: 0.5, max_joint_slide_tick: 2 },
    ...{ orientation_max_rad: Math.PI / 2, orientation_max_tick: 5 },
  };
  const told = moments(replay, scene).map(({ key, tick, note }) => [key, tick, note]);
  assert.deepEqual(
    told.filter(([key]) => ["contact", "jump", "tilt"].includes(key)),
    [
      ["contact", 3, "link 1 in link 3"],
      ["jump", 2, "500 mm"],
      ["tilt", 5, "90°"],
    ],
  );
});

test("the error of the start is neither the largest tip error nor in its chart", () => {
  const run = {
    ...{ contacts: [], self_contacts: [], failures: [], tip_error_max_tick: null, orientation_max_rad: null },
    ...{ step_max_s: null, step_max_tick: null, gave_up: "", method: 0 },
  };
  const replay = {
    run,
    rows: 4,
    tip_error_m: new Float32Array([0.5, 0.001, 0.002, NaN]),
    clearance_m: new Float32Array(4),
  };
  const error_moment = (change) => moments({ ...replay, ...change }, null).find(({ key }) => key === "error").tick;
  assert.equal(error_moment({}), 2);
  assert.equal(error_moment({ run: { ...run, tip_error_max_tick: 0 } }), 2, "0 is no tick of the judge's");
  const start = { rows: 1, tip_error_m: new Float32Array([0.5]) };
  assert.equal(error_moment(start), null);
  assert.equal(error_moment({ ...start, run: { ...run, tip_error_max_tick: 3 } }), null, "only the start is there");
  const chart = error_chart([{ letter: "", actor: { name: "a", scenario: { dt_s: 0.5, tolerance_m: 0.01 }, replay } }]);
  const [{ data }] = chart.option(kLightTheme, 800).series;
  assert.deepEqual(
    data.map(([t]) => t),
    [0.5, 1, 1.5],
  );
  assert.ok(
    data.every(([, error]) => error === null || error < 3),
    "no 500 mm",
  );
  assert.deepEqual(
    chart.table().rows.map((row) => row[2] === null),
    [true, false, false, true],
  );
});

test("keys that belong to the browser are left to it", () => {
  const key = (name, more = {}) =>
    key_action({ key: name, shiftKey: false, ctrlKey: false, altKey: false, metaKey: false, ...more });
  assert.deepEqual(key("ArrowRight"), { do: "step", ticks: 1 });
  assert.deepEqual(key("ArrowLeft", { shiftKey: true }), { do: "step", ticks: -10 });
  for (const held of ["ctrlKey", "altKey", "metaKey"]) assert.equal(key("ArrowRight", { [held]: true }), null);
  assert.equal(key("Tab"), null);
});

test("the category from the positions is the one that the program stores", () => {
  const report = sample();
  const found = [0, 0, 0, 0, 0, 0];
  const kinds = { moving: 0, resting: 0 };
  let undecided = 0;
  for (const replay of report.replays) {
    const { scene } = report.scenarios[report.runs[replay.run].scenario];
    const points = f32(replay.points);
    const [category, obstacle] = [u8(replay.category), u16(replay.category_obstacle)];
    const motions = scene.obstacles.map(({ motion }) => motion && f32(motion));
    for (let row = 0; row < replay.rows; ++row) {
      scene.links.forEach((link, l) => {
        const cell = row * scene.links.length + l;
        const { semi_axes_m, pose } = scene.obstacles[obstacle[cell]];
        const motion = motions[obstacle[cell]];
        const map = motion ? unit_map(semi_axes_m, motion, 12 * row) : unit_map(semi_axes_m, pose);
        const at = (point) => 3 * (row * scene.points + point);
        const result = criteria(map, points, at(link.start), at(link.end));
        const scale = 4 * (result.start + 1) * (result.end + 1);
        if ([result.start, result.end, result.discriminant / scale].some((value) => Math.abs(value) < 1e-5))
          return void ++undecided;
        assert.equal(result.category, category[cell], `run ${replay.run}, tick ${row}, link ${link.number}`);
        ++found[category[cell]];
        ++kinds[motion ? "moving" : "resting"];
      });
    }
  }
  for (const c of [1, 2, 3, 4]) assert.ok(found[c] > 20, `category ${c} was met ${found[c]} times`);
  for (const kind of ["moving", "resting"]) assert.ok(kinds[kind] > 1000, `${kind} obstacles: ${kinds[kind]}`);
  assert.ok(undecided < 0.02 * found.reduce((a, b) => a + b), `${undecided} within the rounding of single precision`);
});

test("the least distance of the links, less their radius, is the clearance that the program stores", () => {
  const report = sample();
  let checked = 0;
  for (const replay of report.replays) {
    const { scene, link_radius_m } = report.scenarios[report.runs[replay.run].scenario];
    const [points, clearance, category] = [f32(replay.points), f32(replay.clearance_m), u8(replay.category)];
    const motions = scene.obstacles.map(({ motion }) => motion && f32(motion));
    const L = scene.links.length;
    for (let row = 0; row < replay.rows; row += 11) {
      if (category.subarray(row * L, (row + 1) * L).some((c) => c > 2)) continue;
      let least = Infinity;
      for (const link of scene.links) {
        scene.obstacles.forEach(({ semi_axes_m, pose }, o) => {
          const [values, offset] = motions[o] ? [motions[o], 12 * row] : [pose, 0];
          const at = (point) => 3 * (row * scene.points + point);
          least = Math.min(least, segment_distance(semi_axes_m, values, offset, points, at(link.start), at(link.end)));
        });
      }
      assert.ok(
        Math.abs(least - link_radius_m - clearance[row]) < 1e-6,
        `run ${replay.run}, tick ${row}: ${least - link_radius_m}, stored ${clearance[row]}`,
      );
      ++checked;
    }
  }
  assert.ok(checked > 200);
});

test("the distance of a link is the least over its points and the ellipsoid's", () => {
  const random = random_numbers(5);
  let outside = 0;
  for (let n = 0; n < 40; ++n) {
    const axes = [0.1 + random(), 0.1 + random(), 0.1 + random()];
    const R = random_rotation(random);
    const c = [random() - 0.5, random() - 0.5, random() - 0.5];
    const points = Array.from({ length: 6 }, () => 4 * (random() - 0.5));
    const found = segment_distance(axes, pose_of(R, c), 0, points, 0, 3);
    if (criteria(unit_map(axes, pose_of(R, c)), points, 0, 3).category > 2) {
      assert.ok(found < 1e-7, `case ${n} hits`);
      continue;
    }
    ++outside;
    const on_link = (t) => [0, 1, 2].map((k) => points[k] + t * (points[3 + k] - points[k]));
    const at = (polar, around) => {
      const own = [
        axes[0] * Math.sin(polar) * Math.cos(around),
        axes[1] * Math.sin(polar) * Math.sin(around),
        axes[2] * Math.cos(polar),
      ];
      return [0, 1, 2].map((k) => c[k] + own.reduce((sum, value, axis) => sum + R[k][axis] * value, 0));
    };
    let best = Infinity;
    for (let s = 0; s <= 60; ++s) {
      for (let t = 0; t < 120; ++t) {
        const p = at((Math.PI * s) / 60, (2 * Math.PI * t) / 120);
        const [a, b] = [on_link(0), on_link(1)];
        const d = b.map((value, k) => value - a[k]);
        const share = Math.min(
          Math.max(
            d.reduce((sum, value, k) => sum + value * (p[k] - a[k]), 0) /
              d.reduce((sum, value) => sum + value * value, 0),
            0,
          ),
          1,
        );
        const q = on_link(share);
        best = Math.min(best, Math.hypot(...q.map((value, k) => value - p[k])));
      }
    }
    assert.ok(found <= best + 1e-9 && found >= best - 0.01, `case ${n}: ${found}, sampled ${best}`);
  }
  assert.ok(outside > 10);
});

test("names move so that none covers another or a number where there is room, and no more than they have to", () => {
  const random = random_numbers(11);
  const covers = (a, b) =>
    Math.abs(a.x - b.x) < (a.width + b.width) / 2 && Math.abs(a.y - b.y) < (a.height + b.height) / 2;
  const place = (width) => ({ x: 300 * random(), y: 300 * random(), width, height: 16 });
  let moved = 0;
  let crowded = 0;
  for (let trial = 0; trial < 200; ++trial) {
    const names = Array.from({ length: 5 }, () => place(80));
    const numbers = Array.from({ length: 6 }, () => place(10));
    const ways = ways_down(names, numbers);
    const placed = names.map((name, i) => ({ ...name, y: name.y + 16 * ways[i] }));
    names.forEach((_, i) => {
      const before = [...numbers, ...placed.slice(0, i)];
      const free = (way) => !before.some((other) => covers({ ...names[i], y: names[i].y + 16 * way }, other));
      const reach = free(ways[i]) ? Math.abs(ways[i]) - 1 : 5;
      if (reach === 5) assert.equal(ways[i], 0, `name ${i} of trial ${trial} finds no room`);
      if (reach === 5) crowded += 1;
      for (let way = -reach; way <= reach; ++way)
        assert.ok(!free(way), `name ${i} of trial ${trial} has room at ${way}, and is at ${ways[i]}`);
    });
    moved += ways.filter((way) => way !== 0).length;
  }
  assert.ok(moved > 200 && crowded < 20, `${moved} moved, ${crowded} found no room`);
  const pile = Array.from({ length: 12 }, () => ({ x: 0, y: 0, width: 80, height: 16 }));
  assert.equal(new Set(ways_down(pile, []).slice(0, 11)).size, 11);
  assert.equal(ways_down(pile, [])[11], 0, "no room");
});

test("joints with the same limit share its line, which names them all", () => {
  const scene = { lower_rad: [-1, -1, null], upper_rad: [1, 0.5, null], prismatic: [false, false, false] };
  const actor = {
    name: "a",
    scenario: { joints: 3, dt_s: 0.1 },
    scene: { scene },
    replay: { run: { method: 0 }, rows: 2, q: new Float32Array(6) },
  };
  const marks = (only) =>
    joints_chart([{ letter: "", actor }], only)
      .option(kLightTheme)
      .series.flatMap(({ markLine }) => markLine.data);
  const lines_of = (only) => marks(only).map(({ yAxis, label }) => [label.formatter, yAxis]);
  const close = (got, expected) => {
    assert.deepEqual(
      got.map(([text]) => text),
      expected.map(([text]) => text),
    );
    got.forEach(([, value], i) => assert.ok(Math.abs(value - (expected[i][1] * 180) / Math.PI) < 1e-9));
  };
  close(lines_of(null), [
    ["q1, q2 least", -1],
    ["q1 most", 1],
    ["q2 most", 0.5],
  ]);
  assert.equal(new Set(marks(null).map(({ label }) => label.position)).size, 3, "labels beside each other");
  close(lines_of(1), [
    ["q2 least", -1],
    ["q2 most", 0.5],
  ]);
});
