// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "camera_registers.h"

namespace anneal6d::emulated {

/// What an emulated camera sees: the images of a folder, again and again, or, without a folder, a
/// grey ramp with the picture's number in its brightness.
class Pictures {
 public:
  Pictures() = default;
  /// Throws std::runtime_error if the folder has no image.
  explicit Pictures(const std::filesystem::path& folder);

  /// Picture `index` as the camera would send it in this format: the sensor shows the image from
  /// its upper left corner on, binned modes a smaller copy of it. The bytes stay as they are until
  /// the next call.
  const std::vector<std::uint8_t>& encoded(std::int64_t index, const PictureFormat& format,
                                           const CameraModel& model);

 private:
  cv::Mat picture(std::int64_t index, const PictureFormat& format) const;

  std::vector<cv::Mat> images_;  // grey or BGR
  PictureFormat cached_format_;
  std::map<std::int64_t, std::vector<std::uint8_t>> cache_;
};

/// A picture (CV_8UC1 or CV_8UC3, BGR) in a colour coding of IIDC; raw codings have the Bayer
/// pattern RGGB, sixteen-bit ones carry twelve bits.
std::vector<std::uint8_t> encode(const cv::Mat& picture, Coding coding);

}  // namespace anneal6d::emulated
