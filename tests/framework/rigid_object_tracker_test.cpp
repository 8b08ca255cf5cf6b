// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/rigid_object_tracker.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <string>

#include "anneal6d/framework/error.h"
#include "special_numbers.h"

namespace anneal6d {
namespace {

using test::kNaN;

CameraModel small_camera() {
  return {.width_px = 64, .height_px = 48, .fx_px = 60, .fy_px = 60, .cx_px = 32, .cy_px = 24};
}

/// A triangle whose box has its centre at (50, 0, 0).
std::shared_ptr<const TriangleMesh> off_centre_mesh() {
  std::vector<MeshVertex> vertices(3);
  vertices[0].position_mm = {40, -10, 0};
  vertices[1].position_mm = {60, -10, 0};
  vertices[2].position_mm = {60, 10, 0};
  return std::make_shared<const TriangleMesh>(vertices, std::vector<Triangle>{{0, 1, 2}});
}

Pose at_depth(double z_mm) { return {Eigen::Quaterniond::Identity(), {0, 0, z_mm}}; }

/// Writes down what it is asked for.
class FakeTracker final : public RigidObjectTracker {
 public:
  explicit FakeTracker(const CameraModel& model = small_camera(),
                       std::shared_ptr<const TriangleMesh> object = off_centre_mesh())
      : RigidObjectTracker(std::move(object), model) {}

  std::string hooks;
  Pose start;
  cv::Mat image, shown;
  cv::Rect region{0, 0, 1000, 1000};
  Judgement judgement{0.75, TrackStatus::tracking};

 protected:
  void on_reset(const Pose& camera_from_object) override {
    hooks += "reset ";
    start = camera_from_object;
  }
  cv::Rect region_of_interest() override { return region; }
  void on_shown(const cv::Mat& undistorted) override {
    hooks += "shown ";
    shown = undistorted;
  }
  void preprocess(const cv::Mat& undistorted) override {
    hooks += "preprocess ";
    image = undistorted;
  }
  void estimate(TrackResult& result) override {
    hooks += "estimate ";
    result.camera_from_object = at_depth(500);
    result.best_camera_from_object = at_depth(501);
  }
  Judgement judge(const TrackResult& result) override {
    hooks += "judge(" +
             std::to_string(static_cast<int>(result.camera_from_object.translation_mm.z())) + ") ";
    return judgement;
  }
};

Frame frame_of(const cv::Mat& image) {
  Frame frame;
  frame.image = image;
  frame.index = 12;
  return frame;
}

Frame grey_frame() { return frame_of(cv::Mat(48, 64, CV_8UC1, cv::Scalar(7))); }

template <class Action>
void expect_refused(const Action& action, const std::string& words) {
  try {
    action();
    ADD_FAILURE() << "was accepted; expected: " << words;
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(RigidObjectTracking, TakesEachFrameThroughItsStepsInOrder) {
  FakeTracker tracker;
  tracker.reset(at_depth(600));
  const TrackResult result = tracker.track(grey_frame());
  EXPECT_EQ(tracker.hooks, "reset preprocess estimate judge(500) ");
  EXPECT_EQ(result.camera_from_object.translation_mm.z(), 500);
  EXPECT_EQ(result.best_camera_from_object.translation_mm.z(), 501);
  EXPECT_EQ(result.quality, 0.75);
  EXPECT_EQ(result.status, TrackStatus::tracking);
}

TEST(RigidObjectTracking, SumsTheTimesOfItsSteps) {
  FakeTracker tracker;
  tracker.reset(at_depth(600));
  const StageTimings timings = tracker.track(grey_frame()).timings;
  EXPECT_GE(timings.preprocess_ms, 0);
  EXPECT_GE(timings.estimate_ms, 0);
  EXPECT_GE(timings.judge_ms, 0);
  EXPECT_GT(timings.total_ms, 0);
  EXPECT_DOUBLE_EQ(timings.total_ms,
                   timings.preprocess_ms + timings.estimate_ms + timings.judge_ms);
}

TEST(RigidObjectTracking, PassesOnThatTheObjectIsLost) {
  FakeTracker tracker;
  tracker.judgement = {0.1, TrackStatus::lost};
  tracker.reset(at_depth(600));
  EXPECT_EQ(tracker.track(grey_frame()).status, TrackStatus::lost);
}

TEST(RigidObjectTracking, TakesGreyAndColourFrames) {
  FakeTracker tracker;
  tracker.reset(at_depth(600));
  tracker.track(frame_of(cv::Mat(48, 64, CV_8UC3, cv::Scalar(1, 2, 3))));
  EXPECT_EQ(tracker.image.type(), CV_8UC3);
}

TEST(RigidObjectTracking, RemovesTheDistortionBeforePreprocessing) {
  CameraModel distorted = small_camera();
  distorted.distortion[0] = -0.5;
  FakeTracker tracker(distorted);
  tracker.reset(at_depth(600));
  cv::Mat image(48, 64, CV_8UC1, cv::Scalar(0));
  image.colRange(0, 10).setTo(255);
  tracker.track(frame_of(image));
  ASSERT_EQ(tracker.image.size(), image.size());
  EXPECT_GT(cv::countNonZero(tracker.image != image), 0);
  EXPECT_EQ(cv::countNonZero(tracker.image != Undistorter(distorted)(image)), 0);
}

TEST(RigidObjectTracking, RemovesTheDistortionOnlyWhereTheTrackerLooks) {
  CameraModel distorted = small_camera();
  distorted.distortion[0] = -0.5;
  FakeTracker tracker(distorted);
  tracker.reset(at_depth(600));
  cv::Mat first(48, 64, CV_8UC1), second(48, 64, CV_8UC1);
  cv::randu(first, 0, 256);
  cv::randu(second, 0, 256);
  tracker.track(frame_of(first));
  tracker.region = {40, 20, 100, 10};  // beyond the image, too
  tracker.track(frame_of(second));
  const cv::Rect inside(40, 20, 24, 10);
  const Undistorter undistort(distorted);
  cv::Mat expected = undistort(first);
  undistort(second)(inside).copyTo(expected(inside));
  EXPECT_EQ(cv::countNonZero(tracker.image != expected), 0);
  tracker.region = {};
  tracker.track(frame_of(first));
  EXPECT_EQ(cv::countNonZero(tracker.image != expected), 0) << "nothing is of interest";
}

TEST(RigidObjectTracking, ShowsTheFrameOfTheStartWithoutDistortionAfterResetting) {
  CameraModel distorted = small_camera();
  distorted.distortion[0] = -0.5;
  FakeTracker tracker(distorted);
  cv::Mat image(48, 64, CV_8UC1, cv::Scalar(0));
  image.colRange(0, 10).setTo(255);
  tracker.reset(at_depth(600), frame_of(image));
  EXPECT_EQ(tracker.hooks, "reset shown ");
  EXPECT_EQ(tracker.start.translation_mm.z(), 600);
  ASSERT_EQ(tracker.shown.size(), image.size());
  EXPECT_GT(cv::countNonZero(tracker.shown != image), 0);
  EXPECT_EQ(cv::countNonZero(tracker.shown != Undistorter(distorted)(image)), 0);
  tracker.track(grey_frame());
  EXPECT_EQ(tracker.hooks, "reset shown preprocess estimate judge(500) ");
}

TEST(RigidObjectTracking, RefusesAStartWithAFrameThatDoesNotFitBeforeResettingAnything) {
  FakeTracker tracker;
  expect_refused([&] { tracker.reset(at_depth(600), frame_of(cv::Mat(64, 48, CV_8UC1))); },
                 "frame 12 is 48x64, the calibration is for 64x48");
  expect_refused([&] { tracker.reset(at_depth(600), frame_of(cv::Mat(48, 64, CV_16UC1))); },
                 "frame 12 is not an 8-bit image");
  EXPECT_EQ(tracker.hooks, "");
  expect_refused([&] { tracker.track(grey_frame()); }, "call reset() first");
}

TEST(RigidObjectTracking, ShowsNothingIfTheStartIsRefused) {
  FakeTracker tracker;
  expect_refused([&] { tracker.reset(at_depth(-600), grey_frame()); }, "behind the camera");
  EXPECT_EQ(tracker.hooks, "");
}

TEST(RigidObjectTracking, GivesAnUndistortedCamerasFramesAsTheyAre) {
  FakeTracker tracker;
  tracker.reset(at_depth(600));
  const Frame frame = grey_frame();
  tracker.track(frame);
  EXPECT_EQ(tracker.image.data, frame.image.data);
}

TEST(RigidObjectTracking, NeedsAStart) {
  FakeTracker tracker;
  expect_refused([&] { tracker.track(grey_frame()); }, "call reset() first");
  EXPECT_EQ(tracker.hooks, "");
}

TEST(RigidObjectTracking, RefusesFramesOfAnotherSize) {
  FakeTracker tracker;
  tracker.reset(at_depth(600));
  expect_refused([&] { tracker.track(frame_of(cv::Mat(64, 48, CV_8UC1, cv::Scalar(0)))); },
                 "frame 12 is 48x64, the calibration is for 64x48");
  EXPECT_EQ(tracker.hooks, "reset ");
}

TEST(RigidObjectTracking, RefusesFramesOfAnotherType) {
  FakeTracker tracker;
  tracker.reset(at_depth(600));
  for (const int type : {CV_16UC1, CV_32FC1, CV_8UC4}) {
    expect_refused([&] { tracker.track(frame_of(cv::Mat(48, 64, type, cv::Scalar(0)))); },
                   "frame 12 is not an 8-bit image");
  }
  EXPECT_THROW(tracker.track(Frame{}), ConfigError);
}

TEST(RigidObjectTracking, GoesOnAfterARefusedFrame) {
  FakeTracker tracker;
  tracker.reset(at_depth(600));
  EXPECT_THROW(tracker.track(Frame{}), ConfigError);
  EXPECT_EQ(tracker.track(grey_frame()).status, TrackStatus::tracking);
}

TEST(RigidObjectTracking, StartsWithAUnitQuaternion) {
  FakeTracker tracker;
  Pose pose = at_depth(600);
  pose.rotation.coeffs() *= 1.0005;
  tracker.reset(pose);
  EXPECT_NEAR(tracker.start.rotation.norm(), 1.0, 1e-15);
}

TEST(RigidObjectTracking, RefusesAStartThatIsNotFinite) {
  FakeTracker tracker;
  expect_refused([&] { tracker.reset(at_depth(kNaN)); }, "not finite");
  Pose turned = at_depth(600);
  turned.rotation.w() = kNaN;
  expect_refused([&] { tracker.reset(turned); }, "not finite");
  EXPECT_EQ(tracker.hooks, "");
}

TEST(RigidObjectTracking, RefusesAStartBehindTheCamera) {
  FakeTracker tracker;
  expect_refused([&] { tracker.reset(at_depth(-600)); }, "z must be positive");
  expect_refused([&] { tracker.reset(at_depth(0)); }, "behind the camera");
}

TEST(RigidObjectTracking, JudgesAStartByTheObjectsCentreNotItsOrigin) {
  FakeTracker tracker;
  // The centre lies at +50 mm along the object's x; turned by a quarter that is away from, or
  // towards the camera.
  const auto away = rotation_from_axis_angle(Eigen::Vector3d::UnitY(), -EIGEN_PI / 2);
  EXPECT_NO_THROW(tracker.reset({away, {0, 0, -20}}));
  EXPECT_THROW(tracker.reset({away.conjugate(), {0, 0, 40}}), ConfigError);
}

TEST(RigidObjectTracking, NeedsAMeshAndASensibleCamera) {
  EXPECT_THROW(FakeTracker(small_camera(), nullptr), ConfigError);
  EXPECT_THROW(FakeTracker(CameraModel{}), ConfigError);
}

TEST(TrackStatusText, IsThatOfTheCsvFiles) {
  EXPECT_EQ(to_string(TrackStatus::tracking), "tracking");
  EXPECT_EQ(to_string(TrackStatus::lost), "lost");
}

}  // namespace
}  // namespace anneal6d
