// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>

#include "mesh_data.h"

namespace anneal6d {

/// Reads a model of the thesis (App. B): NAME.dat holds 18 floats a triangle (nx ny nz x y z, three
/// times), as 18 columns or as 6 columns with three rows a triangle. If NAMETex.dat (6 columns,
/// u v three times; v = 0 is the first row of the picture) and NAME.bmp lie beside it, they are the
/// texture; one without the other is an error. Throws FileError.
MeshData load_dat(const std::filesystem::path& path);

}  // namespace anneal6d
