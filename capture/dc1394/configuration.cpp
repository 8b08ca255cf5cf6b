// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <algorithm>
#include <cstdio>

#include "camera_features.h"
#include "dc1394_source.h"
#include "extras.h"
#include "trigger.h"

namespace anneal6d::dc1394 {
namespace {

// Frames come at the slower of the two: what the bus carries and what the camera's own rate
// control, if it is on, allows. Without rate control the shutter decides.
double free_running_period(const Camera& camera, const VideoFormat& format) {
  dc1394switch_t rate_on = DC1394_OFF;
  dc1394bool_t has_rate = DC1394_FALSE;
  dc1394_feature_is_present(camera.get(), DC1394_FEATURE_FRAME_RATE, &has_rate);
  if (has_rate == DC1394_FALSE) return format.period_s;
  dc1394_feature_get_power(camera.get(), DC1394_FEATURE_FRAME_RATE, &rate_on);
  if (rate_on == DC1394_OFF) return 0;
  if (format.packet_bytes == 0) return format.period_s;  // a fixed mode has a fixed rate
  const auto fps = absolute_value(camera, "frame-rate");
  return fps && *fps > 0 ? std::max(1.0 / *fps, format.period_s) : 0;
}

}  // namespace

Configuration configure(const Camera& camera, const Dc1394Options& options,
                        const std::optional<CameraModel>& calibration) {
  apply_power_and_memory(camera, options);
  Configuration configuration;
  configuration.format = apply_video_format(camera, options, calibration);
  // The frame rate first: without rate control the shutter may be longer than a frame.
  if (const auto rate = options.features.find("frame-rate"); rate != options.features.end()) {
    apply_feature(camera, rate->first, rate->second);
  }
  for (const auto& [name, setting] : options.features) {
    if (name != "frame-rate") apply_feature(camera, name, setting);
  }
  apply_trigger(camera, options);
  apply_pins(camera, options);
  apply_lookup_table(camera, options);
  configuration.counts_frames = apply_frame_info(camera, options);
  configuration.triggered = waits_for_trigger(camera);
  configuration.period_s =
      configuration.triggered ? 0 : free_running_period(camera, configuration.format);
  return configuration;
}

void check_patience(const Camera& camera, const Dc1394Options& options, double period_s) {
  const double shutter_s = absolute_value(camera, "shutter").value_or(0) * 1e-3;
  const double needed_s = 2 * std::max(period_s, shutter_s);
  if (options.stall_timeout_s >= needed_s) return;
  char given[32], needed[32];
  std::snprintf(given, sizeof given, "%.4g", options.stall_timeout_s);
  std::snprintf(needed, sizeof needed, "%.4g", needed_s);
  refuse_setting(camera, "stall-timeout", given,
                 std::string("a frame takes half of ") + needed +
                     " s with its shutter and frame rate; give at least " + needed);
}

}  // namespace anneal6d::dc1394
