// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cmath>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// What a model file holds, before its unit is applied and its values are checked.
struct MeshData {
  std::vector<MeshVertex> vertices;  ///< positions in the file's unit
  std::vector<Triangle> triangles;   ///< indices within `vertices`
  cv::Mat texture_bgr;               ///< CV_8UC3 or empty
};

/// `normal` at unit length, or zero ("compute it") if it has no direction: programs write senseless
/// ones for degenerate faces.
inline Eigen::Vector3f usable_normal(const Eigen::Vector3f& normal) {
  constexpr float kShortest = 1e-6F;
  const float length = normal.norm();
  if (!std::isfinite(length) || length < kShortest) return Eigen::Vector3f::Zero();
  return normal / length;
}

/// More triangles than any model for tracking has; guards memory and time against absurd files.
inline constexpr std::size_t kMaxTriangles = 4'000'000;

}  // namespace anneal6d
