// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <memory>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

enum class LengthUnit { millimetre, centimetre, metre };

/// Reads a model: OBJ (+MTL, texture), PLY, STL, glTF 2; IVT `object.dat` (with
/// `objectTex.dat` and `object.bmp` beside it, if there); ViSP `.cao`. Multiplies lengths by
/// `unit`. Throws FileError: missing or malformed file, no triangle, several textures, a diameter
/// under 5 mm or over 5 m (with a hint about units).
TriangleMesh load_mesh(const std::filesystem::path& path, LengthUnit unit = LengthUnit::millimetre);

/// "mm", "cm", "m"; anything else throws ConfigError.
LengthUnit parse_length_unit(std::string_view text);

}  // namespace anneal6d
