// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <opencv2/videoio.hpp>
#include <optional>

#include "anneal6d/framework/frame_source.h"

namespace anneal6d {

/// A video file, decoded by OpenCV (FFmpeg where OpenCV has it).
class VideoSource : public FrameSource {
 public:
  /// Decodes the first frame, so that a file without a picture is refused here. `camera` is the
  /// calibration, if known. Throws FileError (missing, no video, undecodable), ConfigError (the
  /// video has another size than the calibration).
  explicit VideoSource(const std::filesystem::path& path,
                       std::optional<CameraModel> camera = std::nullopt);

  /// Throws FileError once if the stream breaks off before the end that the file's header
  /// announces; after that the stream is at its end.
  std::optional<Frame> next() override;
  /// Decodes, but converts and copies nothing.
  std::int64_t skip(std::int64_t count) override;
  std::string description() const override;
  std::optional<CameraModel> camera() const override { return camera_; }

 private:
  bool grab();
  void throw_if_cut_short();

  std::filesystem::path path_;
  std::optional<CameraModel> camera_;
  cv::VideoCapture video_;
  cv::Mat first_;  // the frame decoded by the constructor, until it is handed out
  cv::Size size_;
  double announced_frames_ = 0;  // 0: the container does not say
  double frames_per_second_ = 0;
  double position_ms_ = 0;  // presentation time of the last frame
  std::int64_t position_ = 0;
  bool ended_ = false;
};

}  // namespace anneal6d
