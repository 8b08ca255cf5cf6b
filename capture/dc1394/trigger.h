// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <vector>

#include "anneal6d/capture/dc1394.h"
#include "camera.h"

namespace anneal6d::dc1394 {

/// Applies the trigger settings. Throws ConfigError naming the setting, the value and what the
/// camera allows; CaptureError if the camera does not answer.
void apply_trigger(const Camera& camera, const Dc1394Options& options);

/// Whether the camera waits for triggers.
bool waits_for_trigger(const Camera& camera);

/// Modes and sources; empty if the camera has no external trigger.
std::vector<Dc1394FeatureReport> report_trigger(const Camera& camera);

}  // namespace anneal6d::dc1394
