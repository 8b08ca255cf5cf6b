// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "simplified_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace anneal6d {
namespace {

constexpr float kMostError = 0.0025F;  // of the model's extent

bool has_colours_within_triangles(const TriangleMesh& mesh) {
  const auto vertices = mesh.vertices();
  return std::ranges::any_of(mesh.triangles(), [&](const Triangle& triangle) {
    const Eigen::Vector3f& colour = vertices[triangle[0]].albedo_bgr;
    return vertices[triangle[1]].albedo_bgr != colour || vertices[triangle[2]].albedo_bgr != colour;
  });
}

/// Triangles by three entries of `corners` each.
struct IndexedTriangles {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> corners;
};

/// The mesh on vertices that differ in more than their normals: where two differed in those alone,
/// faces would not hang together, as at a seam of the texture.
IndexedTriangles without_normals(const TriangleMesh& mesh) {
  std::vector<MeshVertex> all(mesh.vertices().begin(), mesh.vertices().end());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].position_mm = mesh.vertices()[mesh.welded()[i]].position_mm;
    all[i].normal.setZero();
  }
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * mesh.triangles().size());
  for (const Triangle& triangle : mesh.triangles()) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }

  std::vector<std::uint32_t> remap(all.size());
  const std::size_t different = meshopt_generateVertexRemap(
      remap.data(), corners.data(), corners.size(), all.data(), all.size(), sizeof(MeshVertex));
  IndexedTriangles out{std::vector<MeshVertex>(different),
                       std::vector<std::uint32_t>(corners.size())};
  meshopt_remapIndexBuffer(out.corners.data(), corners.data(), corners.size(), remap.data());
  meshopt_remapVertexBuffer(out.vertices.data(), all.data(), all.size(), sizeof(MeshVertex),
                            remap.data());
  return out;
}

}  // namespace

std::shared_ptr<const TriangleMesh> simplified(std::shared_ptr<const TriangleMesh> mesh,
                                               std::size_t most_triangles) {
  if (mesh->triangles().size() <= most_triangles || has_colours_within_triangles(*mesh)) {
    return mesh;
  }
  IndexedTriangles all = without_normals(*mesh);
  std::vector<std::uint32_t> corners(all.corners.size());
  corners.resize(meshopt_simplify(corners.data(), all.corners.data(), all.corners.size(),
                                  all.vertices.front().position_mm.data(), all.vertices.size(),
                                  sizeof(MeshVertex), 3 * most_triangles, kMostError, 0, nullptr));
  all.vertices.resize(meshopt_optimizeVertexFetch(all.vertices.data(), corners.data(),
                                                  corners.size(), all.vertices.data(),
                                                  all.vertices.size(), sizeof(MeshVertex)));
  std::vector<Triangle> triangles(corners.size() / 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    triangles[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
  }
  return std::make_shared<TriangleMesh>(
      std::move(all.vertices), std::move(triangles),
      mesh->has_texture() ? mesh->texture_levels().front() : cv::Mat());
}

}  // namespace anneal6d
