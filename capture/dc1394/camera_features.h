// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <string>
#include <vector>

#include "anneal6d/capture/dc1394.h"
#include "camera.h"

namespace anneal6d::dc1394 {

/// The features that the camera has, with what it allows and what is set.
std::vector<Dc1394FeatureReport> report_features(const Camera& camera);

/// Checks a setting against the camera and applies it. Throws ConfigError naming the setting, the
/// value and what the camera allows (absent feature, mode, value out of range); CaptureError if
/// the camera refuses or does not keep a value.
void apply_feature(const Camera& camera, const std::string& name,
                   const Dc1394FeatureSetting& setting);

/// The camera's absolute value, in the unit that the settings use. Empty if it has none.
std::optional<double> absolute_value(const Camera& camera, const std::string& name);

}  // namespace anneal6d::dc1394
