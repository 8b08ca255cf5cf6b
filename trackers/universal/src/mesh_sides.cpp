// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "mesh_sides.h"

#include <Eigen/Geometry>

namespace anneal6d {

std::vector<MeshSide> sides_of(const TriangleMesh& mesh) {
  const auto welded = mesh.welded();
  const auto triangles = mesh.triangles();
  std::vector<MeshSide> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t from = welded[triangles[t][c]], to = welded[triangles[t][(c + 1) % 3]];
      sides.push_back({std::minmax(from, to), t, from < to});
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const MeshSide& a, const MeshSide& b) { return a.ends < b.ends; });
  return sides;
}

Eigen::Vector3d normal_of(const TriangleMesh& mesh, const Triangle& triangle) {
  const auto at = [&](std::size_t corner) -> Eigen::Vector3d {
    return mesh.vertices()[triangle[corner]].position_mm.cast<double>();
  };
  return (at(1) - at(0)).cross(at(2) - at(0)).normalized();
}

}  // namespace anneal6d
