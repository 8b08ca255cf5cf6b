// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace anneal6d {
namespace {

constexpr double kFlat = 1e-5;        // of the diameter, as vertices are welded
constexpr double kLeastSine = 1e-3;   // of the turn at a corner of a convex quadrilateral
constexpr double kLeastShare = 0.05;  // of the area of the larger triangle has the smaller
constexpr double kLinear = 1e-4;      // texture coordinates
constexpr float kSame = 1e-5F;        // normals, colours and texture coordinates
constexpr double kLengthStep = 1e-3;  // of the diameter: edges that differ less are equally long

struct Pair {
  Face face;
  std::uint32_t first, second;  // triangles
  int length;                   // of the common edge, steps
};

/// For each vertex the first one that is drawn as it is.
std::vector<std::uint32_t> same_vertices(const TriangleMesh& mesh, bool textured) {
  const auto vertices = mesh.vertices();
  const auto same = [&](const MeshVertex& a, const MeshVertex& b) {
    return a.position_mm == b.position_mm && (a.normal - b.normal).norm() < kSame &&
           (a.albedo_bgr - b.albedo_bgr).norm() < kSame &&
           (!textured || (a.uv - b.uv).norm() < kSame);
  };
  constexpr std::uint32_t kNone = 0;  // follows none
  std::vector<std::uint32_t> first(vertices.size()), next(vertices.size(), kNone);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    std::uint32_t at = mesh.welded()[i];
    while (!same(vertices[at], vertices[i]) && next[at] != kNone) at = next[at];
    first[i] = at;
    if (same(vertices[at], vertices[i])) continue;
    first[i] = next[at] = i;
  }
  return first;
}

/// The pair of triangles (q, p, s) and (p, q, r), if it is one.
std::optional<Face> pair_of(const TriangleMesh& mesh, bool textured, std::uint32_t p,
                            std::uint32_t s, std::uint32_t q, std::uint32_t r) {
  const auto at = [&](std::uint32_t vertex) -> Eigen::Vector3d {
    return mesh.vertices()[vertex].position_mm.cast<double>();
  };
  const auto cross = [&](std::uint32_t from, std::uint32_t via, std::uint32_t to) {
    return Eigen::Vector3d((at(via) - at(from)).cross(at(to) - at(via)));
  };
  const Eigen::Vector3d of_first = cross(p, q, r), of_second = cross(p, s, q);
  const double area_first = of_first.norm(), area_second = of_second.norm();
  if (std::min(area_first, area_second) < kLeastShare * std::max(area_first, area_second)) {
    return {};
  }
  const Eigen::Vector3d normal = of_first / area_first;
  const double least_flat_mm = kFlat * mesh.diameter_mm();
  if (std::abs(normal.dot(at(s) - at(p))) > least_flat_mm ||
      std::abs(of_second.dot(at(r) - at(p))) > least_flat_mm * area_second) {
    return {};
  }
  const auto turns = [&](std::uint32_t from, std::uint32_t via, std::uint32_t to) {
    return normal.dot(cross(from, via, to)) >
           kLeastSine * (at(via) - at(from)).norm() * (at(to) - at(via)).norm();
  };
  if (!turns(r, p, s) || !turns(s, q, r)) return {};
  if (textured) {
    // Where s is, in the first triangle's coordinates.
    const double along_q = normal.dot(cross(p, s, r)) / area_first;
    const double along_r = normal.dot(cross(p, q, s)) / area_first;
    const auto uv = [&](std::uint32_t vertex) -> Eigen::Vector2d {
      return mesh.vertices()[vertex].uv.cast<double>();
    };
    const Eigen::Vector2d expected = uv(p) + along_q * (uv(q) - uv(p)) + along_r * (uv(r) - uv(p));
    if ((uv(s) - expected).lpNorm<Eigen::Infinity>() > kLinear) return {};
  }
  return Face{{p, s, q, r}, 0};
}

}  // namespace

std::vector<Face> faces_of(const TriangleMesh& mesh, bool textured) {
  const auto triangles = mesh.triangles();
  const std::vector<std::uint32_t> same = same_vertices(mesh, textured);
  std::unordered_map<std::uint64_t, std::uint32_t> side_with;  // 3 t + corner
  const auto key = [](std::uint64_t from, std::uint64_t to) { return from << 32 | to; };
  std::vector<Pair> pairs;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t p = same[triangles[t][c]], q = same[triangles[t][(c + 1) % 3]];
      side_with.try_emplace(key(p, q), 3 * t + c);
      const auto other = side_with.find(key(q, p));
      if (other == side_with.end()) continue;
      const std::uint32_t u = other->second / 3, e = other->second % 3;
      const auto face =
          pair_of(mesh, textured, p, triangles[u][(e + 2) % 3], q, triangles[t][(c + 2) % 3]);
      if (!face) continue;
      const float length_mm =
          (mesh.vertices()[p].position_mm - mesh.vertices()[q].position_mm).norm();
      pairs.push_back(
          {*face, u, t,
           static_cast<int>(std::lround(length_mm / (kLengthStep * mesh.diameter_mm())))});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.length > b.length; });

  std::vector<bool> taken(triangles.size());
  std::vector<Face> faces;
  for (const Pair& pair : pairs) {
    if (taken[pair.first] || taken[pair.second]) continue;
    taken[pair.first] = taken[pair.second] = true;
    faces.push_back({pair.face.corners, pair.first});
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (!taken[t]) faces.push_back({{a, b, c, c}, t});
  }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.triangle < b.triangle; });
  return faces;
}

}  // namespace anneal6d
