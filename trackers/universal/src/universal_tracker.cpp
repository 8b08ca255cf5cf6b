// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/trackers/universal_tracker.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/particle_filter.h"
#include "motion_model.h"
#include "pose_filter.h"
#include "raster_model.h"
#include "refiner.h"

namespace anneal6d {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSurvivalRate = 0.25;  // of particles, from layer to layer
constexpr double kNarrowing = 0.6;      // of the particles' spread, from layer to layer
constexpr double kExpectation = 0.1;    // weight of the motion model beside the edges
constexpr double kLeastSpread_px = 0.15;
constexpr double kReach_px = 8.0;  // of the refinement, around the filter's estimate
constexpr double kLostQuality = 0.25;
constexpr int kFramesUntilLost = 2;

std::unique_ptr<PoseScorer> make_scorer(const TrackerSetup& setup,
                                        const UniversalTrackerOptions& options) {
  ScorerSetup scorer;
  scorer.mesh = setup.mesh;
  scorer.camera = setup.camera;
  scorer.edges = options.model_edges;
  scorer.textured = options.textured;
  scorer.threads = options.threads;
  return make_plugin(setup.scorers, "scorer", options.scorer, scorer);
}

class UniversalTracker final : public RigidObjectTracker {
 public:
  UniversalTracker(const TrackerSetup& setup, const UniversalTrackerOptions& options)
      : RigidObjectTracker(setup.mesh, setup.camera),
        options_(options),
        symmetry_(setup.symmetry),
        scorer_(make_scorer(setup, options)),
        filter_(*scorer_, options.rating, setup.mesh->center_mm().cast<double>()),
        motion_(options.sigma_mm, options.sigma_deg * kDegree),
        raster_model_(setup.mesh, options.textured),
        refiner_(raster_model_, setup.camera) {}

 protected:
  void on_reset(const Pose& camera_from_object) override {
    center_ = filter_.to_center(camera_from_object);
    filter_.initialize(center_, static_cast<std::size_t>(options_.particles));  // Alg. 1
    motion_.reset();
    last_motion_.setZero();
    frame_number_ = 0;
    bad_frames_ = 0;
  }

  void preprocess(const cv::Mat& undistorted) override {
    const cv::Rect around = surroundings();
    EdgeOptions options = options_.frame_edges;
    if (!options.threshold) {
      const EdgeThresholds thresholds = resolve_thresholds(undistorted(around), options);
      options.threshold = thresholds.high;
      options.low_threshold =
          options.op == EdgeOperator::canny ? std::optional(thresholds.low) : std::nullopt;
    }
    edges_ = detect_edges(undistorted, options);
    scorer_->set_edges(edges_);
    chance_ = static_cast<double>(cv::countNonZero(edges_.binary(around))) /
              static_cast<double>(around.area());
    image_ = undistorted;
  }

  void estimate(TrackResult& result) override {
    if (options_.mode == UniversalMode::thesis) {
      estimate_as_in_thesis(result);
    } else {
      estimate_by_default(result);
    }
    ++frame_number_;
  }

  Judgement judge(const TrackResult& result) override {
    // Edges that match by chance, because the image is full of them, confirm nothing.
    const double ratio = match_ratio(match_of(result.camera_from_object));
    Judgement judgement;
    judgement.quality = std::clamp((ratio - chance_) / std::max(1e-6, 1.0 - chance_), 0.0, 1.0);
    bad_frames_ = judgement.quality < kLostQuality ? bad_frames_ + 1 : 0;
    judgement.status = bad_frames_ >= kFramesUntilLost ? TrackStatus::lost : TrackStatus::tracking;
    return judgement;
  }

 private:
  /// Algorithms 1-5 with the annealing of 4.1.2.
  void estimate_as_in_thesis(TrackResult& result) {
    const Pose last = center_;
    double score = 0;
    for (int layer = 0; layer < options_.layers; ++layer) {
      PoseFilter::Layer step;
      if (layer == 0) step.drift = last_motion_;  // Alg. 3: meanPose - lastPose
      const double factor = annealing_factor(AnnealingRule::thesis, layer, score, 1.0);
      step.diffusion = (factor * initial_sigma()).asDiagonal();
      filter_.set_layer(step);
      center_ = filter_.run_layer(key(layer), Resampling::multinomial);
      score = match_ratio(match_of(filter_.to_object(center_)));
    }
    last_motion_ = twist_between(last, center_);
    result.camera_from_object = filter_.to_object(center_);
    result.best_camera_from_object = filter_.to_object(filter_.best());
  }

  /// The same loop; noise follows the motion first and then the particles' own spread, and the
  /// filter's basin is searched for its bottom by Gauss-Newton.
  void estimate_by_default(TrackResult& result) {
    const Pose last = center_;
    const Twist drift = motion_.drift();
    const Twist sigma = motion_.sigma();
    Eigen::Matrix<double, 6, 6> diffusion = sigma.asDiagonal();
    const Pose expected = moved(last, drift);
    Pose incumbent = expected;
    filter_.initialize(expected, static_cast<std::size_t>(options_.particles));
    for (int layer = 0; layer < options_.layers; ++layer) {
      PoseFilter::Layer step;
      step.diffusion = diffusion;
      step.incumbent = incumbent;
      step.expected = expected;
      step.expected_sigma = sigma;
      step.expectation = kExpectation;
      step.survival_rate = kSurvivalRate;
      filter_.set_layer(step);
      center_ = filter_.run_layer(key(layer), Resampling::systematic);
      incumbent = filter_.best();
      diffusion = narrowed_spread();
    }
    result.best_camera_from_object = filter_.to_object(filter_.best());

    refiner_.set_image(image_, filter_.to_object(center_));
    const Pose mean = filter_.to_object(center_);
    const Pose refined = refiner_.refine(mean, kReach_px, sigma).camera_from_object;
    const bool better = match_of(refined).matched * 1.05 >= match_of(mean).matched;
    center_ = filter_.to_center(better ? refined : mean);
    center_.rotation = symmetry_.fold(center_.rotation, last.rotation);
    result.camera_from_object = filter_.to_object(center_);
    motion_.observe(last, center_);
  }

  /// Factor of a share of the particles' covariance, no narrower than a fraction of a pixel.
  Eigen::Matrix<double, 6, 6> narrowed_spread() const {
    const double mm_per_px = center_.translation_mm.z() / camera().fx_px;
    const double least_mm = kLeastSpread_px * std::abs(mm_per_px);
    const double least_rad = least_mm / mesh().radius_mm();
    Eigen::Matrix<double, 6, 6> covariance = kNarrowing * kNarrowing * filter_.covariance(center_);
    for (int i = 0; i < 3; ++i) {
      covariance(i, i) += least_rad * least_rad;
      covariance(i + 3, i + 3) += least_mm * least_mm;
    }
    return covariance.llt().matrixL();
  }

  Twist initial_sigma() const {
    Twist sigma;
    sigma << Eigen::Vector3d::Constant(options_.sigma_deg * kDegree),
        Eigen::Vector3d::Constant(options_.sigma_mm);
    return sigma;
  }

  /// The part of the image where the object may be: its bounding sphere at the last pose, half as
  /// large again; the whole image if that is none of it.
  cv::Rect surroundings() const {
    const cv::Rect whole(0, 0, camera().width_px, camera().height_px);
    const double z_mm = center_.translation_mm.z();
    const double radius_mm = 1.5 * mesh().radius_mm();
    if (!(z_mm > 1.5 * radius_mm)) return whole;
    const Eigen::Vector2d middle = camera().project(center_.translation_mm);
    const double radius_px = radius_mm * camera().fx_px / z_mm;
    if (!(middle.norm() < 1e6)) return whole;
    const cv::Rect around =
        cv::Rect(static_cast<int>(middle.x() - radius_px), static_cast<int>(middle.y() - radius_px),
                 static_cast<int>(2 * radius_px), static_cast<int>(2 * radius_px)) &
        whole;
    return around.area() >= 256 ? around : whole;
  }

  EdgeMatch match_of(const Pose& camera_from_object) {
    EdgeMatch match;
    scorer_->score({&camera_from_object, 1}, {&match, 1});
    return match;
  }

  RandomKey key(int layer) const {
    return {options_.seed, frame_number_, static_cast<std::uint32_t>(layer), 0};
  }

  UniversalTrackerOptions options_;
  Symmetry symmetry_;
  std::unique_ptr<PoseScorer> scorer_;
  PoseFilter filter_;
  MotionModel motion_;
  RasterModel raster_model_;
  Refiner refiner_;

  Pose center_;  ///< camera_from_center of the last frame
  Twist last_motion_ = Twist::Zero();
  std::uint32_t frame_number_ = 0;
  int bad_frames_ = 0;
  EdgeImage edges_;
  cv::Mat image_;
  double chance_ = 0;  ///< share of edge pixels around the object
};

}  // namespace

std::unique_ptr<RigidObjectTracker> make_universal_tracker(const TrackerSetup& setup) {
  if (!setup.mesh) throw ConfigError("a tracker needs a mesh");
  return std::make_unique<UniversalTracker>(setup, UniversalTrackerOptions::from(setup.settings));
}

}  // namespace anneal6d
