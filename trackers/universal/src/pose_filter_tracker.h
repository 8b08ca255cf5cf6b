// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <memory>
#include <numbers>
#include <opencv2/core/mat.hpp>

#include "anneal6d/framework/edge_detector.h"
#include "anneal6d/framework/pose_scorer.h"
#include "anneal6d/framework/random.h"
#include "anneal6d/trackers/universal_tracker.h"
#include "pose_filter.h"
#include "twist.h"
#include "workers.h"

namespace anneal6d {

/// What both modes of the universal tracker have: particles around the object's last pose, the
/// scorer that rates them, and the edges of the frame that it compares them with.
class PoseFilterTracker : public RigidObjectTracker {
 protected:
  /// `drawing`: of drawing_of().
  PoseFilterTracker(const TrackerSetup& setup, const UniversalTrackerOptions& options,
                    const ScorerSetup& drawing);

  /// How the object is to be drawn for scorers and views.
  static ScorerSetup drawing_of(const TrackerSetup& setup, const UniversalTrackerOptions& options);

  void on_reset(const Pose& camera_from_object) override;

  /// Finds the edges of the frame for the scorer, where a sphere around the object may appear.
  /// Returns that part of the frame.
  cv::Rect detect_edges_around(const cv::Mat& image, const Pose& camera_from_center,
                               double radius_mm);
  const EdgeImage& frame_edges() const { return edges_; }

  /// Where a sphere about the object's centre and a margin around it appear; the whole image if
  /// that is none of it.
  cv::Rect window(const Pose& camera_from_center, double radius_mm, double margin_px) const;

  /// A window with the pixels around it that blurring it and finding edges in it may read.
  static cv::Rect with_surroundings(const cv::Rect& window);

  /// Whether so much confirmation of a pose by the image, 0..1, is enough.
  static bool confirms(double confirmation);
  /// How many frames running, up to the last, did not confirm their pose.
  int bad_frames() const { return bad_frames_; }
  /// Counts a frame. The object is lost after two bad ones.
  Judgement end_frame(double quality, double confirmation);

  /// Of the random numbers of a layer of this frame.
  RandomKey key(int layer) const {
    return {options_.seed, frame_number_, static_cast<std::uint32_t>(layer), 0};
  }

  static constexpr double kWindow_px = 30.0;                   ///< looked at around the object
  static constexpr double kDegree = std::numbers::pi / 180.0;  ///< rad

  UniversalTrackerOptions options_;
  std::unique_ptr<PoseScorer> scorer_;
  Workers workers_;
  PoseFilter filter_;
  Pose center_;                     ///< camera_from_center of the last frame
  std::uint32_t frame_number_ = 0;  ///< since the last reset

 private:
  EdgeDetector edge_detector_;
  EdgeImage edges_, edges_around_;
  int bad_frames_ = 0;
};

/// The two modes, see UniversalMode.
std::unique_ptr<RigidObjectTracker> make_thesis_tracker(const TrackerSetup& setup,
                                                        const UniversalTrackerOptions& options);
std::unique_ptr<RigidObjectTracker> make_default_tracker(const TrackerSetup& setup,
                                                         const UniversalTrackerOptions& options);

}  // namespace anneal6d
