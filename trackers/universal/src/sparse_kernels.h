// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "vector_width.h"

namespace anneal6d {

/// Points of one pose and the edge image they are looked up in.
struct LookUpJob {
  const float *x, *y, *z;  ///< object frame, padded with NaN to whole longest vectors
  std::size_t count;       ///< with the padding
  float rotation[9];       ///< camera_from_object, row-major
  float translation_mm[3];
  float fx, fy, cx, cy;
  float near_mm;               ///< nearer points are not seen
  int width, height;           ///< of the edge image, pixels
  const std::uint32_t* edges;  ///< one bit a pixel, lowest first
  int words;                   ///< of a row
  // Out.
  int inside;   ///< points in the image
  int on_edge;  ///< those of them on an edge
};
void look_up(LookUpJob& job);

}  // namespace anneal6d
