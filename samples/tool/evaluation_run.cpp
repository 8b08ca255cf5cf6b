// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "evaluation_run.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/sequence_folder.h"
#include "interrupt.h"
#include "progress.h"
#include "tracking_job.h"

namespace anneal6d {

namespace {

std::optional<Pose> truth_of(const std::map<std::int64_t, Pose>& truth, std::int64_t frame) {
  const auto found = truth.find(frame);
  if (found == truth.end()) return std::nullopt;
  return found->second;
}

/// The poses that a sequence is judged against.
std::map<std::int64_t, Pose> truth_for(const std::map<std::int64_t, Pose>& ground_truth,
                                       const EvaluationOptions& options) {
  return options.reference.empty() ? ground_truth : load_poses(options.reference);
}

SequenceEvaluation evaluate_sequence(const std::string& folder, const std::string& name,
                                     const EvaluationOptions& options,
                                     const std::atomic<bool>& stop, Progress& progress) {
  TrackingJob job = open_tracking_job(folder, options.tracking, {});
  const std::map<std::int64_t, Pose> truth = truth_for(job.ground_truth, options);
  const std::optional<Frame> first = job.frames->next();
  if (!first) throw ConfigError(folder + " has no frame after --start");

  SequenceEvaluation evaluation;
  RunOutputs outputs(options.outputs, options.tracking, job);
  const auto add_row = [&](const Frame& frame, const PoseRow& row, const TrackResult& result) {
    evaluation.rows.push_back(row);
    outputs.write(frame, row, result);
  };
  const Pose start = start_tracker(*job.tracker, job.init, truth_of(truth, first->index), *first);
  add_row(*first, given_row(first->index, start), given_result(start));
  progress.advance();

  int restarts = 0;
  while (const std::optional<Frame> frame = job.frames->next()) {
    if (interrupted() || stop) throw Error("interrupted; nothing was written");
    const TimedResult timed = track_timed(*job.tracker, *frame);
    add_row(*frame, estimated_row(frame->index, timed), timed.result);
    progress.advance(1, name);

    const std::optional<Pose> true_pose = truth_of(truth, frame->index);
    if (!true_pose) continue;
    const PoseError error = pose_error(timed.result.camera_from_object, *true_pose, job.symmetry);
    const bool restart =
        options.protocol == Protocol::rbot && !error.is_within(kSuccess_mm, kSuccess_deg);
    evaluation.judged.push_back(
        {error, timed.milliseconds, frame->index, timed.result.quality, restart});
    if (restart) {
      reset_to_truth(*job.tracker, *true_pose, *frame);
      ++restarts;
    }
  }
  outputs.commit();
  evaluation.summary = summarise(name, evaluation.judged);
  evaluation.summary.restarts = restarts;
  evaluation.summary.broken_frames = static_cast<double>(job.frames->broken());
  if (options.pictures) {
    evaluation.pictures = paint_pictures(job, evaluation.rows, evaluation.judged, truth);
  }
  return evaluation;
}

/// Finds out before hours of tracking what would stop it: throws ConfigError and FileError.
/// Returns how many frames are chosen.
std::int64_t check_sequence(const std::string& path, const EvaluationOptions& options) {
  const TrackingOptions& tracking = options.tracking;
  const SequenceFolder folder = open_sequence_folder(path);
  if (!folder.camera_file && tracking.camera.empty()) {
    throw ConfigError(path + " has no camera.yml; give one with --camera");
  }
  if (!folder.model_file && tracking.model.empty()) {
    throw ConfigError(path + " has no model.obj; give one with --model");
  }
  const auto images = static_cast<std::int64_t>(folder.images.size());
  const std::int64_t frames = chosen_frames(images, tracking);
  if (frames == 0) throw ConfigError(path + " has no frame after --start");
  const std::map<std::int64_t, Pose> truth = truth_for(folder.ground_truth, options);
  if (tracking.init.empty() && !truth.contains(tracking.start)) {
    throw ConfigError(
        fmt::format("{}: the pose of the object in frame {} is not known; give it with --init",
                    path, tracking.start));
  }
  for (std::int64_t i = 1; i < frames; ++i) {
    if (truth.contains(tracking.start + i * tracking.stride)) return frames;
  }
  throw ConfigError(path +
                    ": no frame after the first has ground truth to judge it by; give another "
                    "--start, --stride, --frames or --reference");
}

}  // namespace

Protocol parse_protocol(std::string_view text) {
  if (text == "free") return Protocol::free;
  if (text == "rbot") return Protocol::rbot;
  throw ConfigError("--protocol: '" + std::string(text) + "' is not free or rbot");
}

std::string_view to_string(Protocol protocol) {
  return protocol == Protocol::free ? "free" : "rbot";
}

std::vector<SequenceEvaluation> evaluate_sequences(std::span<const std::string> folders,
                                                   std::span<const std::string> names,
                                                   const EvaluationOptions& options) {
  std::int64_t total_frames = 0;
  for (const std::string& folder : folders) total_frames += check_sequence(folder, options);
  Progress progress("evaluating", total_frames);
  std::vector<SequenceEvaluation> evaluations(folders.size());
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stop = false;
  std::exception_ptr failure;
  std::mutex failure_mutex;

  const auto work = [&] {
    for (std::size_t i = next++; i < folders.size() && !stop; i = next++) {
      try {
        evaluations[i] = evaluate_sequence(folders[i], names[i], options, stop, progress);
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();  // later ones follow from `stop`
        stop = true;
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    const std::size_t count = std::min(folders.size(), static_cast<std::size_t>(options.jobs));
    for (std::size_t i = 1; i < count; ++i) workers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return evaluations;
}

}  // namespace anneal6d
