// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace anneal6d {

/// One corner as drawn. Corners at the same position with different normals or texture coordinates
/// are different vertices; `TriangleMesh::welded()` tells which of them coincide.
struct MeshVertex {
  Eigen::Vector3f position_mm = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit; zero means "compute it"
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();      ///< v = 0 is the first row of the texture
  Eigen::Vector3f albedo_bgr = {0.8F, 0.8F, 0.8F};   ///< 0..1; multiplies the texture, if any
};

using Triangle = std::array<std::uint32_t, 3>;

/// An immutable model of the object: triangles, shading normals and, optionally, one texture.
/// Surfaces may be open and winding is not trusted: renderers draw and light both sides.
class TriangleMesh {
 public:
  /// Missing normals are computed: the angle-weighted mean of the adjacent faces that differ by
  /// less than 40 degrees. Degenerate triangles are dropped, and, of a mesh that has two sides
  /// everywhere, one side. `texture` is CV_8UC3 (BGR) or empty.
  /// Throws ConfigError: no triangle left, index out of range, non-finite vertex, albedo outside
  /// 0..1, texture of another type.
  TriangleMesh(std::vector<MeshVertex> vertices, std::vector<Triangle> triangles,
               cv::Mat texture_bgr = {});

  std::span<const MeshVertex> vertices() const { return vertices_; }
  std::span<const Triangle> triangles() const { return triangles_; }
  /// For each vertex the index of the first vertex at the same position (within 1e-5 of the
  /// diameter).
  std::span<const std::uint32_t> welded() const { return welded_; }

  bool has_texture() const { return !texture_levels_.empty(); }
  /// The texture and its box-filtered halvings down to 1 texel, CV_8UC3; empty without texture.
  std::span<const cv::Mat> texture_levels() const { return texture_levels_; }
  /// Level whose texels are closest to one pixel where one millimetre spans `px_per_mm` pixels.
  /// Every renderer uses one level for the whole object, so that all of them agree.
  int texture_level_for(double px_per_mm) const;

  const Eigen::Vector3f& min_corner_mm() const { return min_corner_mm_; }
  const Eigen::Vector3f& max_corner_mm() const { return max_corner_mm_; }
  /// Centre of the bounding box and distance of the farthest vertex from it.
  Eigen::Vector3f center_mm() const { return 0.5F * (min_corner_mm_ + max_corner_mm_); }
  float radius_mm() const { return radius_mm_; }
  /// Diagonal of the bounding box.
  float diameter_mm() const { return (max_corner_mm_ - min_corner_mm_).norm(); }

 private:
  std::vector<MeshVertex> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> welded_;
  std::vector<cv::Mat> texture_levels_;
  double texels_per_mm_ = 0;
  Eigen::Vector3f min_corner_mm_, max_corner_mm_;
  float radius_mm_ = 0;
};

}  // namespace anneal6d
