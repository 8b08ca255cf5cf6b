// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/shading.h"
#include "anneal6d/framework/triangle_mesh.h"
#include "gl_name.h"
#include "mesh_program.h"

namespace anneal6d {

/// A mesh on the graphics card and the course of drawing it into whatever framebuffer is bound, on
/// screen or off. All calls need the context current in which it was made.
class MeshDrawer {
 public:
  /// Throws GraphicsError: the texture is larger than the driver allows, out of memory.
  MeshDrawer(const TriangleMesh& mesh, bool textured);

  /// Draws into the viewport [0, width) x [0, height); window row 0 becomes image row 0. Draws
  /// nothing for a pose that is not finite or behind the near plane. Expects a cleared depth
  /// buffer.
  void draw(const Pose& camera_from_object, const CameraModel& camera,
            const Shading& shading) const;

 private:
  const TriangleMesh& mesh_;
  MeshProgram program_, clipping_program_;
  GlVertexArray vertex_array_;
  GlBuffer vertices_, indices_;
  GlTexture white_;                ///< the texture of what has none
  std::vector<GlTexture> levels_;  ///< one texture a level: just one of them is used in a picture
};

}  // namespace anneal6d
