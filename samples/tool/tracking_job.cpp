// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "tracking_job.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "anneal6d/framework/mesh_file.h"
#include "anneal6d/framework/sequence_folder.h"
#include "plugins.h"
#include "progress.h"

namespace anneal6d {

namespace fs = std::filesystem;

namespace {

/// The simulated object starts where the tracker starts, moves as the tracker expects, and as long
/// as frames are wanted.
Settings simulation_settings(const TrackingOptions& options, const Settings& simulation) {
  Settings settings = simulation;
  for (const char* name : {"seed", "sigma-mm", "sigma-deg"}) {
    if (const auto value = options.settings.text(name)) settings.set(name, *value);
  }
  if (!options.init.empty()) settings.set("init", options.init);
  if (options.frames) {
    settings.set("frames",
                 std::to_string(options.start + (*options.frames - 1) * options.stride + 1));
  }
  return settings;
}

fs::path model_path(const std::string& input, const TrackingOptions& options,
                    const std::optional<SequenceFolder>& folder) {
  if (!options.model.empty()) return options.model;
  if (folder && folder->model_file) return *folder->model_file;
  throw ConfigError(input + (folder ? " has no model.obj" : " brings no model") +
                    "; give one with --model");
}

}  // namespace

std::int64_t chosen_frames(std::int64_t available, const TrackingOptions& options) {
  const std::int64_t after_start = std::max<std::int64_t>(available - options.start, 0);
  const std::int64_t count = (after_start + options.stride - 1) / options.stride;
  return options.frames ? std::min(count, *options.frames) : count;
}

std::shared_ptr<const TriangleMesh> load_model(const fs::path& path, const std::string& unit) {
  return std::make_shared<const TriangleMesh>(load_mesh(path, parse_length_unit(unit)));
}

TrackingJob open_tracking_job(const std::string& input, const TrackingOptions& options,
                              const Settings& simulation) {
  TrackingJob job;
  job.input = input;
  std::optional<SequenceFolder> folder;
  if (fs::is_directory(input)) {
    folder = open_sequence_folder(input);
    job.symmetry = folder->symmetry;
    job.ground_truth = folder->ground_truth;
    job.expected_frames = chosen_frames(static_cast<std::int64_t>(folder->images.size()), options);
  } else {
    job.expected_frames = options.frames;
  }

  check_device_options(input, options.device);
  check_simulation_options(input, simulation);
  if (!is_simulation(input)) job.init = options.init;
  FrameSourceSetup source;
  source.input = input;
  source.settings = options.device;
  source.make_renderer = textured_renderers();
  if (!options.camera.empty()) source.camera = load_camera(options.camera);
  if (is_simulation(input)) {  // nothing can be simulated before the model is there
    source.settings = simulation_settings(options, simulation);
    source.mesh = job.mesh = load_model(model_path(input, options, folder), options.model_unit);
  }
  job.source = open_frame_source(all_frame_sources(), source);
  job.frames.emplace(*job.source, options.start, options.stride, options.frames);
  log(LogLevel::info, job.source->description());

  const std::optional<CameraModel> camera = job.source->camera();
  if (!camera) {
    throw ConfigError(input + (folder ? " has no camera.yml" : " brings no calibration") +
                      "; give one with --camera");
  }
  job.camera = *camera;
  if (!job.mesh) job.mesh = load_model(model_path(input, options, folder), options.model_unit);
  const TrackerSetup setup{job.mesh,         job.camera,    job.symmetry,
                           options.settings, all_scorers(), preparation_progress()};
  job.tracker = make_plugin(all_trackers(options.plugin), "tracker", options.tracker, setup);
  return job;
}

Pose start_tracker(RigidObjectTracker& tracker, const std::string& init,
                   const std::optional<Pose>& truth, const Frame& frame) {
  if (!init.empty()) {
    try {
      const Pose pose = parse_pose(init);
      tracker.reset(pose, frame);
      return pose;
    } catch (const ConfigError& error) {
      throw ConfigError(std::string("--init: ") + error.what());
    }
  }
  if (!truth) {
    throw ConfigError(fmt::format(
        "the pose of the object in frame {} is not known; give it with --init", frame.index));
  }
  reset_to_truth(tracker, *truth, frame);
  return *truth;
}

void reset_to_truth(RigidObjectTracker& tracker, const Pose& truth, const Frame& frame) {
  try {
    tracker.reset(truth, frame);
  } catch (const ConfigError& error) {
    throw Error(fmt::format("ground truth of frame {}: {}", frame.index, error.what()));
  }
}

TimedResult track_timed(RigidObjectTracker& tracker, const Frame& frame) {
  const auto start = std::chrono::steady_clock::now();
  TimedResult timed;
  timed.result = tracker.track(frame);
  timed.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return timed;
}

TrackResult given_result(const Pose& pose) {
  TrackResult result;
  result.camera_from_object = result.best_camera_from_object = pose;
  result.quality = 1;
  result.status = TrackStatus::tracking;
  return result;
}

PoseRow given_row(std::int64_t frame, const Pose& pose) {
  PoseRow row;
  row.frame = frame;
  row.camera_from_object = pose;
  row.quality = 1;
  row.reset = true;
  return row;
}

PoseRow estimated_row(std::int64_t frame, const TimedResult& timed) {
  PoseRow row;
  row.frame = frame;
  row.camera_from_object = timed.result.camera_from_object;
  row.quality = timed.result.quality;
  row.status = timed.result.status;
  row.milliseconds = timed.milliseconds;
  return row;
}

}  // namespace anneal6d
