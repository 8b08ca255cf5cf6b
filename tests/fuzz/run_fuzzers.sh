#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
#
# Runs every fuzzer of a build, one after the other, and stops at the first fault.
#   run_fuzzers.sh BUILD SECONDS [TARGET...]
# New inputs go to BUILD/corpus/TARGET, faults to BUILD/faults; copy what is worth keeping to
# corpus/TARGET under a name that says what it shows.
set -eu
[ $# -ge 2 ] || { echo "usage: $0 BUILD SECONDS [TARGET...]" >&2; exit 2; }
# The readers want real files: in memory they are ten times as fast.
[ ! -d /dev/shm ] || export TMPDIR=${TMPDIR:-/dev/shm}
here=$(cd "$(dirname "$0")" && pwd)
build=$1
seconds=$2
shift 2
[ $# -gt 0 ] || set -- $(ls "$here/corpus")
mkdir -p "$build/faults"
for target in "$@"; do
  mkdir -p "$build/corpus/$target"
  echo "== $target, $seconds s"
  "$build/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
    -max_len=8192 -print_final_stats=1 -close_fd_mask=1 -verbosity=0 \
    -artifact_prefix="$build/faults/$target-" "$build/corpus/$target" "$here/corpus/$target"
done
