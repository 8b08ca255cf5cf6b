#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
#
# Installs what is needed, builds, and runs every test; then builds and runs the tests that matter
# for them under AddressSanitizer with UBSan, and under ThreadSanitizer. Stops at the first stage
# that fails. See tests/README.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [[ -e build && ! -w build ]]; then
  echo "$PWD/build belongs to another user, probably from an earlier run with sudo." >&2
  echo "Remove it (sudo rm -r build) or run this with sudo again." >&2
  exit 1
fi

passed=0 failed=0 skipped=0
current_stage=

# stage NAME COMMAND...: runs one stage and prints the time it took.
stage() {
  current_stage=$1
  shift
  echo
  echo "== $current_stage"
  local start=$SECONDS
  "$@"
  echo "== $current_stage: done in $((SECONDS - start)) s"
}

report() {
  local status=$?
  trap - EXIT
  echo
  ((status == 0)) || echo "Failed in stage '$current_stage'." >&2
  echo "All stages together: $((SECONDS / 60)) min $((SECONDS % 60)) s"
  if ((passed + failed + skipped > 0)); then
    echo "$passed passed, $failed failed, $skipped skipped"
  fi
  exit "$status"
}
trap report EXIT

# build PRESET: configures and builds with all cores.
build() {
  "${runner[@]}" cmake --preset "$1"
  "${runner[@]}" cmake --build --preset "$1" --parallel "$(nproc)"
}

# attribute NAME FILE: a count in the head of a ctest JUnit report.
attribute() { sed -nE "1,12s/^[[:space:]]*$1=\"([0-9]+)\".*/\1/p" "$2"; }

# Adds the counts of a ctest JUnit report to the totals and lists each skipped test with its reason.
count() {
  local failures skips
  failures=$(attribute failures "$1")
  skips=$(($(attribute skipped "$1") + $(attribute disabled "$1")))
  failed=$((failed + failures))
  skipped=$((skipped + skips))
  passed=$((passed + $(attribute tests "$1") - failures - skips))
  awk '
    /<testcase / { match($0, / name="[^"]*"/); name = substr($0, RSTART + 7, RLENGTH - 8); skip = 0 }
    /<skipped/ { skip = 1 }
    skip == 2 { print "skipped: " name ": " $0; skip = 0 }
    skip && /: Skipped$/ { skip = 2 }
  ' "$1" | sed 's/&lt;/</g; s/&gt;/>/g; s/&quot;/"/g; s/&amp;/\&/g'
}

# run_tests PRESET FOLDER: runs the tests of a build; the totals are kept also if some fail.
run_tests() {
  local status=0
  "${runner[@]}" ctest --preset "$1" --parallel "$(nproc)" --output-junit junit.xml || status=$?
  count "$2/junit.xml"
  return "$status"
}

runner=()
stage "packages" bash samples/install_packages.sh
stage "build" build linux
stage "tests" run_tests linux build

stage "build with AddressSanitizer and UBSan" build asan
stage "tests with AddressSanitizer and UBSan" run_tests asan build/asan

# ThreadSanitizer maps its shadow at fixed addresses, which a kernel with much address space
# randomisation may have given away; some containers forbid switching that off.
if setarch "$(uname -m)" --addr-no-randomize true 2>/dev/null; then
  runner=(setarch "$(uname -m)" --addr-no-randomize)
fi
stage "build with ThreadSanitizer" build tsan
stage "tests with ThreadSanitizer" run_tests tsan build/tsan
