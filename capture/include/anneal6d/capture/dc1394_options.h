// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core/types.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "anneal6d/framework/settings.h"

namespace anneal6d {

/// What a feature of an IIDC camera (gain, shutter, ...) is set to.
struct Dc1394FeatureSetting {
  enum class Mode { off, automatic, one_push, manual, absolute };
  Mode mode = Mode::automatic;
  std::vector<int> raw;  ///< manual: one value, of white balance two (blue/U, red/V)
  double absolute = 0;   ///< absolute: in the unit that `anneal6d list` shows
  std::string text;      ///< as given, for messages
};

/// An output pin that signals the exposure.
struct Dc1394Strobe {
  int pin = 0;
  bool active_high = false;
  int delay = 0;     ///< 0..4095, the camera's ticks
  int duration = 0;  ///< 0..4095, the camera's ticks; 0: as long as the exposure
};

/// How a camera at libdc1394 is set up. What is not given stays as the camera has it.
struct Dc1394Options {
  enum class Frames { newest, every };
  enum class Debayer { bilinear, edge_aware, vng, grey };
  enum class FrameInfo { if_present, on, off };

  /// "640x480-mono8" or "format7-0"; empty: the mode of the calibration's size, grey if there is
  /// one; without a calibration 640x480-mono8 or else the camera's first mode.
  std::string video_mode;
  std::string coding;           ///< Format_7: "mono8", "raw8", ...; empty: mono8 if there is one
  std::optional<cv::Rect> roi;  ///< Format_7: part of the mode's picture; default: all of it
  std::optional<int> packet_bytes;  ///< Format_7; default: as the camera recommends
  std::optional<double> fps;        ///< default: the fastest rate of the mode
  int iso_speed = 400;              ///< megabits a second: 100, 200, 400 or 800 (1394b)
  int buffers = 8;                  ///< frames in the ring of DMA buffers, 2..64
  /// Which frames `next` gives: the newest, passing over older ones that wait, or each of them.
  Frames frames = Frames::newest;
  int settle_frames = 2;       ///< dropped after the start, until settings have come into effect
  double stall_timeout_s = 3;  ///< without a frame; then CaptureError
  double recovery_timeout_s = 10;  ///< to wait for a camera that was unplugged; 0: not at all
  FrameInfo frame_info = FrameInfo::if_present;  ///< frame counter in the first pixels
  Debayer debayer = Debayer::bilinear;           ///< of raw codings
  std::string bayer_pattern;                     ///< "rggb", ...; empty: as the camera says

  /// By the setting's name: brightness, auto-exposure, sharpness, white-balance, hue, saturation,
  /// gamma, shutter, gain, iris, trigger-delay, frame-rate.
  std::map<std::string, Dc1394FeatureSetting> features;

  std::optional<int> trigger;  ///< mode 0, 1, 3, 4, 5, 14; -1: off
  std::string trigger_source;  ///< "0".."3" or "software"; empty: as it is
  std::optional<bool> trigger_active_high;
  std::optional<int> trigger_parameter;  ///< 0..4095, of modes 3 to 5
  std::vector<Dc1394Strobe> strobes;
  std::vector<bool> gpio_outputs;            ///< by pin: it is an output; empty: as they are
  std::optional<std::uint32_t> gpio_output;  ///< what the outputs show
  std::optional<int> memory_load;            ///< channel whose settings are loaded first
  std::optional<int> memory_save;            ///< channel that keeps the settings at the end
  std::vector<int> lookup_table;             ///< grey values by input; empty: as it is
  bool power_down = false;                   ///< switch the camera off when done

  /// Reads the settings of `dc1394_settings()`. Throws ConfigError naming a setting that is
  /// malformed, FileError for the file of the look-up table.
  static Dc1394Options from(const Settings& settings);
};

/// A setting of `Dc1394Options::from`, for help texts.
struct Dc1394SettingInfo {
  const char* name;
  const char* type;
  const char* help;
};
std::span<const Dc1394SettingInfo> dc1394_settings();

}  // namespace anneal6d
