// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>

#include "mesh_data.h"

namespace anneal6d {

/// Reads a PLY model, text or binary: elements `vertex` (x y z; if there, normals nx ny nz, colours
/// red green blue, texture coordinates s t, u v or texture_u texture_v, v counted from the bottom)
/// and `face` (list vertex_indices or vertex_index; if there, list texcoord with two numbers a
/// corner). A line "comment TextureFile NAME" names the texture. Throws FileError.
MeshData load_ply(const std::filesystem::path& path);

}  // namespace anneal6d
