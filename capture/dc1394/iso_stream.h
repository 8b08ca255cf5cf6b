// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <dc1394/dc1394.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include "anneal6d/capture/dc1394_options.h"
#include "camera.h"

namespace anneal6d::dc1394 {

struct GiveBack {
  void operator()(dc1394video_frame_t* frame) const;
};
/// A frame in the DMA ring; goes back to the camera when it is let go.
using RingFrame = std::unique_ptr<dc1394video_frame_t, GiveBack>;

/// A camera that sends. Bus and camera are left as they were found: silent, nothing reserved.
class IsoStream {
 public:
  enum class Outcome { frame, nothing, gone };
  struct Received {
    Outcome outcome = Outcome::nothing;
    RingFrame frame;
    std::int64_t passed_over = 0;  ///< complete frames before it that nobody wanted
  };

  /// Reserves channel and bandwidth and has the camera send. Throws BackendUnavailable (another
  /// program receives from it, no bandwidth), ConfigError (speed), CaptureError.
  IsoStream(const Camera& camera, const Dc1394Options& options);
  ~IsoStream();
  IsoStream(const IsoStream&) = delete;
  IsoStream& operator=(const IsoStream&) = delete;

  /// Waits for a frame, at most this long; `newest` passes over all that wait but the last.
  /// Frames that arrived only in part are left out.
  Received receive(std::chrono::milliseconds patience, bool newest);

 private:
  bool take_next(RingFrame& frame);

  const Camera* camera_;
  int ring_size_;
  bool gone_ = false;
};

/// Stops a camera that sends although no program listens. Throws BackendUnavailable if one does.
void silence(const Camera& camera);

}  // namespace anneal6d::dc1394
