// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>

#include "mesh_data.h"

namespace anneal6d {

/// Reads a Wavefront OBJ model: faces of any number of corners, with normals, texture coordinates
/// (v counted from the bottom) and colours of vertices ("v x y z r g b"), if there; materials of
/// MTL files: Kd and one map_Kd, which then covers the whole model. Points and lines are left out;
/// curves and surfaces are refused. Throws FileError with the line.
MeshData load_obj(const std::filesystem::path& path);

}  // namespace anneal6d
