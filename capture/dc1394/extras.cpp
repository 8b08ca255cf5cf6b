// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "extras.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "anneal6d/framework/error.h"

namespace anneal6d::dc1394 {
namespace {

// IIDC 1.31, 4.6 and chapter 5.
constexpr std::uint64_t kStrobeInquiry = 0x100, kStrobeControl = 0x200;
constexpr std::uint32_t kStrobeOn = 0x02000000U, kStrobeHigh = 0x01000000U;

// Point Grey's register reference.
constexpr std::uint64_t kPinDirection = 0x11F8;
constexpr std::uint64_t kFrameInfo = 0x12F8;
constexpr std::uint32_t kFrameCounter = 0x40;

// Look-up table: IIDC 1.32, as Point Grey has it in cameras of version 1.31, too.
constexpr std::uint64_t kTable = 0x80000, kTableControl = 0x8000C, kTableOffset = 0x80010;
constexpr std::uint32_t kTableOn = 0x04000000U;
constexpr std::uint32_t kLargestTableBits = 16;

void check_channel(const Camera& camera, const std::string& setting, int channel) {
  const int most = camera.get()->max_mem_channel;
  if (channel > most) {
    refuse_setting(camera, setting, std::to_string(channel),
                   most == 0 ? "it has no memory channels"
                             : "it has the memory channels 1 to " + std::to_string(most));
  }
}

void apply_strobe(const Camera& camera, const Dc1394Strobe& strobe) {
  const std::string value = std::to_string(strobe.pin);
  if (camera.get()->strobe_control_csr == 0) {
    refuse_setting(camera, "strobe", value, "it has no strobe outputs");
  }
  const std::uint64_t pin = static_cast<std::uint64_t>(strobe.pin) * 4;
  std::uint32_t inquiry = 0;
  if (dc1394_get_strobe_register(camera.get(), kStrobeInquiry + pin, &inquiry) != DC1394_SUCCESS ||
      (inquiry & kPresent) == 0) {
    refuse_setting(camera, "strobe", value, "this pin has no strobe");
  }
  const std::uint32_t control = kPresent | kStrobeOn | (strobe.active_high ? kStrobeHigh : 0) |
                                static_cast<std::uint32_t>(strobe.delay) << 12 |
                                static_cast<std::uint32_t>(strobe.duration);
  check(dc1394_set_strobe_register(camera.get(), kStrobeControl + pin, control), camera.name(),
        "set the strobe of pin " + value);
}

}  // namespace

void apply_power_and_memory(const Camera& camera, const Dc1394Options& options) {
  if (camera.get()->can_switch_on_off == DC1394_TRUE) {
    check(dc1394_camera_set_power(camera.get(), DC1394_ON), camera.name(), "switch it on");
  } else if (options.power_down) {
    refuse_setting(camera, "power-down", "on", "it can't be switched on and off");
  }
  if (!options.memory_load) return;
  check_channel(camera, "memory-load", *options.memory_load);
  check(dc1394_memory_load(camera.get(), static_cast<std::uint32_t>(*options.memory_load)),
        camera.name(), "load the memory channel");
}

void save_memory(const Camera& camera, const Dc1394Options& options) {
  if (!options.memory_save) return;
  check_channel(camera, "memory-save", *options.memory_save);
  check(dc1394_memory_save(camera.get(), static_cast<std::uint32_t>(*options.memory_save)),
        camera.name(), "save to the memory channel");
  for (int attempt = 0; attempt < 100; ++attempt) {  // flash takes about a second
    dc1394bool_t busy = DC1394_FALSE;
    check(dc1394_memory_busy(camera.get(), &busy), camera.name(), "ask for the memory's state");
    if (busy == DC1394_FALSE) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  throw CaptureError(camera.name() +
                     ": saving to the memory channel does not end; switch it off "
                     "and on again");
}

void apply_pins(const Camera& camera, const Dc1394Options& options) {
  for (const Dc1394Strobe& strobe : options.strobes) apply_strobe(camera, strobe);
  if (!options.gpio_outputs.empty()) {
    const auto now = camera.from_point_grey() ? camera.read(kPinDirection) : std::nullopt;
    if (!now)
      refuse_setting(camera, "gpio-direction", "in|out", "its pins have no direction to set");
    std::uint32_t value = *now;
    for (std::size_t pin = 0; pin < options.gpio_outputs.size(); ++pin) {
      const std::uint32_t bit = kPresent >> pin;
      value = options.gpio_outputs[pin] ? value | bit : value & ~bit;
    }
    camera.write(kPinDirection, value, "the direction of the pins");
  }
  if (options.gpio_output) {
    if (camera.get()->PIO_control_csr == 0) {
      refuse_setting(camera, "gpio-output", std::to_string(*options.gpio_output),
                     "it has no output pins");
    }
    check(dc1394_pio_set(camera.get(), *options.gpio_output), camera.name(), "set the output pins");
  }
}

void apply_lookup_table(const Camera& camera, const Dc1394Options& options) {
  if (options.lookup_table.empty()) return;
  const std::string size = std::to_string(options.lookup_table.size()) + " entries";
  const std::uint32_t inquiry = camera.read(kTable).value_or(0);
  const std::uint32_t input_bits = inquiry >> 19 & 0x1FU;
  const std::uint32_t output_bits = inquiry >> 14 & 0x1FU;
  const auto offset = camera.read(kTableOffset);
  if ((inquiry & kPresent) == 0 || !offset || input_bits == 0 || input_bits > kLargestTableBits ||
      output_bits == 0 || output_bits > kLargestTableBits) {
    refuse_setting(camera, "lut", size, "it has no look-up table");
  }
  const std::size_t entries = std::size_t{1} << input_bits;
  const int largest = (1 << output_bits) - 1;
  const int given = *std::max_element(options.lookup_table.begin(), options.lookup_table.end());
  if (options.lookup_table.size() != entries || given > largest) {
    refuse_setting(camera, "lut", size + ", the largest " + std::to_string(given),
                   "its table has " + std::to_string(entries) + " entries from 0 to " +
                       std::to_string(largest));
  }
  for (std::size_t i = 0; i < entries; ++i) {
    const auto value = static_cast<std::uint32_t>(options.lookup_table[i]);
    check(dc1394_set_register(camera.get(), (std::uint64_t{*offset} + i) * 4, value), camera.name(),
          "write the look-up table");
  }
  camera.write(kTableControl, kPresent | kTableOn, "the look-up table");
}

bool apply_frame_info(const Camera& camera, const Dc1394Options& options) {
  const std::uint32_t now = camera.from_point_grey() ? camera.read(kFrameInfo).value_or(0) : 0;
  if ((now & kPresent) == 0) {
    if (options.frame_info == Dc1394Options::FrameInfo::on) {
      refuse_setting(camera, "frame-info", "on",
                     "it can't put its frame counter into pictures; use auto");
    }
    return false;
  }
  const bool wanted = options.frame_info != Dc1394Options::FrameInfo::off;
  camera.write(kFrameInfo, kPresent | (wanted ? kFrameCounter : 0), "the frame information");
  const std::uint32_t kept = camera.read(kFrameInfo).value_or(0);
  return wanted && (kept & ~kPresent) == kFrameCounter;
}

}  // namespace anneal6d::dc1394
