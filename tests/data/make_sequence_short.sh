#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
#
# Makes tests/data/sequence_short again: 20 frames of the measuring cup before clutter.
#
#   tests/data/make_sequence_short.sh [ANNEAL6D]     the tool; default: the one on the PATH
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
exec "${1:-anneal6d}" simulate "$here/sequence_short" --force \
  --model "$here/../../samples/models/measuring_cup.obj" \
  --motion random-walk --sigma-mm 5 --sigma-deg 2 --frames 20 --seed 7 \
  --background clutter --noise 2 --jpeg-quality 92
