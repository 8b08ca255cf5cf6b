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

/// The one texture of a model whose parts each say which they have.
class SoleTexture {
 public:
  /// A part of the model has this texture (empty: none). Throws FileError about the model, at
  /// `place`, if another part has another.
  void add(const std::filesystem::path& texture, const std::filesystem::path& model,
           const std::string& place);
  /// Empty if no part has one.
  const std::filesystem::path& path() const { return path_; }

 private:
  bool is_known_ = false;
  std::filesystem::path path_;
};

}  // namespace anneal6d
