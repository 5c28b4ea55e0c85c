"""Results directories for tests: real records, changed where a test asks for it."""
import copy
import hashlib
import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[3]
PROGRAM = os.environ["BQSA_BENCH"]

# Names as nobody should give them.
HOSTILE = ["two words", "quo'te", 'quo"te', "'; DROP TABLE runs; --", "semi; colon; ", "a = b", "комната",
           "wide\u3000space\u00a0\u2028s", "new\nline\rreturn", "tab\tand\x1f\x7f\x85", "|>>>", "<<<|", ".",
           "", " ", "nan", "inf", "NULL", "Experiment", "0", "a|b", "a,b", "=1+1", "\\", "%s {} $1",
           "bqsa version 3", "x" * 200, "ü" * 200, "\U0001f916", "select", "group", "Order", "order"]


def records(name="paper_scenarios"):
    lines = (ROOT / "results" / name / "runs.jsonl").read_text(encoding="utf-8").splitlines()
    return [json.loads(line) for line in lines]


def record(variant="bqsa", scenario="planar_7r"):
    return next(copy.deepcopy(r) for r in records()
                if r["method"]["variant"] == variant and r["scenario"]["name"] == scenario)


def fail(run, failure="drift"):
    run["judged"].update(success=False, failures=[failure])
    run["claim_holds"] = run["claimed"]["status"] != "success"
    run["times"].update(valid=False, publishable=False,
                        against=["not judged a success"] + run["times"]["against"])
    return run


def of_a_real_arm(run, robot="KUKA LBR iiwa 14"):
    """The run with all that a record can say of an arm with a name, thick links, an orientation and a slide."""
    run = copy.deepcopy(run)
    solid = {"name": "box", "kind": "box", "parts": 1, "ellipsoids": 2, "inflation_m": 0.0125,
             "volume_ratio": 2.5, "within_bounds": True, "hull_over_mesh": None}
    run["scenario"].update(name="shelf_s1_00001", sha256=hashlib.sha256(robot.encode()).hexdigest(),
                           reference_clearance_m=0.0101)
    run["problem"].update(robot=robot, link_radius_m=0.07, link_radii_m=[0.07, 0.05, 0.1 + 0.2],
                          orientation="axis", orientation_tolerance_rad=0.02,
                          geometry={"solids": [solid], "gap_lost_m": 0.025, "radius_excess_m": 0.003})
    angle = {"mean_rad": 0.001, "max_rad": 0.0125, "max_tick": 17}
    run["judged"].update(orientation_at_ticks=angle, orientation_between_ticks=angle | {"max_rad": 1 / 3},
                         max_joint_slide_m=0.0123, max_joint_slide_tick=5)
    return run


def of_campaign(run, key, repetition=1):
    run = copy.deepcopy(run)
    run["campaign"] = {"name": "camp", "key": key, "repetition": repetition}
    run["provenance"].update(host="node7", restarts=2, jobs=4)
    return run


def hostile_records():
    """A run for each hostile name, which is that of everything that has one, and numbers at the edge."""
    numbers = [0.1 + 0.2, 1 / 3, 5e-324, 1e300, -0.0, 3.0, None, 1e22, 123456789.12345679,
               1.9109014941674088e-06]
    runs = []
    for i, name in enumerate(HOSTILE):
        run = record("test_point@42d08c1e")
        run["scenario"].update(name=name, file=name, sha256=f"{i:064x}" if i % 7 else name)
        run["problem"]["obstacles"] = [name, name + name]
        run["method"].update(name=name, variant=name, changed=name)
        run["method"]["parameters"] = {key: j for j, key in enumerate(HOSTILE)} | {"text": name}
        run["judged"]["contacts"] = [{"link": 1, "obstacle": name, "first_tick": 3, "at_tick": True,
                                      "ticks": 4}]
        run["claimed"] = {"status": "crashed", "tick": 4, "message": name}
        run["claim_holds"] = True
        run["judged"]["disagreement"] = name
        run["judged"]["clearance_m"] = numbers[i % len(numbers)]
        run["judged"]["start_error_m"] = numbers[(i + 1) % len(numbers)]
        run["counters"][name] = i
        run["trajectory"] = name
        run["times"]["against"] = [name]
        run["provenance"].update(version=name, processor=name, os=name, host=name, date=name,
                                 command_line=name, seed=2**64 - 1 - i, load_average=None,
                                 out_of_tree=[name], external=name)
        fail(run, "collision")
        runs.append(run)
    success = record()
    success["scenario"]["name"] = "two words"  # another file of that name
    return runs + [success]


def write(directory, runs, name="runs.jsonl"):
    file = pathlib.Path(directory) / name
    file.parent.mkdir(parents=True, exist_ok=True)
    text = "".join(run if isinstance(run, str) else json.dumps(run) + "\n" for run in runs)
    file.write_text(text, encoding="utf-8", newline="")
    return directory


def write_plan(directory, keys):
    head = {"schema": "bqsa-plan/1", "campaign": "camp", "program": "0.1.0", "runs": len(keys)}
    lines = [{"key": key, "scenario": "s", "variant": "v", "repetition": 1} for key in keys]
    write(directory, [head] + lines, "plan.jsonl")


def call(*words):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, encoding="utf-8",
                          check=False)
