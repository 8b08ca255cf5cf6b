// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

namespace anneal6d {

/// Decodes an image file's bytes to CV_8UC3 (BGR). `path` and `place` are for the FileError that
/// bytes which are no image get.
cv::Mat decode_texture(std::span<const unsigned char> bytes, const std::filesystem::path& path,
                       const std::string& place = "");

/// Reads a texture to CV_8UC3 (BGR). Throws FileError.
cv::Mat load_texture(const std::filesystem::path& path);

}  // namespace anneal6d
