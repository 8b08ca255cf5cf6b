// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// What is drawn at once: two triangles (0, 1, 2) and (0, 2, 3) that make a plane convex
/// quadrilateral, or one triangle, whose last two corners are the same.
struct Face {
  std::array<std::uint32_t, 4> corners;  ///< wound like its triangles
  std::uint32_t triangle;                ///< index of the first of them

  bool is_pair() const { return corners[2] != corners[3]; }
};

/// Joins triangles of a mesh into pairs where it can, longest common edges first: diagonals. Their
/// vertices there are alike; with `textured`, texture coordinates are also linear across both. In
/// the order of the triangles.
std::vector<Face> faces_of(const TriangleMesh& mesh, bool textured);

}  // namespace anneal6d
