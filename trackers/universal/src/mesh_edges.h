// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// An edge of a mesh, object frame; all of it in one cache line.
struct alignas(64) MeshEdge {
  Eigen::Vector3f from_mm, to_mm;
  /// Of its two triangles, unit, on the same side; of one of them on a border.
  Eigen::Vector3f normal_a, normal_b;
  std::uint32_t triangle_a = 0, triangle_b = 0;  ///< of the mesh
  bool turned =
      false;  ///< triangle_b is wound the other way: `normal_b` is the opposite of its own
  bool border = false;  ///< of an open surface, or where more than two faces meet
  bool crease = false;  ///< sharp and long, or part of such a line: seen also inside the outline
  bool smooth = false;  ///< the faces approximate one smooth surface
};

/// The edges of a mesh but those inside flat faces. An edge where faces meet sharply is a crease if
/// it is long, or if enough of such edges follow each other, as around the rim of a cup of many
/// triangles; others are a scan's noise.
std::vector<MeshEdge> mesh_edges(const TriangleMesh& mesh);

}  // namespace anneal6d
