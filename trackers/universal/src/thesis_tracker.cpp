// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "anneal6d/framework/annealing.h"
#include "pose_filter_tracker.h"

namespace anneal6d {
namespace {

constexpr double kFarthest = 4;  // of a particle, in standard deviations

/// Algorithms 1-5 of the thesis with the annealing of 4.1.2.
class ThesisTracker final : public PoseFilterTracker {
 public:
  ThesisTracker(const TrackerSetup& setup, const UniversalTrackerOptions& options)
      : PoseFilterTracker(setup, options, drawing_of(setup, options)) {}

 protected:
  void on_reset(const Pose& camera_from_object) override {
    PoseFilterTracker::on_reset(camera_from_object);
    last_motion_.setZero();
  }

  cv::Rect region_of_interest() override {
    return with_surroundings(window(center_, reached_mm(), kWindow_px));
  }

  void preprocess(const cv::Mat& undistorted) override {
    const cv::Rect around = detect_edges_around(undistorted, center_, reached_mm());
    chance_ = static_cast<double>(cv::countNonZero(frame_edges().binary(around))) /
              static_cast<double>(around.area());
  }

  void estimate(TrackResult& result) override {
    const Pose last = center_;
    double rating = 0;  // Alg. 4, of the last layer's estimate
    for (int layer = 0; layer < options_.layers; ++layer) {
      PoseFilter::Layer step;
      if (layer == 0 && options_.drift) step.drift = last_motion_;  // Alg. 3: meanPose - lastPose
      const double factor =
          annealing_factor(options_.annealing, layer, rating, options_.annealing_ratio);
      step.diffusion = (factor * initial_sigma()).asDiagonal();
      filter_.set_layer(step);
      center_ = filter_.run_layer(key(layer), Resampling::multinomial);
      const double ratio = matched_share(filter_.to_object(center_));
      rating = std::exp(-options_.rating.c * (1.0 - ratio));
    }
    last_motion_ = twist_between(last, center_);
    result.camera_from_object = filter_.to_object(center_);
    result.best_camera_from_object = filter_.to_object(filter_.best());
  }

  Judgement judge(const TrackResult& result) override {
    // Edges that match by chance, because the image is full of them, confirm nothing.
    const double share = matched_share(result.camera_from_object);
    const double quality = std::clamp((share - chance_) / std::max(1e-6, 1.0 - chance_), 0.0, 1.0);
    return end_frame(quality, quality);
  }

 private:
  /// Of a sphere around the object that holds it wherever a layer's noise may take it.
  double reached_mm() const {
    return mesh().radius_mm() + kFarthest * options_.sigma_mm + last_motion_.tail<3>().norm();
  }

  Twist initial_sigma() const {
    Twist sigma;
    sigma << Eigen::Vector3d::Constant(options_.sigma_deg * kDegree),
        Eigen::Vector3d::Constant(options_.sigma_mm);
    return sigma;
  }

  /// Of the edges of the object at a pose, those that are in the frame, 0..1.
  double matched_share(const Pose& camera_from_object) {
    EdgeMatch match;
    scorer_->score({&camera_from_object, 1}, {&match, 1});
    return match_ratio(match);
  }

  Twist last_motion_ = Twist::Zero();
  double chance_ = 0;  ///< share of edge pixels around the object
};

}  // namespace

std::unique_ptr<RigidObjectTracker> make_thesis_tracker(const TrackerSetup& setup,
                                                        const UniversalTrackerOptions& options) {
  return std::make_unique<ThesisTracker>(setup, options);
}

}  // namespace anneal6d
