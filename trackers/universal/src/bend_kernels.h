// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>

#include "vector_width.h"

namespace anneal6d {

/// A picture of depths, and pictures of as many rows and columns of what is found in it.
struct BendJob {
  static constexpr int kReach_px = 2;    ///< to both sides, where normals are compared
  static constexpr float kFlat = 0.25F;  ///< rad, less of a turn is not told apart
  static constexpr int kNarrowest_px = static_cast<int>(kLongestVector) + 2 * kReach_px;

  const float* depth_mm;        ///< 0 outside the object
  std::ptrdiff_t depth_stride;  ///< floats from row to row
  int columns, rows;            ///< kNarrowest_px at least, both
  float fx, fy, cx, cy;         ///< (cx, cy) counted from the picture's first pixel
  float jump_mm;                ///< a larger step between neighbours is no surface
  // Out, with rows of `columns`.
  /// x, y, z of the surface's unit normal, camera frame; zero where there is none.
  float* normals[3];
  /// How far the normal turns from kReach_px before a pixel to as much behind it, in the direction
  /// in which it turns fastest, about the angle, rad; kFlat at least, 0 where there is no surface
  /// on all four sides. The pixel's own depth is not asked for.
  float* turns;
};

/// Fills `normals`.
void find_normals(const BendJob& job);
/// Fills `turns`, from the normals.
void find_turns(const BendJob& job);

}  // namespace anneal6d
