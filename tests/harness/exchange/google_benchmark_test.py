"""Google Benchmark's own comparison reads our times."""
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

from made_up_results import call, record, write

TOOL = pathlib.Path("/usr/share/benchmark/compare.py")
SKIPPED = 77


class Comparison(unittest.TestCase):
    def test_finds_the_method_that_became_twice_as_slow(self):
        with tempfile.TemporaryDirectory() as directory:
            files = []
            for name, factor in (("old", 1), ("new", 2)):
                slow, other = record("bqsa"), record("qp")
                slow["times"]["warm_median_s"] = 3e-6 * factor
                results = write(pathlib.Path(directory) / name, [slow, other])
                files.append(f"{results}.json")
                exported = call("export", results, "--google-benchmark", files[-1])
                self.assertEqual(exported.returncode, 0, exported.stderr)
            compared = subprocess.run([sys.executable, TOOL, "--no-color", "benchmarks", *files],
                                      capture_output=True, text=True, check=True).stdout
        lines = {line.split()[0]: line.split() for line in compared.splitlines() if line.startswith("planar")}
        self.assertEqual(lines["planar_7r/bqsa/step_median_median"][1:5],
                         ["+1.0000", "+1.0000", "3000", "6000"])
        self.assertEqual(lines["planar_7r/qp/step_median_median"][1], "+0.0000")


if __name__ == "__main__":
    if not TOOL.exists() or importlib.util.find_spec("scipy") is None:
        print("skipped: needs the packages libbenchmark-tools and python3-scipy")
        sys.exit(SKIPPED)
    unittest.main()
