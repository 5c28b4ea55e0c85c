#!/usr/bin/env bash
# Makes the pages that the tests look at, by the program: `paper`, the paper's scenarios with measurements and
# claims; `odd`, with a crash, a wrong claim, pairs that do not fit and repetitions; `big`, 20 scenarios by 10 methods
# of 400 ticks or so; `robots`, five arms among solids; `solids`, a shelf of boards; `slide`, an arm whose prismatic joint jumps.
#   report/tests/make_reports.sh PROGRAM DIRECTORY
set -euo pipefail
program=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
cd "$(dirname "$0")/../.."
rm -rf "$out"/{paper,odd,big,robots,solids,slide,scenarios}

run() {  # DIRECTORY ARGUMENT...
  local directory=$1
  shift
  "$program" run "$@" --out "$out/$directory" --quiet --no-report
}

run paper scenarios/*.yaml -m none -m bqsa -m bqsa_paper -m bqsa_projection -m bqsa_lookahead -m test_point \
  -m test_point:n=50,m=500 -m qp -m ompl
"$program" measure --quick --sweep plane_nm --sweep step_nk --processes 2 -o "$out/paper/measurements.json" >/dev/null
"$program" report "$out/paper" --claims results/claims/claims.json

run odd scenarios/planar_7r.yaml scenarios/puma560_wall.yaml -m none -m bqsa_paper -m bqsa -m test_point \
  --external "still=python3 -B report/tests/odd_method.py" --external "crasher=python3 -B report/tests/odd_method.py 50"
run odd scenarios/planar_7r.yaml -m ompl --seeds 3
"$program" report "$out/odd"

"$program" generate --family planar --count 12 --seed 3 --out "$out/scenarios/planar"
"$program" generate --family spatial --count 8 --seed 3 --out "$out/scenarios/spatial"
run big "$out"/scenarios/* -m none -m bqsa -m bqsa:release=never -m bqsa_lookahead -m bqsa_escape -m test_point \
  -m potential_field -m qp -m compact_qp -m maciejewski_klein
"$program" report "$out/big"

"$program" generate --family clutter --robots robots --count 10 --seed 1 --out "$out/scenarios/clutter"
"$program" generate --family corridor --robots robots --count 10 --seed 1 --out "$out/scenarios/corridor"
run robots "$out"/scenarios/{clutter,corridor} -m none -m bqsa
"$program" report "$out/robots"

run solids scenarios/solids/ur5e_shelf.yaml scenarios/puma560_ellipsoid.yaml -m none -m bqsa
"$program" report "$out/solids"

run slide tests/harness/program/rail_arm.yaml -m none --external "jumper=python3 -B report/tests/odd_method.py 7 -0.3"
"$program" report "$out/slide"
