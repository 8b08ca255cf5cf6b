// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>

#include "mesh_data.h"

namespace anneal6d {

/// Reads an STL model, text or binary. Facet normals are left out: they say no more than the
/// corners do, and are wrong in many files. Throws FileError.
MeshData load_stl(const std::filesystem::path& path);

}  // namespace anneal6d
