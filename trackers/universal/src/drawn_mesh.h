// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <memory>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// The mesh as it is drawn to find its edges, which is before a black background: in greys, none of
/// them dark, so that black objects do not vanish; what is brighter stays brighter. A textured mesh
/// is drawn as it is.
std::shared_ptr<const TriangleMesh> mesh_to_draw(std::shared_ptr<const TriangleMesh> mesh);

}  // namespace anneal6d
