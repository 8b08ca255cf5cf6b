// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/object_renderer.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d::test {

/// Draws triangles in one grey by the rule that a pixel belongs to what covers its centre: enough
/// to see where the simulation puts the object, without OpenGL.
class FlatRenderer : public ObjectRenderer {
 public:
  FlatRenderer(std::shared_ptr<const TriangleMesh> mesh, const CameraModel& camera)
      : mesh_(std::move(mesh)), camera_(camera) {}

  void render(const Pose& camera_from_object, const Shading&, cv::Mat& color_bgr,
              cv::Mat& depth_mm) override {
    color_bgr.create(camera_.height_px, camera_.width_px, CV_8UC3);
    depth_mm.create(color_bgr.size(), CV_32FC1);
    color_bgr.setTo(0);
    depth_mm.setTo(0);
    const auto vertices = mesh_->vertices();
    for (const Triangle& triangle : mesh_->triangles()) {
      Eigen::Vector2d p[3];
      double z = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3d point =
            camera_from_object * vertices[triangle[i]].position_mm.cast<double>();
        p[i] = camera_.project(point);
        z = point.z();
      }
      fill(p, static_cast<float>(z), color_bgr, depth_mm);
    }
  }

 private:
  static double side(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  }

  static void fill(const Eigen::Vector2d (&p)[3], float z, cv::Mat& color, cv::Mat& depth) {
    const auto [left, right] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
    const auto [top, bottom] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    const double sign = side(p[0], p[1], p[2].x(), p[2].y()) < 0 ? -1 : 1;
    for (int y = std::max(0, static_cast<int>(std::ceil(top)));
         y <= std::min(color.rows - 1, static_cast<int>(std::floor(bottom))); ++y) {
      for (int x = std::max(0, static_cast<int>(std::ceil(left)));
           x <= std::min(color.cols - 1, static_cast<int>(std::floor(right))); ++x) {
        if (sign * side(p[0], p[1], x, y) < 0 || sign * side(p[1], p[2], x, y) < 0 ||
            sign * side(p[2], p[0], x, y) < 0) {
          continue;
        }
        color.at<cv::Vec3b>(y, x) = {kGrey, kGrey, kGrey};
        depth.at<float>(y, x) = z;
      }
    }
  }

 public:
  static constexpr unsigned char kGrey = 200;

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  CameraModel camera_;
};

inline std::unique_ptr<ObjectRenderer> make_flat_renderer(std::shared_ptr<const TriangleMesh> mesh,
                                                          const CameraModel& camera) {
  return std::make_unique<FlatRenderer>(std::move(mesh), camera);
}

/// A box about `center`, edge lengths `size`, millimetres.
inline std::shared_ptr<const TriangleMesh> make_box(
    const Eigen::Vector3f& size, const Eigen::Vector3f& center = Eigen::Vector3f::Zero()) {
  std::vector<MeshVertex> vertices(8);
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector3f corner((i & 1) != 0 ? 0.5F : -0.5F, (i & 2) != 0 ? 0.5F : -0.5F,
                                 (i & 4) != 0 ? 0.5F : -0.5F);
    vertices[i].position_mm = center + corner.cwiseProduct(size);
  }
  const std::vector<Triangle> triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                           {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                           {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return std::make_shared<TriangleMesh>(vertices, triangles);
}

}  // namespace anneal6d::test
