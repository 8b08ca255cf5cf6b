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

/// The object's contour at a pose, drawn while tracking: without what views' contours, seen from a
/// few degrees beside it, leave open.
class ExactContour {
 public:
  explicit ExactContour(const ScorerSetup& setup);

  /// Draws the contour at a pose, unless the last one was drawn from no more than 1.5 degrees
  /// beside it, and as near: shifts and turns of the image do not matter.
  void draw(const Pose& camera_from_object, Workers& workers);

  /// Forgets what was drawn.
  void reset() { drawn_.reset(); }

  /// As it was drawn last.
  const ModelView& contour() const { return contour_; }

  /// See ContourMatch::expect. Where n triangles stand for a round surface their normals are off by
  /// an angle that goes with 1 / sqrt(n), and what they feign with its square.
  double feigned_share() const { return feigned_share_; }

 private:
  bool drawn_near_by(const Pose& camera_from_object) const;

  RasterModel model_;
  ViewPainter painter_;
  double feigned_share_;
  std::optional<Pose> drawn_;
  ModelView contour_;
};

}  // namespace anneal6d
