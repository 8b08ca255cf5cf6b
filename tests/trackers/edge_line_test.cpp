// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "edge_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "anneal6d/framework/srgb.h"

namespace anneal6d {
namespace {

const Eigen::Vector2d kMiddle(30, 20);
const Eigen::Vector2d kRight(1, 0);

/// A stripe of colour, up to a column that may lie between pixels.
struct Stripe {
  double to_column;
  cv::Vec3b bgr;
};

/// What a camera sees of vertical stripes, blurred as trackers blur it. Light mixes within pixels.
cv::Mat stripes(const std::vector<Stripe>& stripes, bool colour = true) {
  cv::Mat image(41, 61, CV_8UC3);
  for (int x = 0; x < image.cols; ++x) {
    std::array<double, 3> light{};
    double begin = x - 0.5;
    for (const Stripe& stripe : stripes) {
      const double end = std::min(x + 0.5, stripe.to_column);
      if (end <= begin) continue;
      for (int c = 0; c < 3; ++c) {
        const auto level = static_cast<std::size_t>(stripe.bgr[c]);
        light[static_cast<std::size_t>(c)] += (end - begin) * srgb_light_table()[level];
      }
      begin = end;
    }
    cv::Vec3b pixel;
    for (int c = 0; c < 3; ++c) {
      const double encoded = 1.055 * std::pow(light[static_cast<std::size_t>(c)], 1 / 2.4) - 0.055;
      pixel[c] = cv::saturate_cast<std::uint8_t>(255 * encoded);
    }
    image.col(x).setTo(pixel);
  }
  if (!colour) cv::extractChannel(image, image, 0);
  cv::Mat smooth;
  cv::GaussianBlur(image, smooth, {5, 5}, kEdgeBlur_px, kEdgeBlur_px, cv::BORDER_REPLICATE);
  return smooth;
}

cv::Vec3b grey(int level) { return cv::Vec3b::all(static_cast<std::uint8_t>(level)); }

/// The best edge beside the middle, located in light.
EdgeLine::Edge best_of(const EdgeLine& line) {
  std::array<EdgeLine::Edge, 3> edges;
  return line.find(edges) > 0 ? edges[0] : EdgeLine::Edge{};
}

TEST(EdgeLineOnAStep, FindsItBetweenPixelsWhicheverSideIsBright) {
  for (const auto& [before, behind] : {std::pair(40, 160), std::pair(160, 40), std::pair(30, 60)}) {
    for (double at_px = -4.0; at_px <= 4.0; at_px += 0.25) {
      for (const bool colour : {false, true}) {
        const cv::Mat image =
            stripes({{kMiddle.x() + at_px, grey(before)}, {1e9, grey(behind)}}, colour);
        const EdgeLine line({image, {}}, kMiddle, kRight, 8);
        const EdgeLine::Edge edge = best_of(line);
        ASSERT_GT(edge.strength, 0) << before << " to " << behind << " at " << at_px;
        // 0.11 px at worst, where the step halves a pixel: the correction is right on average.
        EXPECT_NEAR(edge.offset_px, at_px, 0.13) << before << " to " << behind;
        EXPECT_NEAR(line.strongest().offset_px, at_px, 0.35) << "shifted to the dark side";
      }
    }
  }
}

TEST(EdgeLineOnAStep, CountsFromTheMiddleAlongTheNormal) {
  const cv::Mat image = stripes({{32.5, grey(40)}, {1e9, grey(160)}}, false);
  EXPECT_NEAR(best_of({{image, {}}, kMiddle, -kRight, 8}).offset_px, -2.5, 0.13);
  // The same pixels as part of a larger image.
  const Eigen::Vector2d shifted = kMiddle + Eigen::Vector2d(100, 50);
  EXPECT_NEAR(best_of({{image, {100, 50}}, shifted, kRight, 8}).offset_px, 2.5, 0.13);
}

TEST(EdgeLineOnAStep, FindsNothingOnAPlainPictureOrBeyondItsReach) {
  EXPECT_EQ(best_of({{stripes({{1e9, grey(90)}}), {}}, kMiddle, kRight, 8}).strength, 0);
  const cv::Mat far = stripes({{45.0, grey(40)}, {1e9, grey(160)}});
  EXPECT_EQ(best_of({{far, {}}, kMiddle, kRight, 8}).strength, 0);
}

TEST(EdgeLineOnAStep, StaysInThePictureAtItsBorder) {
  const cv::Mat image = stripes({{2.0, grey(40)}, {1e9, grey(160)}});
  const EdgeLine line({image, {}}, {0, 0}, Eigen::Vector2d(-1, -1).normalized(),
                      EdgeLine::kMaxReach_px);
  EXPECT_TRUE(std::isfinite(best_of(line).offset_px));
}

TEST(EdgeLineWithAPolarity, RefusesTheWrongOne) {
  const cv::Mat image = stripes({{31.0, grey(40)}, {1e9, grey(160)}});
  EdgeLine line({image, {}}, kMiddle, kRight, 8);
  line.require(-1);
  EXPECT_EQ(best_of(line).strength, 0);
  EXPECT_EQ(line.strongest().strength, 0);
  line.require(1);
  EXPECT_NEAR(best_of(line).offset_px, 1.0, 0.13);
  line.require(0);
  EXPECT_NEAR(best_of(line).offset_px, 1.0, 0.13);
}

TEST(EdgeLineWithColours, PrefersTheObjectsEdgeToStrongerClutter) {
  const cv::Vec3b red(30, 30, 150), table(90, 90, 90), clutter(250, 250, 250);
  // Object, background, and something bright that begins as near to the middle.
  const cv::Mat image = stripes({{27.0, red}, {33.0, table}, {1e9, clutter}});
  EdgeLine line({image, {}}, kMiddle, kRight, 8);
  EXPECT_NEAR(line.strongest().offset_px, 3.0, 0.3) << "the stronger edge";
  EXPECT_EQ(line.agreement(), 1);

  Appearance appearance(3);
  line.compare(appearance, 16, 16);
  EXPECT_NEAR(line.strongest().offset_px, 3.0, 0.3) << "nothing was learned yet";

  const std::vector<std::uint16_t> object(200, appearance.bin(red.val));
  const std::vector<std::uint16_t> beside(200, appearance.bin(table.val));
  appearance.learn(object, beside);
  line.compare(appearance, 16, 16);
  EXPECT_NEAR(line.strongest().offset_px, -3.0, 0.3);
  EXPECT_LT(line.agreement(), 0.5) << "the middle is background";

  EdgeLine there({image, {}}, kMiddle - Eigen::Vector2d(3, 0), kRight, 8);
  there.compare(appearance, 16, 16);
  EXPECT_GT(there.agreement(), 0.5) << "the middle is the object's border";
}

TEST(EdgeLineWithColours, KnowsTheObjectsBorderFarFromTheMiddle) {
  const cv::Vec3b red(30, 30, 150), table(90, 90, 90);
  const cv::Mat image = stripes({{23.0, red}, {1e9, table}});
  EdgeLine line({image, {}}, kMiddle, kRight, 16);
  Appearance appearance(3);
  line.compare(appearance, 32, 32);
  const EdgeLine::Border unknown = line.border();
  EXPECT_NEAR(unknown.offset_px, 0, 1e-3) << "nothing was learned yet";

  appearance.learn(std::vector<std::uint16_t>(200, appearance.bin(red.val)),
                   std::vector<std::uint16_t>(200, appearance.bin(table.val)));
  line.compare(appearance, 32, 32);
  EXPECT_NEAR(line.border().offset_px, -7.0, 0.5);
  EXPECT_LT(line.border().variance_px2, 0.1F * unknown.variance_px2);
}

TEST(EdgeLineWithManyEdges, GivesTheBestFirst) {
  const cv::Mat image =
      stripes({{25.0, grey(60)}, {31.0, grey(160)}, {36.0, grey(60)}, {1e9, grey(160)}});
  const EdgeLine line({image, {}}, kMiddle, kRight, 8);
  std::array<EdgeLine::Edge, 5> edges;
  ASSERT_EQ(line.find(edges), 3);
  EXPECT_NEAR(edges[0].offset_px, 1, 0.2) << "the nearest";
  EXPECT_GE(edges[0].score, edges[1].score);
  EXPECT_GE(edges[1].score, edges[2].score);
  EXPECT_EQ(line.find(std::span(edges).first(1)), 1);
  EXPECT_NEAR(edges[0].offset_px, 1, 0.2);
}

}  // namespace
}  // namespace anneal6d
