"""What tools/instruction_guard.py makes of counts, which are made up here."""
import contextlib
import importlib.util
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools/instruction_guard.py"
spec = importlib.util.spec_from_file_location("instruction_guard", TOOL)
instruction_guard = importlib.util.module_from_spec(spec)
spec.loader.exec_module(instruction_guard)

BUILD = {"commit": "c0ffee", "modified": False, "toolchain": {"compiler": "GNU 12.2.0", "glibc": "2.36"}}
OTHER_COMPILER = {**BUILD, "toolchain": {**BUILD["toolchain"], "compiler": "GNU 13.1.0"}}


class GuardTest(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.file = pathlib.Path(directory.name) / "new" / "baseline.json"

    def write(self, counts, build=BUILD):
        entry = {"toolchain": build["toolchain"], "recorded": {}, "instructions": counts}
        self.write_text(json.dumps({"baselines": [entry]}))

    def write_text(self, text):
        self.file.parent.mkdir(exist_ok=True)
        self.file.write_text(text, encoding="utf-8")

    def guard(self, measured, kernels=None, build=BUILD):
        """(exit status, what was printed)"""
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            status = instruction_guard.guard(self.file, build, measured, kernels or list(measured))
        return status, printed.getvalue()

    def record(self, measured, kernels=None, build=BUILD):
        with contextlib.redirect_stdout(io.StringIO()):
            instruction_guard.record(self.file, build, measured, kernels or list(measured))

    def entries(self):
        return json.loads(self.file.read_text(encoding="utf-8"))["baselines"]


class Comparison(GuardTest):
    def test_equal_counts_pass(self):
        self.write({"a": 1000, "b": 5})
        status, text = self.guard({"a": 1000, "b": 5})
        self.assertEqual(status, 0)
        self.assertIn("2 kernels within 2 % of the baseline", text)

    def test_two_percent_either_way_pass(self):
        self.write({"more": 1000, "fewer": 1000})
        self.assertEqual(self.guard({"more": 1020, "fewer": 980})[0], 0)

    def test_more_than_two_percent_more_fails_as_worse(self):
        self.write({"a": 1000, "b": 1000})
        status, text = self.guard({"a": 1021, "b": 1000})
        self.assertEqual(status, 1)
        self.assertRegex(text, r"a +1000 +1021 +\+2\.10 %  worse")
        self.assertIn("1 of 2 kernels differ\n  worse: needs over 2 % more", text)
        self.assertNotIn("better", text)

    def test_more_than_two_percent_fewer_fails_and_asks_to_record(self):
        self.write({"a": 1000})
        status, text = self.guard({"a": 979})
        self.assertEqual(status, 1)
        self.assertRegex(text, r"a +1000 +979 +-2\.10 %  better")
        self.assertIn("better: needs over 2 % fewer instructions than recorded. Keep the gain: --record", text)
        self.assertNotIn("worse", text)

    def test_a_kernel_without_baseline_fails_and_asks_to_record(self):
        self.write({"a": 1000})
        status, text = self.guard({"a": 1000, "b": 7})
        self.assertEqual(status, 1)
        self.assertRegex(text, r"b +- +7 +- +new")
        self.assertIn("new: not in the baseline. Guard it: --record", text)

    def test_a_kernel_that_is_gone_fails_and_asks_to_record(self):
        self.write({"a": 1000, "b": 7})
        status, text = self.guard({"a": 1000})
        self.assertEqual(status, 1)
        self.assertRegex(text, r"b +7 +- +- +gone")
        self.assertIn("gone: in the baseline, but not in the program", text)

    def test_a_kernel_that_was_not_asked_for_is_left_out(self):
        self.write({"a": 1000, "b": 7})
        status, text = self.guard({"a": 1000}, kernels=["a", "b"])
        self.assertEqual(status, 0)
        self.assertIn("1 kernels within", text)

    def test_every_sort_of_difference_is_told_once(self):
        self.write({"a": 100, "b": 100, "c": 100, "d": 100})
        status, text = self.guard({"a": 200, "b": 200, "c": 50, "e": 1})
        self.assertEqual(status, 1)
        self.assertIn("5 of 5 kernels differ", text)
        for word in ("worse:", "better:", "new:", "gone:"):
            self.assertEqual(text.count(word), 1, word)


class Toolchain(GuardTest):
    def test_another_toolchain_is_not_compared(self):
        self.write({"a": 1000})
        status, text = self.guard({"a": 5000}, build=OTHER_COMPILER)
        self.assertEqual(status, 0)
        self.assertIn("a                                                      5000\n", text)
        self.assertIn("compiler GNU 13.1.0", text)
        self.assertTrue(text.endswith(
            "no baseline for this toolchain; nothing was compared; --record makes one\n"), text)

    def test_without_a_file_nothing_is_compared(self):
        status, text = self.guard({"a": 5000})
        self.assertEqual(status, 0)
        self.assertIn("no baseline for this toolchain", text)

    def test_each_toolchain_has_its_own_counts(self):
        self.record({"a": 1000})
        self.record({"a": 5000}, build=OTHER_COMPILER)
        self.assertEqual(self.guard({"a": 1000})[0], 0)
        self.assertEqual(self.guard({"a": 5000}, build=OTHER_COMPILER)[0], 0)
        self.assertEqual(self.guard({"a": 5000})[0], 1)


class Recording(GuardTest):
    def setUp(self):
        super().setUp()
        # The version of valgrind, which need not be installed.
        answer = subprocess.CompletedProcess([], 0, stdout="valgrind-3.19.0\n")
        patch = unittest.mock.patch.object(instruction_guard, "output_of", return_value=answer)
        patch.start()
        self.addCleanup(patch.stop)

    def test_what_is_recorded_passes(self):
        self.record({"a": 1000, "b": 7})
        self.assertEqual(self.guard({"a": 1000, "b": 7})[0], 0)

    def test_provenance_is_kept(self):
        self.record({"a": 1000}, build={**BUILD, "modified": True})
        recorded = self.entries()[0]["recorded"]
        self.assertEqual(recorded["commit"], "c0ffee, modified")
        self.assertRegex(recorded["date"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")

    def test_one_kernel_leaves_the_others_as_they_were(self):
        self.record({"a": 1000, "b": 7})
        self.record({"b": 8}, kernels=["a", "b"])
        self.assertEqual(self.entries()[0]["instructions"], {"a": 1000, "b": 8})

    def test_kernels_that_are_gone_are_dropped(self):
        self.record({"a": 1000, "b": 7})
        self.record({"a": 1000})
        self.assertEqual(self.entries()[0]["instructions"], {"a": 1000})


class Measuring(unittest.TestCase):
    def self_test(self, count):
        """Exit status with `count(inject)` in place of callgrind's."""
        with unittest.mock.patch.object(instruction_guard, "instructions",
                                        lambda program, kernel, repetitions, inject: count(inject)), \
             contextlib.redirect_stdout(io.StringIO()):
            return instruction_guard.self_test("program")

    def instructions(self, report, **arguments):
        """Of a report of callgrind's, and the command that was to give it."""
        answer = subprocess.CompletedProcess([], 0, stderr=report)
        with unittest.mock.patch.object(instruction_guard, "output_of", return_value=answer) as run:
            count = instruction_guard.instructions("program", "a", **arguments)
        return count, [str(word) for word in run.call_args.args[0]]

    def test_counts_are_of_one_repetition_and_of_nothing_else(self):
        count, command = self.instructions("==1== Collected : 123418\n", repetitions=100, inject=5)
        self.assertEqual(count, 1234)
        self.assertIn("--toggle-collect=bqsa::counted_repetitions*", command)
        self.assertEqual(command[-6:], ["--kernel", "a", "--repetitions", "100", "--inject", "5"])

    def test_no_count_is_an_error(self):
        for report in ("", "==1== Collected : 0\n"):  # 0 if no function has the name
            with self.assertRaisesRegex(instruction_guard.GuardError, "a: expected a count"):
                self.instructions(report)

    def test_the_self_test_passes_if_counts_follow_the_work(self):
        self.assertEqual(self.self_test(lambda inject: 10000 + 100 * inject), 0)

    def test_the_self_test_fails_if_injected_work_is_not_seen(self):
        self.assertEqual(self.self_test(lambda inject: 10000), 1)

    def test_the_self_test_fails_if_counts_do_not_repeat(self):
        counts = iter([10000, 10002, 10500, 10000, 10000, 10500])
        self.assertEqual(self.self_test(lambda inject: next(counts)), 1)


class BadInput(GuardTest):
    def test_a_corrupt_baseline_is_named(self):
        for text in ("", "{", "[]", "{}", '{"baselines": 3}', '{"baselines": [{}]}',
                     '{"baselines": [{"toolchain": {}, "recorded": {}, "instructions": []}]}',
                     '{"baselines": [{"toolchain": {}, "recorded": {}, "instructions": {"a": 0}}]}',
                     '{"baselines": [{"toolchain": {}, "recorded": {}, "instructions": {"a": "7"}}]}'):
            with self.subTest(text):
                self.write_text(text)
                with self.assertRaisesRegex(instruction_guard.GuardError,
                                            "baseline.json: expected a baseline as --record writes it"):
                    self.guard({"a": 1000})

    def test_what_cannot_be_measured_is_not_a_regression(self):
        run = subprocess.run([TOOL, "--program", "/nowhere/instruction_guard"], text=True,
                             capture_output=True, check=False, env={"PATH": "/usr/bin:/bin"})
        self.assertEqual(run.returncode, 2)
        self.assertRegex(run.stderr, "(/nowhere/instruction_guard|valgrind): not found")

    def test_without_valgrind_it_says_what_to_install(self):
        run = subprocess.run([sys.executable, TOOL, "--program", TOOL], text=True,
                             capture_output=True, check=False, env={"PATH": "/nowhere"})
        self.assertEqual(run.returncode, 2)
        self.assertIn("valgrind: not found; on Debian: apt-get install valgrind", run.stderr)


if __name__ == "__main__":
    unittest.main()
