// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "run_outputs.h"

#include "anneal6d/trackers/universal_tracker.h"
#include "plugins.h"

namespace anneal6d {

void add_output_options(CLI::App& command, OutputOptions& options) {
  command
      .add_option("--poses", options.poses,
                  std::string("Where the poses go, CSV; default: ") +
                      (options.print_poses ? "standard output" : "none"))
      ->type_name("FILE.csv");
  command
      .add_option("--overlay", options.overlay,
                  "Draw the object's edges over the frames: a video, or a folder of PNGs")
      ->type_name("FILE.mp4|DIR");
  command
      .add_option(
          "--edge-pictures", options.edge_pictures,
          "Write the edges of each frame, of the rendered object, and those in both, as PNGs")
      ->type_name("DIR");
}

RunOutputs::RunOutputs(const OutputOptions& options, const TrackingOptions& tracking,
                       const TrackingJob& job) {
  if (options.print_poses || !options.poses.empty()) poses_.emplace(options.poses);
  if (!options.overlay.empty()) {
    painter_.emplace(make_renderer(job.mesh, job.camera, true), job.mesh, job.camera);
    pictures_.emplace(options.overlay);
  }
  if (!options.edge_pictures.empty()) {
    // The universal tracker's: other trackers have edges of their own, or none.
    const auto tracker = UniversalTrackerOptions::from(tracking.settings);
    edge_pictures_.emplace(options.edge_pictures, job.camera,
                           make_renderer(job.mesh, job.camera, tracker.textured),
                           tracker.frame_edges, tracker.model_edges);
  }
}

void RunOutputs::write(const Frame& frame, const PoseRow& row, const TrackResult& result) {
  if (poses_) poses_->write(row);
  if (pictures_) pictures_->write(painter_->paint(frame, result), frame.index);
  if (edge_pictures_) edge_pictures_->write(frame, result.camera_from_object);
}

void RunOutputs::commit() {
  if (poses_) poses_->commit();
  if (pictures_) pictures_->commit();
}

}  // namespace anneal6d
