// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

namespace anneal6d {

/// Writes a row of pictures: as a video if the path ends in .mp4, .mkv or .avi, otherwise as PNG
/// files `overlay_%04d.png` in a folder of that name, which is made if need be.
///
/// A video grows under a temporary name beside its own, which it takes on `commit()`; without a
/// commit it is removed. A PNG file appears whole or not at all.
class PictureWriter {
 public:
  /// Throws FileError if the place cannot be written to, ConfigError for a bad frame rate.
  explicit PictureWriter(std::filesystem::path path, double frames_per_second = 30);
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// `picture_bgr`: CV_8UC3, the same size every time. `frame` (not negative) numbers the PNG file;
  /// a video takes the pictures in the order of the calls. Throws FileError (cannot be written,
  /// disk full), ConfigError (another size or type).
  void write(const cv::Mat& picture_bgr, std::int64_t frame);

  /// Finishes: a video is closed, checked by reading its last picture, and takes its name. Nothing
  /// may be written afterwards. Throws FileError; also for a video without a picture.
  void commit();

 private:
  class Sink;
  class FolderSink;
  class VideoSink;
  std::unique_ptr<Sink> sink_;
  cv::Size size_px_;
};

}  // namespace anneal6d
