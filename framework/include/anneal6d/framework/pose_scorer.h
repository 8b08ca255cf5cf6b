// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/edge_detector.h"
#include "anneal6d/framework/plugin.h"
#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/shading.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// The thesis's pixelCount and pixelCountAND of one pose (Alg. 4).
struct EdgeMatch {
  std::int32_t rendered = 0;  ///< edge pixels of the rendered object inside the image
  std::int32_t matched = 0;   ///< those of them that are edge pixels of the frame, too
};

/// Port: compares rendered poses with the frame's edges. Implementations are swapped by name and
/// held to one contract suite (tests/contract).
class PoseScorer {
 public:
  virtual ~PoseScorer() = default;

  /// The frame's edges, of the camera's size; kept (shared, not copied) until the next call.
  /// Throws ConfigError for another size or type.
  virtual void set_edges(const EdgeImage& edges) = 0;

  /// Scores each pose; both spans have the same length. A pose that is not finite, or of which
  /// nothing is visible, gets {0, 0}. Not thread safe; works in parallel inside.
  virtual void score(std::span<const Pose> camera_from_object, std::span<EdgeMatch> matches) = 0;
};

/// What a scorer is made from.
struct ScorerSetup {
  std::shared_ptr<const TriangleMesh> mesh;
  CameraModel camera;
  /// Operator and widening for the *rendered* image; thresholds must be given, not automatic.
  EdgeOptions edges;
  Shading shading;
  bool textured = true;  ///< false: ignore the model's texture
  int threads = 0;       ///< CPU threads, 0: all
  /// Folder for what is computed once per model, made if need be; empty: nothing is kept.
  std::filesystem::path view_cache = {};
  /// Told the share done (0..1) of a long preparation, from any thread, one call at a time; may be
  /// empty.
  std::function<void(double)> progress = {};

  /// Throws ConfigError: no mesh, bad camera, bad or automatic thresholds, negative threads.
  void validate() const;
};

/// What every scorer asks of the edges that it is given: CV_8UC1 of the camera's size, in pixels.
/// Throws ConfigError.
void check_edge_image(const EdgeImage& edges, const cv::Size& camera_size);

using ScorerPlugin = Plugin<PoseScorer, ScorerSetup>;
using ScorerTable = PluginTable<PoseScorer, ScorerSetup>;

}  // namespace anneal6d
