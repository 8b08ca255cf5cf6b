// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "texture_file.h"

#include <opencv2/imgcodecs.hpp>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

constexpr std::size_t kMaxTextureFileSize = std::size_t{256} << 20;
constexpr int kMaxTextureSize_px = 16384;

}  // namespace

cv::Mat decode_texture(std::span<const unsigned char> bytes, const std::filesystem::path& path,
                       const std::string& place) {
  cv::Mat texture;
  if (!bytes.empty() && bytes.size() <= kMaxTextureFileSize) {
    const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1,
                          const_cast<unsigned char*>(bytes.data()));
    try {
      texture = cv::imdecode(encoded, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    } catch (const cv::Exception&) {
      texture.release();  // an image that OpenCV refuses, of absurd size for example
    }
  }
  if (texture.empty()) {
    throw FileError(path, place, "the texture is damaged or no image; save it as PNG, JPEG or BMP");
  }
  if (texture.cols > kMaxTextureSize_px || texture.rows > kMaxTextureSize_px) {
    throw FileError(path, place,
                    "the texture has " + std::to_string(texture.cols) + "x" +
                        std::to_string(texture.rows) +
                        " pixels; at most 16384 a side are accepted");
  }
  return texture;
}

cv::Mat load_texture(const std::filesystem::path& path) {
  const std::string content = read_file(path, kMaxTextureFileSize);
  return decode_texture({reinterpret_cast<const unsigned char*>(content.data()), content.size()},
                        path);
}

void SoleTexture::add(const std::filesystem::path& texture, const std::filesystem::path& model,
                      const std::string& place) {
  if (is_known_ && texture != path_) {
    const bool is_mixed = path_.empty() || texture.empty();
    throw FileError(
        model, place,
        is_mixed ? "the model is textured in parts; give all of it one texture (bake its materials)"
                 : "the model has several textures (" + path_.filename().string() + ", " +
                       texture.filename().string() + "); bake them into one");
  }
  is_known_ = true;
  path_ = texture;
}

}  // namespace anneal6d
