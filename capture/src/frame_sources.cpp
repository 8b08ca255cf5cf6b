// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/frame_sources.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "anneal6d/capture/camera_source.h"
#include "anneal6d/capture/dc1394.h"
#include "anneal6d/capture/sequence_source.h"
#include "anneal6d/capture/video_source.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"

namespace anneal6d {
namespace {

constexpr std::string_view kForms =
    "an input is a sequence folder, a video file, camera:N, dc1394:GUID or simulate:";

std::string always_available() { return {}; }

int camera_number(const std::string& input) {
  const std::string text = input_argument(input);
  const std::optional<long long> number = text.empty() ? 0 : parse_integer(text);
  if (!number || *number < 0 || *number > 9999) {
    throw ConfigError("'" + input + "' names no camera: write camera:N with N as in /dev/videoN");
  }
  return static_cast<int>(*number);
}

std::unique_ptr<FrameSource> make_simulation(const FrameSourceSetup& setup) {
  if (!input_argument(setup.input).empty()) {
    throw ConfigError("'" + setup.input +
                      "': nothing may follow 'simulate:'; what is simulated "
                      "is given by options (--model, --motion, --frames, ...)");
  }
  if (!setup.mesh) throw ConfigError("simulate: needs the model of an object (--model FILE)");
  return std::make_unique<SimulationSource>(
      setup.mesh, setup.camera.value_or(default_simulation_camera()),
      SimulationOptions::from(setup.settings), setup.make_renderer);
}

// The name before the colon; empty if there is none. One letter is a drive ("C:\video.mp4").
std::string scheme_of(const std::string& input) {
  const std::size_t colon = input.find(':');
  if (colon == std::string::npos || colon < 2) return {};
  const std::string name = input.substr(0, colon);
  const bool is_name = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  return is_name ? name : std::string();
}

}  // namespace

std::string input_argument(const std::string& input) {
  const std::size_t colon = input.find(':');
  return colon == std::string::npos ? std::string() : input.substr(colon + 1);
}

FrameSourceTable frame_source_plugins() {
  return {
      {"sequence", "a folder of images with calibration and ground truth", always_available,
       [](const FrameSourceSetup& setup) {
         return std::make_unique<SequenceSource>(setup.input, setup.camera);
       }},
      {"video", "a video file", always_available,
       [](const FrameSourceSetup& setup) {
         return std::make_unique<VideoSource>(setup.input, setup.camera);
       }},
      {"camera", "camera:N, a webcam", always_available,
       [](const FrameSourceSetup& setup) {
         return std::make_unique<CameraSource>(camera_number(setup.input), setup.camera);
       }},
      {"dc1394", "dc1394:GUID or dc1394:, a FireWire camera (IIDC, Dragonfly2)",
       why_dc1394_is_unavailable,
       [](const FrameSourceSetup& setup) {
         return open_dc1394_camera(input_argument(setup.input), Dc1394Options::from(setup.settings),
                                   setup.camera);
       }},
      {"simulate", "simulate:, a drawn object that moves", always_available, make_simulation},
  };
}

std::unique_ptr<FrameSource> open_frame_source(const FrameSourceTable& table,
                                               const FrameSourceSetup& setup) {
  constexpr std::string_view kind = "frame source";
  std::error_code ignored;
  if (std::filesystem::is_directory(setup.input, ignored)) {
    return make_plugin(table, kind, "sequence", setup);
  }
  if (std::filesystem::is_regular_file(setup.input, ignored)) {
    return make_plugin(table, kind, "video", setup);
  }
  const std::string scheme = scheme_of(setup.input);
  if (!scheme.empty()) return make_plugin(table, kind, scheme, setup);
  throw FileError(setup.input, "", "there is no such folder or file; " + std::string(kForms));
}

}  // namespace anneal6d
