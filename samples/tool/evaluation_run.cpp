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

SequenceEvaluation evaluate_sequence(const std::string& folder, const std::string& name,
                                     const EvaluationOptions& options,
                                     const std::atomic<bool>& stop, Progress& progress) {
  TrackingJob job = open_tracking_job(folder, options.tracking, {});
  const std::map<std::int64_t, Pose> truth =
      options.reference.empty() ? job.ground_truth : load_poses(options.reference);
  const std::optional<Frame> first = job.frames->next();
  if (!first) throw ConfigError(folder + " has no frame after --start");

  SequenceEvaluation evaluation;
  evaluation.rows.push_back(given_row(
      first->index,
      start_tracker(*job.tracker, options.tracking, truth_of(truth, first->index), *first)));
  progress.advance();

  int restarts = 0;
  while (const std::optional<Frame> frame = job.frames->next()) {
    if (interrupted() || stop) throw Error("interrupted; nothing was written");
    const TimedResult timed = track_timed(*job.tracker, *frame);
    evaluation.rows.push_back(estimated_row(frame->index, timed));
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
  evaluation.summary = summarise(name, evaluation.judged);
  evaluation.summary.restarts = restarts;
  evaluation.summary.broken_frames = static_cast<double>(job.frames->broken());
  if (options.pictures) {
    evaluation.pictures = paint_pictures(job, evaluation.rows, evaluation.judged, truth);
  }
  return evaluation;
}

/// How many frames all folders have, as far as that can be told without reading images.
std::int64_t total_frames(std::span<const std::string> folders, const TrackingOptions& options) {
  std::int64_t total = 0;
  for (const std::string& folder : folders) {
    const auto images = static_cast<std::int64_t>(open_sequence_folder(folder).images.size());
    total += chosen_frames(images, options);
  }
  return total;
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
  Progress progress("evaluating", total_frames(folders, options.tracking));
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
