// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>

#include "anneal6d/framework/shading.h"
#include "gl_name.h"

namespace anneal6d {

/// The shading of shading.h as an OpenGL program. Vertex attributes: 0 position_mm, 1 normal, 2 uv,
/// 3 albedo_bgr. Outputs: 0 the colour (red, green, blue), 1 the depth in millimetres.
class MeshProgram {
 public:
  /// `clips`: triangles are cut at the near plane by the program itself. OpenGL's own clipping
  /// interpolates for a linear image, in which a corner behind the camera has no place.
  explicit MeshProgram(bool clips);

  void use(const Eigen::Matrix4f& clip_from_camera, const Eigen::Matrix3f& camera_from_object,
           const Eigen::Vector3f& translation_mm, const Shading& shading) const;

 private:
  GlProgram program_;
  GLint clip_from_camera_, rotation_, translation_mm_, to_light_, ambient_, diffuse_;
};

}  // namespace anneal6d
