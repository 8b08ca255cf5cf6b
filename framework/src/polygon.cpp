// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "polygon.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

namespace anneal6d {
namespace {

constexpr double kFlat = 1e-9;  // twice an ear's area over the squared size, below it there is none

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Twice the signed area, positive for a turn to the left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross(b - a, c - a);
}

/// The corners in the polygon's plane, scaled to a size of one and counter-clockwise.
std::vector<Eigen::Vector2d> flattened(std::span<const Eigen::Vector3d> polygon) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : polygon) box.extend(p);
  const double size = box.diagonal().norm();
  if (!(size > 0) || !std::isfinite(size)) return {};
  // Newell's normal: it points to the side from which the outline runs counter-clockwise.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> scaled;
  for (const Eigen::Vector3d& p : polygon) scaled.push_back((p - box.center()) / size);
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    normal += scaled[i].cross(scaled[(i + 1) % scaled.size()]);
  }
  if (!(normal.norm() > kFlat)) return {};
  normal.normalize();
  const Eigen::Vector3d x = normal.unitOrthogonal();
  const Eigen::Vector3d y = normal.cross(x);
  std::vector<Eigen::Vector2d> flat;
  for (const Eigen::Vector3d& p : scaled) flat.emplace_back(p.dot(x), p.dot(y));
  return flat;
}

}  // namespace

std::optional<std::vector<std::array<std::uint32_t, 3>>> triangulate(
    std::span<const Eigen::Vector3d> polygon) {
  if (polygon.size() < 3) return std::nullopt;
  const std::vector<Eigen::Vector2d> points = flattened(polygon);
  if (points.empty()) return std::nullopt;

  std::vector<std::uint32_t> outline(points.size());
  std::iota(outline.begin(), outline.end(), 0U);
  const auto corner = [&](std::size_t i) -> const Eigen::Vector2d& {
    return points[outline[i % outline.size()]];
  };
  const auto is_ear = [&](std::size_t i) {
    const Eigen::Vector2d &a = corner(i), &b = corner(i + 1), &c = corner(i + 2);
    if (turn(a, b, c) <= kFlat) return false;
    for (std::size_t j = i + 3; j < i + outline.size(); ++j) {
      const Eigen::Vector2d& p = corner(j);
      if (p == a || p == b || p == c) continue;  // a bridge to a hole passes a corner twice
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  };

  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (outline.size() > 3) {
    const std::size_t n = outline.size();
    std::size_t i = 0;
    while (i < n && !is_ear(i)) ++i;
    if (i < n) {
      triangles.push_back({outline[i], outline[(i + 1) % n], outline[(i + 2) % n]});
    } else {  // only a corner that bends nowhere can go now
      i = 0;
      while (i < n && std::abs(turn(corner(i), corner(i + 1), corner(i + 2))) > kFlat) ++i;
      if (i == n) return std::nullopt;
    }
    outline.erase(outline.begin() + static_cast<std::ptrdiff_t>((i + 1) % n));
  }
  if (turn(corner(0), corner(1), corner(2)) > kFlat) {
    triangles.push_back({outline[0], outline[1], outline[2]});
  }
  if (triangles.empty()) return std::nullopt;
  return triangles;
}

std::vector<Triangle> triangulate_face(std::span<const std::uint32_t> corners,
                                       std::span<const MeshVertex> vertices) {
  if (corners.size() == 3) return {{corners[0], corners[1], corners[2]}};
  std::vector<Eigen::Vector3d> outline;
  for (const std::uint32_t corner : corners) {
    outline.push_back(vertices[corner].position_mm.cast<double>());
  }
  std::vector<Triangle> triangles;
  if (const auto cut = triangulate(outline)) {
    for (const auto& t : *cut) triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  } else {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  return triangles;
}

}  // namespace anneal6d
