#!/usr/bin/env bash
# Generates families of random problems (docs/generator.md), runs the BQSA variants on them and prints the
# summary.
#   tools/random_problems.sh quick DIR   about a minute
#   tools/random_problems.sh full DIR    the figures of results/random_problems
set -euo pipefail
cd "$(dirname "$0")/.."
program=build/release/src/harness/program/bqsa-bench

case "${1:-} ${2:+DIR}" in
  "quick DIR") counts="planar=60 spatial=30 moving=20 singular=20 narrow=20" ;;
  "full DIR") counts="planar=2000 spatial=500 moving=200 singular=200 narrow=200 planar_any=200" ;;
  *) echo "usage: tools/random_problems.sh quick|full DIR" >&2; exit 2 ;;
esac
out=$2

for count in $counts; do
  family=${count%=*}
  directory=$out/scenarios/$family
  "$program" generate --family "$family" --count "${count#*=}" --seed 1 --out "$directory"
  "$program" run "$directory" --out "$out" --no-trajectories --quiet \
    --method none --method bqsa --method bqsa:release=never --method bqsa_paper \
    --method bqsa_projection --method bqsa_lookahead
done
"$program" show "$out" --summary
