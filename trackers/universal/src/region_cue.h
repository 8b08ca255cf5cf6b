// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "appearance.h"
#include "smooth_picture.h"
#include "view_model.h"
#include "workers.h"

namespace anneal6d {

/// Rates poses by colours: at each silhouette point, is the object's colour before it and another
/// behind it? A cue beside the edges, quick enough for thousands of poses a frame.
class RegionCue {
 public:
  /// `views` and `workers` outlive the cue.
  RegionCue(const ViewModel& views, const CameraModel& camera, Workers& workers);

  /// Looks up the colours of the frame at half its resolution.
  void set_image(const SmoothPicture& picture, const Appearance& appearance);

  /// For each pose -1..1: 1 if all colours are where they should be, 0 if they say nothing.
  void score(std::span<const Pose> camera_from_object, std::span<double> scores) const;

 private:
  double score_one(const Pose& camera_from_object) const;

  const ViewModel& views_;
  CameraModel camera_;
  Workers& workers_;
  std::vector<float> silhouettes_;  ///< of all views, as the kernel wants them
  cv::Point origin_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::int8_t> log_odds_;
};

}  // namespace anneal6d
