// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "decoder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "anneal6d/framework/error.h"
#include "mode_names.h"

namespace anneal6d::dc1394 {
namespace {

using Debayer = Dc1394Options::Debayer;

std::uint8_t clamp(int value) { return static_cast<std::uint8_t>(std::clamp(value, 0, 255)); }

// A run of pixels, split into planes: loops over these are what compilers vectorise.
struct Run {
  static constexpr std::size_t kLength = 64;
  std::array<std::uint8_t, kLength> y, u, v;
};

// ITU-R BT.601, full range, in 1/65536.
void put_bgr(const Run& run, std::size_t length, std::uint8_t* bgr) {
  std::array<std::uint8_t, Run::kLength> blue, green, red;
  for (std::size_t i = 0; i < Run::kLength; ++i) {
    const int y = (run.y[i] << 16) + 32768, u = run.u[i] - 128, v = run.v[i] - 128;
    blue[i] = clamp((y + 116130 * u) >> 16);
    green[i] = clamp((y - 22554 * u - 46802 * v) >> 16);
    red[i] = clamp((y + 91881 * v) >> 16);
  }
  for (std::size_t i = 0; i < length; ++i) {
    bgr[3 * i] = blue[i];
    bgr[3 * i + 1] = green[i];
    bgr[3 * i + 2] = red[i];
  }
}

// U Y V
void split_yuv444(const std::uint8_t* yuv, std::size_t length, Run& run) {
  for (std::size_t i = 0; i < length; ++i) {
    run.u[i] = yuv[3 * i];
    run.y[i] = yuv[3 * i + 1];
    run.v[i] = yuv[3 * i + 2];
  }
}

// U Y V Y
void split_yuv422(const std::uint8_t* yuv, std::size_t length, Run& run) {
  for (std::size_t i = 0; i < length / 2; ++i) {
    run.u[2 * i] = run.u[2 * i + 1] = yuv[4 * i];
    run.y[2 * i] = yuv[4 * i + 1];
    run.v[2 * i] = run.v[2 * i + 1] = yuv[4 * i + 2];
    run.y[2 * i + 1] = yuv[4 * i + 3];
  }
}

// U Y Y V Y Y
void split_yuv411(const std::uint8_t* yuv, std::size_t length, Run& run) {
  for (std::size_t i = 0; i < length / 4; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      run.u[4 * i + k] = yuv[6 * i];
      run.v[4 * i + k] = yuv[6 * i + 3];
    }
    run.y[4 * i] = yuv[6 * i + 1];
    run.y[4 * i + 1] = yuv[6 * i + 2];
    run.y[4 * i + 2] = yuv[6 * i + 4];
    run.y[4 * i + 3] = yuv[6 * i + 5];
  }
}

template <class Split>
void decode_yuv(const RawPicture& picture, std::size_t bits_per_pixel, const Split& split,
                std::uint8_t* bgr) {
  Run run{};
  const auto pixels = static_cast<std::size_t>(picture.size.area());
  for (std::size_t at = 0; at < pixels; at += Run::kLength) {
    const std::size_t length = std::min(Run::kLength, pixels - at);
    split(picture.bytes + at * bits_per_pixel / 8, length, run);
    put_bgr(run, length, bgr + 3 * at);
  }
}

// The upper eight of the significant bits.
void narrow(const RawPicture& picture, std::uint8_t* out) {
  const int shift = std::clamp(picture.depth_bits, 8, 16) - 8;
  const std::size_t high = picture.little_endian ? 1 : 0, low = 1 - high;
  const std::uint8_t* in = picture.bytes;
  const auto pixels = static_cast<std::size_t>(picture.size.area());
  for (std::size_t i = 0; i < pixels; ++i, in += 2) {
    out[i] = clamp((in[high] << 8 | in[low]) >> shift);
  }
}

// OpenCV names a pattern by the second and third pixel of the second row.
int bayer_code(dc1394color_filter_t filter, Debayer method) {
  constexpr int codes[4][4] = {{cv::COLOR_BayerBG2BGR, cv::COLOR_BayerBG2BGR_EA,
                                cv::COLOR_BayerBG2BGR_VNG, cv::COLOR_BayerBG2GRAY},
                               {cv::COLOR_BayerGR2BGR, cv::COLOR_BayerGR2BGR_EA,
                                cv::COLOR_BayerGR2BGR_VNG, cv::COLOR_BayerGR2GRAY},
                               {cv::COLOR_BayerGB2BGR, cv::COLOR_BayerGB2BGR_EA,
                                cv::COLOR_BayerGB2BGR_VNG, cv::COLOR_BayerGB2GRAY},
                               {cv::COLOR_BayerRG2BGR, cv::COLOR_BayerRG2BGR_EA,
                                cv::COLOR_BayerRG2BGR_VNG, cv::COLOR_BayerRG2GRAY}};
  return codes[filter - DC1394_COLOR_FILTER_RGGB][static_cast<int>(method)];
}

bool is_raw(dc1394color_coding_t coding) {
  return coding == DC1394_COLOR_CODING_RAW8 || coding == DC1394_COLOR_CODING_RAW16;
}

bool is_grey(dc1394color_coding_t coding) {
  return coding == DC1394_COLOR_CODING_MONO8 || coding == DC1394_COLOR_CODING_MONO16;
}

dc1394color_filter_t choose_filter(const VideoFormat& format, const Dc1394Options& options) {
  constexpr std::array names = {"rggb", "gbrg", "grbg", "bggr"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (options.bayer_pattern == names[i]) {
      return static_cast<dc1394color_filter_t>(DC1394_COLOR_FILTER_RGGB + static_cast<int>(i));
    }
  }
  // A camera that does not say sends the first of the patterns.
  const bool known =
      format.filter >= DC1394_COLOR_FILTER_MIN && format.filter <= DC1394_COLOR_FILTER_MAX;
  return known ? format.filter : DC1394_COLOR_FILTER_RGGB;
}

}  // namespace

Decoder::Decoder(const VideoFormat& format, const Dc1394Options& options)
    : filter_(choose_filter(format, options)), debayer_(options.debayer) {
  switch (format.coding) {
    case DC1394_COLOR_CODING_RGB16:
    case DC1394_COLOR_CODING_MONO16S:
    case DC1394_COLOR_CODING_RGB16S:
      throw ConfigError("--coding: '" + coding_name(format.coding) +
                        "' can't be decoded; choose mono8, mono16, yuv411, yuv422, yuv444, rgb8, "
                        "raw8 or raw16");
    default:
      break;
  }
}

cv::Mat Decoder::decode(const RawPicture& picture) {
  const bool grey =
      is_grey(picture.coding) || (is_raw(picture.coding) && debayer_ == Debayer::grey);
  cv::Mat image = pool_.take(picture.size, grey ? CV_8UC1 : CV_8UC3);
  switch (picture.coding) {
    case DC1394_COLOR_CODING_MONO8:
      std::memcpy(image.data, picture.bytes, static_cast<std::size_t>(picture.size.area()));
      break;
    case DC1394_COLOR_CODING_MONO16:
      narrow(picture, image.data);
      break;
    case DC1394_COLOR_CODING_YUV444:
      decode_yuv(picture, 24, split_yuv444, image.data);
      break;
    case DC1394_COLOR_CODING_YUV422:
      decode_yuv(picture, 16, split_yuv422, image.data);
      break;
    case DC1394_COLOR_CODING_YUV411:
      decode_yuv(picture, 12, split_yuv411, image.data);
      break;
    case DC1394_COLOR_CODING_RGB8:
      cv::cvtColor(cv::Mat(picture.size, CV_8UC3, picture.bytes), image, cv::COLOR_RGB2BGR);
      break;
    case DC1394_COLOR_CODING_RAW8:
      cv::demosaicing(cv::Mat(picture.size, CV_8UC1, picture.bytes), image,
                      bayer_code(filter_, debayer_));
      break;
    case DC1394_COLOR_CODING_RAW16:
      narrow_.create(picture.size, CV_8UC1);
      narrow(picture, narrow_.data);
      cv::demosaicing(narrow_, image, bayer_code(filter_, debayer_));
      break;
    default:
      break;  // refused by the constructor
  }
  return image;
}

std::uint32_t take_frame_counter(const RawPicture& picture) {
  std::uint8_t* first = picture.bytes;
  const std::uint32_t counter = std::uint32_t{first[0]} << 24 | std::uint32_t{first[1]} << 16 |
                                std::uint32_t{first[2]} << 8 | std::uint32_t{first[3]};
  std::uint32_t bits = 8;
  dc1394_get_color_coding_bit_size(picture.coding, &bits);
  const auto row_bytes = static_cast<std::size_t>(picture.size.width) * bits / 8;
  const int below = is_raw(picture.coding) ? 2 : 1;
  if (picture.size.height > below && row_bytes >= 4) {
    std::memcpy(first, first + static_cast<std::size_t>(below) * row_bytes, 4);
  }
  return counter;
}

}  // namespace anneal6d::dc1394
