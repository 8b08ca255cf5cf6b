// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <memory>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/object_renderer.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// Draws the object with OpenGL into memory, exactly as shading.h states: the renderer that the
/// others are measured against. One sample a pixel, taken at its centre. Each renderer has a
/// context of its own; it may be used from any thread, but from one at a time.
class MeshRenderer final : public ObjectRenderer {
 public:
  /// `textured`: false ignores the mesh's texture. Throws ConfigError (no mesh, bad camera),
  /// BackendUnavailable (no OpenGL here) and GraphicsError (image or texture beyond the driver's
  /// limits).
  MeshRenderer(std::shared_ptr<const TriangleMesh> mesh, const CameraModel& camera,
               bool textured = true);
  ~MeshRenderer() override;

  /// A pose that is not finite, or that puts the whole object behind the near plane, gives a black
  /// image and zero depth. Throws GraphicsError.
  void render(const Pose& camera_from_object, const Shading& shading, cv::Mat& color_bgr,
              cv::Mat& depth_mm) override;

  /// The same picture without the depths, which then are not read back.
  void render_color(const Pose& camera_from_object, const Shading& shading, cv::Mat& color_bgr);

  /// Who draws, for people: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5".
  std::string description() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace anneal6d
