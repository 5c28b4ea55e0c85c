"""The command export, by independent readers of its formats: Python's json, csv and sqlite3."""
import csv
import json
import pathlib
import sqlite3
import tempfile
import unittest

from made_up_results import (call, fail, hostile_records, of_a_real_arm, of_campaign, record, records, write,
                             write_plan)

TIMES = ["time", "construct_s", "prepare_s", "plan_s", "first_step_s", "warm_median_s", "warm_p99_s",
         "warm_p999_s", "warm_max_s", "warm_max_tick", "cpu_s", "hidden_cpu_s"]

# Column: where a record has it. Written down once more, and not taken from the program.
FIGURES = {
    "solved": "judged.success", "claim_holds": "claim_holds", "claim_tick": "claimed.tick",
    "claim_link": "claimed.link", "nearest_free_rad": "claimed.nearest_free_rad",
    "joint_noise_rad": "disturbance.joint_noise_rad", "latency_ticks": "disturbance.latency_ticks",
    "judged_rows": "judged.rows", "touching": "judged.touching", "clearance_m": "judged.clearance_m",
    "clearance_at_ticks_m": "judged.clearance_at_ticks_m", "start_error_m": "judged.start_error_m",
    "self_clearance_at_ticks_m": "judged.self_collision.clearance_at_ticks_m",
    "max_joint_step_rad": "judged.max_joint_step_rad", "max_joint_step_tick": "judged.max_joint_step_tick",
    "max_joint_slide_m": "judged.max_joint_slide_m", "max_joint_slide_tick": "judged.max_joint_slide_tick",
    "free_ticks": "ticks.free", "clamped_ticks": "ticks.clamped", "unclaimed_ticks": "ticks.unclaimed",
    "increments_total": "ticks.increments_total", "increments_max": "ticks.increments_max",
    "increments_tick_mean": "ticks.increments_tick_mean",
    "increments_tick_median": "ticks.increments_tick_median",
    "increments_tick_p99": "ticks.increments_tick_p99", "increments_tick_max": "ticks.increments_tick_max",
    "guard_fired_ticks": "ticks.guard_fired", "times_publishable": "times.publishable",
    "includes_pipe": "times.includes_pipe", "warm_steps": "times.warm_steps",
    "repetition": "campaign.repetition"}
FIGURES |= {f"tip_error_{where}_{figure}": f"judged.tip_error_{where}.{figure}"
            for where in ("at_ticks", "between_ticks")
            for figure in ("mean_m", "rms_m", "max_m", "max_x_m", "max_y_m", "max_z_m", "max_tick")}
FIGURES |= {f"orientation_{where}_{figure}": f"judged.orientation_{where}.{figure}"
            for where in ("at_ticks", "between_ticks") for figure in ("mean_rad", "max_rad", "max_tick")}
FIGURES |= {name: f"motion.{name}"
            for name in ("closed_path_drift_rad", "closed_path_drift_joint_rad", "manipulability_min",
                         "manipulability_mean", "singular_value_min_m", "null_space_share",
                         "jerk_rms_rad_s3")} | {"clamp_starts": "ticks.clamp_starts"}
FIGURES |= {name: f"counters.{name}" for name in ("quadratics", "bounds", "point_pairs", "distance_queries",
                                                  "kinematics", "jacobians", "linear_solves", "iterations")}
FIGURES |= {name: f"times.{name}" for name in TIMES if name != "time"} | {"time": "times.run_s"}
# What a scenario need not have.
PROPERTIES = {"robot": "problem.robot", "orientation": "problem.orientation",
              "orientation_tolerance_rad": "problem.orientation_tolerance_rad",
              "reference_clearance_m": "scenario.reference_clearance_m"}
ENUMS = {"claim": "claimed.status", "gave_up_because": "claimed.reason", "gave_up_class": "claimed.class"}


def at(run, path):
    for key in path.split("."):
        run = run.get(key) if run is not None else None
    return run


def expected(run, column):
    if column in TIMES and not run["judged"]["success"]:
        return None
    return at(run, FIGURES[column])


def status(run):
    failures = run["judged"]["failures"]
    return next((f for f in failures if f != "incomplete"), "incomplete") if failures else "success"


def printable(text):
    """What the program makes of control characters."""
    return "".join(" " if ord(c) < 0x20 or 0x7f <= ord(c) < 0xa0 else c for c in text)


class ExportTest(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.place = pathlib.Path(directory.name)
        self.results = self.place / "results"

    def export(self, *formats, status_=0):
        result = call("export", self.results, *formats)
        self.assertEqual(result.returncode, status_, result.stderr)
        return result

    def database(self):
        self.export("--planner-arena", self.place / "runs.db")
        database = sqlite3.connect(self.place / "runs.db")
        self.addCleanup(database.close)
        database.row_factory = sqlite3.Row
        self.assertEqual(database.execute("PRAGMA integrity_check").fetchone()[0], "ok")
        self.assertEqual(database.execute("PRAGMA foreign_key_check").fetchall(), [])
        return database

    def csv_rows(self):
        self.export("--csv", self.place / "runs.csv")
        with open(self.place / "runs.csv", newline="", encoding="utf-8") as stream:
            return list(csv.DictReader(stream, strict=True, restkey="too many", restval="too few"))

    def assert_same(self, stored, value, what):
        """Equal to the last bit; SQLite has 0 and 1 for truths, and does not know -0."""
        if isinstance(value, bool):
            value = int(value)
        self.assertEqual(stored, value, what)
        self.assertEqual(stored is None, value is None, what)


class Database(ExportTest):
    def check_runs(self, runs):
        write(self.results, runs)
        database = self.database()
        rows = database.execute("SELECT runs.*, provenance.record FROM runs JOIN provenance"
                                " ON runs.id = runid").fetchall()
        judged = [run for run in runs if run["judged"] is not None]
        self.assertEqual(len(rows), len(judged))
        enums = {(name, value): text for name, value, text in database.execute("SELECT * FROM enums")}
        for row in rows:
            run = runs[int(row["record"].split(":")[1]) - 1]
            for column in FIGURES:
                self.assert_same(row[column], expected(run, column), (row["record"], column))
            for column, path in ENUMS.items():
                text = enums[column, row[column]] if row[column] is not None else None
                self.assertEqual(text, at(run, path), column)
            self.assertEqual(enums["status", row["status"]], status(run))
            self.assertEqual(row["contact_pairs"], len(run["judged"]["contacts"]))
        return database

    def test_holds_every_figure_of_every_run(self):
        self.check_runs(records())

    def test_holds_the_figures_of_the_motion(self):
        run = record()
        names = [path.split(".")[1] for path in FIGURES.values() if path.startswith("motion.")]
        run["motion"] = {name: 0.1 + i for i, name in enumerate(names)} | {names[1]: None}
        run["ticks"]["clamp_starts"] = 7
        run["judged"]["self_collision"] = {"contacts": [], "clearance_at_ticks_m": 0.25}
        run["judged"].update(max_joint_slide_m=0.125, max_joint_slide_tick=9)
        self.check_runs([run, record("none")])

    def test_holds_what_only_some_scenarios_have(self):
        runs = [record(), of_a_real_arm(record("qp"))]
        database = self.check_runs(runs)
        plain, full = database.execute("SELECT * FROM experiments").fetchall()
        for column, path in PROPERTIES.items():
            self.assertEqual(plain[column], None)
            expected_ = at(runs[1], path)
            self.assertEqual(full[column],
                             expected_.replace(" ", "_") if isinstance(expected_, str) else expected_, column)
        self.assertEqual([float(word) for word in full["link_radii_m"].split()], [0.07, 0.05, 0.1 + 0.2])
        for row, expected_ in ((plain, (0, 0, 0, 0)), (full, (0.07, 1, 0.025, 0.003))):
            self.assertEqual(tuple(row[column] for column in ("link_radius_m", "solids", "gap_lost_m",
                                                              "radius_excess_m")), expected_)

    def test_keeps_hostile_names_and_numbers(self):
        runs = hostile_records()
        database = self.check_runs(runs)
        for row in database.execute("SELECT *, contacts.obstacle AS touched, provenance.seed AS digits"
                                    " FROM provenance"
                                    " JOIN claims USING (runid) JOIN contacts USING (runid)"
                                    " JOIN trajectories USING (runid)"
                                    " JOIN origins ON originid = origins.id"
                                    " JOIN runs ON runid = runs.id"
                                    " JOIN plannerConfigs ON plannerid = plannerConfigs.id"):
            run = runs[int(row["record"].split(":")[1]) - 1]
            name = printable(run["method"]["variant"])
            self.assertEqual(row["name"], name)
            for column in ("message", "touched", "disagreement", "date"):
                self.assertEqual(row[column], name or None, column)
            for column in ("processor", "os", "host", "command_line", "external_command", "out_of_tree"):
                self.assertEqual(row[column], name, column)
            self.assertEqual(row["file"], name)
            self.assertEqual(int(row["digits"]), run["provenance"]["seed"])
            parameters = dict(database.execute("SELECT name, value FROM parameters WHERE plannerid = ?",
                                               (row["plannerid"],)))
            self.assertEqual(parameters, {printable(key): value if key != "text" else name for key, value
                                          in run["method"]["parameters"].items()})
            counters = dict(database.execute("SELECT name, value FROM counters WHERE runid = ?",
                                             (row["runid"],)))
            self.assertEqual(counters, {printable(k): v for k, v in run["counters"].items()})

    def test_a_scenario_with_other_bytes_is_another_experiment(self):
        first, second = record(), record()
        second["scenario"]["sha256"] = "0" * 64
        write(self.results, [first, second])
        rows = self.database().execute("SELECT name, scenario, scenario_sha256, links, obstacles, nk, joints"
                                       " FROM experiments").fetchall()
        self.assertEqual([tuple(row) for row in rows],
                         [("planar_7r", "planar_7r", first["scenario"]["sha256"], 7, 2, 14, 7),
                          ("planar_7r", "planar_7r", "0" * 64, 7, 2, 14, 7)])

    def test_sizes_of_a_family_have_one_name(self):
        runs = []
        for number in (1, 2):
            runs.append(record())
            runs[-1]["scenario"]["name"] = f"crowd_s4_{number:05}"
        write(self.results, runs)
        rows = self.database().execute("SELECT name, scenario FROM experiments").fetchall()
        self.assertEqual([tuple(row) for row in rows],
                         [("crowd", "crowd_s4_00001"), ("crowd", "crowd_s4_00002")])

    def test_an_experiment_has_what_its_runs_agree_on(self):
        first, second = record(), record("qp")
        second["provenance"].update(host="other", version="0.2.0", seed=7,
                                    date="2020-01-01T00:00:00Z")
        first["provenance"].update(host="one", wall_limit_s=600.0, memory_limit_bytes=2**30)
        write(self.results, [first, second])
        row = self.database().execute("SELECT * FROM experiments").fetchone()
        self.assertEqual((row["hostname"], row["version"], row["seed"], row["date"]),
                         ("several", "bqsa-bench several", "several", "2020-01-01T00:00:00Z"))
        self.assertEqual((row["timelimit"], row["memorylimit"], row["runcount"]), (600, 4096, 1))
        self.assertEqual(row["totaltime"], first["times"]["run_s"] + second["times"]["run_s"])
        self.assertIn("processor: AMD EPYC\n", row["cpuinfo"])

    def test_a_trajectory_belongs_to_the_last_run_that_wrote_it(self):
        first, second = record(), record()
        second["scenario"]["sha256"] = "0" * 64
        write(self.results, [first, second])
        rows = self.database().execute("SELECT record, file FROM trajectories"
                                       " JOIN provenance USING (runid)").fetchall()
        self.assertEqual([tuple(row) for row in rows],
                         [("runs.jsonl:2", "trajectories/planar_7r/bqsa.csv")])

    def test_other_settings_are_another_configuration_of_the_same_name(self):
        first, second, third = record(), record(), record()
        second["method"]["parameters"]["increment"] = 0.5
        second["scenario"]["name"] = "other"
        third["scenario"]["name"] = "third"
        write(self.results, [first, second, third])
        database = self.database()
        self.assertEqual([tuple(row) for row in database.execute("SELECT id, name FROM plannerConfigs")],
                         [(1, "bqsa"), (2, "bqsa")])
        self.assertEqual([row[0] for row in database.execute("SELECT plannerid FROM runs")], [1, 2, 1])

    def test_a_failed_run_has_no_time(self):
        write(self.results, [record(), fail(record("qp"))])
        rows = self.database().execute("SELECT solved, time, warm_median_s FROM runs").fetchall()
        self.assertEqual(tuple(rows[0])[0], 1)
        self.assertGreater(rows[0]["time"], 0)
        self.assertEqual(tuple(rows[1]), (0, None, None))

    def test_no_foreign_journal_is_taken_for_ours(self):
        write(self.results, [record()])
        journal = self.place / "runs.db-journal"
        journal.write_text("of someone else")
        result = self.export("--planner-arena", self.place / "runs.db", status_=2)
        self.assertIn("with the journal", result.stderr)
        self.assertFalse((self.place / "runs.db").exists())


class CommaSeparated(ExportTest):
    def check(self, runs):
        write(self.results, runs)
        rows = self.csv_rows()
        self.assertEqual(len(rows), sum(run["judged"] is not None for run in runs))
        for row in rows:
            self.assertNotIn("too many", row)
            self.assertNotIn("too few", row.values())
            run = runs[int(row["record"].split(":")[1]) - 1]
            for column in FIGURES:
                text = row[column if column != "time" else "run_s"]
                value = expected(run, column)
                if value is None:
                    self.assertEqual(text, "", column)
                else:
                    self.assertEqual(float(text), float(value), column)
            for column, path in ENUMS.items():
                self.assertEqual(row[column], at(run, path) or "", column)
            for column, path in PROPERTIES.items():
                value = at(run, path)
                self.assertEqual(row[column], printable(value) if isinstance(value, str) else
                                 "" if value is None else repr(value), column)
            self.assertEqual([float(word) for word in row["link_radii_m"].split()],
                             run["problem"].get("link_radii_m", []))
            geometry = run["problem"].get("geometry") or {}
            self.assertEqual(int(row["solids"]), len(geometry.get("solids", [])))
            for column in ("gap_lost_m", "radius_excess_m"):
                self.assertEqual(float(row[column]), geometry.get(column, 0))
            self.assertEqual(row["status"], status(run))
            self.assertEqual(row["seed"], str(run["provenance"]["seed"]))
            for column, path in {"scenario": "scenario.name", "scenario_sha256": "scenario.sha256",
                                 "scenario_file": "scenario.file", "method": "method.name",
                                 "variant": "method.variant", "changed_parameters": "method.changed",
                                 "trajectory": "trajectory", "date": "provenance.date",
                                 "processor": "provenance.processor"}.items():
                self.assertEqual(row[column], printable(at(run, path) or ""), column)
            parameters = {name.removeprefix("parameter."): value for name, value in row.items()
                          if name.startswith("parameter.") and value != ""}
            recorded = {printable(name): value for name, value in run["method"]["parameters"].items()}
            self.assertEqual(parameters.keys(), {name for name, v in recorded.items() if v != ""})
            for name, text in parameters.items():
                if isinstance(recorded[name], str):
                    self.assertEqual(text, printable(recorded[name]))
                else:
                    self.assertEqual(float(text), recorded[name])

    def test_reads_back_as_the_records(self):
        self.check(records())

    def test_holds_what_only_some_scenarios_have(self):
        self.check([record(), of_a_real_arm(record("qp")), of_a_real_arm(record("none"), "a, b\nc")])

    def test_keeps_hostile_names_and_numbers(self):
        self.check(hostile_records())

    def test_has_the_lines_of_the_standard(self):
        write(self.results, hostile_records())
        self.csv_rows()
        data = (self.place / "runs.csv").read_bytes()
        self.assertTrue(data.endswith(b"\r\n"))
        self.assertEqual(data.count(b"\n"), data.count(b"\r\n"))  # no text has a line break
        header = data.split(b"\r\n")[0].decode()
        self.assertNotIn(" ", header.split(",parameter.")[0])


class GoogleBenchmark(ExportTest):
    def entries(self):
        self.export("--google-benchmark", self.place / "runs.json")
        return json.loads((self.place / "runs.json").read_text(encoding="utf-8"))["benchmarks"]

    def test_times_are_of_successes_with_their_number(self):
        runs = [record("ompl") for _ in range(4)]
        for seed, run in enumerate(runs):
            run["method"]["seed"] = run["provenance"]["seed"] = seed + 1
            run["times"]["plan_s"] = 0.5 + seed
        fail(runs[0])
        write(self.results, runs + [fail(record("qp"))])
        entries = self.entries()
        self.assertEqual([(e["name"], e["real_time"]) for e in entries if e["run_type"] == "iteration"],
                         [("planar_7r/ompl/plan", 1e9 * time) for time in (1.5, 2.5, 3.5)])
        aggregates = {e["aggregate_name"]: e["cpu_time"] for e in entries if e["run_type"] == "aggregate"}
        self.assertEqual(aggregates["median"], 2.5e9)
        self.assertAlmostEqual(aggregates["mean"], 2.5e9, delta=1)
        self.assertAlmostEqual(aggregates["stddev"], 1e9, delta=1)
        for entry in entries:
            self.assertEqual((entry["runs"], entry["successes"], entry["label"]),
                             (4, 3, "3 of 4 runs judged a success"))

    def test_steps_have_a_median_and_a_high_quantile(self):
        write(self.results, [record()])
        times = {e["name"]: e["real_time"] for e in self.entries() if e["run_type"] == "iteration"}
        self.assertEqual(times.keys(), {"planar_7r/bqsa/step_median", "planar_7r/bqsa/step_p99"})
        self.assertAlmostEqual(times["planar_7r/bqsa/step_median"],
                               1e9 * record()["times"]["warm_median_s"])

    def test_files_of_one_name_are_told_apart(self):
        other = record()
        other["scenario"]["sha256"] = "0123456789" + "0" * 54
        write(self.results, [record(), other])
        names = {e["name"].split("/")[0] for e in self.entries()}
        self.assertEqual(names, {"planar_7r@3ea948e8", "planar_7r@01234567"})

    def test_our_own_comparison_reads_it(self):
        write(self.results, records())
        self.entries()
        result = call("compare", self.place / "runs.json", self.place / "runs.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("0 better, 0 worse", result.stdout)

    def test_says_why_times_are_only_indicative(self):
        slow, other = record(), record("qp")
        slow["times"]["against"] = ["assertions on"]
        other["provenance"]["processor"] = "Another"
        write(self.results, [slow, other])
        self.entries()
        ours = json.loads((self.place / "runs.json").read_text(encoding="utf-8"))["context"]["bqsa"]
        self.assertEqual(ours["against"], ["assertions on", "processors: AMD EPYC, Another"])
        self.assertFalse(ours["publishable"])


class WhatCounts(ExportTest):
    def exported(self, status_=0):
        result = self.export("--csv", self.place / "runs.csv", status_=status_)
        with open(self.place / "runs.csv", newline="", encoding="utf-8") as stream:
            return result, [row["record"] for row in csv.DictReader(stream)]

    def test_the_last_of_a_scenario_and_method_counts_in_place_of_the_first(self):
        write(self.results, [record(), record("qp"), fail(record())])
        result, rows = self.exported()
        self.assertEqual(rows, ["runs.jsonl:3", "runs.jsonl:2"])
        self.assertIn("2 runs of 1 scenario\nleft out: 1 repeated later\n", result.stdout)

    def test_pairs_that_do_not_fit_are_no_runs(self):
        write(self.results, records())
        result, rows = self.exported()
        judged = [i for i, run in enumerate(records(), 1) if run["judged"] is not None]
        self.assertEqual(sorted(int(row.split(":")[1]) for row in rows), judged)
        self.assertIn("left out: 3 not applicable\n", result.stdout)

    def test_bad_lines_are_reported_and_left_out(self):
        lying = record("qp")
        lying["judged"]["success"] = False
        unknown = fail(record("qp"), "bored")
        odd = record("qp")
        odd["method"]["parameters"] = 3
        endless = record("qp")
        endless["problem"]["dt_s"] = None
        write(self.results, [record(), "{}\n", lying, "garbage\n", unknown, odd, endless,
                             json.dumps(record("ompl"))[:-7]])
        result, rows = self.exported(status_=2)
        self.assertEqual(rows, ["runs.jsonl:1"])
        for line, why in {2: "not a run record: schema: missing", 3: "judged.success: contradicts",
                          4: "cut short or damaged",
                          5: "judged.failures: expected one of success, disagreement",
                          6: "method.parameters: expected an object",
                          7: "problem.dt_s: expected a number", 8: "cut short or damaged"}.items():
            self.assertRegex(result.stderr, rf"runs\.jsonl:{line}: .*{why}")
        self.assertIn("got bored", result.stderr)

    def test_shards_count_complete_ones_first(self):
        write(self.results, [record()], "shards/10-of-12.jsonl")
        write(self.results, [record("qp")], "shards/2-of-12.jsonl")
        write(self.results, [record("ompl")], "shards/1-of-12.part.jsonl")
        for name in ("13-of-12.jsonl", "0-of-12.jsonl", "a-of-12.jsonl",
                     "4-of-12.jsonl.tmp", "notes.jsonl"):
            write(self.results, ["garbage\n"], f"shards/{name}")
        shards = ["shards/2-of-12.jsonl:1", "shards/10-of-12.jsonl:1", "shards/1-of-12.part.jsonl:1"]
        self.assertEqual(self.exported()[1], shards)
        write(self.results, [fail(record("qp")), record("fcl_gp")])
        self.assertEqual(self.exported()[1], [shards[0], "runs.jsonl:2"] + shards[1:])

    def test_repetitions_of_a_campaign_are_runs_of_their_own(self):
        runs = [of_campaign(record(), f"{i:032x}", i) for i in (1, 2, 3)]
        write(self.results, runs + [of_campaign(record(), f"{2:032x}", 2)])
        rows = self.exported()[1]
        self.assertEqual(rows, ["runs.jsonl:1", "runs.jsonl:4", "runs.jsonl:3"])
        row = self.csv_rows()[1]
        self.assertEqual([row[name] for name in ("campaign", "campaign_key", "repetition", "host", "jobs",
                                                 "restarts")],
                         ["camp", f"{2:032x}", "2", "node7", "4", "2"])

    def test_a_plan_says_what_counts_and_in_which_order(self):
        runs = [of_campaign(record(), key, 1) for key in ("c", "a", "stale")] + [record("qp")]
        write(self.results, runs)
        write_plan(self.results, ["a", "b", "c"])
        result, rows = self.exported()
        self.assertEqual(rows, ["runs.jsonl:2", "runs.jsonl:1"])
        self.assertIn("left out: 2 stale, not of the campaign's plan\n", result.stdout)

    def test_a_broken_plan_stops(self):
        write(self.results, [record()])
        write(self.results, ['{"schema": "bqsa-plan/1"\n'], "plan.jsonl")
        self.assertIn("plan.jsonl:1: ", self.export("--csv", self.place / "x.csv", status_=2).stderr)


class Files(ExportTest):
    def setUp(self):
        super().setUp()
        write(self.results, [record()])

    def refused(self, *formats):
        return self.export(*formats, status_=2).stderr

    def test_a_file_is_replaced_whole_or_stays(self):
        file = self.place / "runs.csv"
        file.write_text("old")
        self.export("--csv", file)
        self.assertTrue(file.read_text().startswith("scenario,"))
        self.assertEqual(sorted(p.name for p in self.place.iterdir()), ["results", "runs.csv"])
        self.assertIn("expected a file that can be written", self.refused("--csv", self.results))
        self.assertIn("expected a file that can be written",
                      self.refused("--planner-arena", self.place / "missing" / "runs.db"))

    def test_the_records_are_not_overwritten(self):
        before = (self.results / "runs.jsonl").read_bytes()
        self.assertIn("got the records", self.refused("--csv", self.results / "." / "runs.jsonl"))
        self.assertEqual((self.results / "runs.jsonl").read_bytes(), before)

    def test_a_file_for_each_format(self):
        self.assertIn("got one for two", self.refused("--csv", self.place / "x",
                                                      "--planner-arena", self.place / "." / "x"))
        self.assertIn("expected --ompl-log, --planner-arena, --csv or --google-benchmark",
                      self.refused())

    def test_a_log_holds_one_scenario(self):
        log = self.place / "one.log"
        self.export("--ompl-log", log)
        self.assertTrue(log.read_text().startswith("bqsa-bench version 0.1.0\nExperiment planar_7r\n"))
        write(self.results, records())
        self.assertIn("there are 3 scenario files, and a log holds one",
                      self.refused("--ompl-log", self.place / "three.log"))

    def test_a_directory_has_the_logs_of_the_last_export_and_keeps_other_files(self):
        logs = self.place / "deep" / "logs"
        write(self.results, records())
        self.export("--ompl-log", logs)
        (logs / "notes.log").write_text("mine")
        write(self.results, [record("qp")])
        self.export("--ompl-log", logs)
        self.assertEqual(sorted(p.name for p in logs.iterdir()), ["000001_planar_7r.log", "notes.log"])

    def test_nothing_to_export_is_said(self):
        write(self.results, [run for run in records() if run["judged"] is None])
        self.assertIn("expected runs that were judged, got none", self.refused("--csv", self.place / "x"))
        self.assertIn("cannot read", call("export", self.place / "none", "--csv", "x").stderr)

    def test_the_same_results_give_the_same_bytes(self):
        write(self.results, records())
        files = []
        for name in ("a", "b"):
            file = self.place / name
            self.export("--planner-arena", file)
            files.append(file.read_bytes())
        self.assertEqual(files[0], files[1])


if __name__ == "__main__":
    unittest.main()
