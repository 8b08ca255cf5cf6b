// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "anneal6d/framework/settings.h"

namespace anneal6d {

/// The options that `track` and `evaluate` share. Empty texts: not given.
struct TrackingOptions {
  std::string model;
  std::string model_unit = "mm";
  std::string camera;
  std::string init;  ///< "tx ty tz qw qx qy qz"
  std::string tracker = "universal";
  std::string plugin;
  std::int64_t start = 0;              ///< frames passed over at the beginning
  std::int64_t stride = 1;             ///< every so many frames one is taken
  std::optional<std::int64_t> frames;  ///< how many frames are taken at most
  /// The tracker's: those that the user gave, and the seed, so that it can be reported.
  Settings settings;
  Settings device;  ///< of the camera: see `add_device_options`
};

void add_tracking_options(CLI::App& command, TrackingOptions& options);

/// Where the object's motion and picture are simulated: names are those of the simulation's
/// settings. `settings` gets what the user gave.
void add_simulation_options(CLI::App& command, Settings& settings);

/// How a FireWire camera is set up. `settings` gets what the user gave.
void add_device_options(CLI::App& command, Settings& settings);

/// Whether an INPUT is "simulate:".
bool is_simulation(const std::string& input);

/// Throws ConfigError if device options were given for an input that has no such device.
void check_device_options(const std::string& input, const Settings& settings);

/// The same of simulation options and an input that is not simulated.
void check_simulation_options(const std::string& input, const Settings& settings);

/// `--name`, kept as typed: whoever reads the setting checks the value.
CLI::Option* add_setting(CLI::App& command, Settings& settings, const std::string& name,
                         const std::string& type, const std::string& help);

}  // namespace anneal6d
