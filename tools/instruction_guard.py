#!/usr/bin/env python3
"""Fails when a hot path of the project needs 2 % more, or fewer, instructions than recorded.

  tools/instruction_guard.py               all kernels against results/instructions/baseline.json
  tools/instruction_guard.py --kernel K    one of them
  tools/instruction_guard.py --record      makes what is measured the baseline of this toolchain
  tools/instruction_guard.py --self-test   the guard itself: A against A passes, 5 % more work fails

Instructions are counted by valgrind's callgrind, of the repetitions alone: what precedes them varies from
run to run. Counts repeat to a dozen as long as compiler, flags and libraries are the same, and are
compared only then. Needs the release build with its benchmarks (docs/guarding.md). Status: 0 nothing
to do, 1 a count has changed, 2 nothing could be measured.
"""
import argparse
import concurrent.futures
import datetime
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/benchmarks/instruction_guard"
BASELINE = ROOT / "results/instructions/baseline.json"
TOLERANCE = 0.02
REPETITIONS = 3
COUNTED = "bqsa::counted_repetitions*"  # the function in which the program repeats

# The self-test: repetitions by which 5 % of them can be done twice, and how well counts repeat.
SELF_TEST_KERNELS = ("segment/polar_form_shared_ends/space", "step/bqsa/planar_7r/free")
SELF_TEST_REPETITIONS = 100
INJECTED_PERCENT = 5
REPEATABILITY = 1e-4

# The C library picks variants of sin, cos, memcpy and others by the processor; the plain ones run
# everywhere.
TUNABLES = "glibc.cpu.hwcaps=-AVX512F,-AVX2,-AVX,-FMA,-FMA4,-BMI2,-ERMS,-SSE4_2,-SSE4_1,-SSSE3"


class GuardError(Exception):
    """Nothing could be measured or compared; the message says why."""


def output_of(command, **options):
    done = subprocess.run(command, text=True, capture_output=True, check=False, **options)
    if done.returncode != 0:
        raise GuardError(f"{' '.join(map(str, command))}: status {done.returncode}\n"
                         f"{done.stderr.strip()}")
    return done


def instructions(program, kernel, repetitions=REPETITIONS, inject=0):
    """Instructions of one repetition."""
    environment = {"GLIBC_TUNABLES": TUNABLES}
    for name in ("PATH", "LD_LIBRARY_PATH", "VALGRIND_LIB"):
        if name in os.environ:
            environment[name] = os.environ[name]
    command = ["valgrind", "--tool=callgrind", f"--toggle-collect={COUNTED}",
               "--callgrind-out-file=/dev/null", program, "--kernel", kernel,
               "--repetitions", str(repetitions), "--inject", str(inject)]
    report = output_of(command, env=environment).stderr
    found = re.search(r"Collected : (\d+)", report)
    if not found or int(found[1]) == 0:
        raise GuardError(f"{kernel}: expected a count from callgrind, got\n{report.strip()}")
    return round(int(found[1]) / repetitions)


def measure(program, kernels, jobs):
    """{kernel: instructions of a repetition}"""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return dict(zip(kernels, pool.map(lambda kernel: instructions(program, kernel), kernels)))


def read_baseline(file):
    """The entries of a baseline file, one a toolchain; none if there is no file."""
    if not file.exists():
        return []
    try:
        entries = json.loads(file.read_text(encoding="utf-8"))["baselines"]
        for entry in entries:
            sound = (isinstance(entry["toolchain"], dict) and isinstance(entry["recorded"], dict) and
                     all(type(count) is int and count > 0
                         for count in entry["instructions"].values()))
            if not sound:
                raise ValueError("instructions must be positive whole numbers")
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise GuardError(f"{file}: expected a baseline as --record writes it, got "
                         f"{type(error).__name__}: {error}") from None
    return entries


def entry_of(entries, toolchain):
    """The entry of a toolchain, or None."""
    return next((entry for entry in entries if entry["toolchain"] == toolchain), None)


def compare(recorded, measured, kernels):
    """(kernel, finding) of every kernel there is, measured or in the baseline.

    kernels  those that the program has; those among them that are not measured are left out
    A finding is "same", "worse", "better", "new" (not in the baseline) or "gone" (from the program).
    """
    findings = []
    for kernel, count in measured.items():
        if kernel not in recorded:
            findings.append((kernel, "new"))
        elif count > recorded[kernel] * (1 + TOLERANCE):
            findings.append((kernel, "worse"))
        elif count < recorded[kernel] * (1 - TOLERANCE):
            findings.append((kernel, "better"))
        else:
            findings.append((kernel, "same"))
    return findings + [(kernel, "gone") for kernel in recorded if kernel not in kernels]


ADVICE = {
    "worse": "worse: needs over 2 % more instructions than recorded. If that is meant: --record",
    "better": "better: needs over 2 % fewer instructions than recorded. Keep the gain: --record",
    "new": "new: not in the baseline. Guard it: --record",
    "gone": "gone: in the baseline, but not in the program. If that is meant: --record",
}


def table(findings, recorded, measured):
    lines = [f"{'instructions of a repetition':46} {'recorded':>12} {'now':>12}   change"]
    for kernel, finding in findings:
        before, now = recorded.get(kernel), measured.get(kernel)
        change = f"{100 * (now / before - 1):+8.2f} %" if before and now else f"{'-':>8}  "
        mark = "" if finding == "same" else f"  {finding}"
        lines.append(f"{kernel:46} {before or '-':>12} {now or '-':>12} {change}{mark}")
    return "\n".join(lines)


def verdict(findings):
    """(what to say at the end, exit status)"""
    bad = [finding for _, finding in findings if finding != "same"]
    if not bad:
        return f"instruction guard: {len(findings)} kernels within 2 % of the baseline", 0
    said = [f"  {ADVICE[finding]}" for finding in ADVICE if finding in bad]
    return "\n".join([f"instruction guard: {len(bad)} of {len(findings)} kernels differ"] + said), 1


def guard(file, build, measured, kernels):
    """Compares and prints; the exit status."""
    entry = entry_of(read_baseline(file), build["toolchain"])
    if entry is None:
        for kernel, count in measured.items():
            print(f"{kernel:46} {count:>12}")
        print("toolchain: " + ", ".join(f"{k} {v}" for k, v in build["toolchain"].items()))
        print("no baseline for this toolchain; nothing was compared; --record makes one")
        return 0
    recorded = entry["instructions"]
    findings = compare(recorded, measured, kernels)
    text, status = verdict(findings)
    print(table(findings, recorded, measured))
    print(text)
    return status


def record(file, build, measured, kernels):
    """Puts what was measured into the entry of this toolchain, and drops kernels that are gone."""
    entries = read_baseline(file)
    entry = entry_of(entries, build["toolchain"])
    if entry is None:
        entry = {"toolchain": build["toolchain"], "recorded": {}, "instructions": {}}
        entries.append(entry)
    now = datetime.datetime.now(datetime.timezone.utc)
    entry["recorded"] = {
        "date": now.strftime("%Y-%m-%dT%H:%M:%SZ"),
        "commit": build["commit"] + (", modified" if build["modified"] else ""),
        "valgrind": output_of(["valgrind", "--version"]).stdout.strip(),
    }
    known = {**entry["instructions"], **measured}
    entry["instructions"] = {kernel: known[kernel] for kernel in kernels if kernel in known}
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps({"baselines": entries}, indent=2) + "\n", encoding="utf-8")
    print(f"recorded {len(measured)} of {len(kernels)} kernels in {file}")
    return 0


def self_test(program):
    """The whole gate on kernels as they are and with work injected; the exit status."""
    failures = 0

    def expect(kernel, what, before, now, status, repeats=False):
        nonlocal failures
        found = verdict(compare({kernel: before}, {kernel: now}, [kernel]))[1]
        good = found == status and (not repeats or abs(now - before) <= REPEATABILITY * before)
        failures += not good
        outcome = f"{'fails' if found else 'passes'}{', as it must' if good else ': WRONG'}"
        print(f"{kernel}: {what}: {before} and {now} ({100 * (now / before - 1):+.3f} %): {outcome}")

    for kernel in SELF_TEST_KERNELS:
        def count(percent, of=kernel):
            return instructions(program, of, SELF_TEST_REPETITIONS, percent)
        first, second, injected = count(0), count(0), count(INJECTED_PERCENT)
        expect(kernel, "A against A", first, second, 0, repeats=True)
        expect(kernel, f"A against A with {INJECTED_PERCENT} % more work", first, injected, 1)
        expect(kernel, f"A with {INJECTED_PERCENT} % more work against A", injected, first, 1)
    print("instruction guard: " + (f"self-test: {failures} FAILED" if failures else
                                   "self-test: passes what it must and fails what it must"))
    return 1 if failures else 0


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("--kernel", metavar="K", action="append", help="may be given several times")
    parser.add_argument("--jobs", "-j", type=int, default=len(os.sched_getaffinity(0)), metavar="N",
                        help="processes at a time; by default as many as cores")
    parser.add_argument("--program", type=pathlib.Path, default=PROGRAM, metavar="FILE",
                        help="default build/release/benchmarks/instruction_guard")
    parser.add_argument("--baseline", type=pathlib.Path, default=BASELINE, metavar="FILE",
                        help="default results/instructions/baseline.json")
    given = parser.parse_args()
    if given.jobs < 1:
        parser.error(f"--jobs: expected at least 1, got {given.jobs}")
    if given.self_test and (given.record or given.kernel):
        parser.error("expected --self-test alone")
    return given


def run(given):
    if not shutil.which("valgrind"):
        raise GuardError("valgrind: not found; on Debian: apt-get install valgrind")
    if not given.program.exists():
        raise GuardError(f"{given.program}: not found; build it: cmake --preset release "
                         "-DBQSA_BUILD_BENCHMARKS=ON && cmake --build --preset release "
                         "--target instruction_guard")
    program = given.program.resolve()
    if given.self_test:
        return self_test(program)
    read_baseline(given.baseline)  # what is wrong with it is said before a minute of measuring
    build = json.loads(output_of([program, "--build"]).stdout)
    kernels = output_of([program, "--list"]).stdout.split()
    wanted = given.kernel or kernels
    if unknown := [kernel for kernel in wanted if kernel not in kernels]:
        raise GuardError(f"--kernel: expected one that `{given.program} --list` names, got "
                         f"'{unknown[0]}'")
    measured = measure(program, wanted, given.jobs)
    return (record if given.record else guard)(given.baseline, build, measured, kernels)


def main():
    given = arguments()
    try:
        return run(given)
    except GuardError as error:
        print(f"instruction guard: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
