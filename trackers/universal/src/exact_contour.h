// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <optional>

#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/pose_scorer.h"
#include "raster_model.h"
#include "view_model.h"
#include "view_painter.h"
#include "workers.h"

namespace anneal6d {

/// The object's contour exactly as it is at a pose, drawn while tracking.
class ExactContour {
 public:
  explicit ExactContour(const ScorerSetup& setup);

  /// Draws the contour at a pose, unless the object looks the same as when it was drawn last, but
  /// for a shift and a turn of the image.
  void draw(const Pose& camera_from_object, Workers& workers);

  /// Forgets what was drawn.
  void reset() { drawn_.reset(); }

  /// As it was drawn last.
  const ModelView& contour() const { return contour_; }

  /// See ContourMatch::expect. Where n triangles stand for a round surface their normals are off by
  /// an angle that goes with 1 / sqrt(n), and what they feign with its square.
  double feigned_share() const { return feigned_share_; }

 private:
  bool looks_as_drawn(const Pose& camera_from_object) const;

  RasterModel model_;
  ViewPainter painter_;
  double feigned_share_;
  std::optional<Pose> drawn_;
  ModelView contour_;
};

}  // namespace anneal6d
