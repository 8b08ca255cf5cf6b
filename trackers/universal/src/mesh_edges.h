// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// An edge of a mesh, object frame.
struct MeshEdge {
  Eigen::Vector3d from_mm, to_mm;
  /// Of the faces, unit, on the same side; equal on a border.
  Eigen::Vector3d normal_a, normal_b;
  bool border = false;  ///< of an open surface, or where more than two faces meet
  bool crease = false;  ///< part of a long sharp line, seen even where no silhouette is
  bool smooth = false;  ///< the faces approximate one smooth surface
};

/// The edges of a mesh but those inside flat faces. Where faces meet sharply there is a crease, if
/// enough of such edges follow each other, as around the rim of a cup of many triangles; short
/// ones are a scan's noise.
std::vector<MeshEdge> mesh_edges(const TriangleMesh& mesh);

}  // namespace anneal6d
