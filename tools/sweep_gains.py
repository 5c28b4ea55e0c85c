#!/usr/bin/env python3
"""Tunes the gains of the reactive rivals on generated problems that nothing else uses.

  tools/sweep_gains.py [--methods NAME,NAME] DIR [results/gain_sweep/summary.txt]

A fixed budget for each method: 60 random settings, then 20 around the best of them. The best has the
highest share of problems solved, then the lowest median tip error of those it solved. DIR takes the
problems and all results; the summary lists every setting. Needs the release build.
"""
import argparse
import json
import math
import pathlib
import random
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/src/harness/program/bqsa-bench"
PROBLEM_SEED = 9001  # of no other results
FAMILIES = {"planar": 60, "spatial": 30, "moving": 20}
SETTINGS_SEED = 1
RANDOM_SETTINGS, NEAR_SETTINGS = 60, 20

# name: (lowest, highest), drawn with a uniform logarithm.
GAINS = {
    "maciejewski_klein": {"influence": (0.02, 0.3), "full_distance": (0.1, 0.9),
                          "escape_velocity": (0.01, 1), "regularization": (1e-7, 1e-2),
                          "exempt_length": (0.02, 0.2)},
    "fcl_gp": {"influence": (0.02, 0.3), "gradient_gain": (10, 3000), "exempt_length": (0.02, 0.2)},
    "qp": {"influence": (0.02, 0.3), "safe_distance": (0.01, 0.9), "gain": (1, 40),
           "max_velocity": (0.3, 10), "exempt_length": (0.02, 0.2)},
    "compact_qp": {"influence": (0.02, 0.3), "safe_distance": (0.01, 0.9), "gain": (1, 40),
                   "max_velocity": (0.3, 10), "exempt_length": (0.02, 0.2),
                   "drift_gain": (1e-3, 3)},
}
PARTS_OF_INFLUENCE = ("full_distance", "safe_distance")
CHOICES = {
    "maciejewski_klein": {"points": ["closest", "all"]},
    "fcl_gp": {"points": ["closest", "all"]},
    "qp": {"points": ["closest", "all"], "approach": ["damped", "none"]},
    "compact_qp": {"points": ["closest", "all"], "constraints": ["inequality", "equality"]},
}
FIXED = {"fcl_gp": ",broadphase=on"}  # faster, with the same answers


def draw(method, stream, near=None):
    """A random setting, or one within a factor of about 1.5 of another."""
    setting = {}
    for name, (low, high) in GAINS[method].items():
        if near:
            value = min(max(near[name] * math.exp(stream.uniform(-0.4, 0.4)), low), high)
        else:
            value = math.exp(stream.uniform(math.log(low), math.log(high)))
        setting[name] = float(f"{value:.2g}")
    for name, choices in CHOICES[method].items():
        setting[name] = stream.choice(choices)
    return setting


def specification(method, setting):
    values = dict(setting)
    for name in PARTS_OF_INFLUENCE:
        if name in values:
            values[name] = float(f"{values[name] * values['influence']:.2g}")
    text = ",".join(f"{name}={value if isinstance(value, str) else format(value, '.2g')}"
                    for name, value in values.items())
    return f"{method}:{text}{FIXED.get(method, '')}"


def run(method, settings, out):
    """(share solved, median tip error [mm], solved by family) of every setting."""
    specs = [specification(method, setting) for setting in settings]
    lines = {}
    for family in FAMILIES:
        directory = out / f"runs-{method}-{family}"
        for number, spec in enumerate(specs):
            single = directory / f"{spec}".replace(":", "_").replace(",", "_")
            if not (single / "runs.jsonl").exists():
                subprocess.run([PROGRAM, "run", out / "problems" / family, "--out", single,
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


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--methods", default=",".join(GAINS))
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("summary", type=pathlib.Path, nargs="?")
    arguments = parser.parse_args()
    methods = arguments.methods.split(",")
    unknown = [method for method in methods if method not in GAINS]
    if unknown:
        parser.error(f"no such method: {unknown[0]} (known: {', '.join(GAINS)})")
    out = arguments.directory
    for family, count in FAMILIES.items():
        subprocess.run([PROGRAM, "generate", "--family", family, "--count", str(count), "--seed",
                        str(PROBLEM_SEED), "--robots", ROOT / "robots",
                        "--out", out / "problems" / family],
                       check=True, stdout=subprocess.DEVNULL)
    report = [f"Gain sweep: {', '.join(f'{n} {f}' for f, n in FAMILIES.items())} problems of seed "
              f"{PROBLEM_SEED}; {RANDOM_SETTINGS} random settings and {NEAR_SETTINGS} around the best "
              "of them for each method.",
              "Solved of all problems, median over the solved of the largest tip error [mm], solved by "
              "family, setting; best first.", ""]
    for method in methods:
        stream = random.Random(SETTINGS_SEED)
        settings = [draw(method, stream) for _ in range(RANDOM_SETTINGS)]
        specs, answers = run(method, settings, out)
        best = min(range(len(settings)), key=lambda k: quality(answers[k]))
        near = [draw(method, stream, settings[best]) for _ in range(NEAR_SETTINGS)]
        more_specs, more_answers = run(method, near, out)
        rows = sorted(zip(specs + more_specs, answers + more_answers), key=lambda r: quality(r[1]))
        report.append(method)
        for spec, (rate, median, solved) in rows:
            by_family = "  ".join(f"{solved[f]:3d}/{n}" for f, n in FAMILIES.items())
            report.append(f"  {100 * rate:5.1f} %  {median:8.4f}  {by_family}  {spec}")
        report.append("")
    text = "\n".join(report)
    print(text)
    if arguments.summary:
        arguments.summary.parent.mkdir(parents=True, exist_ok=True)
        arguments.summary.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
