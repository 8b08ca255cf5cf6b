// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "anneal6d/capture/simulation_source.h"
#include "anneal6d/framework/frame_source.h"
#include "anneal6d/framework/plugin.h"
#include "anneal6d/framework/settings.h"

namespace anneal6d {

/// What a frame source is made from.
struct FrameSourceSetup {
  std::string input;  ///< as the user typed it; see `open_frame_source`
  Settings settings;  ///< the source's own options; unknown names are the caller's business
  std::optional<CameraModel> camera;         ///< replaces the calibration that the source brings
  std::shared_ptr<const TriangleMesh> mesh;  ///< the object to simulate; others ignore it
  ObjectRendererFactory make_renderer;       ///< draws it
};

using FrameSourcePlugin = Plugin<FrameSource, FrameSourceSetup>;
using FrameSourceTable = PluginTable<FrameSource, FrameSourceSetup>;

/// The sources of this module: sequence, video, camera, dc1394, simulate.
FrameSourceTable frame_source_plugins();

/// Opens the source that `setup.input` means: a folder is a sequence, a file a video, and "name:"
/// or "name:which" goes to the row of that name ("camera:0", "simulate:", "dc1394:").
/// Throws FileError (neither a folder nor a file), ConfigError (no row of that name),
/// BackendUnavailable (the row can't be used here, or the module was left out of this build), and
/// what the source's constructor throws.
std::unique_ptr<FrameSource> open_frame_source(const FrameSourceTable& table,
                                               const FrameSourceSetup& setup);

/// What follows the colon of an input: "2" of "camera:2"; empty without a colon.
std::string input_argument(const std::string& input);

}  // namespace anneal6d
