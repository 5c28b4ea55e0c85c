#!/usr/bin/env python3
"""Tunes the gains of methods on generated problems that nothing else uses.

  tools/sweep_gains.py DIR [results/gain_sweep/summary.txt] [--methods NAME,...]

A fixed budget for every entry of the table below: 60 random settings, then 20 around the best of them.
The best has the highest share of problems solved, then the lowest median tip error of those it solved.
DIR takes the problems and all results; the summary lists every setting. Needs the release build.
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

# name: (lowest, highest), drawn with a uniform logarithm, or choices; full_distance and floor are
# parts of influence. What follows the method's name tells entries of one method apart.
POINTS = ["closest", "all"]
GAINS = {
    "maciejewski_klein": {"influence": (0.02, 0.3), "full_distance": (0.1, 0.9),
                          "escape_velocity": (0.01, 1), "regularization": (1e-7, 1e-2),
                          "exempt_length": (0.02, 0.2), "points": POINTS},
    "fcl_gp": {"influence": (0.02, 0.3), "gradient_gain": (10, 3000), "exempt_length": (0.02, 0.2),
               "points": POINTS},
    "potential_field": {"influence": (0.02, 0.3), "gain": (1e-8, 1e-3), "floor": (0.02, 0.5),
                        "exempt_length": (0.02, 0.2), "points": POINTS},
    "potential_field task": {"influence": (0.02, 0.3), "gain": (1e-8, 1e-3), "floor": (0.02, 0.5),
                             "exempt_length": (0.02, 0.2), "points": POINTS},
    "weighted_least_norm": {"influence": (0.02, 0.3), "gain": (1e-5, 100), "decay": (1, 300),
                            "exponent": (0.5, 3), "exempt_length": (0.02, 0.2), "points": POINTS,
                            "motion": ["last", "planned"]},
    "extended_jacobian": {"influence": (0.02, 0.3), "posture_weight": (1e-3, 100),
                          "convergence": (0.02, 1), "damping": (1e-3, 10),
                          "exempt_length": (0.02, 0.2), "correction": ["descent", "newton"]},
    "test_point": {"influence": (0.02, 0.3), "full_distance": (0.1, 0.9),
                   "escape_velocity": (0.01, 1), "regularization": (1e-7, 1e-2),
                   "exempt_length": (0.02, 0.2)},
    "test_point gradient_projection": {"influence": (0.02, 0.3), "gradient_gain": (10, 3000),
                                       "exempt_length": (0.02, 0.2)},
}
FIXED = {"fcl_gp": ",broadphase=on",  # faster, with the same answers
         "potential_field task": ",where=task",
         "test_point gradient_projection": ",law=gradient_projection"}


def draw(ranges, stream, near=None):
    """A random setting, or one within a factor of about 1.5 of another."""
    setting = {}
    for name, values in ranges.items():
        if isinstance(values, list):
            setting[name] = stream.choice(values)
            continue
        low, high = values
        if near:
            value = min(max(near[name] * math.exp(stream.uniform(-0.4, 0.4)), low), high)
        else:
            value = math.exp(stream.uniform(math.log(low), math.log(high)))
        setting[name] = float(f"{value:.2g}")
    return setting


def specification(method, setting):
    values = dict(setting)
    for part in ("full_distance", "floor"):
        if part in values:
            values[part] = float(f"{values[part] * values['influence']:.2g}")
    text = ",".join(f"{name}={value if isinstance(value, str) else format(value, '.2g')}"
                    for name, value in values.items())
    return f"{method.split()[0]}:{text}{FIXED.get(method, '')}"


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
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", metavar="DIR", type=pathlib.Path)
    parser.add_argument("summary", metavar="SUMMARY", type=pathlib.Path, nargs="?")
    parser.add_argument("--methods", metavar="NAME,...", help="entries of the table, default all")
    arguments = parser.parse_args()
    chosen = arguments.methods.split(",") if arguments.methods else list(GAINS)
    if unknown := [name for name in chosen if name not in GAINS]:
        parser.error(f"--methods: expected some of {', '.join(GAINS)}, got {', '.join(unknown)}")
    out = arguments.out
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
    for method in chosen:
        ranges = GAINS[method]
        stream = random.Random(SETTINGS_SEED)
        settings = [draw(ranges, stream) for _ in range(RANDOM_SETTINGS)]
        specs, answers = run(method, settings, out)
        best = min(range(len(settings)), key=lambda k: quality(answers[k]))
        near = [draw(ranges, stream, settings[best]) for _ in range(NEAR_SETTINGS)]
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
