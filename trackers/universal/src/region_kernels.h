// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "vector_width.h"

namespace anneal6d {

/// Silhouette points of one pose and the picture of colours that they are looked up in.
struct ColourJob {
  static constexpr std::size_t kPadding = kLongestVector;  ///< floats

  /// Point, normal, and how far only object (inside) or background (outside) shows along it, all in
  /// the object's frame and millimetres; padded with NaN to whole vectors.
  const float *x, *y, *z, *nx, *ny, *nz, *inside, *outside;
  std::size_t count;  ///< with the padding
  float rotation[9];  ///< camera_from_object, row-major
  float translation_mm[3];
  float fx, fy, cx, cy;  ///< in pixels of the image, (cx, cy) counted from the picture's origin
  float near_mm;         ///< nearer points are not seen
  /// Logarithmic odds of every other pixel of the image; three bytes more than the picture has.
  const std::int8_t* log_odds;
  int columns, rows;
  float clear;  ///< sum of odds at one point that counts as certain
};

/// Mean over the visible points of what colours say for an edge there, -1..1; 0 without points.
float compare_colours(const ColourJob& job);

}  // namespace anneal6d
