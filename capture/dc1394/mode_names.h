// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <dc1394/dc1394.h>

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera.h"

namespace anneal6d::dc1394 {

std::string coding_name(dc1394color_coding_t coding);
std::optional<dc1394color_coding_t> coding_of(const std::string& name);

bool is_format7(dc1394video_mode_t mode);
std::string size_text(const cv::Size& size);

/// A mode that the camera has.
struct Mode {
  dc1394video_mode_t id = DC1394_VIDEO_MODE_640x480_MONO8;
  std::string name;
  cv::Size size;                                            ///< Format_7: the largest
  dc1394color_coding_t coding = DC1394_COLOR_CODING_MONO8;  ///< of fixed modes
};
/// Throws CaptureError: the camera does not answer, or tells of impossible sizes.
std::vector<Mode> list_modes(const Camera& camera);

/// Frames a second, ascending. Fixed modes only.
std::vector<float> list_rates(const Camera& camera, dc1394video_mode_t mode);

/// What a Format_7 mode allows.
struct ScalableLimits {
  cv::Size largest, unit_size;
  cv::Point unit_position;
  std::vector<dc1394color_coding_t> codings;
};
/// Throws CaptureError as above.
ScalableLimits scalable_limits(const Camera& camera, dc1394video_mode_t mode);

/// "a, b, c".
std::string joined(const std::vector<std::string>& words);

}  // namespace anneal6d::dc1394
