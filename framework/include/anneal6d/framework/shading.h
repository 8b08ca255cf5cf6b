// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>

namespace anneal6d {

/// Nearest depth that is drawn: all renderers clip triangles at this plane, so that they agree on
/// objects that touch or pass behind the camera.
inline constexpr double kNearPlane_mm = 10.0;

/// Gouraud shading with one distant light, lit from both sides: the colour of a vertex is
/// albedo * min(1, ambient + diffuse * |normal . to_light|), interpolated linearly in the image; a
/// texture multiplies it, sampled bilinearly with repeat at one level for the whole object
/// (`TriangleMesh::texture_level_for` with px_per_mm = fx / z of the object's centre).
struct Shading {
  Eigen::Vector3f to_light = Eigen::Vector3f(-0.3F, -0.4F, -0.85F).normalized();  ///< camera frame
  float ambient = 0.4F;
  float diffuse = 0.6F;
};

}  // namespace anneal6d
