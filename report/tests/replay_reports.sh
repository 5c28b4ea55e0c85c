#!/usr/bin/env bash
# Makes the page that the tests of the replay look at, by the program: `replay`, with runs that succeed, collide, give
# up and do not fit, obstacles that move, and links with a thickness.
#   report/tests/replay_reports.sh PROGRAM DIRECTORY
set -euo pipefail
program=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
cd "$(dirname "$0")/../.."
rm -rf "$out/replay"
scenarios=$out/replay/scenarios
mkdir -p "$scenarios/thick"

sed -e 's/^name: .*/name: thick_planar/' -e 's/link_radius: 0/link_radius: 0.05/' -e '/name: object/d' \
  scenarios/planar_7r.yaml >"$scenarios/thick/thick_planar.yaml"
sed -e 's/^name: .*/name: thick_puma/' -e 's/link_radius: 0/link_radius: 45/' \
  scenarios/puma560_ellipsoid.yaml >"$scenarios/thick/thick_puma.yaml"
"$program" generate --family moving --count 4 --seed 5 --out "$scenarios/moving" >/dev/null

run() { "$program" run "$@" --out "$out/replay" --quiet --no-report; }
run scenarios/planar_7r.yaml scenarios/puma560_ellipsoid.yaml -m none -m bqsa -m bqsa_paper -m weighted_least_norm
run "$scenarios"/thick "$scenarios"/moving -m none
run scenarios/planar_7r.yaml -m ompl --seeds 2
"$program" report "$out/replay"
