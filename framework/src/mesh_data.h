// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

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

/// More triangles than any model for tracking has; guards memory and time against absurd files.
inline constexpr std::size_t kMaxTriangles = 4'000'000;

}  // namespace anneal6d
