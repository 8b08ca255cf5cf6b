#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
#
# Installs what Anneal6D needs from Debian 12, as root or through sudo. Does nothing, and needs
# neither root nor a network, if all of it is there already.
set -euo pipefail

packages=(
  # compiler and build
  build-essential cmake ninja-build pkg-config
  # libraries
  libcli11-dev libdc1394-dev libegl-dev libeigen3-dev libepoxy-dev libhwy-dev
  libmeshoptimizer-dev libopencv-dev libspdlog-dev libtbb-dev nlohmann-json3-dev
  # OpenGL without a display or a GPU
  libegl1 libegl-mesa0 libgl1-mesa-dri
  # tests, and the real image sequence they and the demo track
  libgtest-dev visp-images-data
)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "All ${#packages[@]} Debian packages are installed."
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "These packages are missing: ${missing[*]}" >&2
    echo "Install them as root (apt-get install ...), or install sudo, and start again." >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing: ${missing[*]}"
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes
     --option DPkg::Lock::Timeout=300)
"${apt[@]}" update
"${apt[@]}" install --no-install-recommends "${missing[@]}"
