#!/usr/bin/env python3
"""Asks what the ellipsoids around solids cost: the same problems with coarse and with fine ones.

  tools/sweep_envelopes.py DIR [results/real_arms/envelopes.txt]

Generates the solids' families of campaigns/real_arms.yaml that stand still, gives every scenario each of
the envelopes below, and runs the methods below on all. The judge goes by the true solids each time. DIR
takes scenarios and results, what is there is not run again. Needs the release build, or --program with
the path of another program.
"""
import argparse
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
import bqsa_results  # noqa: E402

STOCK_PROGRAM = ROOT / "build/release/src/harness/program/bqsa-bench"
SEED = 1
COUNT = 250
FAMILIES = ["clutter", "corridor", "shelf"]
METHODS = ["bqsa", "bqsa_escape", "bqsa_lookahead", "qp"]
# (most ellipsoids a part, how far they may reach beyond it [m])
ENVELOPES = [(1, 1), (8, 0.05), (27, 0.015)]


def with_envelope(text, ellipsoids, inflation):
    """The text of a scenario with this envelope, and a name of its own."""
    text = re.sub(r"^name: ", f"name: e{ellipsoids}_", text, flags=re.MULTILINE)
    envelope = f"envelope: {{inflation: {inflation}, max_ellipsoids: {ellipsoids}}}"
    return re.sub(r"^obstacles:$", f"{envelope}\nobstacles:", text, flags=re.MULTILINE)


def runs_of(program, out, ellipsoids, inflation):
    """The records of all methods on all scenarios with one envelope."""
    scenarios = out / f"scenarios_{ellipsoids}"
    scenarios.mkdir(parents=True, exist_ok=True)
    for family in FAMILIES:
        for file in sorted((out / "generated" / family).glob("*.yaml")):
            text = with_envelope(file.read_text(encoding="utf-8"), ellipsoids, inflation)
            (scenarios / file.name).write_text(text, encoding="utf-8")
    campaign = out / f"campaign_{ellipsoids}.yaml"
    campaign.write_text(
        f"schema: bqsa-campaign/1\nname: envelopes_{ellipsoids}\nscenarios: [{scenarios.name}/*.yaml]\n"
        f"methods: [{', '.join(METHODS)}]\ntrajectories: none\n", encoding="utf-8")
    results = out / f"runs_{ellipsoids}"
    subprocess.run([program, "run", campaign, "--out", results, "--quiet"], check=True,
                   stdout=subprocess.DEVNULL)
    return bqsa_results.load(results)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, metavar="DIR")
    parser.add_argument("summary", type=pathlib.Path, nargs="?")
    parser.add_argument("--program", type=pathlib.Path, default=STOCK_PROGRAM)
    given = parser.parse_args()
    for family in FAMILIES:
        subprocess.run([given.program, "generate", "--family", family, "--count", str(COUNT),
                        "--seed", str(SEED), "--robots", ROOT / "robots",
                        "--out", given.directory / "generated" / family],
                       check=True, stdout=subprocess.DEVNULL)
    lines = [f"Envelopes: {COUNT} problems of seed {SEED} a family; share solved, judged on the true "
             "solids.", ""]
    for ellipsoids, inflation in ENVELOPES:
        runs = runs_of(given.program, given.directory, ellipsoids, inflation)
        pairs = sum(run.problem.nk for run in runs) / len(runs)
        bound = f", reaching {1000 * inflation:g} mm at most" if ellipsoids > 1 else ""
        lines.append(f"{ellipsoids} ellipsoid{'s' * (ellipsoids > 1)} a part at most{bound}; "
                     f"{pairs:.0f} pairs of link and ellipsoid in the mean")
        lines.append(f"  {'':20}" + "".join(f"{family:>12}" for family in FAMILIES))
        for method in METHODS:
            rates = []
            for family in FAMILIES:
                solved = [run.judged.success for run in runs if run.method.name == method
                          and run.scenario.name.startswith(f"e{ellipsoids}_{family}")]
                rates.append(f"{100 * sum(solved) / len(solved):10.1f} %")
            lines.append(f"  {method:20}" + "".join(rates))
        lines.append("")
    text = "\n".join(lines)
    print(text)
    if given.summary:
        given.summary.parent.mkdir(parents=True, exist_ok=True)
        given.summary.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
