// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <dc1394/dc1394.h>

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "anneal6d/capture/dc1394_options.h"
#include "anneal6d/framework/camera_model.h"
#include "camera.h"

namespace anneal6d::dc1394 {

/// What the camera was set to send.
struct VideoFormat {
  std::string name;  ///< "640x480-mono8" or "format7-0 mono8"
  cv::Size size;
  dc1394color_coding_t coding = DC1394_COLOR_CODING_MONO8;
  dc1394color_filter_t filter = DC1394_COLOR_FILTER_RGGB;  ///< of raw codings
  int packet_bytes = 0;                                    ///< Format_7
  /// From frame to frame if the camera runs freely; 0: not known.
  double period_s = 0;
};

/// "640x480-mono8", "format7-0" for each mode that the camera has.
std::vector<std::string> mode_names(const Camera& camera);

/// The modes with their rates or, of Format_7, sizes, steps and codings, for people.
std::vector<std::string> report_modes(const Camera& camera);

/// Chooses mode, coding, region, packets and rate by the options and sets them. `calibration`
/// decides the size if the options don't. Throws ConfigError naming the setting, the value and what
/// the camera allows; CaptureError if the camera's registers make no sense.
VideoFormat apply_video_format(const Camera& camera, const Dc1394Options& options,
                               const std::optional<CameraModel>& calibration);

}  // namespace anneal6d::dc1394
