// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "anneal6d/framework/frame.h"

namespace anneal6d {

/// Frames of several cameras, exposed at the same time.
struct FrameSet {
  std::vector<Frame> frames;     ///< one a camera, in the cameras' order
  double spread_s = 0;           ///< between the first and the last exposure
  std::int64_t lost_before = 0;  ///< sets that were not complete since the last one
};

/// Port: several cameras as one source, for stereo and more.
class FrameSetSource {
 public:
  virtual ~FrameSetSource() = default;
  /// The next set of simultaneous frames; empty at the end. Throws CaptureError.
  virtual std::optional<FrameSet> next() = 0;
  virtual std::string description() const = 0;
  virtual std::size_t size() const = 0;
};

}  // namespace anneal6d
