// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/frame.h"
#include "anneal6d/framework/pose.h"

namespace anneal6d {

/// Port: where frames come from. Constructing one throws FileError (no such folder or file),
/// BackendUnavailable (no such camera) or ConfigError.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame; empty at the end of the stream. Throws FileError (one frame of a sequence is
  /// broken; calling again goes on with the next) or CaptureError (the device failed).
  virtual std::optional<Frame> next() = 0;

  /// Passes over up to `count` frames as cheaply as the source can, without checking what it does
  /// not need to read; returns how many there were, fewer only at the end of the stream. The
  /// following frame keeps its own index. Throws as `next` does.
  virtual std::int64_t skip(std::int64_t count) {
    std::int64_t skipped = 0;
    while (skipped < count && next()) ++skipped;
    return skipped;
  }

  /// One line for people: "sequence cup/, 100 frames of 640x480".
  virtual std::string description() const = 0;

  /// The calibration that comes with the source, if it has one.
  virtual std::optional<CameraModel> camera() const { return std::nullopt; }

  /// The true camera_from_object pose of the frame last handed out, if the source knows it.
  virtual std::optional<Pose> ground_truth() const { return std::nullopt; }
};

}  // namespace anneal6d
