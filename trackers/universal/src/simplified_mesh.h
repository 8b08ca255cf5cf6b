// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <memory>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// The mesh with about `most_triangles` triangles, if it has more: edges collapse onto vertices
/// where that moves the surface least (quadric error; Garland and Heckbert 1997). Nothing moves
/// farther than about 0.25 % of the model's extent, so that an intricate model keeps more of them.
/// Its vertices are some of the mesh's, with their colours and texture coordinates; normals are
/// computed anew. A mesh whose colours change within triangles stays as it is, since they need the
/// vertices.
std::shared_ptr<const TriangleMesh> simplified(std::shared_ptr<const TriangleMesh> mesh,
                                               std::size_t most_triangles);

}  // namespace anneal6d
