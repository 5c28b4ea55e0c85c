#!/usr/bin/env bash
# Builds and runs the tests.
#   ./test.sh         release build, all tests
#   ./test.sh --full  also: sanitizers, headers on their own, clang-tidy, layout of the code,
#                     API reference, instruction counts against results/instructions, page of reports
set -euo pipefail
cd "$(dirname "$0")"
start=$SECONDS
logs=build/logs
jobs=$(nproc)

full=false
case "${1:-}" in
  "") ;;
  --full) full=true ;;
  *) echo "usage: ./test.sh [--full]" >&2; exit 2 ;;
esac

step() {
  echo
  echo "== $*"
}

build() {  # PRESET [CMAKE OPTION...]
  local preset=$1
  shift
  tools/quiet.sh "$logs/configure-$preset.log" cmake --preset "$preset" \
    -DBQSA_BUILD_TESTS=ON -DBQSA_BUILD_BENCHMARKS=ON "$@"
  tools/quiet.sh "$logs/build-$preset.log" cmake --build --preset "$preset"
}

if $full; then
  tools/install_packages.sh program tests full

  step "page of reports: packages to build and look at it"
  tools/quiet.sh "$logs/report-packages.log" tools/report.sh install

  step "layout: clang-format"
  git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run --Werror

  step "sanitizers: build and tests"
  # Without the generator, the equivalences of the variants, whole exports, and statistics over millions of
  # questions, whose code others run too: compiling and running those takes long.
  tools/quiet.sh "$logs/configure-sanitize.log" cmake --preset sanitize \
    -DBQSA_BUILD_TESTS=ON -DBQSA_BUILD_BENCHMARKS=OFF
  tools/quiet.sh "$logs/build-sanitize.log" cmake --build --preset sanitize --target \
    bqsa-bench harness geometry_test batch_test kinematics_test hybrid_ik_test contract_test algorithm_test \
    baselines_test baselines_fcl_test baselines_ompl_test judge_test scenario_test runner_test \
    results_test campaign_test program_test canaries_test conformance_test mixes_test external_test \
    external_canaries_test external_program_test kdl_reference_test skeleton_test statistics_test \
    measuring_test measuring_engine_test claims_test report_test urdf_chain_test fuzz_corpus_test
  ctest --preset sanitize --parallel "$jobs" --progress \
    --exclude-regex '_NOT_BUILT$|^Install|^Exchange|^MissRate|^Conservatism|OfTheRepositorysClaims'

  step "release: build, every header on its own"
  build release -DBQSA_CHECK_HEADERS=ON

  step "instruction guard: test of the gate"
  tools/instruction_guard.py --self-test

  step "instruction guard: hot paths against the baseline"
  tools/instruction_guard.py

  step "static analysis: clang-tidy"
  git ls-files 'src/*.cpp' ':!*_test.cpp' | xargs -P "$jobs" -n 4 clang-tidy -p build/release --quiet \
    --warnings-as-errors='*' 2>/dev/null

  step "API reference: doxygen"
  tools/quiet.sh "$logs/api.log" doxygen docs/Doxyfile
else
  tools/install_packages.sh program tests
  step "release: build (--full adds sanitizers, header check, clang-tidy, layout, API reference)"
  build release
fi

step "release: tests"
status=0
ctest --preset release --parallel "$jobs" --progress || status=$?

seconds=$((SECONDS - start))
printf '\nelapsed: %d min %d s\n' $((seconds / 60)) $((seconds % 60))
exit $status
