// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "anneal6d/framework/shading.h"
#include "anneal6d/framework/triangle_mesh.h"
#include "raster_faces.h"

namespace anneal6d {

/// A grey texture level whose entries hold a texel and its right, lower and lower right neighbours
/// (with repeat) in four bytes, so that bilinear sampling is one load.
struct QuadTexture {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> quads;
};

/// The mesh as the rasterizer wants it: separate arrays of coordinates, padded so that whole
/// vectors can be loaded; millimetres, object frame.
struct RasterModel {
  RasterModel(std::shared_ptr<const TriangleMesh> mesh, bool textured);

  static constexpr std::size_t kPadding = 64;  ///< entries behind the last one, copies of it

  std::shared_ptr<const TriangleMesh> mesh;
  std::size_t vertex_count;
  std::vector<float> x, y, z, nx, ny, nz;
  std::vector<float> luma;  ///< 0..255, brightness at full light
  std::vector<float> u, v;  ///< empty without texture
  std::vector<Face> faces;
  std::vector<QuadTexture> textures;  ///< one a level; empty without texture
  bool patterned;                     ///< has a texture, or vertices of different brightness
  /// Of each face the plane: a point is outside where its product with the unit normal
  /// (x, y, z) is larger than `plane_mm`. From outside a closed surface, those of its faces that
  /// are turned away are hidden and can be skipped. Every point is outside of faces of an open
  /// surface (0, 0, 0; -1), which are seen from both sides.
  std::vector<float> plane_x, plane_y, plane_z, plane_mm;

 private:
  void add_planes();
};

/// Brightness of a colour as OpenCV's conversion from BGR has it.
inline float luma_of(const Eigen::Vector3f& bgr) {
  return 0.114F * bgr[0] + 0.587F * bgr[1] + 0.299F * bgr[2];
}

}  // namespace anneal6d
