// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <opencv2/videoio.hpp>
#include <optional>
#include <string>
#include <vector>

#include "anneal6d/framework/frame_source.h"

namespace anneal6d {

/// A video device that the system lists (Linux: /dev/videoN).
struct CameraDevice {
  int number = 0;
  std::filesystem::path path;
  std::string name;         ///< of the driver; may be empty
  bool accessible = false;  ///< this user may open it
};

/// The entries videoN of `device_folder`, by number; empty on systems without such a folder. Opens
/// each for a moment to see whether this user may.
std::vector<CameraDevice> list_cameras(const std::filesystem::path& device_folder = "/dev");

/// A webcam, through OpenCV (V4L2 on Linux). Frames carry the time at which they were handed over.
class CameraSource : public FrameSource {
 public:
  /// Opens camera `number` and asks it for the calibration's image size. Throws BackendUnavailable
  /// (no such camera, no permission, in use; the message lists the cameras that exist and says what
  /// to do), ConfigError (the camera has not got the calibration's size).
  explicit CameraSource(int number, std::optional<CameraModel> camera = std::nullopt);

  /// Takes a device that is open already; `name` is for messages ("camera 0"). Throws ConfigError
  /// as above.
  CameraSource(std::unique_ptr<cv::VideoCapture> device, std::string name,
               std::optional<CameraModel> camera = std::nullopt);

  /// Waits for the next image; a camera has no end of stream. Throws CaptureError: the camera
  /// stalled (no image within the driver's time limit), was unplugged, or delivers another image
  /// size than the calibration's.
  std::optional<Frame> next() override;
  std::int64_t skip(std::int64_t count) override;
  std::string description() const override;
  std::optional<CameraModel> camera() const override { return camera_; }

 private:
  void grab();

  std::unique_ptr<cv::VideoCapture> device_;
  std::string name_;
  std::optional<CameraModel> camera_;
  std::int64_t position_ = 0;
  std::optional<std::chrono::steady_clock::time_point> first_time_;
};

}  // namespace anneal6d
