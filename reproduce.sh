#!/usr/bin/env bash
# From a fresh clone on Debian 12 to the results: installs what is missing, builds, runs the variants on a
# few hundred random problems and all methods on the paper's scenarios, measures times, draws the paper's
# figures and judges its claims; prints summary, table and claims, and writes them as pages to look at.
# Ends with 1 if a claim no longer holds.
set -euo pipefail
cd "$(dirname "$0")"
start=$SECONDS
out=results/local/reproduce
logs=build/logs

tools/install_packages.sh program
echo "building (first time: a few minutes)"
tools/quiet.sh $logs/configure.log cmake --preset release \
  -DBQSA_BUILD_TESTS=OFF -DBQSA_BUILD_BENCHMARKS=OFF
tools/quiet.sh $logs/build.log cmake --build --preset release --target bqsa-bench count_allocations

rm -rf "$out"
program=build/release/src/harness/program/bqsa-bench
"$program" run campaigns/quick.yaml --out "$out/random_problems" --jobs 1  # one at a time, for its times

echo
# All methods as they are, and the test-point method once more with the gains and the density of points
# that it needs to pass the PUMA 560 scenes.
"$program" run scenarios/*.yaml --out "$out" --quiet --no-report
"$program" run scenarios/*.yaml --out "$out" --quiet --no-report \
  --method test_point:law=gradient_projection,n=50,m=2000,influence=0.08,gradient_gain=600
"$program" show "$out"

echo
echo "measuring detectors and control steps (about a minute)"
"$program" measure --quick --out "$out/measurements.json" > "$out/measurements.txt"
"$program" figures --measurements "$out/measurements.json" --out "$out/figures"
echo
status=0
"$program" claims --quick --measurements "$out/measurements.json" --out "$out/claims" || status=$?

"$program" report "$out" > /dev/null || { [ $status -ne 0 ] || status=2; }

seconds=$((SECONDS - start))
echo
echo "results: $out (runs.jsonl, trajectories); show them again: $program show $out"
echo "random problems: $out/random_problems/report.html, or $program show $out/random_problems --summary (or --failures)"
echo "times: $out/measurements.txt; figures: $out/figures/index.md; claims: $out/claims/claims.md"
printf 'elapsed: %d min %d s\n' $((seconds / 60)) $((seconds % 60))
[ ! -e "$out/report.html" ] || echo "table, measurements, claims and the arm's motions, in a browser: $out/report.html"
exit $status
