#!/usr/bin/env bash
# Fuzzes what reads bytes of others, one target after the other (docs/fuzzing.md).
#   tools/fuzz.sh [TARGET...] [SECONDS]
# Default: all targets, 600 seconds of processor time each. Fails upon the first finding and names the
# input, which it leaves in build/fuzz/findings.
set -euo pipefail
cd "$(dirname "$0")/.."

targets=()
seconds=600
for argument in "$@"; do
  if [[ $argument =~ ^[1-9][0-9]*$ ]]; then
    seconds=$argument
  elif [[ -d tests/fuzz/corpus/$argument && $argument =~ ^[a-z_]+$ ]]; then
    targets+=("$argument")
  else
    echo "usage: tools/fuzz.sh [TARGET...] [SECONDS], targets: $(ls tests/fuzz/corpus | xargs)" >&2
    exit 2
  fi
done
[ ${#targets[@]} -gt 0 ] || mapfile -t targets < <(ls tests/fuzz/corpus)

tools/install_packages.sh program tests fuzz
tools/quiet.sh build/logs/configure-fuzz.log cmake --preset fuzz
tools/quiet.sh build/logs/build-fuzz.log cmake --build --preset fuzz --target "${targets[@]/#/fuzz_}"

# The readers' files, on a memory disk where there is one.
TMPDIR=$(mktemp -d -p "$([ -w /dev/shm ] && echo /dev/shm || echo /tmp)" bqsa-fuzz-XXXXXX)
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT

# The words of the formats: whatever stands in quotes in the readers.
dictionary=build/fuzz/words.dict
grep -rhoE '"[A-Za-z][A-Za-z0-9_ /-]{1,30}"' src/harness/{scenario,campaign,external,results} \
  src/harness/{runner,failure_class,judge/judge}.cpp src/bqsa/method.cpp | sort -u >$dictionary

fuzz() {  # TARGET SECONDS
  local found=build/fuzz/corpus/$1 log=build/logs/fuzz-$1.log
  mkdir -p "$found" build/fuzz/findings
  nice -n 15 "build/fuzz/tests/fuzz/fuzz_$1" -max_total_time="$2" -timeout=10 -rss_limit_mb=2048 \
    -dict=$dictionary -artifact_prefix="build/fuzz/findings/$1-" -print_final_stats=1 \
    "$found" "tests/fuzz/corpus/$1" >"$log" 2>&1 && return
  grep -vE '^#[0-9]+\s' "$log" | tail -n 60 >&2
  echo "finding in $1 (log: $log)" >&2
  return 1
}

processor_seconds() {  # of ended children
  awk '{ printf "%d", ($16 + $17) / hertz }' hertz="$(getconf CLK_TCK)" /proc/$$/stat
}

for target in "${targets[@]}"; do
  executions=0
  begin=$(processor_seconds)
  left=$seconds
  while [ "$left" -gt 0 ]; do
    fuzz "$target" "$left"
    log=build/logs/fuzz-$target.log
    executions=$((executions + $(awk '/number_of_executed_units/ { print $2 }' "$log")))
    left=$((seconds - $(processor_seconds) + begin))
  done
  echo "$target: $executions executions in $((seconds - left)) s of processor time," \
    "$(grep -oE 'cov: [0-9]+ ft: [0-9]+ corp: [0-9]+/[^ ]+' "$log" | tail -n 1)"
done
