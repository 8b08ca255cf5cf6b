// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "anneal6d/framework/pose_scorer.h"
#include "raster_model.h"

namespace anneal6d {

// The rasterizer's inner loops, compiled for several instruction sets and chosen at run time.

/// A pixel of the drawing holds depth and brightness in one word, 0 where there is nothing. Depth
/// is 1/z mapped linearly so that it grows from kFarDepth at the far end of the object to
/// kNearDepth at its near end. Between 1 and 2 all floats have the same exponent: their 23 bits of
/// mantissa, shifted over the 8 of brightness, compare like the numbers, and nothing needs to be
/// converted. What remains of the range is for roundings.
inline constexpr float kFarDepth = 1.0F + 1.0F / 64;
inline constexpr float kNearDepth = 2.0F - 1.0F / 64;

/// A vertex on the image: position in pixels, stored depth, brightness 0..255 (0..1 with texture).
/// Together, since triangles fetch their corners one by one.
struct ImageVertex {
  float x, y, depth, grey;
};

/// Texture coordinates over z, which are linear in the image.
struct TexturePoint {
  float u_over_z, v_over_z;
};

struct VertexJob {
  const RasterModel* model;
  float rotation[9];  ///< camera_from_object, row-major
  float translation_mm[3];
  float fx, fy, cx, cy;
  float to_light[3];  ///< object frame
  float ambient, diffuse;
  float inv_far, depth_scale;
  // Out, one entry a vertex, padded like the model's arrays.
  ImageVertex* vertices;
  TexturePoint* texture_points;  ///< not written without texture
  float* camera_z;               ///< millimetres
  // Out: bounds of x and y.
  float min_x, max_x, min_y, max_y;
};
void project_vertices(VertexJob& job);

struct TriangleJob {
  const RasterModel* model;
  const ImageVertex* vertices;
  const TexturePoint* texture_points;
  const float* camera_z;
  float eye_mm[3];  ///< the camera, object frame
  float inv_far, depth_scale;
  float cx, cy;
  bool clip;                   ///< some triangles may cross the near plane
  const QuadTexture* texture;  ///< null: none
  int x0, y0, x1, y1;          ///< what is drawn of the image, half-open, pixels
  std::uint32_t* pixels;       ///< of (x0, y0)
  int stride;
};
void draw_triangles(const TriangleJob& job);

/// Takes a drawing, so that it is clear then, into pictures of brightness and depth, 0 where there
/// is no object.
struct PictureJob {
  std::uint32_t* pixels;
  int stride, width, height;
  float inv_far, depth_scale;
  std::uint8_t* grey;
  std::ptrdiff_t grey_stride;
  float* depth_mm;  ///< null: not wanted
  std::ptrdiff_t depth_stride;
};
void take_pictures(const PictureJob& job);

/// Entries on both sides of a row of brightness that are read or written with it.
inline constexpr int kRowMargin = 64;
/// Rows of brightness that are taken at a time; with one above and one below they stay in the
/// fastest cache.
inline constexpr int kBandRows = 16;
/// With those beside a band, and one more, since rows are read ahead of their use.
inline constexpr int kBrightnessRows = kBandRows + 3;
/// With the two above a band, see CannyJob.
inline constexpr int kGradientRows = kBandRows + 2;
/// Pixels behind a row of the drawing that are read or written with it: those of the widest vector,
/// or of two of half the width.
inline constexpr int kPixelMargin = 16;

/// A drawing whose brightness an edge operator takes out band by band, so that it is clear then.
/// Borders are repeated.
struct DrawnPicture {
  std::uint32_t* pixels;
  int stride;
  int width, height;
  std::uint16_t* rows;  ///< for kBrightnessRows rows of brightness
  int row_stride;       ///< entries, with a kRowMargin on both sides
};

/// Takes a drawing and finds its edges: a bit is set where max(|Gx|, |Gy|) > threshold. A row of
/// bits has whole words; those behind the last pixel are zero.
struct EdgeJob {
  DrawnPicture picture;
  bool sobel;  ///< else Prewitt
  int threshold;
  std::uint64_t* bits;
};
void find_edges(const EdgeJob& job);

/// Takes a drawing and finds what Canny's operator makes of Sobel's gradients before hysteresis:
/// pixels where |Gx| + |Gy|, 0 outside the picture, is above a threshold and the largest across
/// the edge, as OpenCV's `Canny` has it. Bits as above.
struct CannyJob {
  DrawnPicture picture;
  int low, high;
  std::int16_t* gradients;    ///< for 3 * kGradientRows rows like those of brightness
  std::uint64_t* candidates;  ///< above the low threshold
  std::uint64_t* strong;      ///< above the high one
};
void find_canny_candidates(const CannyJob& job);

/// Counts the bits of rows of whole words, and those that the frame has, too.
struct CountJob {
  const std::uint64_t* bits;
  int words, height;
  const std::uint8_t* frame;    ///< first row, from the byte of the region's first pixel
  std::ptrdiff_t frame_stride;  ///< bytes
};
EdgeMatch count_edge_bits(const CountJob& job);

}  // namespace anneal6d
