#!/usr/bin/env bash
# Submits a campaign to Slurm: its incomplete shards as an array job, and after them, however they end, a
# merge. The same call again submits what is still missing.
#   scripts/slurm/submit.sh CAMPAIGN DIR SHARDS [SBATCH OPTION...] [-- RUN OPTION...]
# DIR is on a file system that all nodes share. One shard should hold minutes of work. SBATCH OPTIONs go to
# the array job, as --time=30 --exclusive --partition=...; RUN OPTIONs to `bqsa-bench run`, as
# --external "mine=python3 mine.py". The program is $BQSA_BENCH, else the one in PATH, else that of this tree.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

if (($# < 3)); then
  echo "usage: $0 CAMPAIGN DIR SHARDS [SBATCH OPTION...] [-- RUN OPTION...]" >&2
  exit 2
fi
campaign=$(realpath "$1")
shards=$3
mkdir -p "$2/slurm"
directory=$(realpath "$2")
shift 3
of_array=()
while (($# > 0)) && [[ $1 != -- ]]; do
  of_array+=("$1")
  shift
done
(($# > 0)) && shift

program=${BQSA_BENCH:-$(command -v bqsa-bench || echo "$here/../../build/release/src/harness/program/bqsa-bench")}
for_plan=()  # the run options that the plan depends on
force=false
for ((i = 1; i <= $#; ++i)); do
  case ${!i} in
    --external) j=$((i + 1)) && for_plan+=(--external "${!j}") ;;
    --external=* | --allow-outside) for_plan+=("${!i}") ;;
    --force) force=true ;;
  esac
done

"$program" plan "$campaign" --out "$directory" "${for_plan[@]}"
missing=$("$program" missing "$shards" "$directory")
$force && missing=1-$shards
common=(--parsable --chdir="$PWD" --export=ALL)
if [[ -n $missing ]]; then
  array=$(sbatch "${common[@]}" --job-name=bqsa-shard --array="$missing" --requeue --open-mode=append \
    --output="$directory/slurm/shard-%a.log" "${of_array[@]}" \
    "$here/shard.sbatch" "$program" "$campaign" "$directory" "$shards" "$@")
  echo "shards $missing of $shards: job $array"
  common+=(--dependency="afterany:$array")
else
  echo "all $shards shards are complete"
fi
merge=$(sbatch "${common[@]}" --job-name=bqsa-merge --output="$directory/slurm/merge.log" \
  "$here/merge.sbatch" "$program" "$directory")
echo "merge: job $merge, which fails if runs are missing; then call this again"
