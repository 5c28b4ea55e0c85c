"""Our logs and databases and those of OMPL's own script, Debian's ompl_benchmark_statistics."""
import pathlib
import random
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest

from made_up_results import HOSTILE, call, fail, hostile_records, of_a_real_arm, record, records, write

SCRIPT = shutil.which("ompl_benchmark_statistics")
SKIPPED = 77
TABLES = ["experiments", "plannerConfigs", "enums", "runs", "progress"]


def contents(database, table):
    """Columns with their types, rows with their types."""
    connection = sqlite3.connect(database)
    columns = [row[1:3] for row in connection.execute(f"PRAGMA table_info({table})")]
    rows = [[repr(cell) for cell in row] for row in connection.execute(f"SELECT * FROM {table}")]
    connection.close()
    return columns, rows


def misread_numbers(count):
    """Numbers whose shortest text is to SQLite that of a neighbour."""
    connection = sqlite3.connect(":memory:")
    stream = random.Random(1)
    found = []
    while len(found) < count:
        number = stream.uniform(-1, 1) * 10.0 ** stream.randint(-12, 3)
        if connection.execute("SELECT CAST(? AS REAL)", (repr(number),)).fetchone()[0] != number:
            found.append(number)
    connection.close()
    return found


class RoundTrip(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.place = pathlib.Path(directory.name)
        self.ours, self.theirs = self.place / "ours.db", self.place / "theirs.db"

    def export(self, runs):
        write(self.place / "results", runs)
        result = call("export", self.place / "results", "--ompl-log", self.place / "logs",
                      "--planner-arena", self.ours)
        self.assertEqual(result.returncode, 0, result.stderr)
        return sorted((self.place / "logs").iterdir())

    def script(self, *words):
        result = subprocess.run([SCRIPT, *map(str, words)], capture_output=True, text=True, check=False,
                                timeout=300)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def assert_equal_databases(self):
        for table in TABLES:
            columns, rows = contents(self.ours, table)
            their_columns, their_rows = contents(self.theirs, table)
            self.assertEqual(columns, their_columns, table)
            self.assertEqual(len(rows), len(their_rows), table)
            for row, their_row in zip(rows, their_rows):
                for (name, _), cell, their_cell in zip(columns, row, their_row):
                    self.assertEqual(cell, their_cell, f"{table}.{name} of row {row[0]}")

    def check(self, runs, counts):
        self.script("-d", self.theirs, *self.export(runs))
        self.assert_equal_databases()
        found = {table: len(contents(self.ours, table)[1]) for table in counts}
        self.assertEqual(found, counts)

    def test_all_methods_on_all_scenarios(self):
        judged = sum(run["judged"] is not None for run in records())
        self.check(records(), {"experiments": 3, "plannerConfigs": 18, "runs": judged, "progress": 0})

    def test_hostile_names_and_numbers(self):
        runs = hostile_records()
        self.check(runs, {"experiments": len(runs), "runs": len(runs)})

    def test_scenarios_with_different_properties(self):
        named = [of_a_real_arm(record(), name) for name in HOSTILE]
        for i, run in enumerate(named):
            run["scenario"]["sha256"] = f"{i:064x}"
            for key in list(run["problem"])[-4:][:i % 5]:  # ever fewer of what need not be there
                del run["problem"][key]
        runs = [record(), record("qp", "puma560_wall")] + named
        self.check(runs, {"experiments": len(runs), "runs": len(runs)})

    def test_several_runs_of_a_planner_and_other_settings_of_its_name(self):
        runs = []
        for seed in range(5):
            runs.append(record("ompl"))
            runs[-1]["method"]["seed"] = runs[-1]["provenance"]["seed"] = seed
            runs[-1]["method"]["parameters"]["range"] = 0.5 if seed == 3 else 0.25
            runs[-1]["times"]["run_s"] = 0.1 * seed
        fail(runs[1])
        self.check(runs, {"experiments": 1, "plannerConfigs": 2, "runs": 5})

    def test_numbers_that_sqlite_rounds_to_a_neighbour(self):
        numbers = misread_numbers(10)
        runs = []
        for seed, number in enumerate(numbers):
            runs.append(record("ompl"))
            runs[-1]["method"]["seed"] = seed
            runs[-1]["judged"].update(clearance_m=number)
        self.check(runs, {"runs": 10})
        connection = sqlite3.connect(self.theirs)
        self.assertEqual([row[0] for row in connection.execute("SELECT clearance_m FROM runs")], numbers)
        connection.close()

    def test_the_script_adds_to_our_database(self):
        logs = self.export(records())
        before = {table: contents(self.ours, table)[1] for table in TABLES}
        self.script("-d", self.ours, "-a", logs[0])
        after = {table: contents(self.ours, table)[1] for table in TABLES}
        added = len([run for run in records()
                     if run["scenario"]["name"] == "planar_7r" and run["judged"] is not None])
        self.assertEqual(len(after["runs"]), len(before["runs"]) + added)
        self.assertEqual(len(after["experiments"]), 4)
        for table in ("plannerConfigs", "enums"):
            self.assertEqual(after[table], before[table])  # it finds ours again
        self.assertEqual(after["runs"][:len(before["runs"])], before["runs"])

    def test_the_views_are_those_of_the_script(self):
        self.script("-d", self.theirs, *self.export(records()))
        for view in ("bestPlannerConfigs", "bestPlannerConfigsPerExperiment"):
            self.assertEqual(contents(self.ours, view), contents(self.theirs, view))
            self.assertGreater(len(contents(self.ours, view)[1]), 0)

    def test_the_script_dumps_and_plots_our_database(self):
        self.export([record(), fail(record("qp")), record("ompl")])
        self.script("-d", self.ours, "-m")
        dump = self.ours.with_suffix(".mysql").read_text(encoding="utf-8")
        self.assertEqual(len(re.findall(r'^INSERT INTO runs', dump, re.MULTILINE)), 3)
        self.script("-d", self.ours, "-p")
        self.assertGreater(self.ours.with_suffix(".pdf").stat().st_size, 10_000)


if __name__ == "__main__":
    if SCRIPT is None:
        print("skipped: needs the package ompl-demos")
        sys.exit(SKIPPED)
    unittest.main()
