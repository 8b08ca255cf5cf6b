// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>

#include "raster_model.h"

namespace anneal6d {

// The rasterizer's inner loops, compiled for several instruction sets and chosen at run time.

/// Inverse depth is stored as (1/z - inv_far) * scale + 1, which is 1 at the far end of the object
/// and kMaxDepth at its near end.
inline constexpr float kMaxDepth = 16777212.0F;  // 24 bits less room for rounding

struct VertexJob {
  const RasterModel* model;
  float rotation[9];  ///< camera_from_object, row-major
  float translation_mm[3];
  float fx, fy, cx, cy;
  float to_light[3];
  float ambient, diffuse;
  float inv_far, depth_scale;
  // Out, one entry a vertex, padded like the model's arrays: position in pixels, stored depth,
  // brightness 0..255 (0..1 with texture), texture coordinates over z, z in millimetres.
  float *image_x, *image_y, *depth, *grey, *u_over_z, *v_over_z, *camera_z;
  // Out: bounds of image_x and image_y.
  float min_x, max_x, min_y, max_y;
};
void project_vertices(VertexJob& job);

struct DrawJob {
  const RasterModel* model;
  const float *image_x, *image_y, *depth, *grey, *u_over_z, *v_over_z, *camera_z;
  float inv_far, depth_scale;
  float cx, cy;
  bool clip;                   ///< some triangles may cross the near plane
  const QuadTexture* texture;  ///< null: none
  int x0, y0, x1, y1;          ///< the region, half-open, pixels
  std::uint32_t* pixels;       ///< of (x0, y0)
  int stride;
};
void draw_triangles(const DrawJob& job);

/// Widths of the margins of a brightness row, in entries.
inline constexpr int kRowMargin = 64;

/// One row of edges as bits: where max(|Gx|, |Gy|) > threshold, for `width` pixels; the bits behind
/// them are zero up to whole words. Rows have their neighbours' values at -1 and `width`;
/// `center_weight` is 2 for Sobel and 1 for Prewitt.
struct EdgeRowJob {
  const std::uint16_t *above, *here, *below;
  int width;
  int center_weight;
  int threshold;
  std::uint64_t* bits;
};
void find_edge_row(const EdgeRowJob& job);

/// Moves the brightness of a row of the drawing to `row` and clears the drawing.
void take_row(std::uint32_t* pixels, int width, std::uint16_t* row);

}  // namespace anneal6d
