// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <span>

#include "mesh_sides.h"

namespace anneal6d {
namespace {

QuadTexture quads_of(const cv::Mat& bgr, const Eigen::Vector3f& albedo_bgr) {
  cv::Mat tinted, grey;
  cv::multiply(bgr, cv::Scalar(albedo_bgr[0], albedo_bgr[1], albedo_bgr[2]), tinted);
  cv::cvtColor(tinted, grey, cv::COLOR_BGR2GRAY);
  QuadTexture texture{grey.cols, grey.rows, {}};
  texture.quads.reserve(grey.total());
  for (int row = 0; row < grey.rows; ++row) {
    const auto* const upper = grey.ptr<std::uint8_t>(row);
    const auto* const lower = grey.ptr<std::uint8_t>((row + 1) % grey.rows);
    for (int column = 0; column < grey.cols; ++column) {
      const int right = (column + 1) % grey.cols;
      texture.quads.push_back(static_cast<std::uint32_t>(upper[column]) |
                              static_cast<std::uint32_t>(upper[right]) << 8 |
                              static_cast<std::uint32_t>(lower[column]) << 16 |
                              static_cast<std::uint32_t>(lower[right]) << 24);
    }
  }
  return texture;
}

/// Of each triangle: 1 if it is wound outward, -1 if inward, 0 if its surface is open. A surface is
/// what hangs together by edges of two triangles; it is closed if it runs through every edge as
/// often in one direction as in the other, also through those where scans are pinched, so that four
/// triangles meet.
std::vector<int> windings_of(const TriangleMesh& mesh) {
  const auto triangles = mesh.triangles();
  std::vector<std::uint32_t> joined(triangles.size());  // a forest, a tree a surface
  std::iota(joined.begin(), joined.end(), 0U);
  const auto surface_of = [&](std::uint32_t t) {
    while (joined[t] != t) t = joined[t] = joined[joined[t]];
    return t;
  };
  const std::vector<MeshSide> sides = sides_of(mesh);
  for_each_edge(sides, [&](std::span<const MeshSide> edge) {
    if (edge.size() == 2) joined[surface_of(edge[0].triangle)] = surface_of(edge[1].triangle);
  });
  std::vector<std::uint32_t> open_at;
  for_each_edge(sides, [&](std::span<const MeshSide> edge) {
    for (const MeshSide& one : edge) {
      int balance = 0;
      for (const MeshSide& other : edge) {
        if (surface_of(other.triangle) != surface_of(one.triangle)) continue;
        balance += other.forward ? 1 : -1;
      }
      if (balance != 0) open_at.push_back(one.triangle);
    }
  });

  // Six times the enclosed volume is positive if triangles are wound outward.
  std::vector<double> volume(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto corner = [&](int c) -> Eigen::Vector3d {
      return mesh.vertices()[triangles[t][c]].position_mm.cast<double>();
    };
    volume[surface_of(t)] += corner(0).dot(corner(1).cross(corner(2)));
  }
  std::vector<int> windings(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) windings[t] = volume[t] > 0 ? 1 : -1;
  for (const std::uint32_t t : open_at) windings[surface_of(t)] = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) windings[t] = windings[surface_of(t)];
  return windings;
}

void pad(std::vector<float>& values) {
  values.resize(values.size() + RasterModel::kPadding, values.back());
}

}  // namespace

RasterModel::RasterModel(std::shared_ptr<const TriangleMesh> source, bool textured)
    : mesh(std::move(source)),
      vertex_count(mesh->vertices().size()),
      faces(faces_of(*mesh, textured && mesh->has_texture())),
      patterned(false) {
  const bool has_texture = textured && mesh->has_texture();
  const Eigen::Vector3f tint = mesh->vertices().front().albedo_bgr;
  const bool one_tint = std::all_of(mesh->vertices().begin(), mesh->vertices().end(),
                                    [&](const MeshVertex& m) { return m.albedo_bgr == tint; });
  patterned = has_texture || !one_tint;
  for (const MeshVertex& vertex : mesh->vertices()) {
    x.push_back(vertex.position_mm.x());
    y.push_back(vertex.position_mm.y());
    z.push_back(vertex.position_mm.z());
    nx.push_back(vertex.normal.x());
    ny.push_back(vertex.normal.y());
    nz.push_back(vertex.normal.z());
    // A texture brings the grey levels; an albedo common to all vertices is multiplied into it, so
    // that coloured light on a coloured texture gets its exact brightness.
    const float albedo = has_texture && one_tint ? 1.0F : luma_of(vertex.albedo_bgr);
    luma.push_back(has_texture ? albedo : 255.0F * albedo);
    if (has_texture) {
      u.push_back(vertex.uv.x());
      v.push_back(vertex.uv.y());
    }
  }
  for (auto* values : {&x, &y, &z, &nx, &ny, &nz, &luma}) pad(*values);
  add_planes();
  if (has_texture) {
    pad(u);
    pad(v);
    const Eigen::Vector3f baked = one_tint ? tint : Eigen::Vector3f::Ones();
    for (const cv::Mat& level : mesh->texture_levels()) textures.push_back(quads_of(level, baked));
  }
}

void RasterModel::add_planes() {
  const std::vector<int> windings = windings_of(*mesh);
  for (const Face& face : faces) {
    const auto corner = [&](int c) -> Eigen::Vector3d {
      return mesh->vertices()[face.corners[c]].position_mm.cast<double>();
    };
    const int winding = windings[face.triangle];
    const Eigen::Vector3d normal =
        winding * (corner(2) - corner(0)).cross(corner(3) - corner(1)).normalized();
    plane_x.push_back(static_cast<float>(normal.x()));
    plane_y.push_back(static_cast<float>(normal.y()));
    plane_z.push_back(static_cast<float>(normal.z()));
    plane_mm.push_back(winding == 0 ? -1.0F : static_cast<float>(normal.dot(corner(0))));
  }
  for (auto* values : {&plane_x, &plane_y, &plane_z, &plane_mm}) pad(*values);
}

}  // namespace anneal6d
