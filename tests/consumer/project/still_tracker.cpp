// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/rigid_object_tracker.h"

namespace {

/// The smallest tracker there is: the object never moves.
class StillTracker final : public anneal6d::RigidObjectTracker {
 public:
  explicit StillTracker(const anneal6d::TrackerSetup& setup)
      : RigidObjectTracker(setup.mesh, setup.camera) {}

 private:
  void on_reset(const anneal6d::Pose& camera_from_object) override { pose_ = camera_from_object; }
  void preprocess(const cv::Mat& /*undistorted*/) override {}
  void estimate(anneal6d::TrackResult& result) override {
    result.camera_from_object = pose_;
    result.best_camera_from_object = pose_;
  }
  Judgement judge(const anneal6d::TrackResult& /*result*/) override {
    return {1.0, anneal6d::TrackStatus::tracking};
  }

  anneal6d::Pose pose_;
};

}  // namespace

extern "C" void anneal6d_tracker_plugins(anneal6d::TrackerTable& table) {
  table.push_back(
      {"still", "says that the object never moves", [] { return std::string(); },
       [](const anneal6d::TrackerSetup& setup) { return std::make_unique<StillTracker>(setup); }});
}
