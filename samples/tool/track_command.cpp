// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <spdlog/fmt/fmt.h>

#include <memory>
#include <optional>
#include <string>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "anneal6d/framework/pose_file.h"
#include "anneal6d/trackers/universal_tracker.h"
#include "anneal6d/visualizer/overlay.h"
#include "anneal6d/visualizer/picture_writer.h"
#include "command.h"
#include "edge_pictures.h"
#include "evaluation.h"
#include "interrupt.h"
#include "options.h"
#include "plugins.h"
#include "pose_output.h"
#include "progress.h"
#include "tracking_job.h"

namespace anneal6d {

namespace {

struct TrackOptions {
  std::string input;
  TrackingOptions tracking;
  Settings simulation;
  std::string poses;
  std::string overlay;
  std::string edge_pictures;
};

/// Everything that a run leaves behind.
class Outputs {
 public:
  Outputs(const TrackOptions& options, const TrackingJob& job) : poses_(options.poses) {
    if (!options.overlay.empty()) {
      painter_.emplace(make_renderer(job.mesh, job.camera, true), job.mesh, job.camera);
      pictures_.emplace(options.overlay);
    }
    if (!options.edge_pictures.empty()) {
      // The universal tracker's: other trackers have edges of their own, or none.
      const auto tracker = UniversalTrackerOptions::from(options.tracking.settings);
      edge_pictures_.emplace(options.edge_pictures, job.camera,
                             make_renderer(job.mesh, job.camera, tracker.textured),
                             tracker.frame_edges, tracker.model_edges);
    }
  }

  void write(const Frame& frame, const PoseRow& row, const TrackResult& result) {
    poses_.write(row);
    if (pictures_) pictures_->write(painter_->paint(frame, result), frame.index);
    if (edge_pictures_) edge_pictures_->write(frame, result.camera_from_object);
  }

  void commit() {
    poses_.commit();
    if (pictures_) pictures_->commit();
  }

 private:
  PoseOutput poses_;
  std::optional<OverlayPainter> painter_;
  std::optional<PictureWriter> pictures_;
  std::optional<EdgePictures> edge_pictures_;
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

void track_first(TrackingJob& job, const TrackOptions& options, Outputs& outputs) {
  const std::optional<Frame> frame = job.frames->next();
  if (!frame) throw ConfigError(job.input + " has no frame after --start");
  TrackResult given;
  given.camera_from_object = given.best_camera_from_object =
      start_tracker(*job.tracker, options.tracking, job.source->ground_truth(), *frame);
  given.quality = 1;
  given.status = TrackStatus::tracking;
  outputs.write(*frame, given_row(frame->index, given.camera_from_object), given);
}

void track_rest(TrackingJob& job, const TrackOptions& options, Outputs& outputs, Tally& tally) {
  std::optional<Progress> progress;  // poses that are printed are progress enough
  if (!options.poses.empty()) progress.emplace("tracking", job.expected_frames);
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
  Outputs outputs(options, job);
  Tally tally;
  track_first(job, options, outputs);
  std::string failure;
  try {
    track_rest(job, options, outputs, tally);
  } catch (const CaptureError& error) {  // what was tracked before is worth keeping
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
  app->add_option("INPUT", options->input,
                  "Sequence folder, video file, camera:N, dc1394:GUID, dc1394: or simulate:")
      ->required();
  add_tracking_options(*app, options->tracking);
  app->add_option("--poses", options->poses, "Where the poses go, CSV; default: standard output")
      ->type_name("FILE.csv");
  app->add_option("--overlay", options->overlay,
                  "Draw the object's edges over the frames: a video, or a folder of PNGs")
      ->type_name("FILE.mp4|DIR");
  app->add_option(
         "--edge-pictures", options->edge_pictures,
         "Write the edges of each frame, of the rendered object, and those in both, as PNGs")
      ->type_name("DIR");
  add_simulation_options(*app, options->simulation);
  add_device_options(*app, options->tracking.device);
  return {app, [options] { return track(*options); }};
}

}  // namespace anneal6d
