// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "anneal6d/capture/sequence_source.h"
#include "dc1394_test.h"

namespace anneal6d {
namespace {

class Dc1394Streaming : public test::Dc1394Test {
 protected:
  static std::string sequence() { return std::string(ANNEAL6D_TEST_DATA) + "/sequence_short"; }

  static double largest_difference(const cv::Mat& a, const cv::Mat& b) {
    return cv::norm(a, b, cv::NORM_INF);
  }

  // A colour picture without sharp edges, so that shared chroma and debayering change little.
  static cv::Mat smooth_colours(int width, int height) {
    cv::Mat picture(height, width, CV_8UC3);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        picture.at<cv::Vec3b>(y, x) =
            cv::Vec3b(static_cast<uchar>(40 + x / 5), static_cast<uchar>(60 + y / 4),
                      static_cast<uchar>(200 - x / 8 - y / 8));
      }
    }
    return picture;
  }
};

TEST_F(Dc1394Streaming, GivesThePicturesOfAGreyCameraWithoutALoss) {
  bus_.add_camera("DR2-BW", test::kGuid, emulated::Pictures(sequence()));
  const auto source = open({{"frame-info", "off"}});
  SequenceSource expected(sequence());
  for (int i = 0; i < 20; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame);
    cv::Mat grey = expected.next()->image;
    if (grey.channels() == 3) cv::cvtColor(grey, grey, cv::COLOR_BGR2GRAY);
    EXPECT_EQ(frame->index, i);
    EXPECT_EQ(frame->lost_before, 0);
    ASSERT_EQ(frame->image.size(), grey.size());
    EXPECT_EQ(largest_difference(frame->image, grey), 0) << "frame " << i;
  }
}

TEST_F(Dc1394Streaming, TheFrameCounterChangesFourPixelsOfTheCornerAtMost) {
  bus_.add_camera("DR2-BW", test::kGuid);
  cv::Mat with = open({{"frame-info", "on"}})->next()->image;
  bus_.clear();
  bus_.add_camera("DR2-BW", test::kGuid);
  cv::Mat without = open({{"frame-info", "off"}})->next()->image;
  EXPECT_EQ(cv::countNonZero(with.row(0).colRange(0, 4) != without.row(1).colRange(0, 4)), 0);
  with(cv::Rect(0, 0, 4, 1)) = 0;
  without(cv::Rect(0, 0, 4, 1)) = 0;
  EXPECT_EQ(largest_difference(with, without), 0);
}

TEST_F(Dc1394Streaming, DecodesEveryColourCoding) {
  const cv::Mat picture = smooth_colours(648, 488);
  const std::string folder = ::testing::TempDir() + "dc1394_colours";
  std::filesystem::create_directories(folder);
  cv::imwrite(folder + "/frame_0000.png", picture);
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  // Rounding of YUV, of shared chroma, and the interpolation of raw pictures.
  const std::vector<std::pair<std::string, double>> cases = {
      {"mono8", 0},  {"mono16", 0}, {"rgb8", 0}, {"yuv422", 4},
      {"yuv411", 4}, {"raw8", 3},   {"raw16", 3}};
  for (const auto& [coding, tolerance] : cases) {
    bus_.clear();
    bus_.add_camera("DR2-COL", test::kGuid, emulated::Pictures(folder));
    const cv::Mat image =
        open({{"video-mode", "format7-0"}, {"coding", coding}, {"frame-info", "off"}})
            ->next()
            ->image;
    const cv::Mat& expected = image.channels() == 1 ? grey : picture;
    ASSERT_EQ(image.size(), expected.size()) << coding;
    ASSERT_EQ(image.type(), expected.type()) << coding;
    const cv::Rect inner(2, 2, image.cols - 4, image.rows - 4);  // Bayer interpolation's border
    EXPECT_LE(largest_difference(image(inner), expected(inner)), tolerance) << coding;
  }
  std::filesystem::remove_all(folder);
}

TEST_F(Dc1394Streaming, HasFourWaysToDebayer) {
  bus_.add_camera("DR2-COL", test::kGuid);
  for (const char* method : {"bilinear", "edge-aware", "vng"}) {
    EXPECT_EQ(open({{"coding", "raw8"}, {"debayer", method}})->next()->image.type(), CV_8UC3);
  }
  EXPECT_EQ(open({{"coding", "raw8"}, {"debayer", "grey"}})->next()->image.type(), CV_8UC1);
}

TEST_F(Dc1394Streaming, AWrongBayerPatternGivesWrongColours) {
  const std::string folder = ::testing::TempDir() + "dc1394_red";
  std::filesystem::create_directories(folder);
  cv::imwrite(folder + "/frame_0000.png", cv::Mat(488, 648, CV_8UC3, cv::Scalar(10, 20, 200)));
  bus_.add_camera("DR2-COL", test::kGuid, emulated::Pictures(folder));
  EXPECT_EQ(open({{"coding", "raw8"}})->next()->image.at<cv::Vec3b>(50, 50),
            cv::Vec3b(10, 20, 200));
  EXPECT_EQ(
      open({{"coding", "raw8"}, {"bayer-pattern", "bggr"}})->next()->image.at<cv::Vec3b>(50, 50),
      cv::Vec3b(200, 20, 10));
  std::filesystem::remove_all(folder);
}

TEST_F(Dc1394Streaming, CutsOutTheRegionOfInterest) {
  bus_.add_camera("DR2-BW", test::kGuid);
  const cv::Mat all = open({{"video-mode", "format7-0"}})->next()->image;
  EXPECT_EQ(all.size(), cv::Size(648, 488));
  bus_.clear();
  bus_.add_camera("DR2-BW", test::kGuid);
  const cv::Mat part = open({{"roi", "100,50,320,240"}, {"frame-info", "off"}})->next()->image;
  EXPECT_EQ(largest_difference(part, all(cv::Rect(100, 50, 320, 240))), 0);
}

TEST_F(Dc1394Streaming, BinsInModesOneAndTwo) {
  bus_.add_camera("DR2-BW", test::kGuid);
  EXPECT_EQ(open({{"video-mode", "format7-1"}})->next()->image.size(), cv::Size(320, 240));
  EXPECT_EQ(open({{"video-mode", "format7-2"}})->next()->image.size(), cv::Size(640, 240));
}

TEST_F(Dc1394Streaming, StampsFramesWithTheTimeOfTheirExposure) {
  bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open({{"fps", "30"}});
  EXPECT_EQ(source->next()->timestamp_s, 0);
  for (int i = 1; i < 100; ++i) {
    // One cycle of the bus, 125 us, is what a timestamp can tell.
    EXPECT_NEAR(source->next()->timestamp_s, i / 30.0, 0.0003);
  }
}

TEST_F(Dc1394Streaming, TheNewestFrameIsTheLastOfThoseThatWait) {
  bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open({{"capture", "newest"}, {"buffers", "4"}, {"frame-info", "on"}});
  std::int64_t last = source->next()->index;
  for (int i = 0; i < 10; ++i) {
    const auto frame = source->next();
    EXPECT_GT(frame->index, last);
    EXPECT_EQ(frame->lost_before, 0) << "passed over is not lost";
    last = frame->index;
  }
  EXPECT_GT(last, 20) << "frames that waited were not passed over";
}

TEST_F(Dc1394Streaming, DropsTheFirstFramesUntilSettingsHaveSettled) {
  bus_.add_camera("DR2-BW", test::kGuid);
  const cv::Mat third = open({{"settle-frames", "2"}, {"frame-info", "off"}})->next()->image;
  bus_.clear();
  bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open({{"frame-info", "off"}});
  source->next();
  source->next();
  EXPECT_EQ(largest_difference(source->next()->image, third), 0);
}

TEST_F(Dc1394Streaming, FramesThatAreDroppedAreNoSilence) {
  bus_.add_camera("DR2-BW", test::kGuid);
  bus_.set_pace(emulated::Pace::real_time);
  // Two seconds of frames are dropped, twice the patience.
  const auto source = open({{"settle-frames", "120"}, {"fps", "60"}, {"stall-timeout", "1"}});
  EXPECT_TRUE(source->next());
}

TEST_F(Dc1394Streaming, FramesStayAsTheyAreWhenTheRingGoesOn) {
  bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open({{"buffers", "2"}});
  std::vector<cv::Mat> kept, copies;
  for (int i = 0; i < 30; ++i) {
    kept.push_back(source->next()->image);
    copies.push_back(kept.back().clone());
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(largest_difference(kept[i], copies[i]), 0) << i;
  }
}

TEST_F(Dc1394Streaming, UsesItsImagesAgain) {
  bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open();
  const uchar* first = source->next()->image.data;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(source->next()->image.data, first);
}

TEST_F(Dc1394Streaming, ChoosesTheModeOfTheCalibrationsSize) {
  bus_.add_camera("DR2-HICOL", test::kGuid);
  const CameraModel calibration{800, 600, 700, 700, 400, 300, {}};
  const auto source = open_dc1394_camera("", Dc1394Options::from(settings()), calibration);
  EXPECT_EQ(source->next()->image.size(), cv::Size(800, 600));
  EXPECT_TRUE(has(source->description(), {"800x600-mono8", test::kGuidText}));
  EXPECT_EQ(source->camera()->width_px, 800);
}

TEST_F(Dc1394Streaming, ASoftwareTriggerIsFiredForEveryFrame) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open({{"trigger", "0"}, {"trigger-source", "software"}});
  for (int i = 0; i < 5; ++i) EXPECT_EQ(source->next()->index, i);
  const std::lock_guard lock(bus_.mutex());
  EXPECT_EQ(camera.frame(), 5) << "frames that nobody triggered";
}

TEST_F(Dc1394Streaming, LeavesCameraAndBusAsTheyWere) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  {
    const auto source = open();
    source->next();
    EXPECT_EQ(reg(camera, 0x614), 0x80000000U);
    EXPECT_LT(bus_.bandwidth(), 4915);
  }
  EXPECT_EQ(reg(camera, 0x614), 0U) << "the camera still sends";
  EXPECT_EQ(bus_.bandwidth(), 4915);
  try {
    const auto source = open();
    source->next();
    throw std::runtime_error("of the caller");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(reg(camera, 0x614), 0U) << "the camera still sends after an exception";
}

}  // namespace
}  // namespace anneal6d
