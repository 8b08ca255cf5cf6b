// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace anneal6d {

/// Reads an image as CV_8UC1 or CV_8UC3, its orientation tag ignored. Throws FileError: missing,
/// not an image, truncated (also a JPEG, which the decoder would complete with grey), absurdly
/// large.
cv::Mat read_image(const std::filesystem::path& path);

/// Writes an image, in the format of the extension; `jpeg_quality` (1..100) counts for
/// JPEG only. Throws FileError.
void write_image(const std::filesystem::path& path, const cv::Mat& image, int jpeg_quality = 95);

}  // namespace anneal6d
