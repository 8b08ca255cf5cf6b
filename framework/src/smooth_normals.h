// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <vector>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// Normal of a triangle, as long as twice its area.
Eigen::Vector3f scaled_normal(const std::vector<MeshVertex>& vertices, const Triangle& triangle);

/// Gives every corner whose vertex has no normal a smoothed one, splitting vertices at creases.
/// `welded`: for each vertex the first one at the same place. Every triangle has an area.
void add_missing_normals(std::vector<MeshVertex>& vertices, std::vector<Triangle>& triangles,
                         const std::vector<std::uint32_t>& welded);

}  // namespace anneal6d
