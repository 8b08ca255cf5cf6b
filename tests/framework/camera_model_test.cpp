// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

CameraModel camera() {
  return {
      .width_px = 320, .height_px = 240, .fx_px = 300, .fy_px = 310, .cx_px = 155, .cy_px = 125};
}

CameraModel distorted() {
  CameraModel model = camera();
  model.distortion = {-0.25, 0.08, 0.002, -0.001, -0.01};
  return model;
}

TEST(Projection, IsThePinholeCameras) {
  const Eigen::Vector2d p = camera().project({10, -20, 500});
  EXPECT_DOUBLE_EQ(p.x(), 300 * 10 / 500.0 + 155);
  EXPECT_DOUBLE_EQ(p.y(), 310 * -20 / 500.0 + 125);
}

TEST(Projection, IsOpenCVsWithoutDistortion) {
  std::vector<cv::Point2d> expected;
  cv::projectPoints(std::vector<cv::Point3d>{{30, 40, 700}}, cv::Vec3d(), cv::Vec3d(),
                    camera().matrix(), cv::noArray(), expected);
  const Eigen::Vector2d p = camera().project({30, 40, 700});
  EXPECT_NEAR(p.x(), expected[0].x, 1e-12);
  EXPECT_NEAR(p.y(), expected[0].y, 1e-12);
}

// The corner of the image lies at -0.5, so a pixel position p becomes (p + 0.5) f - 0.5.
TEST(ScaledCamera, SeesTheSamePointAtTheScaledPlace) {
  for (const double factor : {0.5, 2.0, 0.25}) {
    const CameraModel scaled = camera().scaled(factor);
    EXPECT_EQ(scaled.width_px, static_cast<int>(320 * factor));
    EXPECT_EQ(scaled.height_px, static_cast<int>(240 * factor));
    const Eigen::Vector3d point(35, -60, 400);
    const Eigen::Vector2d expected = (camera().project(point).array() + 0.5) * factor - 0.5;
    EXPECT_LT((scaled.project(point) - expected).norm(), 1e-12) << factor;
  }
}

TEST(ScaledCamera, FitsAnImageShrunkByAveraging) {
  // A pixel of the half image is the mean of 2x2 pixels, whose middle lies between them.
  cv::Mat image = cv::Mat::zeros(240, 320, CV_8UC1), half;
  image(cv::Rect(100, 60, 2, 2)).setTo(255);  // centred at (100.5, 60.5)
  cv::resize(image, half, {}, 0.5, 0.5, cv::INTER_AREA);
  ASSERT_EQ(half.at<std::uint8_t>(30, 50), 255);
  const double z_mm = 300;
  const Eigen::Vector3d point((100.5 - 155) / 300 * z_mm, (60.5 - 125) / 310 * z_mm, z_mm);
  EXPECT_LT((camera().scaled(0.5).project(point) - Eigen::Vector2d(50, 30)).norm(), 1e-12);
}

TEST(ScaledCamera, KeepsTheDistortion) {
  EXPECT_EQ(distorted().scaled(0.5).distortion, distorted().distortion);
}

TEST(UndistorterOf, ACameraWithoutDistortionPassesFramesThrough) {
  const cv::Mat image(240, 320, CV_8UC3, cv::Scalar(1, 2, 3));
  EXPECT_FALSE(camera().has_distortion());
  EXPECT_EQ(Undistorter(camera())(image).data, image.data);
}

TEST(UndistorterOf, ADistortedCameraMovesPointsWhereOpenCVSays) {
  EXPECT_TRUE(distorted().has_distortion());
  const Undistorter undistort(distorted());
  for (const cv::Point2d& seen :
       {cv::Point2d(60, 50), cv::Point2d(250, 60), cv::Point2d(80, 190), cv::Point2d(155, 125)}) {
    // A smooth blob, whose place can be told to a fraction of a pixel.
    cv::Mat image(240, 320, CV_8UC1);
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        const double squared = std::pow(x - seen.x, 2) + std::pow(y - seen.y, 2);
        image.at<std::uint8_t>(y, x) =
            cv::saturate_cast<std::uint8_t>(250 * std::exp(-squared / 18));
      }
    }
    const cv::Moments moments = cv::moments(undistort(image));
    std::vector<cv::Point2d> expected;
    cv::undistortPoints(std::vector{seen}, expected, distorted().matrix(), distorted().distortion,
                        cv::noArray(), distorted().matrix());
    EXPECT_NEAR(moments.m10 / moments.m00, expected[0].x, 0.1) << seen;
    EXPECT_NEAR(moments.m01 / moments.m00, expected[0].y, 0.1) << seen;
  }
}

TEST(UndistorterOf, ADistortedCameraKeepsSizeAndType) {
  const cv::Mat image(240, 320, CV_8UC3, cv::Scalar(10, 20, 30));
  const cv::Mat undistorted = Undistorter(distorted())(image);
  EXPECT_EQ(undistorted.size(), image.size());
  EXPECT_EQ(undistorted.type(), image.type());
  // Places that the camera did not see are filled with the border, not with black edges.
  EXPECT_EQ(undistorted.at<cv::Vec3b>(0, 0), cv::Vec3b(10, 20, 30));
}

void expect_bad(CameraModel model, const std::string& words) {
  try {
    model.validate();
    ADD_FAILURE() << "was accepted; expected: " << words;
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(CameraCheck, AcceptsACamera) {
  EXPECT_NO_THROW(camera().validate());
  EXPECT_NO_THROW(distorted().validate());
}

TEST(CameraCheck, RefusesAbsurdSizes) {
  const auto with = [](int width_px, int height_px) {
    CameraModel model = camera();
    model.width_px = width_px;
    model.height_px = height_px;
    model.cx_px = model.cy_px = 5;
    return model;
  };
  EXPECT_NO_THROW(with(16, 16384).validate());
  expect_bad(with(15, 240), "15x240");
  expect_bad(with(320, 16385), "320x16385");
  expect_bad(with(0, 0), "0x0");
  expect_bad(with(-320, 240), "-320x240");
}

TEST(CameraCheck, RefusesAbsurdFocalLengths) {
  for (const double bad : {0.0, -300.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (double CameraModel::*focal_px : {&CameraModel::fx_px, &CameraModel::fy_px}) {
      CameraModel model = camera();
      model.*focal_px = bad;
      expect_bad(model, "focal length");
    }
  }
}

TEST(CameraCheck, RefusesAPrincipalPointFartherOutsideThanTheImageIsLarge) {
  const auto with = [](double cx_px, double cy_px) {
    CameraModel model = camera();
    model.cx_px = cx_px;
    model.cy_px = cy_px;
    return model;
  };
  EXPECT_NO_THROW(with(-320, 480).validate());
  expect_bad(with(-321, 125), "principal point");
  expect_bad(with(155, 481), "principal point");
  expect_bad(with(std::nan(""), 125), "principal point");
}

TEST(CameraCheck, RefusesDistortionThatIsNotFinite) {
  CameraModel model = camera();
  model.distortion[3] = std::nan("");
  expect_bad(model, "distortion");
}

}  // namespace
}  // namespace anneal6d
