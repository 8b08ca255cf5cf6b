// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "camera_features.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anneal6d/framework/log.h"

namespace anneal6d::dc1394 {
namespace {

using FeatureMode = Dc1394FeatureSetting::Mode;

// Names of the settings, units of the absolute values (IIDC 1.31, 4.7) and how many of the unit
// that we show make one of IIDC's.
struct Feature {
  const char* name;
  dc1394feature_t id;
  const char* unit;
  double scale;
};
constexpr Feature kFeatures[] = {
    {"brightness", DC1394_FEATURE_BRIGHTNESS, "%", 1},
    {"auto-exposure", DC1394_FEATURE_EXPOSURE, "EV", 1},
    {"sharpness", DC1394_FEATURE_SHARPNESS, "", 1},
    {"white-balance", DC1394_FEATURE_WHITE_BALANCE, "K", 1},
    {"hue", DC1394_FEATURE_HUE, "deg", 1},
    {"saturation", DC1394_FEATURE_SATURATION, "%", 1},
    {"gamma", DC1394_FEATURE_GAMMA, "", 1},
    {"shutter", DC1394_FEATURE_SHUTTER, "ms", 1000},
    {"gain", DC1394_FEATURE_GAIN, "dB", 1},
    {"iris", DC1394_FEATURE_IRIS, "F", 1},
    {"trigger-delay", DC1394_FEATURE_TRIGGER_DELAY, "ms", 1000},
    {"frame-rate", DC1394_FEATURE_FRAME_RATE, "fps", 1},
};

const Feature& feature_of(const std::string& name) {
  return *std::find_if(std::begin(kFeatures), std::end(kFeatures),
                       [&](const Feature& row) { return row.name == name; });
}

std::string plain(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string with_unit(double value, const Feature& feature) {
  return plain(value) + (*feature.unit != '\0' ? " " : "") + feature.unit;
}

// What one feature of one camera allows.
class Limits {
 public:
  Limits(const Camera& camera, const Feature& feature) : feature_(&feature) {
    info_.id = feature.id;
    check(dc1394_feature_get(camera.get(), &info_), camera.name(),
          std::string("read the feature ") + feature.name);
  }

  const dc1394feature_info_t& info() const { return info_; }
  bool present() const { return info_.available == DC1394_TRUE; }
  bool switchable() const { return info_.on_off_capable == DC1394_TRUE; }
  bool absolute() const { return info_.absolute_capable == DC1394_TRUE; }
  double lowest() const { return info_.abs_min * feature_->scale; }
  double highest() const { return info_.abs_max * feature_->scale; }

  bool has(dc1394feature_mode_t mode) const {
    const auto* end = info_.modes.modes + info_.modes.num;
    return std::find(info_.modes.modes, end, mode) != end;
  }

  // A camera may keep what is asked of it in single precision.
  bool in_range(double value) const {
    const double slack = 1e-6 * std::max(std::abs(lowest()), std::abs(highest()));
    return value >= lowest() - slack && value <= highest() + slack;
  }

  std::string allowed() const {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (switchable()) add("off");
    if (has(DC1394_FEATURE_MODE_AUTO)) add("auto");
    if (has(DC1394_FEATURE_MODE_ONE_PUSH_AUTO)) add("one-push");
    if (has(DC1394_FEATURE_MODE_MANUAL)) {
      const std::string range = std::to_string(info_.min) + ".." + std::to_string(info_.max);
      add(feature_->id == DC1394_FEATURE_WHITE_BALANCE ? range + "," + range : range);
      if (absolute()) add("abs:" + plain(lowest()) + ".." + with_unit(highest(), *feature_));
    }
    return text.empty() ? "nothing, it can only be read" : text;
  }

  std::string current() const {
    if (switchable() && info_.is_on == DC1394_OFF) return "off";
    std::string text = info_.current_mode == DC1394_FEATURE_MODE_AUTO ? "auto " : "";
    text += feature_->id == DC1394_FEATURE_WHITE_BALANCE
                ? std::to_string(info_.BU_value) + "," + std::to_string(info_.RV_value)
                : std::to_string(info_.value);
    if (absolute()) text += ", " + with_unit(info_.abs_value * feature_->scale, *feature_);
    return text;
  }

  // Empty if the camera allows the setting.
  std::string objection(const Dc1394FeatureSetting& setting) const {
    if (!present()) return "the camera has no such feature";
    const bool manual = has(DC1394_FEATURE_MODE_MANUAL);
    bool allowed_here = false;
    switch (setting.mode) {
      case FeatureMode::off:
        allowed_here = switchable();
        break;
      case FeatureMode::automatic:
        allowed_here = has(DC1394_FEATURE_MODE_AUTO);
        break;
      case FeatureMode::one_push:
        allowed_here = has(DC1394_FEATURE_MODE_ONE_PUSH_AUTO);
        break;
      case FeatureMode::manual:
        allowed_here =
            manual && std::all_of(setting.raw.begin(), setting.raw.end(), [&](int raw) {
              return raw >= static_cast<int>(info_.min) && raw <= static_cast<int>(info_.max);
            });
        break;
      case FeatureMode::absolute:
        allowed_here = manual && absolute() && in_range(setting.absolute);
        break;
    }
    return allowed_here ? std::string() : "the camera allows " + allowed();
  }

 private:
  const Feature* feature_;
  dc1394feature_info_t info_{};
};

void set_mode(const Camera& camera, const Feature& feature, dc1394feature_mode_t mode) {
  check(dc1394_feature_set_mode(camera.get(), feature.id, mode), camera.name(),
        std::string("set the mode of ") + feature.name);
}

void set_absolute_control(const Camera& camera, const Feature& feature, dc1394switch_t on) {
  check(dc1394_feature_set_absolute_control(camera.get(), feature.id, on), camera.name(),
        std::string("switch the absolute control of ") + feature.name);
}

void set_raw(const Camera& camera, const Feature& feature, const std::vector<int>& raw) {
  const auto first = static_cast<std::uint32_t>(raw.front());
  const auto last = static_cast<std::uint32_t>(raw.back());
  const dc1394error_t result =
      feature.id == DC1394_FEATURE_WHITE_BALANCE
          ? dc1394_feature_whitebalance_set_value(camera.get(), first, last)
          : dc1394_feature_set_value(camera.get(), feature.id, first);
  check(result, camera.name(), std::string("set ") + feature.name);
  const Limits now(camera, feature);
  const std::uint32_t kept =
      feature.id == DC1394_FEATURE_WHITE_BALANCE ? now.info().BU_value : now.info().value;
  if (kept != first) {
    log(LogLevel::warning, camera.name() + " keeps " + std::to_string(kept) + " for " +
                               feature.name + " instead of " + std::to_string(first));
  }
}

}  // namespace

std::vector<Dc1394FeatureReport> report_features(const Camera& camera) {
  std::vector<Dc1394FeatureReport> reports;
  for (const Feature& feature : kFeatures) {
    const Limits limits(camera, feature);
    if (limits.present()) reports.push_back({feature.name, limits.allowed(), limits.current()});
  }
  return reports;
}

void apply_feature(const Camera& camera, const std::string& name,
                   const Dc1394FeatureSetting& setting) {
  const Feature& feature = feature_of(name);
  const Limits limits(camera, feature);
  if (const std::string objection = limits.objection(setting); !objection.empty()) {
    refuse_setting(camera, name, setting.text, objection);
  }
  if (limits.switchable()) {
    const dc1394switch_t on = setting.mode == FeatureMode::off ? DC1394_OFF : DC1394_ON;
    check(dc1394_feature_set_power(camera.get(), feature.id, on), camera.name(), "switch " + name);
  }
  switch (setting.mode) {
    case FeatureMode::off:
      return;
    case FeatureMode::automatic:
      set_mode(camera, feature, DC1394_FEATURE_MODE_AUTO);
      return;
    case FeatureMode::one_push:
      set_mode(camera, feature, DC1394_FEATURE_MODE_ONE_PUSH_AUTO);
      return;
    case FeatureMode::manual:
      if (limits.absolute()) set_absolute_control(camera, feature, DC1394_OFF);
      if (limits.info().modes.num > 0) set_mode(camera, feature, DC1394_FEATURE_MODE_MANUAL);
      set_raw(camera, feature, setting.raw);
      return;
    case FeatureMode::absolute:
      set_mode(camera, feature, DC1394_FEATURE_MODE_MANUAL);
      set_absolute_control(camera, feature, DC1394_ON);
      check(dc1394_feature_set_absolute_value(camera.get(), feature.id,
                                              static_cast<float>(setting.absolute / feature.scale)),
            camera.name(), "set " + name);
      return;
  }
}

std::optional<double> absolute_value(const Camera& camera, const std::string& name) {
  const Feature& feature = feature_of(name);
  const Limits limits(camera, feature);
  if (!limits.present() || !limits.absolute()) return std::nullopt;
  return limits.info().abs_value * feature.scale;
}

}  // namespace anneal6d::dc1394
