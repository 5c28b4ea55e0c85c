#!/usr/bin/env bash
# Runs a command with its output in a log file that is shown only if the command fails.
#   tools/quiet.sh LOG COMMAND...
set -euo pipefail
log=$1
shift
mkdir -p "$(dirname "$log")"
if ! "$@" >"$log" 2>&1; then
  cat "$log" >&2
  echo "failed: $* (log: $log)" >&2
  exit 1
fi
