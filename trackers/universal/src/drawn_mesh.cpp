// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "drawn_mesh.h"

#include <algorithm>
#include <vector>

#include "raster_model.h"

namespace anneal6d {
namespace {

constexpr float kBrightest = 0.8F, kDarkest = 0.24F;  // albedos

}  // namespace

std::shared_ptr<const TriangleMesh> mesh_to_draw(std::shared_ptr<const TriangleMesh> mesh) {
  if (mesh->has_texture()) return mesh;
  float brightest = 0;
  for (const MeshVertex& vertex : mesh->vertices()) {
    brightest = std::max(brightest, luma_of(vertex.albedo_bgr));
  }
  std::vector<MeshVertex> vertices(mesh->vertices().begin(), mesh->vertices().end());
  for (MeshVertex& vertex : vertices) {
    const float share = brightest > 0 ? luma_of(vertex.albedo_bgr) / brightest : 1.0F;
    vertex.albedo_bgr.setConstant(kDarkest + share * (kBrightest - kDarkest));
  }
  return std::make_shared<TriangleMesh>(
      std::move(vertices),
      std::vector<Triangle>(mesh->triangles().begin(), mesh->triangles().end()));
}

}  // namespace anneal6d
