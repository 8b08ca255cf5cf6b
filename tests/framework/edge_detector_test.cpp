// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/edge_detector.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

/// 20x12, grey level 50 in columns 0..9, and `bright` in 10..19.
cv::Mat step(int bright) {
  cv::Mat image(12, 20, CV_8UC1, cv::Scalar(50));
  image.colRange(10, 20).setTo(bright);
  return image;
}

/// 64x48 noise of standard deviation `sigma` around 128, always the same.
cv::Mat noise(double sigma) {
  cv::Mat image(48, 64, CV_8UC1);
  cv::RNG random(5);
  random.fill(image, cv::RNG::NORMAL, 128, sigma);
  return image;
}

cv::Mat gradient_magnitude(const cv::Mat& image, EdgeOperator op) {
  return EdgeDetector().gradient(image, op).clone();
}

int different_pixels(const cv::Mat& a, const cv::Mat& b) { return cv::countNonZero(a != b); }

int at(const cv::Mat& image, int x, int y) { return image.at<std::uint8_t>(y, x); }

TEST(SobelGradient, IsFourTimesAStepOnBothItsSides) {
  const cv::Mat gradient = gradient_magnitude(step(60), EdgeOperator::sobel);
  ASSERT_EQ(gradient.type(), CV_8UC1);
  for (int y = 0; y < 12; ++y) {
    EXPECT_EQ(at(gradient, 8, y), 0);
    EXPECT_EQ(at(gradient, 9, y), 40);  // (1 + 2 + 1) * 10; the border rows are repeated
    EXPECT_EQ(at(gradient, 10, y), 40);
    EXPECT_EQ(at(gradient, 11, y), 0);
  }
}

TEST(PrewittGradient, IsThreeTimesAStep) {
  const cv::Mat gradient = gradient_magnitude(step(60), EdgeOperator::prewitt);
  EXPECT_EQ(at(gradient, 9, 5), 30);
  EXPECT_EQ(at(gradient, 10, 5), 30);
}

TEST(GradientMagnitude, IsTheLargerOfBothDirections) {
  // Kernels by hand: Gx = (9 + 2*6 + 3) - (7 + 2*4 + 1) = 8, Gy = (7+2*8+9) - (1+2*2+3) = 24.
  cv::Mat image = cv::Mat::zeros(16, 16, CV_8UC1);
  const cv::Mat patch = (cv::Mat_<std::uint8_t>(3, 3) << 1, 2, 3, 4, 5, 6, 7, 8, 9);
  patch.copyTo(image(cv::Rect(6, 6, 3, 3)));
  EXPECT_EQ(at(gradient_magnitude(image, EdgeOperator::sobel), 7, 7), 24);
  EXPECT_EQ(at(gradient_magnitude(image, EdgeOperator::prewitt), 7, 7), 18);
  // Turned by a quarter the other kernel has the same answer.
  EXPECT_EQ(at(gradient_magnitude(image.t(), EdgeOperator::sobel), 7, 7), 24);
}

TEST(GradientMagnitude, SaturatesAt255) {
  EXPECT_EQ(at(gradient_magnitude(step(250), EdgeOperator::sobel), 9, 5), 255);
}

TEST(GradientMagnitude, OfAColourImageIsTheLargestOfItsChannels) {
  // A step from pure green to pure red of the same grey value in a conversion, say, shows all the
  // same.
  cv::Mat colour(12, 20, CV_8UC3, cv::Scalar(10, 40, 10));
  colour.colRange(10, 20).setTo(cv::Scalar(20, 10, 60));
  const cv::Mat gradient = gradient_magnitude(colour, EdgeOperator::sobel);
  ASSERT_EQ(gradient.type(), CV_8UC1);
  EXPECT_EQ(at(gradient, 9, 5), 200);
}

TEST(GradientMagnitude, OfGreyAsColourIsThatOfGrey) {
  cv::Mat colour;
  cv::cvtColor(noise(20), colour, cv::COLOR_GRAY2BGR);
  EXPECT_EQ(different_pixels(gradient_magnitude(colour, EdgeOperator::sobel),
                             gradient_magnitude(noise(20), EdgeOperator::sobel)),
            0);
}

TEST(DetectingEdges, TakesGradientsAboveTheThreshold) {
  // The step of 10 has a Sobel gradient of 40.
  const cv::Mat above = detect_edges(step(60), {.threshold = 39}).binary;
  EXPECT_EQ(cv::countNonZero(above == 255), 2 * 12);
  EXPECT_EQ(cv::countNonZero(above), 2 * 12);
  EXPECT_EQ(at(above, 9, 0), 255);
  EXPECT_EQ(at(above, 10, 11), 255);
  EXPECT_EQ(cv::countNonZero(detect_edges(step(60), {.threshold = 40}).binary), 0);
}

TEST(DetectingEdges, WidensThemBySquares) {
  for (const int radius : {1, 3}) {
    const cv::Mat wide = detect_edges(step(60), {.threshold = 30, .dilation_px = radius}).binary;
    EXPECT_EQ(cv::countNonZero(wide), (2 + 2 * radius) * 12);
  }
  cv::Mat dot = cv::Mat::zeros(20, 20, CV_8UC1);
  dot.at<std::uint8_t>(10, 10) = 255;
  const EdgeOptions plain{.threshold = 30}, wide{.threshold = 30, .dilation_px = 2};
  EXPECT_EQ(cv::countNonZero(detect_edges(dot, plain).binary), 8);  // but the centre
  EXPECT_EQ(cv::countNonZero(detect_edges(dot, wide).binary), 7 * 7);
}

TEST(DetectingEdges, BlursFirst) {
  const EdgeOptions sharp{.threshold = 40}, blurred{.threshold = 40, .blur_sigma_px = 1.5};
  const cv::Mat image = noise(12);
  EXPECT_LT(cv::countNonZero(detect_edges(image, blurred).binary),
            cv::countNonZero(detect_edges(image, sharp).binary) / 10);
  cv::Mat smooth;
  cv::GaussianBlur(image, smooth, {}, 1.5, 1.5, cv::BORDER_REPLICATE);
  EXPECT_EQ(
      different_pixels(detect_edges(image, blurred).binary, detect_edges(smooth, sharp).binary), 0);
}

TEST(DetectingEdges, LeavesTheImageAsItIs) {
  const cv::Mat image = noise(12), before = image.clone();
  detect_edges(image, {.threshold = 40, .blur_sigma_px = 1, .dilation_px = 2});
  EXPECT_EQ(different_pixels(image, before), 0);
}

TEST(DetectingEdgesByCanny, ThinsThemToAPixel) {
  const cv::Mat edges =
      detect_edges(step(100), {.op = EdgeOperator::canny, .threshold = 100}).binary;
  EXPECT_EQ(cv::countNonZero(edges), 12);
  const cv::Mat wide =
      detect_edges(step(100), {.op = EdgeOperator::canny, .threshold = 100, .dilation_px = 1})
          .binary;
  EXPECT_EQ(cv::countNonZero(wide), 3 * 12);
}

TEST(DetectingEdgesByCanny, FollowsWeakEdgesThatTouchStrongOnes) {
  // The step is 50 in the upper half and 20 in the lower: Sobel's gradients are 200 and 80.
  cv::Mat image = step(100);
  image(cv::Rect(10, 6, 10, 6)).setTo(70);
  const auto left_column_edges = [&](int low) {
    const cv::Mat edges =
        detect_edges(image, {.op = EdgeOperator::canny, .threshold = 150, .low_threshold = low})
            .binary;
    return cv::countNonZero(edges(cv::Rect(8, 8, 4, 4)));
  };
  EXPECT_GE(left_column_edges(60), 4);
  EXPECT_EQ(left_column_edges(120), 0);
}

TEST(DetectingEdgesByCanny, HasALowThresholdOfTwoFifthsUnlessGiven) {
  const EdgeThresholds by_default =
      resolve_thresholds(step(100), {.op = EdgeOperator::canny, .threshold = 150});
  EXPECT_EQ(by_default.high, 150);
  EXPECT_EQ(by_default.low, 60);
  const EdgeThresholds given = resolve_thresholds(
      step(100), {.op = EdgeOperator::canny, .threshold = 150, .low_threshold = 140});
  EXPECT_EQ(given.low, 140);
}

TEST(AutomaticThreshold, LetsAboutATenthOfThePixelsPass) {
  for (const double sigma : {15.0, 25.0}) {
    const int edges = cv::countNonZero(detect_edges(noise(sigma), {}).binary);
    EXPECT_LE(edges, 0.1 * 64 * 48) << sigma;
    EXPECT_GE(edges, 0.08 * 64 * 48) << sigma;
  }
}

TEST(AutomaticThreshold, IsTheSmallestThatLetsNoMoreThanATenthPass) {
  const cv::Mat gradient = gradient_magnitude(noise(20), EdgeOperator::sobel);
  const int high = resolve_thresholds(noise(20), {}).high;
  EXPECT_LE(cv::countNonZero(gradient > high), 0.1 * 64 * 48);
  EXPECT_GT(cv::countNonZero(gradient > high - 1), 0.1 * 64 * 48);
}

TEST(AutomaticThreshold, IsNotMisledByTheNoiseOfAnEmptyImage) {
  EXPECT_EQ(resolve_thresholds(noise(2), {}).high, 24);
  EXPECT_EQ(resolve_thresholds(cv::Mat(48, 64, CV_8UC1, cv::Scalar(99)), {}).high, 24);
  EXPECT_LT(cv::countNonZero(detect_edges(noise(2), {}).binary), 0.01 * 64 * 48);
}

TEST(AutomaticThreshold, StaysBelowSaturation) {
  cv::Mat stripes(48, 64, CV_8UC1, cv::Scalar(0));
  for (int x = 0; x < 64; x += 4) stripes.colRange(x, x + 2).setTo(255);
  EXPECT_EQ(resolve_thresholds(stripes, {}).high, 254);
  EXPECT_GT(cv::countNonZero(detect_edges(stripes, {}).binary), 0);
}

TEST(AutomaticThreshold, IsOfTheBlurredImage) {
  EXPECT_LT(resolve_thresholds(noise(25), {.blur_sigma_px = 1}).high,
            resolve_thresholds(noise(25), {}).high);
}

TEST(AutomaticThreshold, GivesCannyBothThresholds) {
  const EdgeThresholds thresholds = resolve_thresholds(noise(20), {.op = EdgeOperator::canny});
  EXPECT_GT(thresholds.high, 24);
  EXPECT_EQ(thresholds.low, static_cast<int>(0.4 * thresholds.high));
}

TEST(EdgeDetector, FindsTheSameInAnyOrderOfImages) {
  // Larger and smaller, grey and colour: what is left of the image before must not show.
  cv::Mat colour;
  cv::cvtColor(noise(20), colour, cv::COLOR_GRAY2BGR);
  const std::vector<cv::Mat> images{noise(30), step(90), colour, noise(25)(cv::Rect(3, 5, 31, 17)),
                                    noise(15)};
  EdgeDetector detector;
  for (const auto op : {EdgeOperator::sobel, EdgeOperator::prewitt, EdgeOperator::canny}) {
    for (const double blur_sigma_px : {0.0, 1.2}) {
      for (const cv::Mat& image : images) {
        const EdgeOptions options{.op = op, .blur_sigma_px = blur_sigma_px, .dilation_px = 1};
        EdgeImage edges;
        detector.detect(image, options, edges);
        EXPECT_EQ(different_pixels(edges.binary, detect_edges(image, options).binary), 0)
            << to_string(op) << ", " << image.size();
      }
    }
  }
}

TEST(EdgeDetector, AllocatesNoImageAgainForOneThatIsNoLarger) {
  EdgeDetector detector;
  EdgeImage edges;
  const EdgeOptions options{.threshold = 40, .blur_sigma_px = 1, .dilation_px = 1};
  detector.detect(noise(20), options, edges);
  const std::uint8_t* const gradient = detector.gradient(noise(20), EdgeOperator::sobel).data;
  const std::uint8_t* const binary = edges.binary.data;
  detector.detect(noise(20), options, edges);
  EXPECT_EQ(edges.binary.data, binary);
  EXPECT_EQ(detector.gradient(step(60), EdgeOperator::sobel).data, gradient);
}

TEST(DetectingEdgesByCanny, IsOpenCVsCanny) {
  for (const cv::Mat& image : {noise(20), step(200)}) {
    cv::Mat expected;
    cv::Canny(image, expected, 80, 200);
    const EdgeOptions options{.op = EdgeOperator::canny, .threshold = 200, .low_threshold = 80};
    EXPECT_EQ(different_pixels(detect_edges(image, options).binary, expected), 0);
    EXPECT_GT(cv::countNonZero(expected), 0);
  }
}

TEST(EdgeOperatorName, ComesBack) {
  for (const auto op : {EdgeOperator::sobel, EdgeOperator::prewitt, EdgeOperator::canny}) {
    EXPECT_EQ(parse_edge_operator(to_string(op)), op);
  }
}

TEST(EdgeOperatorName, ThatIsUnknownIsRefusedWithAList) {
  try {
    parse_edge_operator("Sobel");
    FAIL() << "was accepted";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("'Sobel'; there are: sobel, prewitt, canny"),
              std::string::npos)
        << error.what();
  }
}

void expect_bad(const EdgeOptions& options, const char* words) {
  try {
    options.validate();
    ADD_FAILURE() << "was accepted; expected: " << words;
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(EdgeOptionsCheck, AcceptsTheEndsOfTheRanges) {
  EXPECT_NO_THROW(EdgeOptions{}.validate());
  EXPECT_NO_THROW((EdgeOptions{.threshold = 254, .blur_sigma_px = 5, .dilation_px = 8}.validate()));
  EXPECT_NO_THROW(
      (EdgeOptions{.op = EdgeOperator::canny, .threshold = 10000, .low_threshold = 10000}
           .validate()));
}

TEST(EdgeOptionsCheck, NamesTheBadField) {
  expect_bad({.threshold = 255}, "edge threshold 255 is not in 0..254 for sobel");
  expect_bad({.op = EdgeOperator::prewitt, .threshold = -1}, "edge threshold -1");
  expect_bad({.op = EdgeOperator::canny, .threshold = 10001}, "0..10000 for canny");
  expect_bad({.threshold = 50, .low_threshold = 20}, "low edge threshold belongs to canny");
  expect_bad({.op = EdgeOperator::canny, .threshold = 50, .low_threshold = 51},
             "low edge threshold 51");
  expect_bad({.op = EdgeOperator::canny, .low_threshold = -3}, "low edge threshold -3");
  expect_bad({.blur_sigma_px = 5.1}, "edge blur");
  expect_bad({.blur_sigma_px = std::nan("")}, "edge blur");
  expect_bad({.dilation_px = 9}, "edge dilation of 9 px");
  expect_bad({.dilation_px = -1}, "edge dilation of -1 px");
}

}  // namespace
}  // namespace anneal6d
