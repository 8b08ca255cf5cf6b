// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/settings.h"

namespace anneal6d {

enum class SimulatedMotion {
  random_walk,   ///< an independent Gaussian step each frame, as in the thesis (6.2)
  manipulation,  ///< smooth reaches from place to place, as of a hand
};

enum class SimulatedLight {
  fixed,
  moving,    ///< the lamp circles the viewing axis, once in 120 frames
  changing,  ///< brightness swings by a third, once in 60 frames, but for the forearm
};

/// What a simulation shows (thesis simulation mode). In brackets: the setting that `from` reads.
struct SimulationOptions {
  int frames = 100;        ///< [frames] 1..1,000,000
  std::uint64_t seed = 1;  ///< [seed] the same seed and options give the same pixels
  SimulatedMotion motion = SimulatedMotion::random_walk;  ///< [motion] random-walk, manipulation
  /// [sigma-mm] Standard deviation of a frame's translation along each axis of the camera frame,
  /// 0..100; of a manipulation, over the time that the hand moves.
  double sigma_mm = 5;
  /// [sigma-deg] The same of the rotation vector, in the camera frame, about the object's origin (a
  /// manipulation: about its centre), 0..45.
  double sigma_deg = 2;
  /// [init] camera_from_object of the first frame. Empty: the model's y axis points up, seen
  /// obliquely from above, so far away that its diameter covers 40 % of the image's height.
  std::optional<Pose> start;

  /// [background] "none": black, as in the thesis; "clutter": boxes, discs, lines and gradients
  /// drawn by seed; anything else: an image file, scaled and cut to fill the frame.
  std::string background = "none";
  SimulatedLight light = SimulatedLight::fixed;  ///< [light] fixed, moving, changing
  bool occluder = false;  ///< [occluder] a forearm sweeps to and fro in front of the object
  /// [occluder-size] Width of the forearm as a share of the object's diameter in the first frame,
  /// 0.05..2.
  double occluder_size = 0.4;
  double occluder_speed_px = 6;  ///< [occluder-speed] pixels a frame, 0..500

  double noise = 0;  ///< [noise] standard deviation of the sensor's noise, grey levels, 0..64
  /// [blur] How long the shutter is open around the frame's moment, as a share of the time between
  /// frames, 0..1; 0: no motion blur.
  double blur = 0;
  /// [supersampling] The object is drawn this many times as densely in each direction and averaged
  /// down, 1..8.
  int supersampling = 4;

  /// Throws ConfigError naming the bad field.
  void validate() const;

  /// The defaults, with what `settings` says in place; other settings are ignored. Throws
  /// ConfigError naming the setting.
  static SimulationOptions from(const Settings& settings);

  /// Every option as a setting, such that `from` gives these options again: for the record.
  Settings to_settings() const;
};

std::string_view to_string(SimulatedMotion motion);
std::string_view to_string(SimulatedLight light);
/// "random-walk", "manipulation"; anything else throws ConfigError.
SimulatedMotion parse_simulated_motion(std::string_view text);
/// "fixed", "moving", "changing"; anything else throws ConfigError.
SimulatedLight parse_simulated_light(std::string_view text);

}  // namespace anneal6d
