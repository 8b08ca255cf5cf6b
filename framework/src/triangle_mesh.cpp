// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <unordered_map>
#include <utility>

#include "anneal6d/framework/error.h"
#include "smooth_normals.h"

namespace anneal6d {
namespace {

constexpr float kWeldTolerance = 1e-5F;    // of the diameter
constexpr float kDegenerateArea = 1e-12F;  // of the squared diameter

void check(const std::vector<MeshVertex>& vertices, const std::vector<Triangle>& triangles,
           const cv::Mat& texture) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const MeshVertex& v = vertices[i];
    const std::string which = "mesh: vertex " + std::to_string(i);
    if (!v.position_mm.allFinite() || !v.normal.allFinite() || !v.uv.allFinite()) {
      throw ConfigError(which + " is not finite");
    }
    // Entry by entry: minCoeff() and maxCoeff() may pass over NaN.
    if (!((v.albedo_bgr.array() >= 0.0F) && (v.albedo_bgr.array() <= 1.0F)).all()) {
      throw ConfigError(which + " has an albedo outside 0..1");
    }
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t corner : triangles[i]) {
      if (corner >= vertices.size()) {
        throw ConfigError("mesh: triangle " + std::to_string(i) + " names vertex " +
                          std::to_string(corner) + " of " + std::to_string(vertices.size()));
      }
    }
  }
  if (!texture.empty() && texture.type() != CV_8UC3) {
    throw ConfigError("mesh: the texture is not an 8-bit image of three channels");
  }
}

/// For each vertex the first one within the tolerance, found through a grid of cells: a point near
/// a cell's border looks into the cells around it, too.
std::vector<std::uint32_t> weld(const std::vector<MeshVertex>& vertices, float tolerance_mm) {
  const float cell_mm = std::max(8.0F * tolerance_mm, 1e-12F);
  using Cell = std::array<std::int64_t, 3>;
  const auto cell_of = [&](const Eigen::Vector3f& p) {
    Cell cell;
    for (int i = 0; i < 3; ++i) cell[i] = static_cast<std::int64_t>(std::floor(p[i] / cell_mm));
    return cell;
  };
  const auto hash = [](const Cell& cell) {
    const auto number = [&](std::size_t i) { return static_cast<std::size_t>(cell[i]); };
    return number(0) * 73856093U ^ number(1) * 19349663U ^ number(2) * 83492791U;
  };
  std::unordered_map<Cell, std::vector<std::uint32_t>, decltype(hash)> grid(vertices.size(), hash);

  std::vector<std::uint32_t> first(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3f& p = vertices[i].position_mm;
    const Cell low = cell_of(p.array() - tolerance_mm);
    const Cell high = cell_of(p.array() + tolerance_mm);
    first[i] = i;
    for (auto x = low[0]; x <= high[0]; ++x) {
      for (auto y = low[1]; y <= high[1]; ++y) {
        for (auto z = low[2]; z <= high[2]; ++z) {
          const auto found = grid.find({x, y, z});
          if (found == grid.end()) continue;
          for (const std::uint32_t other : found->second) {
            if ((vertices[other].position_mm - p).norm() <= tolerance_mm) {
              first[i] = std::min(first[i], other);
            }
          }
        }
      }
    }
    if (first[i] == i) grid[cell_of(p)].push_back(i);
  }
  return first;
}

/// Drops triangles that have two corners in one place, and those of a mesh that has two sides
/// everywhere which stand where another one is. Just a few of these are folds of a closed surface,
/// as scans have them, and would leave it open.
void drop_repeated(std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& welded) {
  std::vector<std::pair<Triangle, std::size_t>> places;  // welded corners, and which triangle
  for (const Triangle& t : triangles) {
    Triangle corners = {welded[t[0]], welded[t[1]], welded[t[2]]};
    std::sort(corners.begin(), corners.end());
    places.emplace_back(corners, places.size());
  }
  std::sort(places.begin(), places.end());
  std::vector<bool> thin(triangles.size()), repeated(triangles.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [corners, triangle] = places[i];
    thin[triangle] = corners[0] == corners[1] || corners[1] == corners[2];
    repeated[triangle] = i > 0 && corners == places[i - 1].first;
  }
  const bool two_sided = 3 * std::count(repeated.begin(), repeated.end(), true) >
                         static_cast<std::ptrdiff_t>(triangles.size());
  std::size_t next = 0;
  std::erase_if(triangles, [&](const Triangle& /*triangle*/) {
    const std::size_t i = next++;
    return thin[i] || (two_sided && repeated[i]);
  });
}

/// Drops vertices that no triangle uses, keeping the order.
void drop_unused(std::vector<MeshVertex>& vertices, std::vector<Triangle>& triangles) {
  constexpr auto kUnused = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> renumbered(vertices.size(), kUnused);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t corner : t) renumbered[corner] = 0;
  }
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (renumbered[i] == kUnused) continue;
    vertices[count] = vertices[i];
    renumbered[i] = count++;
  }
  vertices.resize(count);
  for (Triangle& t : triangles) {
    for (std::uint32_t& corner : t) corner = renumbered[corner];
  }
}

std::vector<cv::Mat> halvings(const cv::Mat& texture) {
  std::vector<cv::Mat> levels;
  if (texture.empty()) return levels;
  levels.push_back(texture.clone());
  while (levels.back().rows > 1 || levels.back().cols > 1) {
    const cv::Size half(std::max(1, levels.back().cols / 2), std::max(1, levels.back().rows / 2));
    cv::Mat next;
    cv::resize(levels.back(), next, half, 0, 0, cv::INTER_AREA);
    levels.push_back(next);
  }
  return levels;
}

}  // namespace

TriangleMesh::TriangleMesh(std::vector<MeshVertex> vertices, std::vector<Triangle> triangles,
                           cv::Mat texture_bgr)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  check(vertices_, triangles_, texture_bgr);
  drop_unused(vertices_, triangles_);
  if (triangles_.empty()) throw ConfigError("mesh: there is no triangle");

  Eigen::AlignedBox3f box;
  for (const MeshVertex& v : vertices_) box.extend(v.position_mm);
  const float diagonal_mm = box.diagonal().norm();

  const float least_mm2 = kDegenerateArea * diagonal_mm * diagonal_mm;
  std::erase_if(triangles_, [&](const Triangle& t) {
    return !(0.5F * scaled_normal(vertices_, t).norm() > least_mm2);
  });
  const std::vector<std::uint32_t> welded = weld(vertices_, kWeldTolerance * diagonal_mm);
  drop_repeated(triangles_, welded);
  if (triangles_.empty()) throw ConfigError("mesh: every triangle is degenerate (has no area)");

  for (MeshVertex& v : vertices_) {
    if (!v.normal.isZero()) v.normal.normalize();
  }
  add_missing_normals(vertices_, triangles_, welded);
  drop_unused(vertices_, triangles_);
  welded_ = weld(vertices_, kWeldTolerance * diagonal_mm);

  box.setEmpty();
  for (const MeshVertex& v : vertices_) box.extend(v.position_mm);
  min_corner_mm_ = box.min();
  max_corner_mm_ = box.max();
  for (const MeshVertex& v : vertices_) {
    radius_mm_ = std::max(radius_mm_, (v.position_mm - center_mm()).norm());
  }

  texture_levels_ = halvings(texture_bgr);
  if (has_texture()) {
    double area_mm2 = 0, area_uv = 0;
    for (const Triangle& t : triangles_) {
      area_mm2 += 0.5 * scaled_normal(vertices_, t).norm();
      const Eigen::Vector2f a = vertices_[t[1]].uv - vertices_[t[0]].uv;
      const Eigen::Vector2f b = vertices_[t[2]].uv - vertices_[t[0]].uv;
      area_uv += 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
    }
    texels_per_mm_ = std::sqrt(area_uv * static_cast<double>(texture_bgr.total()) / area_mm2);
  }
}

int TriangleMesh::texture_level_for(double px_per_mm) const {
  const int last = static_cast<int>(texture_levels_.size()) - 1;
  const double texels_per_px = texels_per_mm_ / px_per_mm;
  if (!(texels_per_px > 1)) return 0;
  return std::clamp(static_cast<int>(std::lround(std::log2(texels_per_px))), 0, std::max(0, last));
}

}  // namespace anneal6d
