// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <spdlog/fmt/fmt.h>

#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "command.h"
#include "evaluation.h"
#include "interrupt.h"
#include "options.h"
#include "progress.h"
#include "run_outputs.h"
#include "tracking_job.h"

namespace anneal6d {

namespace {

struct TrackOptions {
  std::string input;
  TrackingOptions tracking;
  OutputOptions outputs;
  Settings simulation;
};

/// What the run came to, for the line at its end.
struct Tally {
  std::int64_t given = 0;
  std::int64_t lost = 0;
  std::int64_t not_received = 0;
  std::vector<double> milliseconds;

  void log_summary(std::int64_t broken) const {
    std::string text = fmt::format("tracked {} frames, lost in {}", milliseconds.size(), lost);
    if (broken > 0) text += fmt::format(", {} broken and left out", broken);
    if (not_received > 0) text += fmt::format(", {} never arrived from the camera", not_received);
    if (!milliseconds.empty()) {
      text += fmt::format(", median {:.1f} ms, 95% {:.1f} ms", quantile(milliseconds, 0.5),
                          quantile(milliseconds, 0.95));
    }
    log(LogLevel::info, text);
  }
};

void track_first(TrackingJob& job, RunOutputs& outputs) {
  const std::optional<Frame> frame = job.frames->next();
  if (!frame) throw ConfigError(job.input + " has no frame after --start");
  const Pose pose = start_tracker(*job.tracker, job.init, job.source->ground_truth(), *frame);
  outputs.write(*frame, given_row(frame->index, pose), given_result(pose));
}

void track_rest(TrackingJob& job, const TrackOptions& options, RunOutputs& outputs, Tally& tally) {
  std::optional<Progress> progress;  // poses that are printed are progress enough
  if (!options.outputs.poses.empty()) progress.emplace("tracking", job.expected_frames);
  if (progress) progress->advance();
  while (!interrupted()) {
    const std::optional<Frame> frame = job.frames->next();
    if (!frame) return;
    const TimedResult timed = track_timed(*job.tracker, *frame);
    outputs.write(*frame, estimated_row(frame->index, timed), timed.result);
    tally.milliseconds.push_back(timed.milliseconds);
    tally.not_received += frame->lost_before;
    if (timed.result.status == TrackStatus::lost) ++tally.lost;
    if (progress) {
      progress->advance(1, fmt::format("quality {:.2f}, {}", timed.result.quality,
                                       to_string(timed.result.status)));
    }
  }
}

int track(const TrackOptions& options) {
  catch_interrupt();
  TrackingJob job = open_tracking_job(options.input, options.tracking, options.simulation);
  RunOutputs outputs(options.outputs, options.tracking, job);
  Tally tally;
  track_first(job, outputs);
  std::string failure;
  try {
    track_rest(job, options, outputs, tally);
  } catch (const std::exception& error) {  // what was tracked before is worth keeping
    failure = error.what();
  }
  outputs.commit();
  if (interrupted()) log(LogLevel::warning, "interrupted; the poses so far are kept");
  tally.log_summary(job.frames->broken());
  if (!failure.empty()) throw Error(failure + "; the poses before that are kept");
  return 0;
}

}  // namespace

Command add_track_command(CLI::App& tool) {
  CLI::App* app =
      tool.add_subcommand("track", "Tracks an object through images and writes its poses");
  auto options = std::make_shared<TrackOptions>();
  options->outputs.print_poses = true;
  app->add_option("INPUT", options->input,
                  "Sequence folder, video file, camera:N, dc1394:GUID, dc1394: or simulate:")
      ->required();
  add_tracking_options(*app, options->tracking);
  add_output_options(*app, options->outputs);
  add_simulation_options(*app, options->simulation);
  add_device_options(*app, options->tracking.device);
  return {app, [options] { return track(*options); }};
}

}  // namespace anneal6d
