// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "line_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "instruction_sets.h"

namespace anneal6d {
namespace {

/// Interpolated between the four pixels around a place; outside, as at the border.
double interpolated(const cv::Mat& picture, int channel, double x, double y) {
  x = std::clamp(x, 0.0, picture.cols - 1.001);
  y = std::clamp(y, 0.0, picture.rows - 1.001);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const auto pixel = [&](int r, int c) -> double {
    return picture.ptr<std::uint8_t>(r)[c * picture.channels() + channel];
  };
  const double right = x - column, down = y - row;
  return (1 - down) * ((1 - right) * pixel(row, column) + right * pixel(row, column + 1)) +
         down * ((1 - right) * pixel(row + 1, column) + right * pixel(row + 1, column + 1));
}

/// A picture in memory that ends with its last pixel, so that a sanitizer sees reads behind it.
cv::Mat tight_picture(std::vector<std::uint8_t>& bytes, int channels) {
  bytes.resize(static_cast<std::size_t>(23 * 17 * channels));
  cv::RNG random(5);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.uniform(0, 256));
  return {17, 23, CV_8UC(channels), bytes.data()};
}

class SampledLine : public testing::TestWithParam<int> {};

TEST_P(SampledLine, InterpolatesBetweenPixelsStaysInThePictureAndHasItsSlopes) {
  std::vector<std::uint8_t> bytes;
  const cv::Mat picture = tight_picture(bytes, GetParam());
  constexpr int kCount = 37;
  for (const std::int64_t target : test::instruction_sets()) {
    const test::OnInstructionSet on(target);
    SCOPED_TRACE(hwy::TargetName(target));
    for (const auto& [x, y, step_x, step_y] : {std::array{3.3F, 2.7F, 0.5F, 0.3F},
                                               {-9.5F, 8.25F, 1.0F, 0.0F},
                                               {30.0F, 25.0F, -0.8F, -0.6F},
                                               {11.0F, -20.0F, 0.0F, 1.0F},
                                               {22.0F, 16.0F, 0.6F, 0.8F}}) {
      std::array<std::array<float, kCount + LineJob::kPadding>, 3> grey;
      std::array<float, kCount + LineJob::kPadding> slope;
      sample_line({.data = picture.data,
                   .stride = static_cast<std::ptrdiff_t>(picture.step[0]),
                   .columns = picture.cols,
                   .rows = picture.rows,
                   .channels = picture.channels(),
                   .x = x,
                   .y = y,
                   .step_x = step_x,
                   .step_y = step_y,
                   .count = kCount,
                   .grey = {grey[0].data(), grey[1].data(), grey[2].data()},
                   .slope = slope.data()});
      for (int channel = 0; channel < picture.channels(); ++channel) {
        for (std::size_t i = 0; i < kCount; ++i) {
          const double along = static_cast<double>(i);
          const double expected =
              interpolated(picture, channel, x + along * step_x, y + along * step_y);
          EXPECT_NEAR(grey[static_cast<std::size_t>(channel)][i], expected, 0.02)
              << "sample " << i << " from " << x << ", " << y << ", channel " << channel;
        }
      }
      for (std::size_t i = 1; i < kCount - 1; ++i) {
        double sum = 0;
        for (int channel = 0; channel < picture.channels(); ++channel) {
          const auto& values = grey[static_cast<std::size_t>(channel)];
          sum += std::pow(0.5 * (values[i + 1] - values[i - 1]), 2);
        }
        EXPECT_NEAR(slope[i], std::sqrt(sum), 1e-3) << "sample " << i << " from " << x << ", " << y;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(GreyAndColour, SampledLine, testing::Values(1, 3));

}  // namespace
}  // namespace anneal6d
