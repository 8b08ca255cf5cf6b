// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>

#include "mesh_data.h"

namespace anneal6d {

/// Reads a glTF 2 model, text (.gltf) or binary (.glb): the meshes of its scene at their places,
/// with normals, if given; points and lines are left out. The albedo is the base colour times the
/// vertex colour, as shown on a screen (sRGB). At most one texture, inside or beside, which then
/// covers the whole model. Extensions that the file requires are refused. Throws FileError.
MeshData load_gltf(const std::filesystem::path& path, bool is_binary);

}  // namespace anneal6d
