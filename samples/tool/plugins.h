// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <memory>

#include "anneal6d/capture/frame_sources.h"
#include "anneal6d/framework/rigid_object_tracker.h"

namespace anneal6d {

/// Every scorer of this program: of the trackers (CPU) and of the visualizer (OpenGL).
ScorerTable all_scorers();

/// Every tracker of this program and, if `plugin` is not empty, of that shared library. Throws what
/// `load_tracker_plugins` throws, and ConfigError if the library repeats a name.
TrackerTable all_trackers(const std::filesystem::path& plugin);

/// Every frame source of this program.
FrameSourceTable all_frame_sources();

/// Draws with OpenGL, off screen; `textured` false ignores the mesh's texture.
std::unique_ptr<ObjectRenderer> make_renderer(std::shared_ptr<const TriangleMesh> mesh,
                                              const CameraModel& camera, bool textured);

/// The same, for simulations.
ObjectRendererFactory textured_renderers();

}  // namespace anneal6d
