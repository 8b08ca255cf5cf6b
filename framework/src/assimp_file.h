// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <string_view>

#include "mesh_data.h"

namespace anneal6d {

/// Whether `extension` (".obj", lower case) is of a format that `load_with_assimp` reads: OBJ,
/// glTF. PLY and STL have readers of our own: assimp's hang on truncated PLY and accept truncated
/// STL.
bool is_read_by_assimp(std::string_view extension);

/// Reads a model through assimp: all meshes of the scene at their places, polygons cut into
/// triangles, points and lines left out, normals as the file gives them. The albedo is the
/// material's diffuse colour times the vertex colour, as shown on a screen (sRGB). At most one
/// texture, which then covers the whole model. Every file the model names must be there. Throws
/// FileError.
MeshData load_with_assimp(const std::filesystem::path& path, std::string_view extension);

}  // namespace anneal6d
