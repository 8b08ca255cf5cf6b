// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d::test {

/// Not turned.
inline Pose at(double x_mm, double y_mm, double z_mm) {
  Pose pose;
  pose.translation_mm = {x_mm, y_mm, z_mm};
  return pose;
}

inline CameraModel vga_camera() {
  CameraModel camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = camera.fy_px = 500;
  camera.cx_px = 320;
  camera.cy_px = 240;
  return camera;
}

/// A flat rectangle in the object's x-y plane around its origin; normals to -z, towards the camera
/// for a pose without rotation. uv runs from (0, 0) at (-x, -y) to (1, 1) at (+x, +y).
inline std::shared_ptr<const TriangleMesh> make_rectangle(float width_mm, float height_mm,
                                                          cv::Mat texture_bgr = {},
                                                          Eigen::Vector3f albedo_bgr = {1, 1, 1}) {
  const auto corner = [&](float u, float v) {
    return MeshVertex{
        {(u - 0.5F) * width_mm, (v - 0.5F) * height_mm, 0}, {0, 0, -1}, {u, v}, albedo_bgr};
  };
  return std::make_shared<TriangleMesh>(
      std::vector<MeshVertex>{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)},
      std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}, std::move(texture_bgr));
}

/// A ring around the object's z axis: 2 * segments * sides triangles.
inline std::shared_ptr<const TriangleMesh> make_torus(unsigned segments = 48, unsigned sides = 16,
                                                      float ring_mm = 60, float tube_mm = 22) {
  std::vector<MeshVertex> vertices;
  std::vector<Triangle> triangles;
  const float turn = 2 * std::numbers::pi_v<float>;
  for (unsigned i = 0; i < segments; ++i) {
    const float a = turn * static_cast<float>(i) / static_cast<float>(segments);
    for (unsigned k = 0; k < sides; ++k) {
      const float b = turn * static_cast<float>(k) / static_cast<float>(sides);
      const Eigen::Vector3f normal(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b),
                                   std::sin(b));
      const Eigen::Vector3f center(ring_mm * std::cos(a), ring_mm * std::sin(a), 0);
      vertices.push_back({center + tube_mm * normal, normal, {0, 0}, {0.8F, 0.8F, 0.8F}});
      const unsigned i1 = (i + 1) % segments;
      const unsigned k1 = (k + 1) % sides;
      triangles.push_back({i * sides + k, i1 * sides + k, i1 * sides + k1});
      triangles.push_back({i * sides + k, i1 * sides + k1, i * sides + k1});
    }
  }
  return std::make_shared<TriangleMesh>(std::move(vertices), std::move(triangles));
}

}  // namespace anneal6d::test
