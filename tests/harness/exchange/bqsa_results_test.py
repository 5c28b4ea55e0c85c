"""The reader in Python, against the program and against records that are made up here."""
import csv
import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import warnings

from made_up_results import (ROOT, call, fail, hostile_records, of_a_real_arm, of_campaign, record, records,
                             write, write_plan)

sys.path.insert(0, str(ROOT / "python"))
import bqsa_results  # noqa: E402

NOTEBOOK = ROOT / "examples/results_notebook.py"


class ReaderTest(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.place = pathlib.Path(directory.name) / "results"

    def load(self, runs, warns=()):
        """What load() makes of runs, which has to warn of these, in order."""
        write(self.place, runs)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            loaded = bqsa_results.load(self.place)
        self.assertEqual(len(caught), len(warns), [str(w.message) for w in caught])
        for warning, expected in zip(caught, warns):
            self.assertIn(expected, str(warning.message))
        return loaded


class Loading(ReaderTest):
    def test_records_are_read_as_they_are(self):
        runs = self.load(records())
        judged = [run for run in records() if run["judged"] is not None]
        self.assertEqual([run.record for run in runs], judged)
        self.assertEqual(len(runs.not_applicable), 3)
        self.assertEqual(runs.not_applicable[0].status, "not applicable")
        run = runs.filter(variant="bqsa", scenario__name="planar_7r")[0]
        self.assertEqual(run.judged.tip_error_at_ticks.max_tick,
                         run.record["judged"]["tip_error_at_ticks"]["max_tick"])
        self.assertEqual(run.method.parameters["release"], "last")
        self.assertIs(run.times.plan_s, None)
        with self.assertRaisesRegex(AttributeError, "no 'clearence_m'; it has success"):
            print(run.judged.clearence_m)

    def test_hostile_names_are_kept(self):
        runs = self.load(hostile_records())
        self.assertEqual([run.variant for run in runs], [r["method"]["variant"] for r in hostile_records()])

    def test_lines_that_are_no_records_are_warned_of_and_left_out(self):
        lying = record("qp")
        lying["judged"]["success"] = False
        nameless = record("qp")
        del nameless["scenario"]["name"]
        runs = self.load([record(), "\n", "garbage\n", "{}\n", lying, nameless, "[NaN]\n",
                          record("ompl"), json.dumps(record("qp"))[:-9]],
                         ["runs.jsonl:3: cut short", "runs.jsonl:4: not a record of bqsa-run/1",
                          "runs.jsonl:5: not a run record: judged.success contradicts",
                          "runs.jsonl:6: not a run record: scenario.name",
                          "runs.jsonl:7: cut short", "runs.jsonl:9: cut short"])
        self.assertEqual([run.variant for run in runs], ["bqsa", "ompl"])

    def test_text_that_is_not_utf_8_is_damage(self):
        self.load([record()])
        with open(self.place / "runs.jsonl", "ab") as stream:
            stream.write(json.dumps(record("qp")).replace("AMD", "\\u00e4").encode("ascii") + b"\n")
            stream.write(b'{"schema": "\xff"}\n')
        with self.assertWarnsRegex(UserWarning, "runs.jsonl:3: cut short or damaged"):
            self.assertEqual(len(bqsa_results.load(self.place)), 2)

    def test_the_last_run_counts_in_place_of_the_first(self):
        runs = self.load([record(), record("qp"), fail(record())])
        self.assertEqual([(run.variant, run.success) for run in runs], [("bqsa", False), ("qp", True)])
        self.assertEqual(runs.superseded, 1)

    def test_other_bytes_seeds_and_repetitions_are_other_runs(self):
        other, seeded = record("ompl"), record("ompl")
        other["scenario"]["sha256"] = "0" * 64
        seeded["method"]["seed"] = 2
        campaign = [of_campaign(record("ompl"), str(i), i) for i in (1, 2)]
        self.assertEqual(len(self.load([record("ompl"), other, seeded] + campaign)), 5)

    def test_shards_count_complete_ones_first(self):
        write(self.place, [record("qp")], "shards/2-of-12.jsonl")
        write(self.place, [record()], "shards/10-of-12.jsonl")
        write(self.place, [record("fcl_gp")], "shards/1-of-12.part.jsonl")
        write(self.place, ["garbage"], "shards/13-of-12.jsonl")
        self.assertEqual([run.variant for run in bqsa_results.load(self.place)], ["qp", "bqsa", "fcl_gp"])
        runs = self.load([fail(record("qp")), record("ompl")])
        self.assertEqual([(run.variant, run.judged.success) for run in runs],
                         [("qp", True), ("ompl", True), ("bqsa", True), ("fcl_gp", True)])

    def test_a_plan_says_what_counts_and_in_which_order(self):
        write_plan(self.place, ["a", "b", "c"])
        runs = self.load([of_campaign(record(), key) for key in ("c", "a", "old")] + [record("qp")],
                         ["2 stale records, not of the plan, are left out"])
        self.assertEqual([run.key for run in runs], ["a", "c"])
        self.assertEqual((runs.stale, runs.missing), (2, 1))

    def test_a_plan_that_is_cut_short_is_none(self):
        write_plan(self.place, ["a", "b"])
        lines = (self.place / "plan.jsonl").read_text().splitlines(keepends=True)
        write(self.place, lines[:2], "plan.jsonl")
        write(self.place, [record()])
        with self.assertRaisesRegex(ValueError, "expected a whole plan"):
            bqsa_results.load(self.place)

    def test_no_results_are_an_error(self):
        with self.assertRaisesRegex(FileNotFoundError, "runs.jsonl"):
            bqsa_results.load(self.place)

    def test_counts_what_the_export_counts(self):
        """The same runs in the same order as bqsa-bench export, whatever is wrong with the directory."""
        write_plan(self.place, ["e", "b", "c", "a"])
        runs = [of_campaign(record(variant), key) for key, variant in
                (("a", "bqsa"), ("b", "qp"), ("d", "ompl"), ("a", "bqsa"), ("c", "bqsa_projection"))]
        write(self.place, runs[1:2], "shards/1-of-2.jsonl")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            loaded = self.load(runs + ["{"], ["cut short", "1 stale"])
        file = self.place.parent / "runs.csv"
        self.assertEqual(call("export", self.place, "--csv", file).returncode, 2)
        with open(file, newline="", encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([run.variant for run in loaded], [row["variant"] for row in rows])
        self.assertEqual(len(rows), 2)


class Questions(ReaderTest):
    def test_success_rates_are_those_that_the_program_prints(self):
        runs = []
        for variant, successes, total in (("bqsa", 9, 40), ("qp", 39, 40), ("none", 0, 40), ("ompl", 40, 40)):
            for number in range(total):
                run = record(variant)
                run["scenario"]["name"] = f"many_s1_{number:05}"
                if variant != "none" and number >= successes:
                    fail(run)
                runs.append(run)
        loaded = self.load(runs)
        printed = call("show", self.place, "--summary").stdout
        for variant, group in loaded.group_by("variant").items():
            rate = group.success_rate()
            line = next(line for line in printed.splitlines()
                        if re.search(rf"\b{variant} ", line) and f"{rate.lower * 100:.1f}" in line)
            numbers = re.findall(r"[0-9.]+", line.partition(variant)[2])
            for expected in (rate.runs, rate.successes):
                self.assertIn(str(expected), numbers, line)
            for expected in (rate.share, rate.lower, rate.upper):
                self.assertIn(f"{100 * expected:.1f}", numbers, line)

    def test_wilson_intervals_are_those_of_the_formula(self):
        for runs in (1, 7, 50, 2000):
            for successes in {0, 1, runs // 2, runs}:
                lower, upper = bqsa_results.wilson_interval(successes, runs)
                for end in (lower, upper):  # where the share is 1.96 deviations away
                    deviation = (end * (1 - end) / runs) ** 0.5
                    self.assertAlmostEqual(abs(successes / runs - end), 1.959963984540054 * deviation)
                self.assertLessEqual(lower, successes / runs + 1e-12)
                self.assertGreaterEqual(upper, successes / runs - 1e-12)
        self.assertEqual(bqsa_results.wilson_interval(0, 0), (0, 1))

    def test_groups_are_in_order_of_appearance(self):
        runs = self.load(records())
        groups = runs.group_by("scenario.name", "success")
        self.assertEqual(list(groups)[:2], [("planar_7r", False), ("planar_7r", True)])
        self.assertEqual(sum(map(len, groups.values())), len(runs))
        by_parameter = runs.group_by("method.parameters.increment")
        self.assertEqual(set(by_parameter), {None, 0.002})
        self.assertEqual(list(runs.group_by(lambda run: run.problem.dimension)), [2, 3])

    def test_robots_are_told_apart_by_name(self):
        nameless = record("qp")
        nameless["problem"]["robot"] = None
        runs = self.load([record(), nameless, of_a_real_arm(record()), of_a_real_arm(fail(record("qp"))),
                          of_a_real_arm(record(), "UR5e")])
        self.assertEqual({robot: (len(group), len(group.filter(success=True)))
                          for robot, group in runs.group_by("robot").items()},
                         {None: (2, 2), "KUKA LBR iiwa 14": (2, 1), "UR5e": (1, 1)})

    def test_filters_take_conditions_and_values(self):
        runs = self.load(records())
        found = runs.filter(lambda run: run.problem.joints == 6, success=False, method__name="none")
        self.assertEqual([run.scenario.name for run in found], ["puma560_ellipsoid", "puma560_wall"])
        self.assertEqual(runs.filter(status="drift"), [run for run in runs if run.status == "drift"])
        self.assertEqual(len(runs.filter(family="planar_7r")), 17)

    def test_an_invalid_run_has_no_time(self):
        runs = self.load([record(), fail(record("qp"))])
        self.assertEqual(len(runs.values("times.warm_median_s")), 1)
        self.assertEqual(len(runs.values("judged.clearance_m")), 2)
        self.assertEqual(runs[1].valid_times, {})
        self.assertIs(runs.filter(success=False).step_time(0.5), None)

    def test_pooled_step_times_are_those_that_the_program_prints(self):
        runs = self.load(records())
        printed = call("show", self.place, "--summary").stdout
        block = printed[printed.index("\ntime "):printed.index("\nplans ")]
        numbers = re.search(r"^planar_7r\n.*?^  bqsa +[0-9]+ +([0-9.]+) +([0-9.]+)", block, re.MULTILINE | re.DOTALL)
        group = runs.filter(family="planar_7r", variant="bqsa")
        for share, number in ((0.5, numbers[1]), (0.99, numbers[2])):
            self.assertEqual(f"{1e6 * group.step_time(share):.3g}", number)

    def test_the_most_telling_failure_is_the_status(self):
        run = fail(record())
        run["judged"]["failures"] = ["incomplete", "collision", "drift"]
        self.assertEqual(self.load([run])[0].status, "collision")
        run["judged"]["failures"] = ["incomplete"]
        self.assertEqual(self.load([run])[0].status, "incomplete")

    def test_families_are_those_of_the_program(self):
        names = {"planar_s4_00012": "planar", "planar_7r": "planar_7r", "narrow_s1_00001": "narrow",
                 "crowd_k8": "crowd_k", "crowd_8": "crowd", "a--12": "a", "12": "12", "s1_2": "s1",
                 "_s1_2": "_s1", "x_s1_y": "x_s1_y", "x_s_1": "x_s"}
        runs = []
        for number, name in enumerate(names):
            runs.append(record())
            runs[-1]["scenario"].update(name=name, sha256=f"{number:064x}")
        loaded = self.load(runs)
        self.assertEqual([run.family for run in loaded], list(names.values()))
        file = self.place.parent / "runs.csv"
        call("export", self.place, "--csv", file)
        rows = file.read_text(encoding="utf-8").splitlines()[1:]
        self.assertEqual([row.split(",")[3] for row in rows], list(names.values()))


class Trajectories(ReaderTest):
    def test_are_read_when_asked_for(self):
        runs = self.load([record()])
        with self.assertRaises(FileNotFoundError):
            print(runs[0].trajectory)
        write(self.place, ["t,q1,q2\n0,0.25,-1\n0.5,0.5,-1.5\n"], runs[0].record.trajectory)
        trajectory = runs[0].trajectory
        self.assertEqual((trajectory.t, trajectory.q), ([0, 0.5], [[0.25, -1], [0.5, -1.5]]))
        self.assertEqual(len(trajectory), 2)
        runs[0].trajectory_file.unlink()
        self.assertIs(runs[0].trajectory, trajectory)

    def test_of_the_program_are_read(self):
        result = call("run", ROOT / "scenarios/planar_7r.yaml", "--method", "none", "--out", self.place, "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        run, = bqsa_results.load(self.place)
        self.assertEqual(len(run.trajectory), run.judged.rows)
        self.assertEqual(len(run.trajectory.q[0]), 7)

    def test_other_files_are_refused(self):
        run, = self.load([record()])
        write(self.place, ["time,q1\n0,1\n"], run.record.trajectory)
        with self.assertRaisesRegex(ValueError, "expected a header t,q1..qn"):
            print(run.trajectory)

    def test_there_may_be_none(self):
        run = record()
        run["trajectory"] = None
        self.assertIs(self.load([run])[0].trajectory, None)


class Notebook(ReaderTest):
    def run_notebook(self, *words, blocked=""):
        """As a script; modules that are blocked cannot be imported."""
        code = (f"import sys, runpy; sys.modules.update(dict.fromkeys({blocked!r}.split()));"
                f"sys.argv = {[str(NOTEBOOK), *map(str, words)]!r}; runpy.run_path(sys.argv[0])")
        result = subprocess.run([sys.executable, "-B", "-c", code], capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_runs_on_the_reference_results(self):
        text = self.run_notebook(blocked="matplotlib matplotlib.pyplot")
        self.assertIn("51 runs, 3 pairs that do not fit", text)
        self.assertRegex(text, r"bqsa_lookahead +3 of 3 \(100.0 %, 43.9 .. 100.0 %\) +[0-9.]+ us a tick")
        self.assertIn("puma560_wall         none                     collision", text)

    def test_runs_on_results_without_a_success(self):
        write(self.place, [fail(record())])
        self.assertIn("0 of 1", self.run_notebook(self.place, blocked="matplotlib matplotlib.pyplot"))

    def test_draws_where_matplotlib_is_installed(self):
        if importlib.util.find_spec("matplotlib") is None:
            self.skipTest("needs the package python3-matplotlib")
        picture = self.place.parent / "rates.png"
        self.run_notebook(ROOT / "results/paper_scenarios", picture)
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))


if __name__ == "__main__":
    unittest.main()
