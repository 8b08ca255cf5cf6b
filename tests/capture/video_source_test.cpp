// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/video_source.h"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgproc.hpp>

#include "capture_test_support.h"

namespace anneal6d {
namespace {

using test::contains;
using test::message_of;

constexpr int kFrames = 60;

// A film of a square that moves one pixel a frame.
class VideoSourceOverAFilm : public testing::Test {
 protected:
  void SetUp() override {
    cv::VideoWriter writer(path_.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25,
                           {160, 120});
    if (!writer.isOpened()) GTEST_SKIP() << "this OpenCV can't write MJPG in AVI";
    for (int i = 0; i < kFrames; ++i) {
      cv::Mat image(120, 160, CV_8UC3, cv::Scalar(40, 40, 40));
      cv::rectangle(image, {i, 40, 40, 40}, {255, 255, 255}, cv::FILLED);
      writer.write(image);
    }
  }

  // Where the square begins, pixels.
  static int square_x(const Frame& frame) {
    int x = 0;
    while (x < frame.image.cols && frame.image.at<cv::Vec3b>(60, x)[0] < 150) ++x;
    return x;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "film.avi";
};

TEST_F(VideoSourceOverAFilm, HandsOutEveryFrameAndThenEnds) {
  VideoSource source(path_);
  std::vector<Frame> frames;
  while (auto frame = source.next()) frames.push_back(*frame);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i) {
    const Frame& frame = frames[static_cast<std::size_t>(i)];
    EXPECT_EQ(frame.index, i);
    EXPECT_NEAR(square_x(frame), i, 1);
    EXPECT_NEAR(frame.timestamp_s, i / 25.0, 1e-9);
  }
  EXPECT_FALSE(source.next());
}

TEST_F(VideoSourceOverAFilm, SkipsAndKeepsIndices) {
  VideoSource source(path_);
  EXPECT_EQ(source.skip(10), 10);
  const auto frame = source.next();
  EXPECT_EQ(frame->index, 10);
  EXPECT_NEAR(square_x(*frame), 10, 1);
  EXPECT_EQ(source.skip(1000), kFrames - 11);
  EXPECT_FALSE(source.next());
}

TEST_F(VideoSourceOverAFilm, SaysWhereACutOffFileBreaksOff) {
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  std::string message;
  int frames = 0;
  message = message_of<FileError>([&] {
    VideoSource source(path_);
    while (source.next()) ++frames;
  });
  EXPECT_LT(frames, kFrames);
  EXPECT_TRUE(contains(message, "film.avi")) << message;
  EXPECT_TRUE(contains(message, "truncated") || contains(message, "cut-off")) << message;
}

TEST_F(VideoSourceOverAFilm, EndsAfterHavingReportedTheBreak) {
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  VideoSource source(path_);
  EXPECT_THROW(
      {
        while (source.next()) {
        }
      },
      FileError);
  EXPECT_FALSE(source.next());
}

TEST_F(VideoSourceOverAFilm, RefusesAFilmOfAnotherSizeThanTheCalibration) {
  const std::string message = message_of<ConfigError>([&] {
    VideoSource source(path_, CameraModel{640, 480, 600, 600, 320, 240, {}});
  });
  EXPECT_TRUE(contains(message, "160x120") && contains(message, "640x480")) << message;
}

TEST(VideoSource, RefusesMissingAndUndecodableFiles) {
  test::TemporaryFolder folder;
  EXPECT_TRUE(contains(message_of<FileError>([&] { VideoSource source(folder / "none.mp4"); }),
                       "no such file"));
  std::ofstream(folder / "text.mp4") << "this is text, not a film";
  EXPECT_TRUE(contains(message_of<FileError>([&] { VideoSource source(folder / "text.mp4"); }),
                       "text.mp4"));
  std::ofstream(folder / "empty.mp4");
  EXPECT_THROW(VideoSource(folder / "empty.mp4"), FileError);
}

}  // namespace
}  // namespace anneal6d
