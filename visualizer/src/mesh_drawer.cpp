// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "mesh_drawer.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

// Farther away nothing of the largest object that is accepted (5 m) covers a pixel, and single
// precision would begin to overflow.
constexpr double kFarthest_mm = 1e9;

GLuint make_buffer() {
  GLuint name = 0;
  glGenBuffers(1, &name);
  return name;
}

GLuint make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return name;
}

/// A texture without further levels, sampled bilinearly with repeat. `image`: CV_8UC3.
GlTexture make_texture(const cv::Mat& image) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (image.cols > limit || image.rows > limit) {
    throw GraphicsError("the model's texture of " + std::to_string(image.cols) + "x" +
                        std::to_string(image.rows) + " is larger than OpenGL's limit of " +
                        std::to_string(limit) + "; scale it down");
  }
  const cv::Mat packed = image.isContinuous() ? image : image.clone();
  GLuint name = 0;
  glGenTextures(1, &name);
  GlTexture texture(name);
  glBindTexture(GL_TEXTURE_2D, name);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, packed.cols, packed.rows, 0, GL_BGR, GL_UNSIGNED_BYTE,
               packed.data);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  return texture;
}

/// OpenGL's projection for a pinhole camera whose pixel centres lie at integer coordinates: pixel
/// (u, v) is centred in window coordinates at (u + 0.5, v + 0.5). Image rows grow with window rows,
/// so that what is read back needs no flip. w is the depth in the camera frame.
Eigen::Matrix4f clip_from_camera(const CameraModel& camera, double near_mm, double far_mm) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  matrix(0, 0) = 2 * camera.fx_px / camera.width_px;
  matrix(0, 2) = 2 * (camera.cx_px + 0.5) / camera.width_px - 1;
  matrix(1, 1) = 2 * camera.fy_px / camera.height_px;
  matrix(1, 2) = 2 * (camera.cy_px + 0.5) / camera.height_px - 1;
  matrix(2, 2) = (far_mm + near_mm) / (far_mm - near_mm);
  matrix(2, 3) = -2 * far_mm * near_mm / (far_mm - near_mm);
  matrix(3, 2) = 1;
  return matrix.cast<float>();
}

}  // namespace

MeshDrawer::MeshDrawer(const TriangleMesh& mesh, bool textured)
    : mesh_(mesh),
      program_(false),
      clipping_program_(true),
      vertex_array_(make_vertex_array()),
      vertices_(make_buffer()),
      indices_(make_buffer()),
      white_(make_texture(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(255)))) {
  static_assert(sizeof(MeshVertex) == 11 * sizeof(float), "uploaded as it lies in memory");
  static_assert(sizeof(Triangle) == 3 * sizeof(GLuint));

  glBindVertexArray(vertex_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices().size_bytes()),
               mesh.vertices().data(), GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.triangles().size_bytes()),
               mesh.triangles().data(), GL_STATIC_DRAW);
  std::size_t offset = 0;
  const GLint components[] = {3, 3, 2, 3};  // position, normal, uv, albedo
  for (GLuint attribute = 0; attribute < 4; ++attribute) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribPointer(attribute, components[attribute], GL_FLOAT, GL_FALSE, sizeof(MeshVertex),
                          reinterpret_cast<const void*>(offset));
    offset += static_cast<std::size_t>(components[attribute]) * sizeof(float);
  }
  if (textured) {
    for (const cv::Mat& level : mesh.texture_levels()) levels_.push_back(make_texture(level));
  }
  check_gl("uploading the model");
}

void MeshDrawer::draw(const Pose& camera_from_object, const CameraModel& camera,
                      const Shading& shading) const {
  if (!camera_from_object.is_finite()) return;
  const Eigen::Vector3d center_mm = camera_from_object * mesh_.center_mm().cast<double>();
  if (!(center_mm.norm() < kFarthest_mm)) return;

  // The depth buffer spans the object's bounding sphere, a little widened against rounding.
  const double reach_mm = 1.01 * mesh_.radius_mm();
  const double far_mm = center_mm.z() + reach_mm;
  if (far_mm <= kNearPlane_mm) return;
  double near_mm = center_mm.z() - reach_mm;
  const bool clips = near_mm < kNearPlane_mm;
  if (clips) near_mm = 0.5 * kNearPlane_mm;  // the program clips, OpenGL need not

  (clips ? clipping_program_ : program_)
      .use(clip_from_camera(camera, near_mm, far_mm),
           camera_from_object.rotation.toRotationMatrix().cast<float>(),
           camera_from_object.translation_mm.cast<float>(), shading);

  GLuint texture = white_.get();
  if (!levels_.empty()) {
    const double depth_mm = std::max(center_mm.z(), kNearPlane_mm);
    const int level = mesh_.texture_level_for(camera.fx_px / depth_mm);
    texture = levels_[std::min(static_cast<std::size_t>(level), levels_.size() - 1)].get();
  }
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture);

  glViewport(0, 0, camera.width_px, camera.height_px);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_DITHER);
  glBindVertexArray(vertex_array_.get());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * mesh_.triangles().size()), GL_UNSIGNED_INT,
                 nullptr);
}

}  // namespace anneal6d
