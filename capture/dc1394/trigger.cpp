// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "trigger.h"

#include <algorithm>

namespace anneal6d::dc1394 {
namespace {

constexpr std::uint64_t kTriggerControl = 0x830;
constexpr std::uint32_t kTriggerParameter = 0x00000FFFU;

dc1394feature_info_t trigger_info(const Camera& camera) {
  dc1394feature_info_t info{};
  info.id = DC1394_FEATURE_TRIGGER;
  check(dc1394_feature_get(camera.get(), &info), camera.name(), "read the trigger");
  return info;
}

// Trigger modes are numbered 0 to 5, 14, 15; the library counts them without gaps.
int mode_number(dc1394trigger_mode_t mode) {
  const int place = mode - DC1394_TRIGGER_MODE_0;
  return place <= 5 ? place : place + 8;
}

std::string all_modes(const dc1394feature_info_t& info) {
  std::string all = "off";
  for (std::uint32_t i = 0; i < info.trigger_modes.num; ++i) {
    all += ", " + std::to_string(mode_number(info.trigger_modes.modes[i]));
  }
  return all;
}

std::string source_name(dc1394trigger_source_t source) {
  return source == DC1394_TRIGGER_SOURCE_SOFTWARE
             ? std::string("software")
             : std::to_string(source - DC1394_TRIGGER_SOURCE_0);
}

std::string all_sources(const dc1394feature_info_t& info) {
  std::string all;
  for (std::uint32_t i = 0; i < info.trigger_sources.num; ++i) {
    all += (i == 0 ? "" : ", ") + source_name(info.trigger_sources.sources[i]);
  }
  return all;
}

void set_trigger_mode(const Camera& camera, const dc1394feature_info_t& info, int number) {
  for (std::uint32_t i = 0; i < info.trigger_modes.num; ++i) {
    const dc1394trigger_mode_t mode = info.trigger_modes.modes[i];
    if (mode_number(mode) != number) continue;
    check(dc1394_external_trigger_set_mode(camera.get(), mode), camera.name(),
          "set the trigger mode");
    check(dc1394_external_trigger_set_power(camera.get(), DC1394_ON), camera.name(),
          "switch the trigger on");
    return;
  }
  refuse_setting(camera, "trigger", std::to_string(number), "it has " + all_modes(info));
}

void set_trigger_source(const Camera& camera, const dc1394feature_info_t& info,
                        const std::string& name) {
  const dc1394trigger_source_t wanted =
      name == "software"
          ? DC1394_TRIGGER_SOURCE_SOFTWARE
          : static_cast<dc1394trigger_source_t>(DC1394_TRIGGER_SOURCE_0 + (name.front() - '0'));
  const auto* end = info.trigger_sources.sources + info.trigger_sources.num;
  if (std::find(info.trigger_sources.sources, end, wanted) == end) {
    refuse_setting(camera, "trigger-source", name, "it has " + all_sources(info));
  }
  check(dc1394_external_trigger_set_source(camera.get(), wanted), camera.name(),
        "set the trigger source");
}

}  // namespace

std::vector<Dc1394FeatureReport> report_trigger(const Camera& camera) {
  const dc1394feature_info_t info = trigger_info(camera);
  if (info.available == DC1394_FALSE) return {};
  const bool on = info.is_on == DC1394_ON;
  return {{"trigger", all_modes(info),
           on ? std::to_string(mode_number(info.trigger_mode)) : std::string("off")},
          {"trigger-source", all_sources(info), source_name(info.trigger_source)}};
}

void apply_trigger(const Camera& camera, const Dc1394Options& options) {
  if (!options.trigger && options.trigger_source.empty() && !options.trigger_active_high &&
      !options.trigger_parameter) {
    return;
  }
  const dc1394feature_info_t info = trigger_info(camera);
  if (info.available == DC1394_FALSE) {
    refuse_setting(camera, "trigger", options.trigger ? std::to_string(*options.trigger) : "",
                   "it has no external trigger");
  }
  if (!options.trigger_source.empty()) set_trigger_source(camera, info, options.trigger_source);
  if (options.trigger_active_high) {
    if (info.polarity_capable == DC1394_FALSE) {
      refuse_setting(camera, "trigger-polarity", *options.trigger_active_high ? "high" : "low",
                     "the polarity of its trigger is fixed");
    }
    check(dc1394_external_trigger_set_polarity(camera.get(), *options.trigger_active_high
                                                                 ? DC1394_TRIGGER_ACTIVE_HIGH
                                                                 : DC1394_TRIGGER_ACTIVE_LOW),
          camera.name(), "set the trigger polarity");
  }
  if (options.trigger == -1) {
    check(dc1394_external_trigger_set_power(camera.get(), DC1394_OFF), camera.name(),
          "switch the trigger off");
  } else if (options.trigger) {
    set_trigger_mode(camera, info, *options.trigger);
  }
  if (options.trigger_parameter) {  // the library has no function for it
    const std::uint32_t now = camera.read(kTriggerControl).value_or(kPresent);
    camera.write(
        kTriggerControl,
        (now & ~kTriggerParameter) | static_cast<std::uint32_t>(*options.trigger_parameter),
        "the trigger parameter");
  }
}

bool waits_for_trigger(const Camera& camera) {
  dc1394switch_t on = DC1394_OFF;
  return dc1394_external_trigger_get_power(camera.get(), &on) == DC1394_SUCCESS && on == DC1394_ON;
}

}  // namespace anneal6d::dc1394
