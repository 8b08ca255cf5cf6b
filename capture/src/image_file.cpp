// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "image_file.h"

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr std::string_view kJpegStart = "\xff\xd8";
constexpr std::string_view kJpegScan = "\xff\xda";
constexpr std::string_view kJpegEnd = "\xff\xd9";
constexpr std::size_t kMaxImageBytes = std::size_t{1} << 29;

// Whether the chunks of a PNG lead to its IEND.
bool png_is_complete(std::string_view bytes) {
  std::size_t at = kPngSignature.size();
  while (at + 12 <= bytes.size()) {
    std::size_t length = 0;
    for (int i = 0; i < 4; ++i) {
      length = length << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
    }
    const bool is_end = bytes.substr(at + 4, 4) == "IEND";
    if (length > bytes.size() - at - 12) return false;
    if (is_end) return true;
    at += 12 + length;
  }
  return false;
}

// An end marker can't occur inside compressed data, but does occur in an embedded thumbnail: the
// one that counts follows the last scan.
bool jpeg_is_complete(std::string_view bytes) {
  const std::size_t scan = bytes.rfind(kJpegScan);
  const std::size_t end = bytes.rfind(kJpegEnd);
  return scan != std::string_view::npos && end != std::string_view::npos && scan < end;
}

}  // namespace

cv::Mat read_image(const std::filesystem::path& path) {
  const std::string bytes = read_file(path, kMaxImageBytes);
  const std::string_view view = bytes;
  if (view.empty()) throw FileError(path, "", "the file is empty; it should be an image");
  if ((view.substr(0, kPngSignature.size()) == kPngSignature && !png_is_complete(view)) ||
      (view.substr(0, kJpegStart.size()) == kJpegStart && !jpeg_is_complete(view))) {
    throw FileError(path, "byte " + std::to_string(view.size()),
                    "the image is cut off here; copy or record it again");
  }
  cv::Mat image;
  try {
    const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1,
                          const_cast<char*>(bytes.data()));
    image = cv::imdecode(encoded, cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& error) {
    throw FileError(path, "", "the image can't be decoded: " + error.err);
  }
  if (image.empty()) throw FileError(path, "", "not an image that can be decoded");
  return image;
}

void write_image(const std::filesystem::path& path, const cv::Mat& image, int jpeg_quality) {
  std::vector<unsigned char> bytes;
  std::string reason =
      "it has " + std::to_string(image.cols) + "x" + std::to_string(image.rows) + " pixels";
  bool encoded = false;
  try {
    encoded =
        cv::imencode(path.extension().string(), image, bytes,
                     {cv::IMWRITE_JPEG_QUALITY, jpeg_quality, cv::IMWRITE_PNG_COMPRESSION, 4});
  } catch (const cv::Exception& error) {
    reason += ", " + error.err;
  }
  if (!encoded) throw FileError(path, "", "the image can't be encoded: " + reason);
  std::ofstream stream(path, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw FileError(path, "", "can't be written; is the disk full or read-only?");
}

}  // namespace anneal6d
