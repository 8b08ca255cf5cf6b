// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "blur_kernels.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "instruction_sets.h"

namespace anneal6d {
namespace {

cv::Mat noise(int type) {
  cv::Mat image(61, 83, type);
  cv::RNG random(3);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

class BlurredWindow : public testing::TestWithParam<int> {};

// Noise is the hardest case; the last windows have a row and columns beyond the image's border.
TEST_P(BlurredWindow, IsTheOneOfTheWholeBlurredImage) {
  const cv::Mat image = noise(GetParam());
  cv::Mat whole;
  cv::GaussianBlur(image, whole, {5, 5}, 1, 1, cv::BORDER_REPLICATE);
  for (const std::int64_t target : test::instruction_sets()) {
    const test::OnInstructionSet on(target);
    SCOPED_TRACE(hwy::TargetName(target));
    for (const cv::Rect& window : {cv::Rect(20, 15, 47, 30), cv::Rect(1, 1, 5, 4),
                                   cv::Rect(0, 0, 83, 61), cv::Rect(60, 40, 23, 21)}) {
      cv::Mat smooth(window.size(), image.type());
      const int middle = window.height / 3;  // two strips
      blur_rows(image, window, middle, window.height, smooth);
      blur_rows(image, window, 0, middle, smooth);
      const cv::Mat expected = whole(window);
      EXPECT_LE(cv::norm(smooth, expected, cv::NORM_INF), 1) << window;
      const double mean = cv::norm(smooth, expected, cv::NORM_L1) /
                          static_cast<double>(smooth.total() * smooth.elemSize());
      EXPECT_LT(mean, 0.2) << window;
    }
  }
}

TEST_P(BlurredWindow, KeepsPlainLevels) {
  for (const int level : {0, 1, 127, 254, 255}) {
    const cv::Mat image(20, 90, GetParam(), cv::Scalar::all(level));
    cv::Mat smooth(image.size(), image.type());
    blur_rows(image, {0, 0, 90, 20}, 0, 20, smooth);
    EXPECT_EQ(cv::norm(smooth, image, cv::NORM_INF), 0) << level;
  }
}

INSTANTIATE_TEST_SUITE_P(GreyAndColour, BlurredWindow, testing::Values(CV_8UC1, CV_8UC3));

}  // namespace
}  // namespace anneal6d
