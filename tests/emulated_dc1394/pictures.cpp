// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "pictures.h"

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace anneal6d::emulated {
namespace {

constexpr std::size_t kMostCached = 64;

struct Yuv {
  double y = 0, u = 0, v = 0;
};

// IIDC 1.31, 3.3: full range, chroma around 128 (ITU-R BT.601 coefficients).
Yuv to_yuv(const cv::Vec3b& bgr) {
  const double b = bgr[0], g = bgr[1], r = bgr[2];
  return {0.299 * r + 0.587 * g + 0.114 * b, -0.168736 * r - 0.331264 * g + 0.5 * b + 128,
          0.5 * r - 0.418688 * g - 0.081312 * b + 128};
}

std::uint8_t byte(double value) { return cv::saturate_cast<std::uint8_t>(value); }

cv::Mat as_grey(const cv::Mat& picture) {
  if (picture.channels() == 1) return picture;
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

cv::Mat as_colour(const cv::Mat& picture) {
  if (picture.channels() == 3) return picture;
  cv::Mat colour;
  cv::cvtColor(picture, colour, cv::COLOR_GRAY2BGR);
  return colour;
}

// `group` neighbours share their mean chroma: "U Y V Y" for two, "U Y Y V Y Y" for four.
void append_shared_chroma(const cv::Mat& colour, int group, std::vector<std::uint8_t>& bytes) {
  for (int y = 0; y < colour.rows; ++y) {
    for (int x = 0; x < colour.cols; x += group) {
      std::array<std::uint8_t, 4> luma{};
      Yuv sum;
      for (int i = 0; i < group; ++i) {
        const Yuv yuv = to_yuv(colour.at<cv::Vec3b>(y, x + i));
        luma[static_cast<std::size_t>(i)] = byte(yuv.y);
        sum.u += yuv.u / group;
        sum.v += yuv.v / group;
      }
      const auto half = static_cast<std::size_t>(group / 2);
      bytes.push_back(byte(sum.u));
      bytes.insert(bytes.end(), luma.begin(), luma.begin() + half);
      bytes.push_back(byte(sum.v));
      bytes.insert(bytes.end(), luma.begin() + half, luma.begin() + 2 * half);
    }
  }
}

cv::Mat bayer_rggb(const cv::Mat& colour) {
  cv::Mat raw(colour.size(), CV_8UC1);
  for (int y = 0; y < colour.rows; ++y) {
    for (int x = 0; x < colour.cols; ++x) {
      const int channel = y % 2 == 0 ? (x % 2 == 0 ? 2 : 1) : (x % 2 == 0 ? 1 : 0);
      raw.at<std::uint8_t>(y, x) = colour.at<cv::Vec3b>(y, x)[channel];
    }
  }
  return raw;
}

void append(const cv::Mat& plane, std::vector<std::uint8_t>& bytes) {
  for (int y = 0; y < plane.rows; ++y) {
    const std::uint8_t* row = plane.ptr(y);
    bytes.insert(bytes.end(), row, row + plane.cols * plane.elemSize());
  }
}

// Twelve bits, right-aligned, big endian.
void append_twelve_bits(const cv::Mat& plane, std::vector<std::uint8_t>& bytes) {
  for (int y = 0; y < plane.rows; ++y) {
    for (int x = 0; x < plane.cols; ++x) {
      const int value = plane.at<std::uint8_t>(y, x) << 4;
      bytes.push_back(static_cast<std::uint8_t>(value >> 8));
      bytes.push_back(static_cast<std::uint8_t>(value));
    }
  }
}

}  // namespace

std::vector<std::uint8_t> encode(const cv::Mat& picture, Coding coding) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(picture.total() * static_cast<std::size_t>(bits_per_pixel(coding)) / 8);
  switch (coding) {
    case Coding::mono8:
      append(as_grey(picture), bytes);
      break;
    case Coding::mono16:
      append_twelve_bits(as_grey(picture), bytes);
      break;
    case Coding::raw8:
      append(bayer_rggb(as_colour(picture)), bytes);
      break;
    case Coding::raw16:
      append_twelve_bits(bayer_rggb(as_colour(picture)), bytes);
      break;
    case Coding::rgb8: {
      cv::Mat rgb;
      cv::cvtColor(as_colour(picture), rgb, cv::COLOR_BGR2RGB);
      append(rgb, bytes);
      break;
    }
    case Coding::yuv444: {
      const cv::Mat colour = as_colour(picture);
      for (int y = 0; y < colour.rows; ++y) {
        for (int x = 0; x < colour.cols; ++x) {
          const Yuv yuv = to_yuv(colour.at<cv::Vec3b>(y, x));
          bytes.insert(bytes.end(), {byte(yuv.u), byte(yuv.y), byte(yuv.v)});
        }
      }
      break;
    }
    case Coding::yuv422:
      append_shared_chroma(as_colour(picture), 2, bytes);
      break;
    case Coding::yuv411:
      append_shared_chroma(as_colour(picture), 4, bytes);
      break;
  }
  return bytes;
}

Pictures::Pictures(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("frame_")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    images_.push_back(cv::imread(file.string(), cv::IMREAD_ANYCOLOR));
    if (images_.back().empty()) throw std::runtime_error("unreadable image: " + file.string());
  }
  if (images_.empty()) throw std::runtime_error("no frame_* in " + folder.string());
}

cv::Mat Pictures::picture(std::int64_t index, const PictureFormat& format) const {
  if (!images_.empty()) {
    return images_[static_cast<std::size_t>(index) % images_.size()];
  }
  cv::Mat ramp(format.top + format.height, format.left + format.width, CV_8UC1);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) {
      ramp.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>((x + 2 * y) / 4 + 7 * index);
    }
  }
  return ramp;
}

const std::vector<std::uint8_t>& Pictures::encoded(std::int64_t index, const PictureFormat& format,
                                                   const CameraModel& model) {
  const auto key_of = [](const PictureFormat& f) {
    return std::array{f.width, f.height, f.left, f.top, static_cast<int>(f.coding)};
  };
  // The ramp repeats after 256 pictures, since 7 and 256 have no common factor.
  const std::int64_t period = images_.empty() ? 256 : static_cast<std::int64_t>(images_.size());
  const std::int64_t which = index % period;
  if (key_of(format) != key_of(cached_format_) || cache_.size() > kMostCached + 256) cache_.clear();
  cached_format_ = format;
  if (const auto found = cache_.find(which); found != cache_.end()) return found->second;

  const cv::Mat image = picture(which, format);
  cv::Mat sensor;
  const bool binned = format.bytes_per_packet != 0 && !images_.empty() &&
                      format.width + format.left <= model.scalable[2].max_width &&
                      format.height + format.top <= model.scalable[2].max_height &&
                      format.height <= image.rows / 2;
  if (binned && format.width <= image.cols / 2) {
    cv::resize(image, sensor, {image.cols / 2, image.rows / 2}, 0, 0, cv::INTER_AREA);
  } else {
    sensor = image;
  }
  cv::Mat view = cv::Mat::zeros(format.height, format.width, sensor.type());
  const cv::Rect wanted(format.left, format.top, format.width, format.height);
  const cv::Rect there = wanted & cv::Rect(0, 0, sensor.cols, sensor.rows);
  if (!there.empty()) {
    sensor(there).copyTo(view(there - wanted.tl()));
  }
  return cache_[which] = encode(view, format.coding);
}

}  // namespace anneal6d::emulated
