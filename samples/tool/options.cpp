// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "options.h"

#include "anneal6d/capture/dc1394_options.h"
#include "anneal6d/framework/error.h"

namespace anneal6d {

namespace {

constexpr std::int64_t kMost = 1'000'000'000;  // frames: a year at 30 a second

void add_tracker_settings(CLI::App& command, Settings& settings) {
  const auto add = [&](const char* name, const char* type, const char* help) {
    add_setting(command, settings, name, type, help)->group("Tracker");
  };
  add("scorer", "NAME", "What compares poses with the image; see anneal6d list");
  add("mode", "default|thesis", "thesis: Algorithms 1 to 5 as written there");
  add("particles", "N", "Particles a layer, where the object must be searched");
  add("layers", "N", "Annealing layers of a search");
  add("sigma-mm", "MM", "Standard deviation of the motion from frame to frame, along each axis");
  add("sigma-deg", "DEGREES", "The same of the rotation, about each axis");
  add("edges", "sobel|prewitt|canny", "Edge operator");
  add("edge-threshold", "N|auto",
      "Sobel, Prewitt: the gradient that makes an edge; Canny: the high threshold");
  add("canny-low", "N|auto", "Canny's low threshold");
  add("edge-dilation", "PX", "How far the frame's edges are widened");
  add("edge-blur", "PX", "Gaussian blur before the edge operator, standard deviation");
  add("model-edge-threshold", "N", "The threshold for the edges of the rendered object");
  add("rating", "ratio|normalized|balanced", "How matches become likelihoods");
  add("rating-c", "C", "Steepness of the rating");
  add("rating-c1", "C", "First weight of the normalized rating");
  add("rating-c2", "C", "Second weight of the normalized rating");
  add("rating-c3", "C", "Third weight of the normalized rating");
  add("textured", "on|off", "Use the model's texture");
  add("annealing", "thesis|geometric", "How the thesis mode narrows its noise");
  add("annealing-ratio", "RATIO", "From layer to layer, for the geometric rule");
  add("drift", "on|off", "Let the thesis mode start at the last motion");
  add("view-cache", "FOLDER|off", "Where models' views are kept from run to run");
  add("threads", "N", "CPU threads; the poses do not depend on it");
}

}  // namespace

CLI::Option* add_setting(CLI::App& command, Settings& settings, const std::string& name,
                         const std::string& type, const std::string& help) {
  return command
      .add_option_function<std::string>(
          "--" + name, [&settings, name](const std::string& value) { settings.set(name, value); },
          help)
      ->type_name(type);
}

void add_tracking_options(CLI::App& command, TrackingOptions& options) {
  command.add_option("--model", options.model, "The object; default: model.obj of the sequence")
      ->type_name("FILE");
  command.add_option("--model-unit", options.model_unit, "Unit of the model's lengths, default mm")
      ->type_name("mm|cm|m");
  command
      .add_option("--camera", options.camera, "Calibration; default: camera.yml of the sequence")
      ->type_name("FILE");
  command
      .add_option("--init", options.init,
                  "Pose of the object in the first frame, camera_from_object, mm and unit "
                  "quaternion; default: the ground truth of that frame")
      ->type_name("\"tx ty tz qw qx qy qz\"");
  command.add_option("--start", options.start, "First frame, default 0")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{0}, kMost));
  command.add_option("--stride", options.stride, "Take every Nth frame, default 1")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{1}, kMost));
  command.add_option("--frames", options.frames, "Take at most N frames; default: all")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{1}, kMost));
  command.add_option("--tracker", options.tracker, "Default universal; see anneal6d list")
      ->type_name("NAME");
  command.add_option("--plugin", options.plugin, "Shared library with further trackers")
      ->type_name("FILE");
  options.settings.set("seed", "1");
  add_setting(command, options.settings, "seed", "N", "Seed of all random numbers, default 1");
  add_tracker_settings(command, options.settings);
}

void add_simulation_options(CLI::App& command, Settings& settings) {
  const auto add = [&](const char* name, const char* type, const char* help) {
    add_setting(command, settings, name, type, help)->group("Simulation");
  };
  add("motion", "random-walk|manipulation", "How the object moves");
  add("background", "none|clutter|FILE", "What is behind the object");
  add("light", "fixed|moving|changing", "How the scene is lit");
  add("noise", "LEVELS", "Standard deviation of the sensor's noise, grey levels");
  add("blur", "SHARE", "Exposure as a share of the time between frames, 0 to 1");
  add("supersampling", "N", "Samples a pixel in each direction, 1 to 8");
  add("occluder", "on|off", "A forearm sweeps in front of the object");
  add("occluder-size", "SHARE", "Its width in diameters of the object");
  add("occluder-speed", "PX", "Pixels it moves a frame");
}

void add_device_options(CLI::App& command, Settings& settings) {
  for (const Dc1394SettingInfo& setting : dc1394_settings()) {
    add_setting(command, settings, setting.name, setting.type, setting.help)
        ->group("FireWire camera (dc1394:)");
  }
}

bool is_simulation(const std::string& input) { return input.starts_with("simulate:"); }

void check_device_options(const std::string& input, const Settings& settings) {
  if (input.starts_with("dc1394:") || settings.begin() == settings.end()) return;
  throw ConfigError("--" + settings.begin()->first +
                    ": only for FireWire cameras (dc1394:), not for '" + input + "'");
}

void check_simulation_options(const std::string& input, const Settings& settings) {
  if (is_simulation(input) || settings.begin() == settings.end()) return;
  throw ConfigError("--" + settings.begin()->first + ": only for simulate:, not for '" + input +
                    "'");
}

}  // namespace anneal6d
