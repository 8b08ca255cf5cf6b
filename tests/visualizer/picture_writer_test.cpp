// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/visualizer/picture_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <string>

#include "anneal6d/framework/error.h"
#include "full_disk.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

/// Gives each test an empty folder.
class PictureWriterTest : public testing::Test {
 protected:
  PictureWriterTest()
      : folder_(fs::temp_directory_path() /
                ("anneal6d_pictures_" + std::to_string(::getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~PictureWriterTest() override { fs::remove_all(folder_); }

  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  const fs::path folder_;
};

/// Flat, and of another grey for each number.
cv::Mat picture(int number) { return {120, 160, CV_8UC3, cv::Scalar::all(20 + 20 * number)}; }

class VideoTest : public PictureWriterTest, public testing::WithParamInterface<const char*> {};

TEST_P(VideoTest, CanBeReadBack) {
  const fs::path path = folder_ / (std::string("out") + GetParam());
  PictureWriter writer(path, 25);
  for (int i = 0; i < 10; ++i) writer.write(picture(i), i);
  EXPECT_FALSE(fs::exists(path)) << "before the commit";
  writer.commit();
  EXPECT_EQ(files(), 1U);

  cv::VideoCapture video(path.string());
  EXPECT_EQ(video.get(cv::CAP_PROP_FPS), 25);
  cv::Mat image;
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(video.read(image)) << i;
    ASSERT_EQ(image.size(), cv::Size(160, 120));
    EXPECT_NEAR(cv::mean(image)[0], 20 + 20 * i, 8);
  }
  EXPECT_FALSE(video.read(image));
}

TEST_P(VideoTest, LeavesNothingWithoutACommit) {
  {
    PictureWriter writer(folder_ / (std::string("out") + GetParam()));
    writer.write(picture(0), 0);
  }
  EXPECT_EQ(files(), 0U);
}

TEST_P(VideoTest, KeepsTheOldFileUntilTheCommit) {
  const fs::path path = folder_ / (std::string("out") + GetParam());
  std::ofstream(path) << "old";
  {
    PictureWriter writer(path);
    writer.write(picture(0), 0);
  }
  EXPECT_EQ(fs::file_size(path), 3U);
  PictureWriter writer(path);
  writer.write(picture(0), 0);
  writer.commit();
  EXPECT_GT(fs::file_size(path), 3U);
}

TEST_P(VideoTest, NoticesAFullDisk) {
  const test::FullDisk full(100000);
  const fs::path path = folder_ / (std::string("out") + GetParam());
  EXPECT_THROW(
      {
        PictureWriter writer(path);
        cv::Mat noise(480, 640, CV_8UC3);
        for (int i = 0; i < 10; ++i) {
          cv::randu(noise, 0, 256);
          writer.write(noise, i);
        }
        writer.commit();
      },
      FileError);
  EXPECT_EQ(files(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Containers, VideoTest, testing::Values(".mp4", ".avi", ".mkv", ".MP4"),
                         [](const auto& container) {
                           return std::string(container.param).substr(1);
                         });

TEST_F(PictureWriterTest, NumbersPngFilesByTheFrame) {
  PictureWriter writer(folder_ / "a" / "b");
  writer.write(picture(1), 7);
  writer.write(picture(2), 12345);
  writer.commit();
  const cv::Mat image = cv::imread((folder_ / "a" / "b" / "overlay_0007.png").string());
  EXPECT_EQ(cv::norm(image, picture(1), cv::NORM_INF), 0);
  EXPECT_TRUE(fs::exists(folder_ / "a" / "b" / "overlay_12345.png"));
}

TEST_F(PictureWriterTest, LeavesNoHalfPngOnAFullDisk) {
  PictureWriter writer(folder_ / "out");
  cv::Mat noise(480, 640, CV_8UC3);
  cv::randu(noise, 0, 256);
  const test::FullDisk full(10000);
  EXPECT_THROW(writer.write(noise, 0), FileError);
  EXPECT_TRUE(fs::is_empty(folder_ / "out"));
}

TEST_F(PictureWriterTest, RefusesAPlaceThatCannotBeWritten) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THROW(PictureWriter(folder_ / "file"), FileError) << "a file where a folder should be";
  EXPECT_THROW(PictureWriter(folder_ / "file" / "deeper"), FileError);
  EXPECT_THROW(PictureWriter(folder_ / "missing" / "out.mp4"), FileError);
  fs::create_directory(folder_ / "folder.mp4");
  EXPECT_THROW(PictureWriter(folder_ / "folder.mp4"), FileError);
  EXPECT_THROW(PictureWriter("/proc/overlays"), FileError) << "a folder nobody may write";
}

TEST_F(PictureWriterTest, NamesTheFileTypesItCanWrite) {
  try {
    PictureWriter writer(folder_ / "out.webm");
    FAIL() << "accepted";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find(".mp4, .mkv, .avi"), std::string::npos);
  }
}

TEST_F(PictureWriterTest, RefusesPicturesThatDoNotFit) {
  PictureWriter writer(folder_ / "out");
  EXPECT_THROW(writer.write(cv::Mat(), 0), ConfigError);
  writer.write(picture(0), 0);
  EXPECT_THROW(writer.write(cv::Mat::zeros(60, 80, CV_8UC3), 1), ConfigError);
  EXPECT_THROW(writer.write(cv::Mat::zeros(120, 160, CV_8UC1), 1), ConfigError);
  EXPECT_THROW(writer.write(picture(0), -1), ConfigError);
}

TEST_F(PictureWriterTest, RefusesAVideoWithoutPicturesAndAnAbsurdRate) {
  PictureWriter writer(folder_ / "out.mp4");
  EXPECT_THROW(writer.commit(), FileError);
  EXPECT_THROW(PictureWriter(folder_ / "x.mp4", 0), ConfigError);
  EXPECT_THROW(PictureWriter(folder_ / "x.mp4", std::nan("")), ConfigError);
}

}  // namespace
}  // namespace anneal6d
