#!/usr/bin/env bash
# Installs what packages.txt lists for the given steps and is missing; does nothing if all is there.
#   tools/install_packages.sh program tests
# A package with a command in the third column is left alone where there is such a command already.
# Without the rights to install it prints the command to run instead and fails.
set -euo pipefail
cd "$(dirname "$0")/.."

missing=()
for step in "$@"; do
  while read -r package command; do
    [ -z "$command" ] || ! command -v "$command" >/dev/null || continue
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) ||
      status=unknown
    [ "$status" = installed ] || missing+=("$package")
  done < <(awk -v step="$step" '!/^#/ && $2 == step { print $1, $3 }' packages.txt)
done
[ ${#missing[@]} -gt 0 ] || exit 0

if [ "$(id -u)" = 0 ]; then
  as_root=(env)
elif sudo -n true 2>/dev/null; then
  as_root=(sudo -n env)
elif command -v sudo >/dev/null && [ -t 0 ]; then
  as_root=(sudo env)
else
  echo "missing packages, and no right to install them; as root run:" >&2
  echo "  apt-get update && apt-get install -y --no-install-recommends ${missing[*]}" >&2
  exit 1
fi

echo "installing: ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update &&
       "${as_root[@]}" DEBIAN_FRONTEND=noninteractive \
         apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  cat "$log" >&2
  echo "installing packages failed" >&2
  exit 1
fi
