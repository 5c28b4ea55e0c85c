#!/usr/bin/env python3
"""A first look at results, cell by cell: in Jupyter, VS Code or Spyder, or as a script.

  examples/results_notebook.py [DIR [PICTURE.png]]
"""
# %% The reader is one file without dependencies.
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
import bqsa_results  # noqa: E402

# %% All runs of a results directory, a campaign's or any other.
is_notebook = "ipykernel" in sys.modules
directory = sys.argv[1] if len(sys.argv) > 1 and not is_notebook else ROOT / "results/paper_scenarios"
runs = bqsa_results.load(directory)
print(f"{len(runs)} runs, {len(runs.not_applicable)} pairs that do not fit")

# %% How often each method succeeds, and how fast it then is: never a time without success.
by_variant = runs.group_by("variant")
for variant, group in by_variant.items():
    median, p99 = group.step_time(0.5), group.step_time(0.99)
    time = f"{1e6 * median:.3g} us a tick, p99 {1e6 * p99:.3g} us" if median else ""
    print(f"{variant:24} {str(group.success_rate()):38} {time}")

# %% What went wrong.
for run in runs.filter(success=False):
    print(f"{run.scenario.name:20} {run.variant:24} {run.status}")

# %% One run: what the judge found, the work that it took, its parameters.
best = min(runs.successes, key=lambda run: run.judged.tip_error_at_ticks.max_m, default=None)
if best is not None:
    print(best, f"clearance {best.judged.clearance_m} m, {best.counters.quadratics} quadratics")
    print({name: value for name, value in best.method.parameters.items()})

# %% Its motion, read when it is asked for; results that are shipped without trajectories have none.
if best is not None and best.trajectory_file is not None and best.trajectory_file.exists():
    print(f"{len(best.trajectory)} rows, from {best.trajectory.q[0]}")

# %% A picture, where matplotlib is installed.
try:
    import matplotlib.pyplot as plt
except ImportError:
    plt = None
if plt is not None and runs:
    rates = [group.success_rate() for group in by_variant.values()]
    below = [max(0, rate.share - rate.lower) for rate in rates]
    above = [max(0, rate.upper - rate.share) for rate in rates]
    figure, axes = plt.subplots(figsize=(7, 0.3 * len(rates) + 1))
    axes.barh(list(by_variant), [rate.share for rate in rates], xerr=[below, above], capsize=2)
    axes.set_xlabel("share of runs judged a success, Wilson's interval of 95 %")
    axes.set_xlim(0, 1)
    axes.invert_yaxis()
    figure.tight_layout()
    if is_notebook:
        plt.show()
    elif len(sys.argv) > 2:
        figure.savefig(sys.argv[2])
