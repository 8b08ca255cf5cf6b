// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/dc1394_options.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"

namespace anneal6d {
namespace {

constexpr const char* kFeatureType = "off|auto|one-push|N|abs:X";
constexpr Dc1394SettingInfo kSettings[] = {
    {"video-mode", "WxH-CODING|format7-N", "Picture size and coding, or a Format_7 mode"},
    {"coding", "mono8|mono16|yuv411|yuv422|yuv444|rgb8|raw8|raw16", "Colour coding of Format_7"},
    {"roi", "LEFT,TOP,WIDTH,HEIGHT", "Part of the Format_7 picture"},
    {"packet-size", "BYTES", "Bytes a packet of Format_7; default: as the camera recommends"},
    {"fps", "RATE", "Frames a second; default: the fastest of the mode"},
    {"iso-speed", "100|200|400|800", "Bus speed; 800 in B mode; default 400"},
    {"buffers", "N", "Frames in the DMA ring, 2 to 64, default 8"},
    {"capture", "newest|every", "Pass over frames that wait, or give each; track: newest"},
    {"settle-frames", "N", "Frames dropped after the start, default 2"},
    {"stall-timeout", "SECONDS", "Without a frame the camera has failed, default 3"},
    {"recovery-timeout", "SECONDS", "Wait for an unplugged camera, default 10"},
    {"frame-info", "auto|on|off", "Count frames by the camera's counter in the first pixels"},
    {"debayer", "bilinear|edge-aware|vng|grey", "How raw pictures become colour or grey"},
    {"bayer-pattern", "rggb|gbrg|grbg|bggr", "Of raw pictures; default: as the camera says"},
    {"brightness", kFeatureType, "Black level"},
    {"auto-exposure", kFeatureType, "Exposure that automatic gain and shutter aim at"},
    {"sharpness", kFeatureType, "Sharpness"},
    {"white-balance", "off|auto|one-push|BLUE,RED", "White balance"},
    {"hue", kFeatureType, "Hue"},
    {"saturation", kFeatureType, "Saturation"},
    {"gamma", kFeatureType, "Gamma"},
    {"shutter", kFeatureType, "Exposure time, abs: in ms; longer than a frame: --frame-rate off"},
    {"gain", kFeatureType, "Gain, abs: in dB"},
    {"iris", kFeatureType, "Iris of an auto-iris lens"},
    {"trigger-delay", kFeatureType, "From trigger to exposure, abs: in ms"},
    {"frame-rate", kFeatureType, "The camera's frame rate control; off: extended shutter"},
    {"trigger", "off|0|1|3|4|5|14", "External trigger mode"},
    {"trigger-source", "0|1|2|3|software", "Input pin; software: fired for every frame"},
    {"trigger-polarity", "low|high", "Which level triggers"},
    {"trigger-parameter", "N", "Parameter of trigger modes 3 to 5"},
    {"strobe", "PIN:low|high:DELAY:DURATION,...", "Pins that signal the exposure"},
    {"gpio-direction", "in|out,...", "Direction of the pins, from pin 0 on"},
    {"gpio-output", "N", "What the output pins show, one bit a pin"},
    {"memory-load", "N", "Load the settings of this memory channel first"},
    {"memory-save", "N", "Save the settings to this memory channel"},
    {"lut", "FILE", "Look-up table: one number for each input value"},
    {"power-down", "on|off", "Switch the camera off when done, default off"},
};
constexpr std::array kFeatures = {"brightness", "auto-exposure", "sharpness",     "white-balance",
                                  "hue",        "saturation",    "gamma",         "shutter",
                                  "gain",       "iris",          "trigger-delay", "frame-rate"};
constexpr std::size_t kLargestTable_bytes = 1 << 20;

[[noreturn]] void refuse(const std::string& name, const std::string& value,
                         const std::string& wanted) {
  throw ConfigError("--" + name + ": '" + value + "' is not " + wanted);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text + separator);  // so that an empty last part counts
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::optional<std::vector<int>> integers(const std::string& text, char separator) {
  std::vector<int> numbers;
  for (const std::string& part : split(text, separator)) {
    const auto number = parse_integer(part);
    if (!number || *number < -100'000 || *number > 100'000) return std::nullopt;
    numbers.push_back(static_cast<int>(*number));
  }
  return numbers;
}

// One of the words, or the default if the setting was not given; the index of the word.
std::size_t choice(const Settings& settings, const std::string& name,
                   std::initializer_list<const char*> words, std::size_t otherwise) {
  const auto given = settings.text(name);
  if (!given) return otherwise;
  std::string all;
  std::size_t index = 0;
  for (const char* word : words) {
    if (*given == word) return index;
    all += (index++ == 0 ? "" : ", ") + std::string(word);
  }
  refuse(name, *given, "one of " + all);
}

Dc1394FeatureSetting feature(const std::string& name, const std::string& text) {
  using Mode = Dc1394FeatureSetting::Mode;
  Dc1394FeatureSetting setting;
  setting.text = text;
  const std::size_t wanted = name == "white-balance" ? 2 : 1;
  if (text == "off") {
    setting.mode = Mode::off;
  } else if (text == "auto") {
    setting.mode = Mode::automatic;
  } else if (text == "one-push") {
    setting.mode = Mode::one_push;
  } else if (text.starts_with("abs:") && parse_number(text.substr(4))) {
    setting.mode = Mode::absolute;
    setting.absolute = *parse_number(text.substr(4));
  } else if (const auto raw = integers(text, ','); raw && raw->size() == wanted) {
    setting.mode = Mode::manual;
    setting.raw = *raw;
  } else {
    refuse(name, text,
           wanted == 2 ? "off, auto, one-push or two whole numbers BLUE,RED"
                       : "off, auto, one-push, a whole number or abs:NUMBER");
  }
  return setting;
}

Dc1394Strobe strobe(const std::string& text) {
  const auto parts = split(text, ':');
  const auto number = [&](std::size_t i) { return parse_integer(parts[i]).value_or(-1); };
  const bool complete = parts.size() == 4 && (parts[1] == "low" || parts[1] == "high");
  if (!complete || number(0) < 0 || number(0) > 31 || number(2) < 0 || number(2) > 4095 ||
      number(3) < 0 || number(3) > 4095) {
    refuse("strobe", text, "PIN:low|high:DELAY:DURATION with delay and duration up to 4095");
  }
  return {static_cast<int>(number(0)), parts[1] == "high", static_cast<int>(number(2)),
          static_cast<int>(number(3))};
}

std::vector<int> read_table(const std::string& path) {
  std::istringstream stream(read_file(path, kLargestTable_bytes));
  std::vector<int> table;
  for (std::string word; stream >> word;) {
    const auto value = parse_integer(word);
    if (!value || *value < 0 || *value > 65535) {
      throw FileError(path, "entry " + std::to_string(table.size() + 1),
                      "'" + word + "' is not a whole number from 0 to 65535");
    }
    table.push_back(static_cast<int>(*value));
  }
  if (table.empty()) throw FileError(path, "", "the look-up table is empty");
  return table;
}

void read_pins(const Settings& settings, Dc1394Options& options) {
  if (const auto text = settings.text("strobe")) {
    for (const std::string& part : split(*text, ',')) options.strobes.push_back(strobe(part));
  }
  if (const auto text = settings.text("gpio-direction")) {
    for (const std::string& part : split(*text, ',')) {
      if (part != "in" && part != "out") refuse("gpio-direction", *text, "a list of in and out");
      options.gpio_outputs.push_back(part == "out");
    }
    if (options.gpio_outputs.size() > 8) refuse("gpio-direction", *text, "at most eight pins");
  }
  if (const auto value = settings.integer("gpio-output", 0, 255)) {
    options.gpio_output = static_cast<std::uint32_t>(*value);
  }
}

void read_trigger(const Settings& settings, Dc1394Options& options) {
  if (const auto text = settings.text("trigger")) {
    options.trigger = *text == "off" ? -1 : settings.integer("trigger", 0, 15);
  }
  options.trigger_source = settings.text("trigger-source").value_or("");
  choice(settings, "trigger-source", {"0", "1", "2", "3", "software"}, 0);
  if (settings.has("trigger-polarity")) {
    options.trigger_active_high = choice(settings, "trigger-polarity", {"low", "high"}, 0) == 1;
  }
  options.trigger_parameter = settings.integer("trigger-parameter", 0, 4095);
}

}  // namespace

std::span<const Dc1394SettingInfo> dc1394_settings() { return kSettings; }

Dc1394Options Dc1394Options::from(const Settings& settings) {
  Dc1394Options options;
  options.video_mode = settings.text("video-mode").value_or("");
  options.coding = settings.text("coding").value_or("");
  if (const auto text = settings.text("roi")) {
    const auto numbers = integers(*text, ',');
    if (!numbers || numbers->size() != 4) refuse("roi", *text, "LEFT,TOP,WIDTH,HEIGHT in pixels");
    options.roi.emplace((*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]);
  }
  options.packet_bytes = settings.integer("packet-size", 1, 65535);
  options.fps = settings.number("fps", 0.001, 10'000);
  constexpr int speeds[] = {100, 200, 400, 800};
  options.iso_speed = speeds[choice(settings, "iso-speed", {"100", "200", "400", "800"}, 2)];
  options.buffers = settings.integer("buffers", 2, 64).value_or(options.buffers);
  options.frames =
      choice(settings, "capture", {"newest", "every"}, 0) == 0 ? Frames::newest : Frames::every;
  options.settle_frames =
      settings.integer("settle-frames", 0, 1000).value_or(options.settle_frames);
  options.stall_timeout_s =
      settings.number("stall-timeout", 0.05, 86'400).value_or(options.stall_timeout_s);
  options.recovery_timeout_s =
      settings.number("recovery-timeout", 0, 86'400).value_or(options.recovery_timeout_s);
  options.frame_info =
      static_cast<FrameInfo>(choice(settings, "frame-info", {"auto", "on", "off"}, 0));
  options.debayer = static_cast<Debayer>(
      choice(settings, "debayer", {"bilinear", "edge-aware", "vng", "grey"}, 0));
  options.bayer_pattern = settings.text("bayer-pattern").value_or("");
  choice(settings, "bayer-pattern", {"rggb", "gbrg", "grbg", "bggr"}, 0);
  for (const char* name : kFeatures) {
    if (const auto text = settings.text(name)) options.features[name] = feature(name, *text);
  }
  read_trigger(settings, options);
  read_pins(settings, options);
  options.memory_load = settings.integer("memory-load", 0, 15);
  options.memory_save = settings.integer("memory-save", 1, 15);
  if (const auto path = settings.text("lut")) options.lookup_table = read_table(*path);
  options.power_down = settings.flag("power-down").value_or(false);
  return options;
}

}  // namespace anneal6d
