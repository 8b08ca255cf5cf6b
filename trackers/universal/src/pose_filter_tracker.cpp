// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "pose_filter_tracker.h"

#include "anneal6d/framework/plugin.h"
#include "drawn_mesh.h"

namespace anneal6d {
namespace {

constexpr double kLostQuality = 0.25;
constexpr int kFramesUntilLost = 2;

}  // namespace

PoseFilterTracker::PoseFilterTracker(const TrackerSetup& setup,
                                     const UniversalTrackerOptions& options,
                                     const ScorerSetup& drawing)
    : RigidObjectTracker(setup.mesh, setup.camera),
      options_(options),
      scorer_(make_plugin(setup.scorers, "scorer", options.scorer, drawing)),
      workers_(options.threads),
      filter_(*scorer_, options.rating, setup.mesh->center_mm().cast<double>(), workers_) {}

ScorerSetup PoseFilterTracker::drawing_of(const TrackerSetup& setup,
                                          const UniversalTrackerOptions& options) {
  ScorerSetup scorer;
  scorer.mesh = mesh_to_draw(setup.mesh);
  scorer.camera = setup.camera;
  scorer.edges = options.model_edges;
  scorer.textured = options.textured;
  scorer.threads = options.threads;
  scorer.view_cache = options.view_cache;
  scorer.progress = setup.progress;
  return scorer;
}

void PoseFilterTracker::on_reset(const Pose& camera_from_object) {
  center_ = filter_.to_center(camera_from_object);
  filter_.initialize(center_, static_cast<std::size_t>(options_.particles));  // Alg. 1
  frame_number_ = 0;
  bad_frames_ = 0;
}

cv::Rect PoseFilterTracker::detect_edges_around(const cv::Mat& image,
                                                const Pose& camera_from_center, double radius_mm) {
  const cv::Rect around = window(camera_from_center, radius_mm, kWindow_px);
  edge_detector_.detect(image(around), options_.frame_edges, edges_around_);
  edges_.binary.create(image.size(), CV_8UC1);
  edges_.binary.setTo(0);
  edges_around_.binary.copyTo(edges_.binary(around));
  scorer_->set_edges(edges_);
  return around;
}

cv::Rect PoseFilterTracker::window(const Pose& camera_from_center, double radius_mm,
                                   double margin_px) const {
  const cv::Rect whole(0, 0, camera().width_px, camera().height_px);
  const double z_mm = camera_from_center.translation_mm.z();
  if (!(z_mm > 1.2 * radius_mm)) return whole;
  const Eigen::Vector2d middle = camera().project(camera_from_center.translation_mm);
  const Eigen::Vector2d focal_px(camera().fx_px, camera().fy_px);
  const Eigen::Vector2d half = (focal_px * (radius_mm / (z_mm - radius_mm))).array() + margin_px;
  if (!(middle.norm() < 1e6) || !(half.norm() < 1e6)) return whole;
  const Eigen::Vector2i corner = (middle - half).cast<int>(), size = (2 * half).cast<int>();
  const cv::Rect around = whole & cv::Rect(corner.x(), corner.y(), size.x(), size.y());
  return around.area() >= 256 ? around : whole;
}

cv::Rect PoseFilterTracker::with_surroundings(const cv::Rect& window) {
  constexpr int kReach_px = 24;
  return {window.x - kReach_px, window.y - kReach_px, window.width + 2 * kReach_px,
          window.height + 2 * kReach_px};
}

bool PoseFilterTracker::confirms(double confirmation) { return confirmation >= kLostQuality; }

RigidObjectTracker::Judgement PoseFilterTracker::end_frame(double quality, double confirmation) {
  ++frame_number_;
  bad_frames_ = confirms(confirmation) ? 0 : bad_frames_ + 1;
  return {quality, bad_frames_ >= kFramesUntilLost ? TrackStatus::lost : TrackStatus::tracking};
}

}  // namespace anneal6d
