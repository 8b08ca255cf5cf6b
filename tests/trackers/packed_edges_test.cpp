// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "packed_edges.h"

#include <gtest/gtest.h>

#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace anneal6d {
namespace {

cv::Mat random_binary(int width, int height, int percent) {
  cv::Mat noise(height, width, CV_8UC1);
  cv::RNG random(static_cast<std::uint64_t>(width));
  random.fill(noise, cv::RNG::UNIFORM, 0, 100);
  return noise < percent;
}

bool bit(const PackedEdges& packed, int x, int y) { return packed.row(y)[x / 8] >> (x % 8) & 1; }

TEST(PackedEdgeImage, HoldsOneBitAPixelLowestFirst) {
  for (const int width : {1, 7, 8, 63, 64, 65, 200}) {
    const cv::Mat binary = random_binary(width, 9, 40);
    PackedEdges packed;
    packed.assign(binary);
    EXPECT_EQ(packed.size(), binary.size());
    for (int y = 0; y < binary.rows; ++y) {
      for (int x = 0; x < width; ++x) {
        ASSERT_EQ(bit(packed, x, y), binary.at<std::uint8_t>(y, x) != 0) << x << ", " << y;
      }
    }
  }
}

TEST(PackedEdgeImage, TakesAnyValueButZeroAsAnEdge) {
  cv::Mat binary = cv::Mat::zeros(1, 8, CV_8UC1);
  binary.at<std::uint8_t>(0, 2) = 1;
  binary.at<std::uint8_t>(0, 5) = 128;
  PackedEdges packed;
  packed.assign(binary);
  EXPECT_EQ(packed.row(0)[0], 1 << 2 | 1 << 5);
}

TEST(PackedEdgeImage, CanBeReadByWordsUpToTheLastPixel) {
  const cv::Mat binary(3, 65, CV_8UC1, cv::Scalar(255));
  PackedEdges packed;
  packed.assign(binary);
  std::uint64_t word;
  std::memcpy(&word, packed.row(2) + 64 / 8, sizeof word);
  EXPECT_EQ(word, 1U);  // behind the last pixel there is nothing
}

TEST(PackedEdgeImage, ForgetsTheImageBefore) {
  PackedEdges packed;
  packed.assign(cv::Mat(20, 100, CV_8UC1, cv::Scalar(255)));
  packed.assign(cv::Mat::zeros(5, 30, CV_8UC1));
  EXPECT_EQ(packed.size(), cv::Size(30, 5));
  for (int y = 0; y < 5; ++y) {
    for (int byte = 0; byte < 4; ++byte) EXPECT_EQ(packed.row(y)[byte], 0);
  }
}

using Bits = std::vector<std::uint64_t>;

Bits packed_words(const cv::Mat& binary) {
  const int words = (binary.cols + 63) / 64;
  Bits bits(static_cast<std::size_t>(words * binary.rows));
  for (int y = 0; y < binary.rows; ++y) {
    for (int x = 0; x < binary.cols; ++x) {
      if (!binary.at<std::uint8_t>(y, x)) continue;
      bits[static_cast<std::size_t>(y * words + x / 64)] |= std::uint64_t{1} << (x % 64);
    }
  }
  return bits;
}

TEST(DilatingBits, WidensAsOpenCVDoes) {
  for (const int width : {1, 30, 63, 64, 65, 127, 128, 131}) {
    for (const int radius : {0, 1, 2, 5, 8}) {
      const cv::Mat binary = random_binary(width, 23, 3);
      const int words = (width + 63) / 64;
      Bits bits = packed_words(binary), scratch;
      dilate_bits(bits, scratch, width, binary.rows, words, radius);

      cv::Mat expected;
      cv::dilate(binary, expected,
                 cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1}));
      for (int y = 0; y < binary.rows; ++y) {
        for (int x = 0; x < 64 * words; ++x) {
          const bool set = bits[static_cast<std::size_t>(y * words + x / 64)] >> (x % 64) & 1;
          const bool wanted = x < width && expected.at<std::uint8_t>(y, x) != 0;
          ASSERT_EQ(set, wanted) << width << " wide, radius " << radius << ": " << x << ", " << y;
        }
      }
    }
  }
}

TEST(GrowingBits, TakesTheComponentsThatHoldABit) {
  for (const int width : {1, 40, 64, 65, 130, 200}) {
    for (const int percent : {20, 40, 60, 100}) {  // 40: pieces that wind through many rows
      const cv::Mat candidates = random_binary(width, 57, percent);
      cv::Mat seeds = cv::Mat::zeros(candidates.size(), CV_8UC1);
      for (int y = 3; y < candidates.rows; y += 17) {
        const int x = y * 31 % width;
        seeds.at<std::uint8_t>(y, x) = candidates.at<std::uint8_t>(y, x);
      }
      Bits bits = packed_words(seeds);
      grow_bits(bits, packed_words(candidates), candidates.rows, (width + 63) / 64);

      cv::Mat labels, expected = cv::Mat::zeros(candidates.size(), CV_8UC1);
      cv::connectedComponents(candidates, labels, 8);
      std::vector<cv::Point> places;
      cv::findNonZero(seeds, places);
      for (const cv::Point& place : places) expected.setTo(255, labels == labels.at<int>(place));
      EXPECT_EQ(bits, packed_words(expected)) << width << " wide, " << percent << " percent";
    }
  }
}

TEST(GrowingBits, FollowsASpiral) {
  // One pixel wide, with one pixel between its turns; seeded in the middle.
  constexpr int kSide = 131;
  cv::Mat spiral = cv::Mat::zeros(kSide, kSide, CV_8UC1);
  cv::Point at(0, 0), step(1, 0);
  spiral.at<std::uint8_t>(at) = 255;
  const cv::Rect inside(0, 0, kSide, kSide);
  for (int turned = 0; turned < 2;) {
    const cv::Point next = at + step, after = next + step;
    const bool free =
        inside.contains(next) && !(inside.contains(after) && spiral.at<std::uint8_t>(after) != 0);
    if (free) {
      at = next;
      spiral.at<std::uint8_t>(at) = 255;
      turned = 0;
    } else {
      step = {-step.y, step.x};
      ++turned;
    }
  }
  cv::Mat seed = cv::Mat::zeros(spiral.size(), CV_8UC1);
  seed.at<std::uint8_t>(at) = 255;
  Bits bits = packed_words(seed);
  grow_bits(bits, packed_words(spiral), kSide, (kSide + 63) / 64);
  EXPECT_GT(cv::countNonZero(spiral), kSide * kSide / 3);
  EXPECT_EQ(bits, packed_words(spiral));
}

}  // namespace
}  // namespace anneal6d
