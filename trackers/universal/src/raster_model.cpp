// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <unordered_map>

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

/// Every edge between welded vertices belongs to two triangles that run through it in opposite
/// directions.
bool is_closed(const TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, int> balance;
  const auto welded = mesh.welded();
  for (const Triangle& t : mesh.triangles()) {
    for (int c = 0; c < 3; ++c) {
      const std::uint64_t from = welded[t[c]], to = welded[t[(c + 1) % 3]];
      if (++balance[from << 32 | to] > 1) return false;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [&](const auto& edge) {
    return balance.contains(edge.first << 32 | edge.first >> 32);
  });
}

/// Six times the enclosed volume; positive if the triangles are wound outward.
double signed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const Triangle& t : mesh.triangles()) {
    const auto corner = [&](int c) -> Eigen::Vector3d {
      return mesh.vertices()[t[c]].position_mm.cast<double>();
    };
    volume += corner(0).dot(corner(1).cross(corner(2)));
  }
  return volume;
}

void pad(std::vector<float>& values) {
  values.resize(values.size() + RasterModel::kPadding, values.back());
}

}  // namespace

RasterModel::RasterModel(std::shared_ptr<const TriangleMesh> source, bool textured)
    : mesh(std::move(source)),
      vertex_count(mesh->vertices().size()),
      triangles(mesh->triangles().begin(), mesh->triangles().end()),
      patterned(false),
      closed(is_closed(*mesh)) {
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
  if (closed) add_planes();
  if (has_texture) {
    pad(u);
    pad(v);
    const Eigen::Vector3f baked = one_tint ? tint : Eigen::Vector3f::Ones();
    for (const cv::Mat& level : mesh->texture_levels()) textures.push_back(quads_of(level, baked));
  }
}

void RasterModel::add_planes() {
  const double outward = signed_volume(*mesh) > 0 ? 1 : -1;
  for (const Triangle& t : triangles) {
    const auto corner = [&](int c) -> Eigen::Vector3d {
      return mesh->vertices()[t[c]].position_mm.cast<double>();
    };
    const Eigen::Vector3d normal =
        outward * (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    plane_x.push_back(static_cast<float>(normal.x()));
    plane_y.push_back(static_cast<float>(normal.y()));
    plane_z.push_back(static_cast<float>(normal.z()));
    plane_mm.push_back(static_cast<float>(normal.dot(corner(0))));
  }
  for (auto* values : {&plane_x, &plane_y, &plane_z, &plane_mm}) pad(*values);
}

}  // namespace anneal6d
