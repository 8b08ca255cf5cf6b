// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// Writes `path` (.obj), beside it the materials (.mtl) and, if there is one, the texture (.png) of
/// the same name. Lengths in millimetres; numbers such that they read back exactly. A colour that
/// changes within a triangle is written to the vertices ("v x y z r g b"), else to materials.
/// Throws FileError.
void write_obj(const TriangleMesh& mesh, const std::filesystem::path& path);

}  // namespace anneal6d
