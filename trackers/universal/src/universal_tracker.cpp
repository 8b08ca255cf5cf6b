// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/trackers/universal_tracker.h"

#include <string>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "pose_filter_tracker.h"

namespace anneal6d {
namespace {

void warn_of_unread_settings(const Settings& settings) {
  for (const std::string name : {"annealing", "annealing-ratio", "drift"}) {
    if (settings.has(name)) {
      log(LogLevel::warning, "--" + name + " does nothing without --mode thesis");
    }
  }
}

}  // namespace

std::unique_ptr<RigidObjectTracker> make_universal_tracker(const TrackerSetup& setup) {
  if (!setup.mesh) throw ConfigError("a tracker needs a mesh");
  const auto options = UniversalTrackerOptions::from(setup.settings);
  if (options.mode == UniversalMode::standard) warn_of_unread_settings(setup.settings);
  return options.mode == UniversalMode::thesis ? make_thesis_tracker(setup, options)
                                               : make_default_tracker(setup, options);
}

}  // namespace anneal6d
