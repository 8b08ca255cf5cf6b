// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "smooth_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace anneal6d {
namespace {

constexpr double kCreaseAngle_rad = 40.0 * std::numbers::pi / 180.0;
// A vertex where more triangles meet has them merged by direction, into 3 * 16^2 at most.
constexpr std::size_t kMostAround = 256;
constexpr int kDirectionSteps = 16;

/// One face, or several of nearly one direction, that meet at a vertex.
struct Corner {
  Eigen::Vector3f normal;    ///< unit length
  Eigen::Vector3f weighted;  ///< the normal times the angle of the corner
};

float corner_angle_rad(const std::vector<MeshVertex>& vertices, const Triangle& t, int corner) {
  const Eigen::Vector3f& p = vertices[t[corner]].position_mm;
  const Eigen::Vector3f a = vertices[t[(corner + 1) % 3]].position_mm - p;
  const Eigen::Vector3f b = vertices[t[(corner + 2) % 3]].position_mm - p;
  // Not the arc cosine, which takes the corners of slivers for zero.
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Cell of a direction, whose sign does not matter, on the three sides of half a cube.
int direction_cell(const Eigen::Vector3f& normal) {
  Eigen::Index side = 0;
  normal.cwiseAbs().maxCoeff(&side);
  const auto step = [&](Eigen::Index axis) {
    const float place = 0.5F * (normal[axis % 3] / normal[side] + 1.0F);  // 0..1
    return std::clamp(static_cast<int>(kDirectionSteps * place), 0, kDirectionSteps - 1);
  };
  return (static_cast<int>(side) * kDirectionSteps + step(side + 1)) * kDirectionSteps +
         step(side + 2);
}

/// One corner for each direction that occurs. Each face looks at all corners of its vertex: without
/// this a fan of very many triangles would take the square of their number.
void merge_by_direction(std::vector<Corner>& corners) {
  std::map<int, Eigen::Vector3f> sums;
  for (const Corner& corner : corners) {
    Eigen::Vector3f& sum = sums.try_emplace(direction_cell(corner.normal), 0, 0, 0).first->second;
    if (sum.dot(corner.normal) < 0) {
      sum -= corner.weighted;
    } else {
      sum += corner.weighted;
    }
  }
  corners.clear();
  for (const auto& [cell, sum] : sums) corners.push_back({sum.normalized(), sum});
}

}  // namespace

Eigen::Vector3f scaled_normal(const std::vector<MeshVertex>& vertices, const Triangle& triangle) {
  const Eigen::Vector3f& a = vertices[triangle[0]].position_mm;
  return (vertices[triangle[1]].position_mm - a).cross(vertices[triangle[2]].position_mm - a);
}

void add_missing_normals(std::vector<MeshVertex>& vertices, std::vector<Triangle>& triangles,
                         const std::vector<std::uint32_t>& welded) {
  std::vector<std::vector<Corner>> around(vertices.size());
  for (const Triangle& t : triangles) {
    const Eigen::Vector3f normal = scaled_normal(vertices, t).normalized();
    for (int c = 0; c < 3; ++c) {
      const float angle_rad = corner_angle_rad(vertices, t, c);
      around[welded[t[c]]].push_back({normal, angle_rad * normal});
    }
  }
  for (std::vector<Corner>& corners : around) {
    if (corners.size() > kMostAround) merge_by_direction(corners);
  }

  const float crease_cosine = static_cast<float>(std::cos(kCreaseAngle_rad));
  std::map<std::tuple<std::uint32_t, int, int, int>, std::uint32_t> made;
  const std::size_t given = vertices.size();
  for (Triangle& t : triangles) {
    const Eigen::Vector3f face_normal = scaled_normal(vertices, t).normalized();
    for (std::uint32_t& corner : t) {
      if (corner < given && !vertices[corner].normal.isZero()) continue;
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (const Corner& neighbour : around[welded[corner]]) {
        const float cosine = neighbour.normal.dot(face_normal);
        if (std::abs(cosine) < crease_cosine) continue;
        // Winding is not trusted: a neighbour turned the other way counts with its sign flipped.
        if (cosine < 0) {
          sum -= neighbour.weighted;
        } else {
          sum += neighbour.weighted;
        }
      }
      const Eigen::Vector3f normal = sum.normalized();
      const Eigen::Vector3i key = (normal * 1000.0F).array().round().cast<int>();
      const auto next = static_cast<std::uint32_t>(vertices.size());
      const auto [entry, is_new] = made.try_emplace({corner, key[0], key[1], key[2]}, next);
      if (is_new) {
        MeshVertex vertex = vertices[corner];
        vertex.normal = normal;
        vertices.push_back(vertex);
      }
      corner = entry->second;
    }
  }
}

}  // namespace anneal6d
