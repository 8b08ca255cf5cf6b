#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
#
# Installs what is needed, builds, and tracks two objects: a real cube, filmed by hand (images of the
# Debian package visp-images-data), and a simulated measuring cup, whose true poses are known.
# Leaves videos and poses in out/demo and says where. Stops at the first thing that fails.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

for folder in build out; do
  if [[ -e $folder && ! -w $folder ]]; then
    echo "$PWD/$folder belongs to another user, probably from an earlier run with sudo." >&2
    echo "Remove it (sudo rm -r $folder) or run this with sudo again." >&2
    exit 1
  fi
done

step() { printf '\n== %s\n' "$1"; }

step "Packages"
bash samples/install_packages.sh

step "Build"
cmake --preset linux -D ANNEAL6D_BUILD_TESTS=OFF
cmake --build --preset linux --parallel "$(nproc)"
anneal6d=build/samples/anneal6d

out=out/demo
mkdir -p "$out"

step "A real cube, 218 images"
"$anneal6d" track /usr/share/visp-images-data/ViSP-images/mbt/cube \
  --model samples/models/cube84.obj --camera samples/models/cube_real_camera.yml \
  --init "20.4476989 110.150545 507.896372 0.369745373 0.80422149 0.432676095 -0.171194482" \
  --overlay "$out/cube.mp4" --poses "$out/cube.csv"

step "A simulated measuring cup, 100 images"
"$anneal6d" simulate "$out/cup" --model samples/models/measuring_cup.obj \
  --motion manipulation --background clutter --force
"$anneal6d" track "$out/cup" --overlay "$out/cup.mp4" --poses "$out/cup.csv"
"$anneal6d" evaluate "$out/cup" --out "$out/cup_evaluation"

cat <<END

Done. In $PWD/$out:
  cube.mp4, cube.csv      the real cube: overlay video, and a pose for every frame
  cup/                    the simulated sequence: images, camera, model, true poses
  cup.mp4, cup.csv        the simulated cup: overlay video, and a pose for every frame
  cup_evaluation/         its errors against the true poses: report.html, summary.json, cup/poses.csv
END
