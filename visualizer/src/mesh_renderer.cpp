// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/visualizer/mesh_renderer.h"

#include <optional>

#include "anneal6d/framework/error.h"
#include "anneal6d/visualizer/headless_context.h"
#include "mesh_drawer.h"
#include "render_target.h"

namespace anneal6d {

struct MeshRenderer::Impl {
  std::shared_ptr<const TriangleMesh> mesh;
  CameraModel camera;
  HeadlessContext context;
  std::optional<RenderTarget> target;
  std::optional<MeshDrawer> drawer;

  ~Impl() {
    try {
      const HeadlessContext::Current current(context);
      drawer.reset();
      target.reset();
    } catch (const GraphicsError&) {
      // In use on another thread against the rules; everything goes with the context all the same.
    }
  }
};

MeshRenderer::MeshRenderer(std::shared_ptr<const TriangleMesh> mesh, const CameraModel& camera,
                           bool textured) {
  if (!mesh) throw ConfigError("a mesh renderer needs a mesh");
  camera.validate();
  impl_ = std::make_unique<Impl>();
  impl_->mesh = std::move(mesh);
  impl_->camera = camera;
  const HeadlessContext::Current current(impl_->context);
  impl_->target.emplace(cv::Size(camera.width_px, camera.height_px));
  impl_->drawer.emplace(*impl_->mesh, textured);
}

MeshRenderer::~MeshRenderer() = default;

void MeshRenderer::render(const Pose& camera_from_object, const Shading& shading,
                          cv::Mat& color_bgr, cv::Mat& depth_mm) {
  const HeadlessContext::Current current(impl_->context);
  impl_->target->begin(true);
  impl_->drawer->draw(camera_from_object, impl_->camera, shading);
  impl_->target->read_color(color_bgr);
  impl_->target->read_depth(depth_mm);
  check_gl("drawing the object");
}

void MeshRenderer::render_color(const Pose& camera_from_object, const Shading& shading,
                                cv::Mat& color_bgr) {
  const HeadlessContext::Current current(impl_->context);
  impl_->target->begin(false);
  impl_->drawer->draw(camera_from_object, impl_->camera, shading);
  impl_->target->read_color(color_bgr);
  check_gl("drawing the object");
}

std::string MeshRenderer::description() const { return impl_->context.description(); }

}  // namespace anneal6d
