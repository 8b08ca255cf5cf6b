// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/random.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d::test {

using SharedMesh = std::shared_ptr<const TriangleMesh>;

inline MeshVertex vertex_at(float x_mm, float y_mm, float z_mm) {
  MeshVertex vertex;
  vertex.position_mm = {x_mm, y_mm, z_mm};
  return vertex;
}

/// Box of these sides around the object's origin, flat faces, closed, wound outward.
inline SharedMesh make_box(float x_mm, float y_mm, float z_mm) {
  std::vector<MeshVertex> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(vertex_at(i & 1 ? x_mm / 2 : -x_mm / 2, i & 2 ? y_mm / 2 : -y_mm / 2,
                                i & 4 ? z_mm / 2 : -z_mm / 2));
  }
  return std::make_shared<const TriangleMesh>(corners, std::vector<Triangle>{{0, 2, 3},
                                                                             {0, 3, 1},
                                                                             {4, 5, 7},
                                                                             {4, 7, 6},
                                                                             {0, 1, 5},
                                                                             {0, 5, 4},
                                                                             {2, 6, 7},
                                                                             {2, 7, 3},
                                                                             {0, 4, 6},
                                                                             {0, 6, 2},
                                                                             {1, 3, 7},
                                                                             {1, 7, 5}});
}

/// A surface over angles u and v in steps; `surface(u, v)` gives the vertex. Whole turns close by
/// welding.
template <class Surface>
SharedMesh make_grid(std::uint32_t u_steps, double u_end_rad, std::uint32_t v_steps,
                     double v_begin_rad, double v_end_rad, const Surface& surface,
                     cv::Mat texture_bgr = {}) {
  std::vector<MeshVertex> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i <= u_steps; ++i) {
    for (std::uint32_t k = 0; k <= v_steps; ++k) {
      MeshVertex vertex =
          surface(u_end_rad * i / u_steps, v_begin_rad + (v_end_rad - v_begin_rad) * k / v_steps);
      vertex.uv = {static_cast<float>(i) / static_cast<float>(u_steps),
                   static_cast<float>(k) / static_cast<float>(v_steps)};
      vertices.push_back(vertex);
      if (i == u_steps || k == v_steps) continue;
      const std::uint32_t here = i * (v_steps + 1) + k, next = here + v_steps + 1;
      triangles.push_back({here, next, next + 1});
      triangles.push_back({here, next + 1, here + 1});
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles),
                                              std::move(texture_bgr));
}

/// Ring around the object's z axis, smooth, closed.
inline SharedMesh make_torus(double ring_mm, double tube_mm, std::uint32_t steps = 20) {
  const double turn = 2 * std::numbers::pi;
  return make_grid(2 * steps, turn, steps, 0, turn, [&](double u, double v) {
    const double radius_mm = ring_mm + tube_mm * std::cos(v);
    return vertex_at(static_cast<float>(radius_mm * std::cos(u)),
                     static_cast<float>(radius_mm * std::sin(u)),
                     static_cast<float>(tube_mm * std::sin(v)));
  });
}

/// Sphere whose vertices have colours that change from place to place.
inline SharedMesh make_coloured_sphere(double radius_mm) {
  const double pi = std::numbers::pi;
  return make_grid(36, 2 * pi, 18, -pi / 2, pi / 2, [&](double u, double v) {
    const Eigen::Vector3d direction(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v),
                                    std::sin(v));
    MeshVertex vertex;
    vertex.position_mm = (radius_mm * direction).cast<float>();
    vertex.normal = direction.cast<float>();
    vertex.albedo_bgr = Eigen::Vector3f(static_cast<float>(0.5 + 0.4 * std::cos(3 * u)),
                                        static_cast<float>(0.5 + 0.4 * std::sin(5 * v)),
                                        static_cast<float>(0.5 + 0.4 * std::sin(2 * u + v)));
    return vertex;
  });
}

/// Open bowl, half a sphere, seen from inside and outside; optionally textured.
inline SharedMesh make_bowl(double radius_mm, cv::Mat texture_bgr = {}) {
  const double pi = std::numbers::pi;
  return make_grid(
      32, 2 * pi, 10, 0.1 - pi / 2, 0,
      [&](double u, double v) {
        return vertex_at(static_cast<float>(radius_mm * std::cos(u) * std::cos(v)),
                         static_cast<float>(radius_mm * std::sin(u) * std::cos(v)),
                         static_cast<float>(radius_mm * std::sin(v)));
      },
      std::move(texture_bgr));
}

/// Evenly spread over SO(3).
inline Eigen::Quaterniond random_rotation(const RandomKey& key) {
  const auto a = random_normals(key, 1000), b = random_normals(key, 1001);
  return Eigen::Quaterniond(a[0], a[1], b[0], b[1]).normalized();
}

/// Uniform in [low, high).
inline double random_between(const RandomKey& key, std::uint32_t draw, double low, double high) {
  return low + (high - low) * random_uniform(key, draw);
}

/// The pose that puts the object's centre at `center_mm`, camera frame.
inline Pose pose_with_center(const TriangleMesh& mesh, const Eigen::Quaterniond& rotation,
                             const Eigen::Vector3d& center_mm) {
  return {rotation, center_mm - rotation * mesh.center_mm().cast<double>()};
}

}  // namespace anneal6d::test
