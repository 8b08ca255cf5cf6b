// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>

#include "mesh_data.h"

namespace anneal6d {

/// Reads a ViSP `.cao` model (version V1): faces from points and from lines become triangles,
/// cylinders open tubes, circles discs; lines by themselves have no surface and are left out.
/// `load("part.cao")` adds files, relative to the one that names them. Options (`name=...`) are
/// skipped. Throws FileError with the line.
MeshData load_cao(const std::filesystem::path& path);

}  // namespace anneal6d
