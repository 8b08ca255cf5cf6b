// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "anneal6d/framework/frame_source.h"
#include "anneal6d/framework/pose_file.h"
#include "anneal6d/framework/rigid_object_tracker.h"
#include "frame_reader.h"
#include "options.h"

namespace anneal6d {

/// All that is needed to follow one object through one input.
struct TrackingJob {
  std::string input;
  CameraModel camera;
  std::shared_ptr<const TriangleMesh> mesh;
  Symmetry symmetry;
  std::map<std::int64_t, Pose> ground_truth;  ///< of a sequence folder; empty otherwise
  std::unique_ptr<FrameSource> source;
  std::optional<FrameReader> frames;
  std::optional<std::int64_t> expected_frames;  ///< how many will come, if that is known
  /// `--init`, the pose in the first chosen frame; empty: not given, or meant for the simulation,
  /// whose first frame need not be chosen.
  std::string init;
  std::unique_ptr<RigidObjectTracker> tracker;
};

/// Opens the input, reads model and calibration and makes the tracker. `simulation` is for the
/// input "simulate:". Throws FileError, ConfigError and BackendUnavailable.
TrackingJob open_tracking_job(const std::string& input, const TrackingOptions& options,
                              const Settings& simulation);

/// Reads a model; `unit` as of --model-unit. Throws FileError and ConfigError.
std::shared_ptr<const TriangleMesh> load_model(const std::filesystem::path& path,
                                               const std::string& unit);

/// How many of `available` frames --start, --stride and --frames choose.
std::int64_t chosen_frames(std::int64_t available, const TrackingOptions& options);

/// Starts the tracker in `frame`. The pose is `init`, if not empty, else `truth`, which may be
/// unknown. Throws ConfigError for a bad `init`, Error for a missing or bad truth.
Pose start_tracker(RigidObjectTracker& tracker, const std::string& init,
                   const std::optional<Pose>& truth, const Frame& frame);

/// Throws Error: the pose is not one that a tracker can start from.
void reset_to_truth(RigidObjectTracker& tracker, const Pose& truth, const Frame& frame);

/// Milliseconds and result of `tracker.track(frame)`.
struct TimedResult {
  TrackResult result;
  double milliseconds = 0;
};
TimedResult track_timed(RigidObjectTracker& tracker, const Frame& frame);

/// What a tracker would say of a pose that was given.
TrackResult given_result(const Pose& camera_from_object);

/// The row of a frame whose pose was given, and of one whose pose was estimated.
PoseRow given_row(std::int64_t frame, const Pose& camera_from_object);
PoseRow estimated_row(std::int64_t frame, const TimedResult& timed);

}  // namespace anneal6d
