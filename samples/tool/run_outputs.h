// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <optional>
#include <string>

#include "anneal6d/framework/pose_file.h"
#include "anneal6d/visualizer/overlay.h"
#include "anneal6d/visualizer/picture_writer.h"
#include "edge_pictures.h"
#include "options.h"
#include "pose_output.h"
#include "tracking_job.h"

namespace anneal6d {

/// Where a run's results go. Empty texts: not wanted.
struct OutputOptions {
  std::string poses;
  bool print_poses = false;  ///< to standard output, where they go to no file
  std::string overlay;
  std::string edge_pictures;

  bool any() const {
    return print_poses || !poses.empty() || !overlay.empty() || !edge_pictures.empty();
  }
};

void add_output_options(CLI::App& command, OutputOptions& options);

/// The files that a run leaves behind, frame by frame. Poses and video appear on `commit()`.
class RunOutputs {
 public:
  /// Opens what is wanted. Throws FileError, ConfigError and BackendUnavailable.
  RunOutputs(const OutputOptions& options, const TrackingOptions& tracking, const TrackingJob& job);

  /// Throws FileError and what the renderer throws.
  void write(const Frame& frame, const PoseRow& row, const TrackResult& result);
  void commit();

 private:
  std::optional<PoseOutput> poses_;
  std::optional<OverlayPainter> painter_;
  std::optional<PictureWriter> pictures_;
  std::optional<EdgePictures> edge_pictures_;
};

}  // namespace anneal6d
