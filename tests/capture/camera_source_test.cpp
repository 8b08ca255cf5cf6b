// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/camera_source.h"

#include <gtest/gtest.h>

#include <fstream>

#include "capture_test_support.h"

namespace anneal6d {
namespace {

using test::contains;
using test::message_of;

// A camera of 64x48 pixels that stops after some pictures.
class StallingDevice : public cv::VideoCapture {
 public:
  explicit StallingDevice(int pictures) : left_(pictures) {}
  bool grab() override { return left_-- > 0; }
  bool retrieve(cv::OutputArray image, int) override {
    cv::Mat(48, 64, CV_8UC3, cv::Scalar(1, 2, 3)).copyTo(image);
    return true;
  }
  bool set(int, double) override { return false; }
  double get(int property) const override { return property == cv::CAP_PROP_FRAME_WIDTH ? 64 : 48; }

 private:
  int left_;
};

TEST(CameraSource, SaysThatAMissingCameraIsMissingAndWhatThereIs) {
  constexpr int no_such_camera = 9998;
  const std::string message =
      message_of<BackendUnavailable>([] { CameraSource source(no_such_camera); });
  EXPECT_TRUE(contains(message, "camera 9998")) << message;
  EXPECT_TRUE(contains(message, list_cameras().empty() ? "no /dev/video*" : "there are: "))
      << message;
}

TEST(CameraSource, ReportsAStallAsAFailureAndNotAsTheEnd) {
  CameraSource source(std::make_unique<StallingDevice>(3), "camera 7");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(source.next()->index, i);
  const std::string message = message_of<CaptureError>([&] { source.next(); });
  EXPECT_TRUE(contains(message, "camera 7") && contains(message, "3 frames")) << message;
}

TEST(CameraSource, SkipsFramesAndReportsAStallWhileItSkips) {
  CameraSource source(std::make_unique<StallingDevice>(4), "camera 7");
  EXPECT_EQ(source.skip(2), 2);
  EXPECT_EQ(source.next()->index, 2);
  EXPECT_THROW(source.skip(2), CaptureError);
}

TEST(CameraSource, RefusesACalibrationOfASizeThatTheCameraHasNot) {
  const std::string message = message_of<ConfigError>([] {
    CameraSource source(std::make_unique<StallingDevice>(1), "camera 7",
                        CameraModel{640, 480, 600, 600, 320, 240, {}});
  });
  EXPECT_TRUE(contains(message, "640x480") && contains(message, "64x48")) << message;
}

TEST(ListCameras, ListsVideoDevicesByNumberAndNothingElse) {
  test::TemporaryFolder folder;
  for (const char* name : {"video10", "video2", "videoX", "null", "video", "video-1"}) {
    std::ofstream(folder / name) << "x";
  }
  const std::vector<CameraDevice> cameras = list_cameras(folder.path());
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].number, 2);
  EXPECT_EQ(cameras[1].number, 10);
  EXPECT_EQ(cameras[1].path, folder / "video10");
  EXPECT_TRUE(cameras[0].accessible);
}

TEST(ListCameras, IsEmptyWhereThereIsNoDeviceFolder) {
  EXPECT_TRUE(list_cameras("/no/such/folder").empty());
}

}  // namespace
}  // namespace anneal6d
