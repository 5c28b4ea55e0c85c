"""The JSON Schema of scenario files agrees with what the program loads and refuses.

Usage: check_schema.py SOURCE_DIRECTORY
"""

import json
import pathlib
import sys

import jsonschema
import yaml


def main(source: pathlib.Path) -> int:
    schema = json.loads((source / "scenarios/bqsa-scenario-1.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    failures = []

    good = {path.name: path.read_text() for path in sorted((source / "scenarios").rglob("*.yaml"))}
    table = yaml.safe_load((source / "tests/harness/scenario/bad_scenarios.yaml").read_text())
    good |= {base: table[base] for base in ("planar", "spatial")}
    for name, text in good.items():
        for error in validator.iter_errors(yaml.safe_load(text)):
            failures.append(f"{name}: refused: {error.message}")

    refused = 0
    for case in table["cases"]:
        base = table[case["base"]]
        if case["replace"] not in base:
            failures.append(f"{case['name']}: nothing to replace")
        elif case.get("schema", True):
            text = base.replace(case["replace"], case["by"], 1)
            if validator.is_valid(yaml.safe_load(text)):
                failures.append(f"{case['name']}: accepted")
            refused += 1

    print(*failures, sep="\n")
    print(f"{len(good)} good files, {refused} bad ones, {len(failures)} failures")
    return 0 if not failures and len(good) >= 5 and refused >= 60 else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
