// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include "anneal6d/framework/pose_scorer.h"
#include "anneal6d/visualizer/mesh_renderer.h"

namespace anneal6d {

/// The thesis's rating pipeline, plainly (4.1.2, 4.2.2): draw with OpenGL, read back, convert to
/// grey, detect edges with OpenCV, AND with the frame's edges, count. The truth that faster scorers
/// are tested against. Pose by pose; the driver's and OpenCV's threads do what is parallel, so that
/// `ScorerSetup::threads` has no meaning here.
class ReferenceScorer final : public PoseScorer {
 public:
  /// Throws what `ScorerSetup::validate` and the MeshRenderer throw.
  explicit ReferenceScorer(const ScorerSetup& setup);

  void set_edges(const EdgeImage& edges) override;
  /// Before the first `set_edges` nothing matches.
  void score(std::span<const Pose> camera_from_object, std::span<EdgeMatch> matches) override;

 private:
  MeshRenderer renderer_;
  EdgeOptions edge_options_;
  Shading shading_;
  cv::Mat frame_edges_;
  // Kept between poses to save allocations.
  EdgeDetector edge_detector_;
  cv::Mat color_, grey_, matched_;
  EdgeImage rendered_;
};

namespace visualizer {

/// The scorers of this module: "reference".
ScorerTable scorer_plugins();

}  // namespace visualizer
}  // namespace anneal6d
