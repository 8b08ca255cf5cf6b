// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench_scene.h"
#include "bench_trial.h"

namespace anneal6d {

/// What `bench` measures.
struct BenchOptions {
  std::vector<std::string> scorers;  ///< those that can be used here
  std::vector<int> particles = {100, 600};
  std::vector<int> layers = {1, 5};
  std::vector<std::string> edges = {"sobel", "canny"};
  int threads = 0;  ///< CPU threads, 0: all
  std::uint64_t seed = 1;
  std::string view_cache;  ///< as of --view-cache; empty: the default
};

/// Names of steps, as in `bench --out`.
inline constexpr const char* kScoreStep = "score";  ///< all poses of a sample
inline constexpr const char* kTotalStep = "total";
inline constexpr const char* kEdgesStep = "edges";
inline constexpr const char* kSearchStep = "search";
inline constexpr const char* kJudgeStep = "judge";
inline constexpr const char* kDrawStep = "draw";
inline constexpr const char* kGreyStep = "grey";
inline constexpr const char* kAndStep = "and";
inline constexpr const char* kCountStep = "count";

/// Every scorer with every kind of edges, on one thread and on `threads`: a sample scores as many
/// poses as the largest layer has.
std::vector<BenchTrial> scorer_trials(const BenchOptions& options);

/// `track()` in the thesis's mode, every scorer with every kind of edges, particles and layers
/// (thesis Fig. 6.24, 6.25, Table 6.2); and in the default mode with its scorer, if that is among
/// them. Each frame starts at the true pose of the one before, so that all trials see the same. The
/// trials refer to `scene`, which has two frames or more.
std::vector<BenchTrial> frame_trials(const BenchOptions& options, const BenchFrames& scene);

/// The steps of scoring one pose as the thesis has them (Table 6.4, without CUDA). Throws
/// BackendUnavailable: no OpenGL.
std::vector<BenchTrial> step_trials(const BenchOptions& options);

/// Drawing one pose with OpenGL and reading it back, by the number of triangles (Table 6.3).
/// Throws BackendUnavailable: no OpenGL.
std::vector<BenchTrial> draw_trials(const BenchOptions& options);

}  // namespace anneal6d
