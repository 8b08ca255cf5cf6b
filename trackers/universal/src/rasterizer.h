// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/pose_scorer.h"
#include "line_array.h"
#include "packed_edges.h"
#include "raster_kernels.h"
#include "raster_model.h"

namespace anneal6d {

/// Part of the image, pixels: [x, x + width) x [y, y + height).
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool empty() const { return width <= 0 || height <= 0; }
};

/// Draws one pose at a time into the part of the image that the object covers. A pixel holds its
/// depth and its brightness in one word, nearer being larger, so that the depth test is a maximum
/// (`raster_kernels.h`). One rasterizer serves one thread at a time; the model outlives it.
class Rasterizer {
 public:
  Rasterizer(const RasterModel& model, const CameraModel& camera, const Shading& shading);

  /// Draws the object, to be consumed by count_edges before the next drawing. The region holds
  /// every pixel of the object and a margin of `margin_px` around it, as far as they are in the
  /// image; its x is a multiple of 8. Empty, with nothing to consume, if no part of the object can
  /// be visible or the pose is not finite.
  Region draw(const Pose& camera_from_object, int margin_px);

  /// Consumes a drawing: edge operator, threshold, dilation (thesis Alg. 4), AND with the frame's
  /// edges and both counts, without an image in between. Blur is left out; thresholds are given,
  /// Canny's both. The margin was at least 1 + options.dilation_px, and one more for Canny.
  EdgeMatch count_edges(const PackedEdges& frame_edges, const EdgeOptions& options);

  /// Draws the object as images of the region's size, 0 where there is no object: brightness,
  /// CV_8UC1, and depth, CV_32FC1, millimetres, if wanted. (Re)allocated as needed; unchanged if
  /// the region, which is that of `draw`, is empty.
  Region draw_images(const Pose& camera_from_object, int margin_px, cv::Mat& grey,
                     cv::Mat* depth_mm = nullptr);

 private:
  std::optional<TriangleJob> set_up(const Pose& camera_from_object, int margin_px);

  const RasterModel& model_;
  CameraModel camera_;
  Shading shading_;

  Region region_;
  int stride_ = 0;                   // words a row of the drawing
  LineArray<std::uint32_t> pixels_;  // all zero but between draw and consumption

  std::vector<ImageVertex> vertices_;
  std::vector<TexturePoint> texture_points_;
  std::vector<float> camera_z_;
  LineArray<std::uint16_t> rows_;      // a band of brightness, see DrawnPicture
  LineArray<std::int16_t> gradients_;  // and of gradients, see CannyJob
  std::vector<std::uint64_t> bits_, candidates_, widened_;
};

}  // namespace anneal6d
