// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include "anneal6d/capture/dc1394_options.h"
#include "camera.h"

namespace anneal6d::dc1394 {

// Each applies what the options give and throws ConfigError naming the setting, the value and what
// the camera allows; CaptureError if the camera does not answer.

/// Switches the camera on, if it can be switched, and loads a memory channel.
void apply_power_and_memory(const Camera& camera, const Dc1394Options& options);

/// Saves the settings to a memory channel and waits until that is done.
void save_memory(const Camera& camera, const Dc1394Options& options);

/// Strobes and general purpose pins.
void apply_pins(const Camera& camera, const Dc1394Options& options);

void apply_lookup_table(const Camera& camera, const Dc1394Options& options);

/// Has the camera put its frame counter into the first pixels; returns whether it does.
bool apply_frame_info(const Camera& camera, const Dc1394Options& options);

}  // namespace anneal6d::dc1394
