// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <memory>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/edge_detector.h"
#include "anneal6d/framework/frame.h"
#include "anneal6d/framework/object_renderer.h"

namespace anneal6d {

/// Writes for each frame what the scores are made of: `edges_%04d.png` (of the frame, thesis
/// Fig. 4.3), `rendered_%04d.png` (of the object in the estimated pose, Fig. 4.6) and
/// `matched_%04d.png` (both, Fig. 4.7). Each file appears whole or not at all.
class EdgePictures {
 public:
  /// Makes the folder if need be. Thresholds of `model_edges` must be given. Throws FileError.
  EdgePictures(std::filesystem::path folder, const CameraModel& camera,
               std::unique_ptr<ObjectRenderer> renderer, const EdgeOptions& frame_edges,
               const EdgeOptions& model_edges);

  /// Throws FileError and what the renderer throws.
  void write(const Frame& frame, const Pose& camera_from_object);

 private:
  std::filesystem::path folder_;
  Undistorter undistort_;
  std::unique_ptr<ObjectRenderer> renderer_;
  EdgeOptions frame_edges_, model_edges_;
};

}  // namespace anneal6d
