// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/frame.h"
#include "anneal6d/framework/plugin.h"
#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/pose_scorer.h"
#include "anneal6d/framework/settings.h"
#include "anneal6d/framework/symmetry.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

enum class TrackStatus { tracking, lost };
std::string_view to_string(TrackStatus status);

/// Milliseconds of wall time that each stage of one frame took.
struct StageTimings {
  double preprocess_ms = 0;  ///< undistort, detect edges
  double estimate_ms = 0;    ///< search for the pose
  double judge_ms = 0;       ///< quality and status
  double total_ms = 0;
};

struct TrackResult {
  Pose camera_from_object;       ///< the estimate: what a user should take
  Pose best_camera_from_object;  ///< the single best hypothesis (the best particle)
  /// 0..1: how far the image confirms the pose; trackers say what it is the probability of, and it
  /// means the same for every scorer.
  double quality = 0;
  TrackStatus status = TrackStatus::lost;
  StageTimings timings;
};

/// Port: follows one known rigid object. The public functions are fixed and own the course of one
/// frame (validate, preprocess, estimate, judge); a tracker fills in the steps.
class RigidObjectTracker {
 public:
  virtual ~RigidObjectTracker() = default;

  /// Starts (again) at a known pose. Throws ConfigError for a pose that is not finite or that puts
  /// the object's centre behind the camera.
  void reset(const Pose& camera_from_object);

  /// The same, with a frame that shows the object at this pose, from which a tracker may learn what
  /// object and background look like. Throws also as `track` does for the frame.
  void reset(const Pose& camera_from_object, const Frame& frame);

  /// Follows the object into the next frame. Throws ConfigError if the frame's size or type is not
  /// the calibration's, or if `reset` was never called; never for what the image shows.
  TrackResult track(const Frame& frame);

  const CameraModel& camera() const { return camera_; }
  const TriangleMesh& mesh() const { return *mesh_; }

 protected:
  RigidObjectTracker(std::shared_ptr<const TriangleMesh> mesh, const CameraModel& camera);

  struct Judgement {
    double quality = 0;
    TrackStatus status = TrackStatus::lost;
  };

  /// Forget everything and start at the pose.
  virtual void on_reset(const Pose& camera_from_object) = 0;
  /// Where `on_shown`, `preprocess` and what follows will look; asked before them. Only there is
  /// distortion removed, elsewhere the image they get may be anything. Clipped to the image.
  virtual cv::Rect region_of_interest() { return {0, 0, camera_.width_px, camera_.height_px}; }
  /// After `on_reset`: the object at that pose, in an image without distortion.
  virtual void on_shown(const cv::Mat& /*undistorted*/) {}
  /// Prepare the image (of the camera's size, distortion removed, valid until the next frame) for
  /// `estimate`.
  virtual void preprocess(const cv::Mat& undistorted) = 0;
  /// Find the pose; fills both poses of the result.
  virtual void estimate(TrackResult& result) = 0;
  /// Say how good the estimate is.
  virtual Judgement judge(const TrackResult& result) = 0;

 private:
  void check(const Frame& frame) const;
  const cv::Mat& undistorted(const Frame& frame);

  std::shared_ptr<const TriangleMesh> mesh_;
  CameraModel camera_;
  Undistorter undistorter_;
  cv::Mat undistorted_;  ///< the last frame, where it was of interest
  bool started_ = false;
};

/// What a tracker is made from.
struct TrackerSetup {
  std::shared_ptr<const TriangleMesh> mesh;
  CameraModel camera;
  Symmetry symmetry;
  Settings settings;    ///< the tracker's own options; unknown names are the caller's business
  ScorerTable scorers;  ///< the scorers this program has
  /// Told the share done (0..1) of a long preparation of the model, from any thread, one call at a
  /// time; may be empty.
  std::function<void(double)> progress;
};

using TrackerPlugin = Plugin<RigidObjectTracker, TrackerSetup>;
using TrackerTable = PluginTable<RigidObjectTracker, TrackerSetup>;

/// Loads trackers from a shared library that exports
/// `extern "C" void anneal6d_tracker_plugins(anneal6d::TrackerTable&)`; the function appends its
/// rows. The library stays loaded. Throws FileError (cannot be loaded), ConfigError (no such
/// symbol).
TrackerTable load_tracker_plugins(const std::filesystem::path& path);

}  // namespace anneal6d
