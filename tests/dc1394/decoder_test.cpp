// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "decoder.h"

#include <gtest/gtest.h>

#include <vector>

#include "anneal6d/framework/error.h"

namespace anneal6d::dc1394 {
namespace {

class Dc1394Decoder : public ::testing::Test {
 protected:
  static cv::Mat decode(std::vector<unsigned char> bytes, int width, dc1394color_coding_t coding,
                        int depth_bits = 8, bool little_endian = false) {
    RawPicture picture;
    picture.bytes = bytes.data();
    picture.size = {width, 1};
    picture.coding = coding;
    picture.depth_bits = depth_bits;
    picture.little_endian = little_endian;
    VideoFormat format;
    format.coding = coding;
    return Decoder(format, Dc1394Options()).decode(picture).clone();
  }

  static cv::Vec3b bgr(const cv::Mat& image, int x) { return image.at<cv::Vec3b>(0, x); }
};

TEST_F(Dc1394Decoder, KnowsThatYuvIsFullRange) {
  const cv::Mat image = decode({128, 0, 128, 255}, 2, DC1394_COLOR_CODING_YUV422);
  EXPECT_EQ(bgr(image, 0), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(bgr(image, 1), cv::Vec3b(255, 255, 255));
}

TEST_F(Dc1394Decoder, TurnsThePrimariesOfYuvIntoColours) {
  // ITU-R BT.601, full range: red is Y 76, U 85, V 255; blue is Y 29, U 255, V 107.
  EXPECT_EQ(bgr(decode({85, 76, 255, 76}, 2, DC1394_COLOR_CODING_YUV422), 0), cv::Vec3b(0, 0, 254));
  EXPECT_EQ(bgr(decode({255, 29, 107}, 1, DC1394_COLOR_CODING_YUV444), 0), cv::Vec3b(254, 0, 0));
}

TEST_F(Dc1394Decoder, GivesFourPixelsOfYuv411TheirOwnBrightness) {
  const cv::Mat image = decode({128, 10, 20, 128, 30, 40}, 4, DC1394_COLOR_CODING_YUV411);
  for (int x = 0; x < 4; ++x) EXPECT_EQ(bgr(image, x)[0], 10 * (x + 1));
}

TEST_F(Dc1394Decoder, TakesTheUpperBitsOfSixteen) {
  EXPECT_EQ(decode({0x0A, 0xBC}, 1, DC1394_COLOR_CODING_MONO16, 12).at<uchar>(0), 0xAB);
  EXPECT_EQ(decode({0xAB, 0xCD}, 1, DC1394_COLOR_CODING_MONO16, 16).at<uchar>(0), 0xAB);
  EXPECT_EQ(decode({0xBC, 0x0A}, 1, DC1394_COLOR_CODING_MONO16, 12, true).at<uchar>(0), 0xAB);
}

TEST_F(Dc1394Decoder, RefusesCodingsThatItCantDecode) {
  VideoFormat format;
  format.coding = DC1394_COLOR_CODING_RGB16;
  EXPECT_THROW(Decoder(format, Dc1394Options()), ConfigError);
}

TEST(TakeFrameCounter, ReadsBigEndianAndHealsThePixels) {
  std::vector<unsigned char> bytes = {0x01, 0x02, 0x03, 0x04, 9, 9, 50, 51, 52, 53, 54, 55};
  RawPicture picture;
  picture.bytes = bytes.data();
  picture.size = {6, 2};
  EXPECT_EQ(take_frame_counter(picture), 0x01020304U);
  EXPECT_EQ(bytes[0], 50);
  EXPECT_EQ(bytes[3], 53);
  EXPECT_EQ(bytes[4], 9);
}

TEST(ImagePool, GivesAnImageAgainOnlyWhenNobodyHoldsIt) {
  ImagePool pool;
  cv::Mat first = pool.take({8, 8}, CV_8UC1);
  const uchar* memory = first.data;
  EXPECT_NE(pool.take({8, 8}, CV_8UC1).data, memory);
  first.release();
  EXPECT_EQ(pool.take({8, 8}, CV_8UC1).data, memory);
  EXPECT_EQ(pool.size(), 2U);
}

TEST(ImagePool, DoesNotKeepWithoutLimit) {
  ImagePool pool;
  std::vector<cv::Mat> held;
  for (int i = 0; i < 100; ++i) held.push_back(pool.take({8, 8}, CV_8UC1));
  EXPECT_LE(pool.size(), 16U);
}

}  // namespace
}  // namespace anneal6d::dc1394
