#!/usr/bin/env bash
# The page of reports (report/README.md), whose template is built by Node.
#   tools/report.sh install         the packages of its lock file, into build/report
#   tools/report.sh build           builds template and types anew
#   tools/report.sh check           builds them elsewhere and compares
#   tools/report.sh test PROGRAM    has PROGRAM make pages, and looks at them in a browser
# Exit status: 0 done, 1 failed, 2 called wrongly, 77 something is not installed.
set -euo pipefail
cd "$(dirname "$0")/.."
packages=$PWD/build/report
template=dist/template.html
types=src/report-data.d.ts

missing() {
  echo "skipped: $*"
  exit 77
}

need_node() {
  command -v node >/dev/null || missing "node is not installed"
  node -e 'process.exit(parseInt(process.versions.node) >= 18 ? 0 : 1)' ||
    missing "node $(node --version) is too old, 18 is needed"
}

need_packages() {
  need_node
  cmp -s report/package-lock.json "$packages/installed-lock.json" ||
    missing "the npm packages are not installed; run tools/report.sh install"
}

# A copy of the sources, with the packages, in which whatever is built or left lying disturbs nobody.
copy_sources() {
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  mkdir "$work/report"
  tar -C report --exclude=./node_modules -cf - . | tar -C "$work/report" -xf -
  ln -s "$packages/node_modules" "$work/report/node_modules"
}

build() {  # in a copy
  cd "$work/report"
  rm -f "$template" "$types"
  node generate_types.mjs || exit 1
  node node_modules/typescript/bin/tsc --noEmit || exit 1
  node node_modules/vite/bin/vite.js build --logLevel warn || exit 1
  cd - >/dev/null
}

same() {  # FILE of the tree and of the copy
  cmp "report/$1" "$work/report/$1" >&2 || {
    echo "report/$1: is not what its sources give; run tools/report.sh build" >&2
    return 1
  }
}

case "${1:-}:$#" in
  install:1)
    need_node
    command -v npm >/dev/null || missing "npm is not installed"
    cmp -s report/package-lock.json "$packages/installed-lock.json" && exit 0
    rm -f "$packages/installed-lock.json"
    mkdir -p "$packages"
    cp report/package.json report/package-lock.json report/.npmrc "$packages"
    (cd "$packages" && npm ci)
    cp report/package-lock.json "$packages/installed-lock.json"
    ;;
  build:1)
    need_packages
    copy_sources
    build
    cp "$work/report/$template" "report/$template"
    cp "$work/report/$types" "report/$types"
    ;;
  check:1)
    need_packages
    copy_sources
    build
    status=0
    same "$types" || status=1
    same "$template" || status=1
    exit $status
    ;;
  test:2)
    need_packages
    browser=${CHROMIUM:-/usr/bin/chromium}
    [ -x "$browser" ] || missing "no browser $browser; set CHROMIUM"
    program=$(realpath "$2")
    copy_sources
    report/tests/make_reports.sh "$program" "$work/pages" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    report/tests/replay_reports.sh "$program" "$work/pages" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    cd "$work/report"
    CHROMIUM=$browser BQSA_REPORT_PAGES=$work/pages node --test tests/*.test.mjs
    ;;
  *)
    sed -n '2,7s/^# \?//p' "$0" >&2
    exit 2
    ;;
esac
