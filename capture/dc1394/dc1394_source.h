// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "anneal6d/capture/dc1394.h"
#include "anneal6d/framework/frame_source.h"
#include "camera.h"
#include "decoder.h"
#include "feature_snapshot.h"
#include "frame_clock.h"
#include "iso_stream.h"
#include "video_format.h"

namespace anneal6d::dc1394 {

/// The settings of a camera, applied.
struct Configuration {
  VideoFormat format;
  bool counts_frames = false;  ///< its pictures carry a counter
  bool triggered = false;      ///< by a pin or by software
  double period_s = 0;         ///< from frame to frame; 0: not known
};

/// Checks all settings and applies them to a camera that does not send. Throws as
/// `open_dc1394_camera`.
Configuration configure(const Camera& camera, const Dc1394Options& options,
                        const std::optional<CameraModel>& calibration);

/// Throws ConfigError if the stall timeout would take a camera that is only slow, by its shutter or
/// frame rate, for one that has failed. `period_s` as in Configuration.
void check_patience(const Camera& camera, const Dc1394Options& options, double period_s);

/// A frame with the time of its exposure on the host's clock.
struct TimedFrame {
  Frame frame;
  std::uint64_t time_us = 0;
};

/// One camera, kept going.
class Dc1394Source : public FrameSource {
 public:
  Dc1394Source(const std::string& guid, Dc1394Options options, std::optional<CameraModel> camera);
  ~Dc1394Source() override;

  std::optional<Frame> next() override { return next_timed(options_.frames).frame; }
  std::string description() const override;
  std::optional<CameraModel> camera() const override { return calibration_; }

  /// Whatever the options say: the newest frame, or the next in order.
  TimedFrame next_timed(Dc1394Options::Frames which);
  const std::string& name() const { return name_; }
  std::uint64_t guid() const { return guid_; }
  double period_s() const { return configuration_.period_s; }

 private:
  using Clock = std::chrono::steady_clock;

  void start(std::unique_ptr<Camera> camera);
  void stop();
  void let_go(const std::string& why);
  void wait_for_camera();
  void fire_trigger();
  void look_after_silent_camera(bool patience_is_short);
  std::optional<TimedFrame> take(IsoStream::Received received);

  Dc1394Options options_;
  std::optional<CameraModel> calibration_;
  std::uint64_t guid_ = 0;
  std::string name_;
  std::unique_ptr<Camera> camera_;           // null while it is unplugged
  std::unique_ptr<IsoStream> stream_;        // before the camera it goes
  std::optional<FeatureSnapshot> features_;  // as they were at the first start
  Configuration configuration_;
  std::optional<Decoder> decoder_;
  std::optional<FrameClock> clock_;
  int unsettled_ = 0;                  // frames still to be dropped
  std::int64_t passed_unsettled_ = 0;  // frames dropped since the last one handed out
  std::uint32_t generation_ = 0;
};

}  // namespace anneal6d::dc1394
