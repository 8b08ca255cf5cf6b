// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <optional>

#include "anneal6d/framework/frame_source.h"
#include "anneal6d/framework/sequence_folder.h"

namespace anneal6d {

/// The images of a sequence folder, in order. Frames are indexed by the file's position, also after
/// a skip; timestamps suppose 30 frames a second. Images come as stored: grey or BGR, 8 bit; an
/// orientation tag is ignored, since a calibration belongs to the sensor.
class SequenceSource : public FrameSource {
 public:
  /// `camera` replaces the folder's camera.yml, which is then not read. Throws FileError: no such
  /// folder, no image in it, a malformed camera.yml, groundtruth.csv or meta.json.
  explicit SequenceSource(const std::filesystem::path& folder,
                          std::optional<CameraModel> camera = std::nullopt);

  /// Throws FileError with the image's path: unreadable, truncated, or of another size than the
  /// calibration's (without one: than the first image's). The next call goes on with the next
  /// image.
  std::optional<Frame> next() override;
  /// Opens no file.
  std::int64_t skip(std::int64_t count) override;
  std::string description() const override;
  std::optional<CameraModel> camera() const override { return camera_; }
  std::optional<Pose> ground_truth() const override;

  const SequenceFolder& folder() const { return folder_; }

 private:
  std::int64_t size() const { return static_cast<std::int64_t>(folder_.images.size()); }
  void check_size(const std::filesystem::path& path, const cv::Mat& image);

  SequenceFolder folder_;
  std::optional<CameraModel> camera_;
  cv::Size frame_size_;  // empty until known
  std::string size_origin_;
  std::int64_t position_ = 0;
};

}  // namespace anneal6d
