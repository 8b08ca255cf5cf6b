// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "anneal6d/framework/edge_detector.h"
#include "instruction_sets.h"
#include "packed_edges.h"
#include "raster_kernels.h"

namespace anneal6d {
namespace {

/// Noise, smoothed: strong and weak edges in all directions, up to the border.
cv::Mat noise(int width, int height, double sigma_px) {
  cv::Mat picture(height, width, CV_8UC1);
  cv::RNG random(static_cast<std::uint64_t>(width) * 1000 + static_cast<std::uint64_t>(height));
  random.fill(picture, cv::RNG::UNIFORM, 0, 256);
  if (sigma_px == 0) return picture;
  cv::GaussianBlur(picture, picture, {}, sigma_px);
  cv::normalize(picture, picture, 0, 255, cv::NORM_MINMAX);
  return picture;
}

cv::Mat canny_by_bits(const cv::Mat& picture, int low, int high) {
  const int width = picture.cols, height = picture.rows, words = (width + 63) / 64;
  const int stride = width + kPixelMargin, row_stride = width + 2 * kRowMargin;
  const auto entries = [](int rows, int columns) {
    return static_cast<std::size_t>(rows * columns);
  };
  std::vector<std::uint32_t> pixels(entries(height, stride));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      pixels[entries(y, stride) + static_cast<std::size_t>(x)] =
          0xABCDEF00U | picture.at<std::uint8_t>(y, x);
    }
  }
  // What was there before must not matter.
  std::vector<std::uint16_t> rows(entries(kBrightnessRows, row_stride), 77);
  std::vector<std::int16_t> gradients(3 * rows.size(), 777);
  std::vector<std::uint64_t> bits(entries(height, words), ~std::uint64_t{0}), candidates = bits;
  find_canny_candidates({.picture = {.pixels = pixels.data(),
                                     .stride = stride,
                                     .width = width,
                                     .height = height,
                                     .rows = rows.data(),
                                     .row_stride = row_stride},
                         .low = low,
                         .high = high,
                         .gradients = gradients.data(),
                         .candidates = candidates.data(),
                         .strong = bits.data()});
  grow_bits(bits, candidates, height, words);

  cv::Mat edges(height, 64 * words, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < 64 * words; ++x) {
      const std::uint64_t word = bits[entries(y, words) + static_cast<std::size_t>(x / 64)];
      edges.at<std::uint8_t>(y, x) = word >> (x % 64) & 1 ? 255 : 0;
    }
  }
  return edges;
}

TEST(CannyByBits, EqualsOpenCVs) {
  for (const std::int64_t target : test::instruction_sets()) {
    const test::OnInstructionSet on(target);
    for (const cv::Size size : {cv::Size(1, 1),
                                {1, 30},
                                {30, 1},
                                {7, 2},
                                {64, 16},
                                {65, 17},
                                {127, 33},
                                {200, 64},
                                {333, 100}}) {
      for (const double sigma_px : {0.0, 1.0, 3.0}) {
        const cv::Mat picture = noise(size.width, size.height, sigma_px);
        for (const auto& [low, high] : {std::pair{0, 0}, {0, 60}, {40, 100}, {100, 1000}}) {
          SCOPED_TRACE(testing::Message() << hwy::TargetName(target) << ", " << size << ", sigma "
                                          << sigma_px << ", " << low << " to " << high);
          const cv::Mat expected =
              detect_edges(picture,
                           {.op = EdgeOperator::canny, .threshold = high, .low_threshold = low})
                  .binary;
          const cv::Mat found = canny_by_bits(picture, low, high);
          ASSERT_EQ(cv::countNonZero(found.colRange(0, size.width) != expected), 0);
          ASSERT_EQ(cv::countNonZero(found.colRange(size.width, found.cols)), 0);
        }
      }
    }
  }
}

TEST(CannyByBits, TakesThePictureAway) {
  std::vector<std::uint32_t> pixels(40 * (30 + kPixelMargin), 0x12345678);
  std::vector<std::uint16_t> rows(kBrightnessRows * (30 + 2 * kRowMargin));
  std::vector<std::int16_t> gradients(3 * rows.size());
  std::vector<std::uint64_t> bits(40), candidates(40);
  find_canny_candidates({.picture = {.pixels = pixels.data(),
                                     .stride = 30 + kPixelMargin,
                                     .width = 30,
                                     .height = 40,
                                     .rows = rows.data(),
                                     .row_stride = 30 + 2 * kRowMargin},
                         .low = 10,
                         .high = 20,
                         .gradients = gradients.data(),
                         .candidates = candidates.data(),
                         .strong = bits.data()});
  for (std::size_t y = 0; y < 40; ++y) {
    for (std::size_t x = 0; x < 30; ++x) ASSERT_EQ(pixels[y * (30 + kPixelMargin) + x], 0U);
  }
}

}  // namespace
}  // namespace anneal6d
