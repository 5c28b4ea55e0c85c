#!/usr/bin/env bash
# Generates families of random problems (docs/generator.md), runs methods on them and prints the summary.
#   tools/random_problems.sh quick DIR    BQSA variants, about a minute
#   tools/random_problems.sh full DIR     BQSA variants, the figures of results/random_problems
#   tools/random_problems.sh rivals DIR   all methods, the figures of results/rivals
set -euo pipefail
cd "$(dirname "$0")/.."
program=build/release/src/harness/program/bqsa-bench

variants=(none bqsa bqsa:release=never bqsa_paper bqsa_projection bqsa_lookahead)
seed=1
all_methods=false  # with their defaults, besides the variants
case "${1:-} ${2:+DIR}" in
  "quick DIR") counts="planar=60 spatial=30 moving=20 singular=20 narrow=20" ;;
  "full DIR") counts="planar=2000 spatial=500 moving=200 singular=200 narrow=200 planar_any=200" ;;
  "rivals DIR")
    counts="planar=200 spatial=100 moving=50"
    seed=4  # neither the seed by which BQSA was developed nor that of the gain sweep
    all_methods=true
    variants=(maciejewski_klein:closest=fcl fcl_gp:solver=libccd_m qp:solver=dual_network)
    ;;
  *) echo "usage: tools/random_problems.sh quick|full|rivals DIR" >&2; exit 2 ;;
esac
out=$2
methods=("${variants[@]/#/--method=}")

for count in $counts; do
  family=${count%=*}
  directory=$out/scenarios/$family
  "$program" generate --family "$family" --count "${count#*=}" --seed "$seed" --out "$directory"
  run=("$program" run "$directory" --out "$out" --no-trajectories --quiet --plan-budget 5)
  if $all_methods; then "${run[@]}"; fi
  "${run[@]}" "${methods[@]}"
done
"$program" show "$out" --summary
