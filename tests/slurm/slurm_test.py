"""A campaign of 200 runs, by a private Slurm in 8 shards of which one is killed, and by GNU parallel: equal to
the run without them but for times. Ends with 77 where they are not installed.    slurm_test.py BQSA_BENCH"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from private_slurm import PrivateSlurm, missing_programs

BENCH = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).resolve().parents[2]
SHARDS = 8

CAMPAIGN = """\
schema: bqsa-campaign/1
name: two_hundred
scenarios: [{generate: {family: planar, seed: 11, count: 50}}]
methods: [bqsa, maciejewski_klein]
repetitions: 2
trajectories: none
"""


def run(*words, status=0, **options):
    done = subprocess.run([str(word) for word in words], text=True, capture_output=True, **options)
    assert status in (None, done.returncode), f"{words}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def findings_of(directory):
    """What was found of each run, by its key; times are left out."""
    findings = {}
    for line in (directory / "runs.jsonl").read_text(encoding="utf-8").splitlines():
        record = json.loads(line)
        key = record["campaign"]["key"]
        assert key not in findings, "a run is recorded twice"
        findings[key] = {name: record.get(name) for name in ("judged", "claimed", "counters", "ticks")}
    return findings


def processes_of(words):
    """Processes whose command line has these words one after the other."""
    found = []
    for command in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            text = command.read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue  # it has just ended
        if words in text and text.startswith(BENCH):
            found.append(int(command.parent.name))
    return found


class CampaignOnManyNodes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.place)
        cls.campaign = cls.place / "campaign.yaml"
        cls.campaign.write_text(CAMPAIGN, encoding="utf-8")
        run(BENCH, "run", cls.campaign, "--out", cls.place / "alone", "--quiet")
        cls.alone = findings_of(cls.place / "alone")

    def test_by_slurm_with_a_task_killed_and_resumed(self):
        self.assertEqual(len(self.alone), 200)
        directory = self.place / "slurm"
        with PrivateSlurm() as slurm:
            environment = dict(slurm.environment, BQSA_BENCH=BENCH)

            def submit():
                said = run(ROOT / "scripts/slurm/submit.sh", self.campaign, directory, SHARDS, env=environment)
                return said, int(re.search(r"merge: job (\d+)", said)[1])

            said, merge = submit()
            self.assertIn("shards 1,2,3,4,5,6,7,8 of 8", said)
            self.kill_a_task(2)
            slurm.wait_for_end()
            self.assertEqual(slurm.job(merge)["ExitCode"], "1:0", "runs are missing")
            self.assertIn("missing: planar_s11_", (directory / "slurm/merge.log").read_text())
            self.assertEqual(run(BENCH, "missing", SHARDS, directory), "2\n")

            said, merge = submit()
            self.assertIn("shards 2 of 8", said)
            slurm.wait_for_end()
            self.assertEqual(slurm.job(merge)["ExitCode"], "0:0", (directory / "slurm/merge.log").read_text())
        self.assertEqual(findings_of(directory), self.alone)

    def kill_a_task(self, shard):
        """Kills the program that is at work on a shard, in the middle of it."""
        part = self.place / f"slurm/shards/{shard}-of-{SHARDS}.part.jsonl"
        end = time.monotonic() + 60
        while not part.exists() or part.read_bytes().count(b"\n") < 3:
            self.assertLess(time.monotonic(), end, "the shard does not start")
            time.sleep(0.02)
        for process in processes_of(f"--shard {shard}/{SHARDS} "):
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def test_by_gnu_parallel(self):
        directory = self.place / "parallel"
        run(BENCH, "plan", self.campaign, "--out", directory)
        # As docs/campaigns.md has it.
        run("bash", "-c", 'bqsa-bench missing 8 "$1" | tr , "\\n" | '
            'parallel --jobs 2 bqsa-bench run "$0" --out "$1" --shard {}/8 --jobs 1',
            self.campaign, directory,
            env=dict(os.environ, PATH=f"{pathlib.Path(BENCH).parent}:{os.environ['PATH']}"))
        self.assertEqual(run(BENCH, "missing", SHARDS, directory), "\n")
        run(BENCH, "merge", directory, "--out", directory)
        self.assertEqual(findings_of(directory), self.alone)


if missing := missing_programs() + [name for name in ("parallel",) if not shutil.which(name)]:
    print(f"skipped: {', '.join(missing)} not installed (packages slurm-wlm, munge, parallel)")
    sys.exit(77)
unittest.main()
