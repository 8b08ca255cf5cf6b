// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <dc1394/dc1394.h>

#include <opencv2/core/mat.hpp>
#include <optional>

#include "anneal6d/capture/dc1394_options.h"
#include "image_pool.h"
#include "video_format.h"

namespace anneal6d::dc1394 {

/// Pixels as they lie in the DMA buffer.
struct RawPicture {
  unsigned char* bytes = nullptr;
  cv::Size size;
  dc1394color_coding_t coding = DC1394_COLOR_CODING_MONO8;
  dc1394color_filter_t filter = DC1394_COLOR_FILTER_RGGB;
  int depth_bits = 8;  ///< significant bits of sixteen-bit samples, right-aligned
  bool little_endian = false;
};

/// Turns what the camera sends into CV_8UC1 or BGR CV_8UC3, in one pass from the DMA buffer (raw16
/// in two).
/// YUV is full range (IIDC 1.31, 3.3), which OpenCV's own conversions are not.
class Decoder {
 public:
  /// Throws ConfigError: a coding that can't be decoded (signed and 16-bit colour ones).
  Decoder(const VideoFormat& format, const Dc1394Options& options);

  /// The picture in memory that does not belong to the ring.
  cv::Mat decode(const RawPicture& picture);

  dc1394color_filter_t filter() const { return filter_; }

 private:
  dc1394color_filter_t filter_;
  Dc1394Options::Debayer debayer_;
  ImagePool pool_;
  cv::Mat narrow_;  // eight bits of raw16
};

/// The camera's frame counter in the first four bytes, which are then overwritten with the pixels
/// below them (of raw codings those two rows below, which have the same colours).
std::uint32_t take_frame_counter(const RawPicture& picture);

}  // namespace anneal6d::dc1394
