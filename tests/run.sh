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

# stage NAME COMMAND...: runs one stage and prints the time it took, also that of all processors.
stage() {
  current_stage=$1
  shift
  echo
  echo "== $current_stage"
  local TIMEFORMAT="== $current_stage: took %0R s; processors %0U s and %0S s in the kernel"
  time "$@"
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

# count FOLDER: adds the results of a build's tests to the totals, and lists each skipped one with
# its reason. CTest's report has an entry for each half of a test program, which GoogleTest's own
# report of that half explains, if the program came to its end.
count() {
  local name status results half_failed half_skipped
  while read -r name status; do
    results=$1/tests/results/$name.xml
    if [[ -f $results ]]; then
      half_failed=$(sed -nE 's/^<testsuites .* failures="([0-9]+)".*/\1/p' "$results")
      half_skipped=$(grep -c '<testcase .* result="skipped"' "$results" || true)
      passed=$((passed + $(grep -c '<testcase ' "$results" || true) - half_failed - half_skipped))
      # A sanitizer can fail a program all of whose tests passed.
      if [[ $status != run ]] && ((half_failed == 0)); then half_failed=1; fi
      failed=$((failed + half_failed))
      skipped=$((skipped + half_skipped))
      list_skipped "$results"
    elif [[ $status == run ]]; then
      passed=$((passed + 1))
    else
      failed=$((failed + 1))
    fi
  done < <(sed -nE 's/.*<testcase name="([^"]*)".* status="([^"]*)".*/\1 \2/p' "$1/junit.xml")
}

# list_skipped FILE: the skipped tests of a GoogleTest report.
list_skipped() {
  awk '
    /<testcase .* result="skipped"/ {
      match($0, / name="[^"]*"/); name = substr($0, RSTART + 7, RLENGTH - 8)
      match($0, / classname="[^"]*"/); name = substr($0, RSTART + 12, RLENGTH - 13) "." name
    }
    /<skipped message=/ {
      sub(/.*<skipped message="[^&]*&#x0A;/, ""); sub(/(&#x0A;)?">.*/, "")
      print "skipped: " name ": " $0
    }
  ' "$1" | sed 's/&#x0A;/ /g; s/&lt;/</g; s/&gt;/>/g; s/&quot;/"/g; s/&apos;/'"'"'/g; s/&amp;/\&/g'
}

# run_tests PRESET FOLDER: runs the tests of a build; the totals are kept also if some fail.
run_tests() {
  local status=0
  "${runner[@]}" ctest --preset "$1" --parallel "$(nproc)" --output-junit junit.xml || status=$?
  count "$2"
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
