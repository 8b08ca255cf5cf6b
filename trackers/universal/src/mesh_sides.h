// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// A triangle at one of its edges.
struct MeshSide {
  std::pair<std::uint32_t, std::uint32_t> ends;  ///< welded vertices, the lower one first
  std::uint32_t triangle;
  bool forward;  ///< the triangle runs through the edge from the lower vertex to the other
};

/// All sides of a mesh, those of an edge next to each other and in the order of the triangles.
std::vector<MeshSide> sides_of(const TriangleMesh& mesh);

/// Calls `look_at(sides)` for the sides of each edge.
template <class LookAt>
void for_each_edge(std::span<const MeshSide> sides, const LookAt& look_at) {
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].ends == sides[first].ends) ++end;
    look_at(sides.subspan(first, end - first));
  }
}

/// Of a triangle: unit, object frame, where its corners run counter-clockwise.
Eigen::Vector3d normal_of(const TriangleMesh& mesh, const Triangle& triangle);

}  // namespace anneal6d
