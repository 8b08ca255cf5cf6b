// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "anneal6d/framework/annealing.h"
#include "anneal6d/framework/edge_detector.h"
#include "anneal6d/framework/rating.h"
#include "anneal6d/framework/resampling.h"
#include "anneal6d/framework/rigid_object_tracker.h"
#include "anneal6d/framework/shading.h"

namespace anneal6d {

enum class UniversalMode {
  /// Algorithms 1-5 as the thesis has them: multinomial draw, noise narrowed by the rating, the
  /// estimate the weighted mean.
  thesis,
  /// A motion model that learns, a refinement of what it expects by edges and colours, and, where
  /// the image does not confirm that, the same filter with systematic resampling, noise narrowed by
  /// the particles' own spread, colours beside the edges, and a refinement of its best particles.
  standard,
};

/// `anneal6d` in the user's cache folder (XDG_CACHE_HOME or ~/.cache, on Windows LOCALAPPDATA);
/// empty if there is none.
std::filesystem::path default_view_cache();

/// Everything about the universal tracker that can be chosen. Names in quotes are those of
/// `Settings` and of the tool's options.
struct UniversalTrackerOptions {
  UniversalMode mode = UniversalMode::standard;  ///< "mode": thesis | default
  std::string scorer = "sparse";                 ///< "scorer": a name of the scorer table
  int particles = 200;                           ///< "particles": a layer, 1..100000
  int layers = 6;                                ///< "layers": a frame, 1..100
  /// Of the thesis's mode: "annealing" (thesis | geometric), "annealing-ratio" (0..1, of the
  /// geometric rule), "drift" (on | off: start at the last motion, as Alg. 3 has it; off by
  /// default, since on a random walk it doubles the noise).
  AnnealingRule annealing = AnnealingRule::thesis;
  double annealing_ratio = 0.5;
  bool drift = false;
  double sigma_mm = 5.0;   ///< "sigma-mm": expected motion a frame and axis, 0..1000
  double sigma_deg = 2.0;  ///< "sigma-deg": expected turn a frame and axis, 0..90
  /// Of the camera's image: "edges", "edge-threshold" (number | auto), "canny-low" (number | auto),
  /// "edge-dilation" (px), "edge-blur" (sigma, px).
  EdgeOptions frame_edges{.dilation_px = 1};
  /// Of the rendered object: the same operator and blur; "model-edge-threshold".
  EdgeOptions model_edges{.threshold = 40};
  RatingOptions
      rating;  ///< "rating": ratio | normalized | balanced; "rating-c", "-c1", "-c2", "-c3"
  bool textured = true;    ///< "textured": on | off; off ignores the model's texture
  std::uint64_t seed = 1;  ///< "seed"
  int threads = 0;         ///< "threads": 0 means all
  /// "view-cache": folder | off. Where the views of a model are kept from run to run; by default
  /// the user's cache folder; empty: nowhere.
  std::filesystem::path view_cache = default_view_cache();

  /// The thesis's or the default configuration with what the settings change. Throws ConfigError
  /// naming the setting; settings of other names are left alone.
  static UniversalTrackerOptions from(const Settings& settings);

  /// Throws ConfigError naming the field.
  void validate() const;
};

/// Follows a rigid object of any shape: particles propose poses, rendered edges decide (thesis,
/// chapter 4).
std::unique_ptr<RigidObjectTracker> make_universal_tracker(const TrackerSetup& setup);

}  // namespace anneal6d
