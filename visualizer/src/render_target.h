// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <opencv2/core/mat.hpp>

#include "gl_name.h"

namespace anneal6d {

/// An image in the driver's memory to draw into and to read back from. All calls need the context
/// current in which it was made.
class RenderTarget {
 public:
  /// Throws GraphicsError: larger than the driver allows, out of memory.
  explicit RenderTarget(cv::Size size_px);

  /// Binds and clears it; `with_depth`: the depth in millimetres is drawn, too.
  void begin(bool with_depth) const;

  /// CV_8UC3, row 0 first; after `begin(false)` or `begin(true)`.
  void read_color(cv::Mat& color_bgr);
  /// CV_32FC1, row 0 first; after `begin(true)`.
  void read_depth(cv::Mat& depth_mm) const;

 private:
  cv::Size size_px_;
  GlRenderbuffer color_, depth_mm_, depth_test_;
  GlFramebuffer color_only_, color_and_depth_;
  cv::Mat color_rgba_;  // the driver's own layout, for which reading is a plain copy
};

}  // namespace anneal6d
