// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <optional>

#include "anneal6d/framework/frame_source.h"

namespace anneal6d {

/// Takes the frames that --start, --stride and --frames choose, and goes on past broken ones.
class FrameReader {
 public:
  /// `source` outlives the reader.
  FrameReader(FrameSource& source, std::int64_t start, std::int64_t stride,
              std::optional<std::int64_t> frames);

  /// The next chosen frame that can be read; empty at the end. A broken one is logged and counted,
  /// except before the first good one: then its FileError is thrown, since the initial pose belongs
  /// to that frame. Throws CaptureError if the device failed.
  std::optional<Frame> next();

  std::int64_t broken() const { return broken_; }

 private:
  FrameSource* source_;
  std::int64_t to_skip_;  // before the next frame
  std::int64_t stride_;
  std::optional<std::int64_t> left_;
  std::int64_t broken_ = 0;
  bool started_ = false;
};

}  // namespace anneal6d
