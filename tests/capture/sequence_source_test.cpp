// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/sequence_source.h"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "capture_test_support.h"

namespace anneal6d {
namespace {

using test::contains;
using test::message_of;

// Five images; image i has the grey value 10 i.
class SequenceSourceOverFiveImages : public testing::Test {
 protected:
  SequenceSourceOverFiveImages() {
    for (int i = 0; i < 5; ++i) {
      cv::imwrite(image(i).string(), cv::Mat(48, 64, CV_8UC1, cv::Scalar(10 * i)));
    }
  }

  std::filesystem::path image(int index) const {
    return folder_ / ("frame_000" + std::to_string(index) + ".png");
  }
  void cut_off(int index) {
    std::filesystem::resize_file(image(index), std::filesystem::file_size(image(index)) / 2);
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  static int grey(const std::optional<Frame>& frame) { return frame->image.at<unsigned char>(0); }

  test::TemporaryFolder folder_;
};

TEST_F(SequenceSourceOverFiveImages, HandsOutEveryImageInOrderAndThenEnds) {
  SequenceSource source(folder_.path());
  for (int i = 0; i < 5; ++i) {
    const auto frame = source.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->index, i);
    EXPECT_EQ(grey(frame), 10 * i);
    EXPECT_DOUBLE_EQ(frame->timestamp_s, i / 30.0);
  }
  EXPECT_FALSE(source.next());
  EXPECT_FALSE(source.next());
}

TEST_F(SequenceSourceOverFiveImages, SkipsByArithmeticAndKeepsIndices) {
  cut_off(1);
  SequenceSource source(folder_.path());
  EXPECT_EQ(source.skip(3), 3);
  EXPECT_EQ(source.next()->index, 3);
  EXPECT_EQ(source.skip(5), 1);
  EXPECT_EQ(source.skip(5), 0);
  EXPECT_FALSE(source.next());
}

TEST_F(SequenceSourceOverFiveImages, NamesACutOffImageAndGoesOnWithTheNext) {
  cut_off(2);
  SequenceSource source(folder_.path());
  source.skip(2);
  const std::string message = message_of<FileError>([&] { source.next(); });
  EXPECT_TRUE(contains(message, "frame_0002.png")) << message;
  EXPECT_TRUE(contains(message, "cut off")) << message;
  EXPECT_EQ(source.next()->index, 3);
}

TEST_F(SequenceSourceOverFiveImages, NamesAnImageOfAnotherSizeAndGoesOnWithTheNext) {
  cv::imwrite(image(1).string(), cv::Mat(24, 32, CV_8UC1, cv::Scalar(0)));
  SequenceSource source(folder_.path());
  source.next();
  const std::string message = message_of<FileError>([&] { source.next(); });
  EXPECT_TRUE(contains(message, "frame_0001.png")) << message;
  EXPECT_TRUE(contains(message, "32x24") && contains(message, "64x48")) << message;
  EXPECT_EQ(source.next()->index, 2);
}

TEST_F(SequenceSourceOverFiveImages, HoldsImagesToTheSizeOfTheGivenCalibration) {
  CameraModel camera{640, 480, 600, 600, 320, 240, {}};
  SequenceSource source(folder_.path(), camera);
  const std::string message = message_of<FileError>([&] { source.next(); });
  EXPECT_TRUE(contains(message, "640x480") && contains(message, "calibration")) << message;
}

TEST_F(SequenceSourceOverFiveImages, ReadsNoCalibrationFileIfACalibrationIsGiven) {
  write("camera.yml", "nonsense");
  EXPECT_THROW(SequenceSource{folder_.path()}, FileError);
  SequenceSource source(folder_.path(), CameraModel{64, 48, 60, 60, 32, 24, {}});
  EXPECT_DOUBLE_EQ(source.camera()->fx_px, 60);
}

TEST_F(SequenceSourceOverFiveImages, GivesTheTruthOfTheFrameLastHandedOut) {
  write("groundtruth.csv", "frame,tx,ty,tz,qw,qx,qy,qz\n0,1,0,500,1,0,0,0\n3,4,0,500,1,0,0,0\n");
  SequenceSource source(folder_.path());
  EXPECT_FALSE(source.ground_truth());
  source.next();
  EXPECT_DOUBLE_EQ(source.ground_truth()->translation_mm.x(), 1);
  source.next();
  EXPECT_FALSE(source.ground_truth());
  source.skip(1);
  source.next();
  EXPECT_DOUBLE_EQ(source.ground_truth()->translation_mm.x(), 4);
}

TEST_F(SequenceSourceOverFiveImages, RefusesWhatIsNoImage) {
  write("frame_0000.png", "this is text");
  SequenceSource source(folder_.path());
  EXPECT_TRUE(contains(message_of<FileError>([&] { source.next(); }), "frame_0000.png"));
  write("frame_0001.png", "");
  EXPECT_TRUE(contains(message_of<FileError>([&] { source.next(); }), "empty"));
}

TEST(SequenceSource, RefusesAJpegThatTheDecoderWouldFillUpWithGrey) {
  test::TemporaryFolder folder;
  const auto path = folder / "frame_0000.jpg";
  cv::Mat picture(120, 160, CV_8UC3);
  cv::randu(picture, 0, 255);
  cv::imwrite(path.string(), picture);
  EXPECT_TRUE(SequenceSource(folder.path()).next());
  std::filesystem::resize_file(path, std::filesystem::file_size(path) * 2 / 3);
  SequenceSource source(folder.path());
  EXPECT_TRUE(contains(message_of<FileError>([&] { source.next(); }), "cut off"));
}

TEST(SequenceSource, TurnsSixteenBitAndTransparentImagesIntoEightBitOnes) {
  test::TemporaryFolder folder;
  cv::imwrite((folder / "frame_0000.png").string(), cv::Mat(48, 64, CV_16UC1, cv::Scalar(25700)));
  cv::imwrite((folder / "frame_0001.png").string(),
              cv::Mat(48, 64, CV_8UC4, cv::Scalar(10, 20, 30, 40)));
  SequenceSource source(folder.path());
  const auto grey = source.next();
  EXPECT_EQ(grey->image.type(), CV_8UC1);
  EXPECT_EQ(grey->image.at<unsigned char>(0), 100);
  const auto color = source.next();
  ASSERT_EQ(color->image.type(), CV_8UC3);
  EXPECT_EQ(color->image.at<cv::Vec3b>(0), cv::Vec3b(10, 20, 30));
}

TEST(SequenceSource, RefusesAFolderThatIsNotThere) {
  const std::string message =
      message_of<FileError>([] { SequenceSource source("/no/such/folder"); });
  EXPECT_TRUE(contains(message, "/no/such/folder")) << message;
}

}  // namespace
}  // namespace anneal6d
