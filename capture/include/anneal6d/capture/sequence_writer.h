// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

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
};

/// Writes what `source` still has as a sequence folder: frame_0000.png..., camera.yml, model.obj
/// (with model.mtl and model.png for colours and texture; millimetres), groundtruth.csv (if the
/// source knows the truth) and meta.json. Frames are numbered from 0. Everything goes to a
/// temporary folder beside `folder`, which takes its name at the end: nothing half-written is left.
/// Returns the number of frames. Throws FileError (`folder` is a file or a non-empty folder; cannot
/// be written), ConfigError (a bad option, a source without calibration or without any frame), and
/// what the source throws.
std::int64_t write_sequence(FrameSource& source, const TriangleMesh& mesh,
                            const std::filesystem::path& folder,
                            const SequenceWriterOptions& options = {});

}  // namespace anneal6d
