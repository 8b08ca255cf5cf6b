// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/rigid_object_tracker.h"

#include <chrono>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

class Stopwatch {
 public:
  /// Milliseconds since construction or the last lap.
  double lap_ms() {
    const auto now = Clock::now();
    const double passed_ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return passed_ms;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

std::string_view to_string(TrackStatus status) {
  return status == TrackStatus::tracking ? "tracking" : "lost";
}

RigidObjectTracker::RigidObjectTracker(std::shared_ptr<const TriangleMesh> mesh,
                                       const CameraModel& camera)
    : mesh_(std::move(mesh)), camera_((camera.validate(), camera)), undistorter_(camera) {
  if (!mesh_) throw ConfigError("a tracker needs a mesh");
}

void RigidObjectTracker::reset(const Pose& camera_from_object) {
  if (!camera_from_object.is_finite()) throw ConfigError("the initial pose is not finite");
  const double depth_mm = (camera_from_object * mesh_->center_mm().cast<double>()).z();
  if (depth_mm <= kNearPlane_mm) {
    throw ConfigError(
        "the initial pose puts the object's centre at z = " + std::to_string(depth_mm) +
        " mm, behind the camera; z must be positive (x right, y down, z forward)");
  }
  on_reset({camera_from_object.rotation.normalized(), camera_from_object.translation_mm});
  started_ = true;
}

void RigidObjectTracker::reset(const Pose& camera_from_object, const Frame& frame) {
  check(frame);
  reset(camera_from_object);
  on_shown(undistorted(frame));
}

void RigidObjectTracker::check(const Frame& frame) const {
  const cv::Mat& image = frame.image;
  if (image.type() != CV_8UC1 && image.type() != CV_8UC3) {
    throw ConfigError("frame " + std::to_string(frame.index) +
                      " is not an 8-bit image with 1 (grey) or 3 (BGR) channels");
  }
  if (image.cols != camera_.width_px || image.rows != camera_.height_px) {
    throw ConfigError("frame " + std::to_string(frame.index) + " is " + std::to_string(image.cols) +
                      "x" + std::to_string(image.rows) + ", the calibration is for " +
                      std::to_string(camera_.width_px) + "x" + std::to_string(camera_.height_px) +
                      "; calibrate at the size of the images");
  }
}

const cv::Mat& RigidObjectTracker::undistorted(const Frame& frame) {
  const cv::Rect whole(0, 0, camera_.width_px, camera_.height_px);
  undistorter_.undistort(frame.image, region_of_interest() & whole, undistorted_);
  return undistorted_;
}

TrackResult RigidObjectTracker::track(const Frame& frame) {
  if (!started_) throw ConfigError("track() needs an initial pose: call reset() first");
  check(frame);
  TrackResult result;
  Stopwatch watch;
  preprocess(undistorted(frame));
  result.timings.preprocess_ms = watch.lap_ms();
  estimate(result);
  result.timings.estimate_ms = watch.lap_ms();
  const Judgement judgement = judge(result);
  result.quality = judgement.quality;
  result.status = judgement.status;
  result.timings.judge_ms = watch.lap_ms();
  result.timings.total_ms =
      result.timings.preprocess_ms + result.timings.estimate_ms + result.timings.judge_ms;
  return result;
}

}  // namespace anneal6d
