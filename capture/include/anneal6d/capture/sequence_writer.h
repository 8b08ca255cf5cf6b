// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "anneal6d/capture/frame_set_source.h"
#include "anneal6d/framework/frame_source.h"
#include "anneal6d/framework/settings.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// How a sequence folder is written.
struct SequenceWriterOptions {
  std::string name;      ///< of the sequence, for meta.json; empty: the folder's name
  Settings settings;     ///< what the sequence was made with, for meta.json ("seed" and the rest)
  int jpeg_quality = 0;  ///< 0: PNG, lossless; 1..100: JPEG
  /// Replace a sequence folder that is there already. A folder that holds anything else than such
  /// a sequence is never replaced.
  bool force = false;
  /// Called after each frame with the number written so far; may be empty.
  std::function<void(std::int64_t)> progress;
  /// Recordings: asked after each frame; true ends the recording and keeps it. May be empty.
  std::function<bool(std::int64_t)> stop;
};

/// Writes what `source` still has as a sequence folder: frame_0000.png..., camera.yml, model.obj
/// (with model.mtl and model.png for colours and texture; millimetres), groundtruth.csv (if the
/// source knows the truth) and meta.json. Frames are numbered from 0. Everything goes to a
/// temporary folder beside `folder`, which takes its name at the end: nothing half-written is left.
/// Should that fail (the disk is full, or another sequence came to be there meanwhile), the frames
/// stay in the temporary folder, which the FileError names. Returns the number of frames. Throws
/// FileError (`folder` is a file or a non-empty folder; cannot be written), ConfigError (a bad
/// option, a source without calibration or without any frame), and what the source throws.
std::int64_t write_sequence(FrameSource& source, const TriangleMesh& mesh,
                            const std::filesystem::path& folder,
                            const SequenceWriterOptions& options = {});

/// What a recording came to.
struct Recording {
  std::int64_t frames = 0;
  std::int64_t lost = 0;    ///< that the camera took in between, but nobody received
  std::int64_t broken = 0;  ///< that could not be read, and were logged and left out
};

/// Records from a camera (or any other source) until `options.stop` says so or the stream ends, as
/// a sequence folder that plays the same images again: as `write_sequence`, but the model may be
/// null and the source need not be calibrated. If the camera or the disk fails, what was recorded
/// before is kept and a CaptureError thrown that says so.
Recording record_sequence(FrameSource& source, const TriangleMesh* mesh,
                          const std::filesystem::path& folder,
                          const SequenceWriterOptions& options = {});

/// The same of several cameras: sequence folders camera_0, camera_1, ... in `folder`, in which
/// images of the same number belong together.
Recording record_sequences(FrameSetSource& source, const std::filesystem::path& folder,
                           const SequenceWriterOptions& options = {});

}  // namespace anneal6d
