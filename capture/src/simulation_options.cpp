// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/simulation_options.h"

#include <charconv>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/pose_file.h"

namespace anneal6d {
namespace {

struct Range {
  double low, high;
};
constexpr Range kFrames{1, 1'000'000};
constexpr Range kSigma_mm{0, 100};
constexpr Range kSigma_deg{0, 45};
constexpr Range kOccluderSize{0.05, 2};
constexpr Range kOccluderSpeed_px{0, 500};
constexpr Range kNoise{0, 64};
constexpr Range kBlur{0, 1};
constexpr Range kSupersampling{1, 8};

void check(const char* name, double value, const Range& range) {
  if (value >= range.low && value <= range.high) return;  // false for NaN, too
  throw ConfigError("simulation: " + std::string(name) + " is " + std::to_string(value) +
                    ", it must lie within " + std::to_string(range.low) + " and " +
                    std::to_string(range.high));
}

// Shortest text that reads back exactly, independent of the locale.
std::string text_of(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string text_of(const Pose& pose) {
  const Eigen::Vector3d& t = pose.translation_mm;
  const Eigen::Quaterniond& q = pose.rotation;
  std::string text;
  for (const double value : {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()}) {
    text += (text.empty() ? "" : " ") + text_of(value);
  }
  return text;
}

}  // namespace

std::string_view to_string(SimulatedMotion motion) {
  return motion == SimulatedMotion::random_walk ? "random-walk" : "manipulation";
}

std::string_view to_string(SimulatedLight light) {
  switch (light) {
    case SimulatedLight::moving:
      return "moving";
    case SimulatedLight::changing:
      return "changing";
    case SimulatedLight::fixed:
      break;
  }
  return "fixed";
}

SimulatedMotion parse_simulated_motion(std::string_view text) {
  if (text == "random-walk") return SimulatedMotion::random_walk;
  if (text == "manipulation") return SimulatedMotion::manipulation;
  throw ConfigError("motion is '" + std::string(text) +
                    "'; it must be random-walk or manipulation");
}

SimulatedLight parse_simulated_light(std::string_view text) {
  if (text == "fixed") return SimulatedLight::fixed;
  if (text == "moving") return SimulatedLight::moving;
  if (text == "changing") return SimulatedLight::changing;
  throw ConfigError("light is '" + std::string(text) + "'; it must be fixed, moving or changing");
}

void SimulationOptions::validate() const {
  check("frames", frames, kFrames);
  check("sigma-mm", sigma_mm, kSigma_mm);
  check("sigma-deg", sigma_deg, kSigma_deg);
  check("occluder-size", occluder_size, kOccluderSize);
  check("occluder-speed", occluder_speed_px, kOccluderSpeed_px);
  check("noise", noise, kNoise);
  check("blur", blur, kBlur);
  check("supersampling", supersampling, kSupersampling);
  if (background.empty()) {
    throw ConfigError("simulation: background is empty; it must be none, clutter or an image file");
  }
  if (start && !start->is_finite()) {
    throw ConfigError("simulation: the start pose (init) holds a number that is not finite");
  }
}

SimulationOptions SimulationOptions::from(const Settings& settings) {
  SimulationOptions options;
  const auto number = [&settings](const char* name, const Range& range, double& value) {
    value = settings.number(name, range.low, range.high).value_or(value);
  };
  const auto integer = [&settings](const char* name, const Range& range, int& value) {
    value = settings.integer(name, static_cast<int>(range.low), static_cast<int>(range.high))
                .value_or(value);
  };
  integer("frames", kFrames, options.frames);
  options.seed = settings.natural_number("seed").value_or(options.seed);
  if (const auto text = settings.text("motion")) options.motion = parse_simulated_motion(*text);
  number("sigma-mm", kSigma_mm, options.sigma_mm);
  number("sigma-deg", kSigma_deg, options.sigma_deg);
  if (const auto text = settings.text("init")) options.start = parse_pose(*text);
  options.background = settings.text("background").value_or(options.background);
  if (const auto text = settings.text("light")) options.light = parse_simulated_light(*text);
  options.occluder = settings.flag("occluder").value_or(options.occluder);
  number("occluder-size", kOccluderSize, options.occluder_size);
  number("occluder-speed", kOccluderSpeed_px, options.occluder_speed_px);
  number("noise", kNoise, options.noise);
  number("blur", kBlur, options.blur);
  integer("supersampling", kSupersampling, options.supersampling);
  options.validate();
  return options;
}

Settings SimulationOptions::to_settings() const {
  Settings settings;
  settings.set("frames", std::to_string(frames));
  settings.set("seed", std::to_string(seed));
  settings.set("motion", std::string(to_string(motion)));
  settings.set("sigma-mm", text_of(sigma_mm));
  settings.set("sigma-deg", text_of(sigma_deg));
  if (start) settings.set("init", text_of(*start));
  settings.set("background", background);
  settings.set("light", std::string(to_string(light)));
  settings.set("occluder", occluder ? "true" : "false");
  settings.set("occluder-size", text_of(occluder_size));
  settings.set("occluder-speed", text_of(occluder_speed_px));
  settings.set("noise", text_of(noise));
  settings.set("blur", text_of(blur));
  settings.set("supersampling", std::to_string(supersampling));
  return settings;
}

}  // namespace anneal6d
