// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/visualizer/overlay.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "anneal6d/framework/error.h"
#include "anneal6d/visualizer/mesh_renderer.h"
#include "opengl_test.h"
#include "test_meshes.h"

namespace anneal6d {
namespace {

const cv::Vec3b kGreen(0, 255, 0);
const cv::Vec3b kRed(0, 0, 255);
const cv::Vec3b kGrey(90, 90, 90);

/// Draws a white rectangle, columns 271..370 and rows 211..270, moved with x and y, 500 mm away.
class RectangleRenderer final : public ObjectRenderer {
 public:
  void render(const Pose& pose, const Shading&, cv::Mat& color_bgr, cv::Mat& depth_mm) override {
    const cv::Rect box(271 + cvRound(pose.translation_mm.x()),
                       211 + cvRound(pose.translation_mm.y()), 100, 60);
    color_bgr = cv::Mat::zeros(480, 640, CV_8UC3);
    depth_mm = cv::Mat::zeros(480, 640, CV_32FC1);
    color_bgr(box).setTo(cv::Scalar::all(255));
    depth_mm(box).setTo(500);
  }
};

TrackResult result_at(double x_mm, double y_mm, TrackStatus status = TrackStatus::tracking) {
  TrackResult result;
  result.camera_from_object.translation_mm = {x_mm, y_mm, 500};
  result.quality = 0.83;
  result.status = status;
  return result;
}

OverlayPainter make_painter(const CameraModel& camera = test::vga_camera()) {
  return {std::make_unique<RectangleRenderer>(), test::make_rectangle(100, 60), camera};
}

Frame grey_frame(int type = CV_8UC3) {
  Frame frame;
  frame.image = cv::Mat(480, 640, type, cv::Scalar::all(90));
  frame.index = 12;
  return frame;
}

bool has_reddish(const cv::Mat& picture, const cv::Rect& box) {
  cv::Mat found;  // the letters' borders are blended with what lies below
  cv::inRange(picture(box), cv::Scalar(0, 0, 150), cv::Scalar(90, 90, 255), found);
  return cv::countNonZero(found) > 20;
}

TEST(OverlayPainter, DrawsTheOutlineOfThePoseOverTheFrame) {
  OverlayPainter painter = make_painter();
  const cv::Mat picture = painter.paint(grey_frame(), result_at(50, 30)).clone();
  ASSERT_EQ(picture.size(), cv::Size(640, 480));
  EXPECT_EQ(picture.at<cv::Vec3b>(241, 330), kGreen);  // first row of the object
  EXPECT_EQ(picture.at<cv::Vec3b>(239, 330), kGrey);   // and two rows above it
  EXPECT_EQ(picture.at<cv::Vec3b>(260, 420), kGreen);  // last column
  EXPECT_EQ(picture.at<cv::Vec3b>(290, 335), kGrey);   // inside, away from the axes
}

TEST(OverlayPainter, TurnsRedWhenTheObjectIsLost) {
  OverlayPainter painter = make_painter();
  const cv::Rect text(0, 0, 400, 40);
  const cv::Mat tracking = painter.paint(grey_frame(), result_at(0, 0)).clone();
  const cv::Mat lost = painter.paint(grey_frame(), result_at(0, 0, TrackStatus::lost)).clone();
  EXPECT_EQ(tracking.at<cv::Vec3b>(211, 280), kGreen);
  EXPECT_EQ(lost.at<cv::Vec3b>(211, 280), kRed);
  EXPECT_FALSE(has_reddish(tracking, text));
  EXPECT_TRUE(has_reddish(lost, text));
}

TEST(OverlayPainter, TakesGreyFramesAndLeavesTheFrameAlone) {
  OverlayPainter painter = make_painter();
  const Frame frame = grey_frame(CV_8UC1);
  EXPECT_EQ(painter.paint(frame, result_at(0, 0)).at<cv::Vec3b>(400, 500), kGrey);
  const Frame color = grey_frame();
  painter.paint(color, result_at(0, 0));
  EXPECT_EQ(cv::norm(color.image, grey_frame().image, cv::NORM_INF), 0);
}

TEST(OverlayPainter, RemovesTheDistortionOfTheFrame) {
  CameraModel camera = test::vga_camera();
  camera.distortion = {-0.2, 0, 0, 0, 0};
  // The ideal point (520, 340) is (0.4, 0.2) in the normalised image, r^2 = 0.2, factor 0.96.
  Frame frame = grey_frame();
  cv::circle(frame.image, {cvRound(320 + 200 * 0.96), cvRound(240 + 100 * 0.96)}, 3,
             cv::Scalar(255, 0, 0), cv::FILLED);
  OverlayPainter painter = make_painter(camera);
  const cv::Mat& picture = painter.paint(frame, result_at(0, 0));
  EXPECT_GT(picture.at<cv::Vec3b>(340, 520)[0], 240);
  EXPECT_LT(picture.at<cv::Vec3b>(340, 520)[1], 20);
}

TEST(OverlayPainter, RefusesAFrameOfAnotherSizeOrType) {
  OverlayPainter painter = make_painter();
  Frame frame = grey_frame();
  frame.image = frame.image.rowRange(0, 240);
  EXPECT_THROW(painter.paint(frame, result_at(0, 0)), ConfigError);
  EXPECT_THROW(painter.paint(grey_frame(CV_16UC1), result_at(0, 0)), ConfigError);
  EXPECT_THROW(painter.paint(Frame{}, result_at(0, 0)), ConfigError);
}

TEST(OverlayPainter, RefusesToBeMadeFromNothing) {
  EXPECT_THROW(OverlayPainter(nullptr, test::make_torus(), test::vga_camera()), ConfigError);
  EXPECT_THROW(OverlayPainter(std::make_unique<RectangleRenderer>(), nullptr, test::vga_camera()),
               ConfigError);
}

TEST(OverlayTripod, PointsAlongTheAxes) {
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(kGrey));
  Pose pose;
  pose.translation_mm = {0, 0, 500};
  draw_tripod(picture, test::vga_camera(), pose, 100);
  EXPECT_EQ(picture.at<cv::Vec3b>(240, 380), kRed);    // x to the right
  EXPECT_EQ(picture.at<cv::Vec3b>(300, 320), kGreen);  // y down
}

TEST(OverlayTripod, IsLeftOutWhereItCannotBeSeen) {
  for (const double z_mm : {-500.0, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(kGrey));
    Pose pose;
    pose.translation_mm = {1e9, 0, z_mm};
    draw_tripod(picture, test::vga_camera(), pose, 100);
    EXPECT_EQ(cv::norm(picture, cv::Mat(480, 640, CV_8UC3, cv::Scalar(kGrey)), cv::NORM_INF), 0);
  }
}

TEST(EdgePictures, ShowWhatFrameAndRenderingShare) {
  RectangleRenderer renderer;
  EdgeOptions options;
  options.threshold = 40;
  const std::vector<Pose> poses = {result_at(0, 0).camera_from_object,
                                   result_at(200, 0).camera_from_object};
  const EdgeImage first = rendered_edges(renderer, poses[0], {}, options);
  const EdgeImage both = particle_edges(renderer, poses, {}, options);
  EXPECT_GT(cv::countNonZero(first.binary), 0);
  EXPECT_EQ(cv::countNonZero(both.binary), 2 * cv::countNonZero(first.binary));

  const EdgeImage matched = matched_edges(both, first);
  EXPECT_EQ(cv::norm(matched.binary, first.binary, cv::NORM_INF), 0);
  const cv::Mat picture = edge_picture(matched);
  EXPECT_EQ(picture.at<cv::Vec3b>(211, 300), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(240, 320), cv::Vec3b(0, 0, 0));
}

TEST(EdgePictures, MustHaveTheSameSize) {
  const EdgeImage small{cv::Mat::zeros(10, 10, CV_8UC1)};
  const EdgeImage large{cv::Mat::zeros(20, 10, CV_8UC1)};
  EXPECT_THROW(matched_edges(small, large), ConfigError);
  cv::Mat picture = edge_picture(small);
  EXPECT_THROW(draw_edges(picture, large, kRed), ConfigError);
}

using OverlayWithOpenGl = test::OpenGlTest;

TEST_F(OverlayWithOpenGl, FollowsTheRenderedObject) {
  const auto mesh = test::make_rectangle(100, 60);
  OverlayPainter painter(std::make_unique<MeshRenderer>(mesh, test::vga_camera()), mesh,
                         test::vga_camera());
  const cv::Mat& picture = painter.paint(grey_frame(), result_at(0.5, 0.5));
  for (int column = 271; column <= 370; ++column) {
    EXPECT_EQ(picture.at<cv::Vec3b>(211, column), kGreen);
    EXPECT_EQ(picture.at<cv::Vec3b>(209, column), kGrey);
  }
}

}  // namespace
}  // namespace anneal6d
