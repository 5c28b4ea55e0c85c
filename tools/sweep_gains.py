#!/usr/bin/env python3
"""Tunes the gains of methods on generated problems that nothing else uses.

  tools/sweep_gains.py DIR [results/gain_sweep/summary.txt]      maciejewski_klein and fcl_gp
  tools/sweep_gains.py DIR --method M --gain NAME=LOW:HIGH ...   any method, with the same budget

The budget of each method: 60 random settings, then 20 around the best of them. The best has the
highest share of problems solved, then the lowest median tip error of those it solved. DIR takes the
problems and all results; the summary lists every setting. Needs the release build, or --program with
the path of another program that has the method.
"""
import argparse
import json
import math
import pathlib
import random
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
STOCK_PROGRAM = ROOT / "build/release/src/harness/program/bqsa-bench"
PROBLEM_SEED = 9001  # of no other results
FAMILIES = {"planar": 60, "spatial": 30, "moving": 20}
SETTINGS_SEED = 1
RANDOM_SETTINGS, NEAR_SETTINGS = 60, 20

# name: (lowest, highest), drawn with a uniform logarithm; full_distance is a part of influence.
GAINS = {
    "maciejewski_klein": {"influence": (0.02, 0.3), "full_distance": (0.1, 0.9),
                          "escape_velocity": (0.01, 1), "regularization": (1e-7, 1e-2),
                          "exempt_length": (0.02, 0.2)},
    "fcl_gp": {"influence": (0.02, 0.3), "gradient_gain": (10, 3000), "exempt_length": (0.02, 0.2)},
}
CHOICES = {"maciejewski_klein": {"points": ["closest", "all"]},
           "fcl_gp": {"points": ["closest", "all"]}}
FIXED = {"fcl_gp": ",broadphase=on"}  # faster, with the same answers


def draw(method, ranges, stream, near=None):
    """A random setting, or one within a factor of about 1.5 of another."""
    setting = {}
    for name, (low, high) in ranges.items():
        if near:
            value = min(max(near[name] * math.exp(stream.uniform(-0.4, 0.4)), low), high)
        else:
            value = math.exp(stream.uniform(math.log(low), math.log(high)))
        setting[name] = float(f"{value:.2g}")
    for name, choices in CHOICES.get(method, {}).items():
        setting[name] = stream.choice(choices)
    return setting


def specification(method, setting):
    values = dict(setting)
    if "full_distance" in values:
        values["full_distance"] = float(f"{values['full_distance'] * values['influence']:.2g}")
    text = ",".join(f"{name}={value if isinstance(value, str) else format(value, '.2g')}"
                    for name, value in values.items())
    return f"{method}:{text}{FIXED.get(method, '')}"


def run(program, method, settings, out):
    """(share solved, median tip error [mm], solved by family) of every setting."""
    specs = [specification(method, setting) for setting in settings]
    lines = {}
    for family in FAMILIES:
        directory = out / f"runs-{method}-{family}"
        for number, spec in enumerate(specs):
            single = directory / f"{spec}".replace(":", "_").replace(",", "_")
            if not (single / "runs.jsonl").exists():
                subprocess.run([program, "run", out / "problems" / family, "--out", single,
                                "--no-trajectories", "--quiet", "--method", spec],
                               check=True, stdout=subprocess.DEVNULL)
            with open(single / "runs.jsonl", encoding="utf-8") as file:
                lines[number, family] = [json.loads(line) for line in file if line.strip()]
    answers = []
    for number in range(len(specs)):
        solved, errors = {}, []
        for family in FAMILIES:
            good = [record["judged"] for record in lines[number, family]
                    if record["judged"]["success"]]
            solved[family] = len(good)
            errors += [1000 * judged["tip_error_at_ticks"]["max_m"] for judged in good]
        median = statistics.median(errors) if errors else math.inf
        answers.append((sum(solved.values()) / sum(FAMILIES.values()), median, solved))
    return specs, answers


def quality(answer):
    return (-answer[0], answer[1])


def gain_range(text):
    """NAME=LOW:HIGH as (name, (low, high))."""
    try:
        name, bounds = text.split("=")
        low, high = (float(bound) for bound in bounds.split(":"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"expected NAME=LOW:HIGH, got '{text}'") from None
    if not 0 < low < high < math.inf:
        raise argparse.ArgumentTypeError(f"expected 0 < LOW < HIGH, got '{text}'")
    return name, (low, high)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, metavar="DIR")
    parser.add_argument("summary", type=pathlib.Path, nargs="?")
    parser.add_argument("--method")
    parser.add_argument("--gain", type=gain_range, action="append", default=[],
                        metavar="NAME=LOW:HIGH")
    parser.add_argument("--program", type=pathlib.Path, default=STOCK_PROGRAM)
    given = parser.parse_args()
    if bool(given.method) != bool(given.gain):
        parser.error("expected --method with at least one --gain, or neither")
    return given


def main():
    given = arguments()
    out = given.directory
    gains = {given.method: dict(given.gain)} if given.method else GAINS
    for family, count in FAMILIES.items():
        subprocess.run([given.program, "generate", "--family", family, "--count", str(count), "--seed",
                        str(PROBLEM_SEED), "--robots", ROOT / "robots",
                        "--out", out / "problems" / family],
                       check=True, stdout=subprocess.DEVNULL)
    report = [f"Gain sweep: {', '.join(f'{n} {f}' for f, n in FAMILIES.items())} problems of seed "
              f"{PROBLEM_SEED}; {RANDOM_SETTINGS} random settings and {NEAR_SETTINGS} around the best "
              "of them for each method.",
              "Solved of all problems, median over the solved of the largest tip error [mm], solved by "
              "family, setting; best first.", ""]
    for method, ranges in gains.items():
        stream = random.Random(SETTINGS_SEED)
        settings = [draw(method, ranges, stream) for _ in range(RANDOM_SETTINGS)]
        specs, answers = run(given.program, method, settings, out)
        best = min(range(len(settings)), key=lambda k: quality(answers[k]))
        near = [draw(method, ranges, stream, settings[best]) for _ in range(NEAR_SETTINGS)]
        more_specs, more_answers = run(given.program, method, near, out)
        rows = sorted(zip(specs + more_specs, answers + more_answers), key=lambda r: quality(r[1]))
        report.append(method)
        for spec, (rate, median, solved) in rows:
            by_family = "  ".join(f"{solved[f]:3d}/{n}" for f, n in FAMILIES.items())
            report.append(f"  {100 * rate:5.1f} %  {median:8.4f}  {by_family}  {spec}")
        report.append("")
    text = "\n".join(report)
    print(text)
    if given.summary:
        given.summary.parent.mkdir(parents=True, exist_ok=True)
        given.summary.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
