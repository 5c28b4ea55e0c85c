#!/usr/bin/env python3
"""Tunes the gains of methods on generated problems that nothing else uses.

  tools/sweep_gains.py DIR [results/gain_sweep/summary.txt]       all entries of the table below
  tools/sweep_gains.py DIR --methods NAME,...                     some of them
  tools/sweep_gains.py DIR --method M --gain NAME=LOW:HIGH ...    any method, with the same budget

The budget of each entry: 60 random settings, then 20 around the best of them. The best has the highest
share of problems solved, then the lowest median tip error of those it solved. DIR takes the problems
and all results, what is there is not run again; the summary lists every setting. Needs the release
build, or --program with the path of another program that has the method.
"""
import argparse
import json
import math
import pathlib
import random
import shutil
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
STOCK_PROGRAM = ROOT / "build/release/src/harness/program/bqsa-bench"
PROBLEM_SEED = 9001  # of no other results
FAMILIES = {"planar": 60, "spatial": 30, "moving": 20}
SETTINGS_SEED = 1
RANDOM_SETTINGS, NEAR_SETTINGS = 60, 20

# name: (lowest, highest), drawn with a uniform logarithm, or choices. What follows the method's name
# tells entries of one method apart.
POINTS = ["closest", "all"]
ESCAPE = {"influence": (0.02, 0.3), "full_distance": (0.1, 0.9), "escape_velocity": (0.01, 1),
          "regularization": (1e-7, 1e-2), "exempt_length": (0.02, 0.2)}
CLIMB = {"influence": (0.02, 0.3), "gradient_gain": (10, 3000), "exempt_length": (0.02, 0.2)}
FIELD = {"influence": (0.02, 0.3), "gain": (1e-8, 1e-3), "floor": (0.02, 0.5),
         "exempt_length": (0.02, 0.2)}
PROGRAM_BOUNDS = {"influence": (0.02, 0.3), "safe_distance": (0.01, 0.9), "gain": (1, 40),
                  "max_velocity": (0.3, 10), "exempt_length": (0.02, 0.2)}
GAINS = {
    "bqsa_escape": {**ESCAPE, "points": POINTS},
    "test_point": ESCAPE,
    "test_point gradient_projection": CLIMB,
    "maciejewski_klein": {**ESCAPE, "points": POINTS},
    "fcl_gp": {**CLIMB, "points": POINTS},
    "potential_field": {**FIELD, "points": POINTS},
    "potential_field task": {**FIELD, "points": POINTS},
    "weighted_least_norm": {"influence": (0.02, 0.3), "gain": (1e-5, 100), "decay": (1, 300),
                            "exponent": (0.5, 3), "exempt_length": (0.02, 0.2), "points": POINTS,
                            "motion": ["last", "planned"]},
    "extended_jacobian": {"influence": (0.02, 0.3), "posture_weight": (1e-3, 100),
                          "convergence": (0.02, 1), "damping": (1e-3, 10),
                          "exempt_length": (0.02, 0.2), "correction": ["descent", "newton"]},
    "qp": {**PROGRAM_BOUNDS, "points": POINTS, "approach": ["damped", "none"]},
    "compact_qp": {**PROGRAM_BOUNDS, "drift_gain": (1e-3, 3), "points": POINTS,
                   "constraints": ["inequality", "equality"]},
}
PARTS_OF_INFLUENCE = ("full_distance", "floor", "safe_distance")
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


def specification(entry, setting):
    values = dict(setting)
    for part in PARTS_OF_INFLUENCE:
        if part in values:
            values[part] = float(f"{values[part] * values['influence']:.2g}")
    text = ",".join(f"{name}={value if isinstance(value, str) else format(value, '.2g')}"
                    for name, value in values.items())
    return f"{entry.split()[0]}:{text}{FIXED.get(entry, '')}"


def records_in(directory):
    with open(directory / "runs.jsonl", encoding="utf-8") as file:
        return [json.loads(line) for line in file if line.strip()]


def is_complete(directory, problems):
    return (directory / "runs.jsonl").exists() and len(records_in(directory)) == problems


def run(program, specs, out):
    """(share solved, median tip error [mm], solved by family) of every setting."""
    answers = []
    for spec in specs:
        solved, errors = {}, []
        for family in FAMILIES:
            method = spec.split(":")[0]
            single = out / f"runs-{method}-{family}" / spec.replace(":", "_").replace(",", "_")
            if not is_complete(single, FAMILIES[family]):
                shutil.rmtree(single, ignore_errors=True)
                subprocess.run([program, "run", out / "problems" / family, "--out", single,
                                "--no-trajectories", "--quiet", "--method", spec],
                               check=True, stdout=subprocess.DEVNULL)
            judged = [record["judged"] for record in records_in(single)]
            good = [verdict for verdict in judged if verdict and verdict["success"]]
            solved[family] = len(good)
            errors += [1000 * judged["tip_error_at_ticks"]["max_m"] for judged in good]
        median = statistics.median(errors) if errors else math.inf
        answers.append((sum(solved.values()) / sum(FAMILIES.values()), median, solved))
    return answers


def quality(answer):
    return (-answer[0], answer[1])


def sweep(program, entry, ranges, out):
    """(setting, answer) of the whole budget, the best first."""
    stream = random.Random(SETTINGS_SEED)
    settings = [draw(ranges, stream) for _ in range(RANDOM_SETTINGS)]
    specs = [specification(entry, setting) for setting in settings]
    answers = run(program, specs, out)
    best = min(range(len(settings)), key=lambda k: quality(answers[k]))
    near = [specification(entry, draw(ranges, stream, settings[best]))
            for _ in range(NEAR_SETTINGS)]
    return sorted(zip(specs + near, answers + run(program, near, out)), key=lambda r: quality(r[1]))


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
    parser.add_argument("--methods", metavar="NAME,...")
    parser.add_argument("--method", metavar="M")
    parser.add_argument("--gain", type=gain_range, action="append", default=[],
                        metavar="NAME=LOW:HIGH")
    parser.add_argument("--program", type=pathlib.Path, default=STOCK_PROGRAM)
    given = parser.parse_args()
    if bool(given.method) != bool(given.gain):
        parser.error("expected --method with at least one --gain, or neither")
    if given.method and given.methods:
        parser.error("expected --method or --methods, not both")
    given.entries = {given.method: dict(given.gain)} if given.method else GAINS
    if given.methods:
        names = given.methods.split(",")
        if unknown := [name for name in names if name not in GAINS]:
            parser.error(f"--methods: expected some of {', '.join(GAINS)}; got {', '.join(unknown)}")
        given.entries = {name: GAINS[name] for name in names}
    return given


def main():
    given = arguments()
    out = given.directory
    for family, count in FAMILIES.items():
        subprocess.run([given.program, "generate", "--family", family, "--count", str(count),
                        "--seed", str(PROBLEM_SEED), "--robots", ROOT / "robots",
                        "--out", out / "problems" / family],
                       check=True, stdout=subprocess.DEVNULL)
    report = [f"Gain sweep: {', '.join(f'{n} {f}' for f, n in FAMILIES.items())} problems of seed "
              f"{PROBLEM_SEED}; {RANDOM_SETTINGS} random settings and {NEAR_SETTINGS} around the best "
              "of them for each method.",
              "Solved of all problems, median over the solved of the largest tip error [mm], solved by "
              "family, setting; best first.", ""]
    for entry, ranges in given.entries.items():
        report.append(entry)
        for spec, (rate, median, solved) in sweep(given.program, entry, ranges, out):
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
