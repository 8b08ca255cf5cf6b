// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "camera_registers.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "config_rom.h"

namespace anneal6d::emulated {
namespace {

// Format_7's registers, from the command base: one page a mode.
constexpr std::uint32_t kScalableBase = 0x8000;
constexpr std::uint32_t kScalableSize = 0x100;
constexpr std::uint32_t kAbsoluteBase = 0x900;
constexpr std::uint32_t kStrobeBase = 0x1300;
constexpr std::uint32_t kPioBase = 0x1600;
constexpr std::uint32_t kTableBase = 0x80000;  // look-up table: control, then its entries
constexpr std::uint32_t kTableEntries = 0x82000;

// Quadlet offsets from the start of the register space, as inquiries give them.
constexpr std::uint32_t quadlet_offset(std::uint32_t from_base) {
  return (static_cast<std::uint32_t>(kCommandBase) + from_base) / 4;
}

// Feature registers by their place: 0 brightness, ... 15 frame rate (IIDC 1.31, 4.6).
constexpr int kBrightness = 0, kExposure = 1, kSharpness = 2, kWhiteBalance = 3, kHue = 4,
              kSaturation = 5, kGamma = 6, kShutter = 7, kGain = 8, kIris = 9, kTrigger = 12,
              kTriggerDelay = 13, kFrameRate = 15;
constexpr std::uint32_t kAbsoluteFlag = 0x40000000U, kOnePushBit = 0x04000000U,
                        kOnBit = 0x02000000U, kAutoBit = 0x01000000U;

// IIDC 1.31, 4.5: what a feature can do.
constexpr std::uint32_t inquiry(bool absolute, bool one_push, bool switchable, bool automatic,
                                std::uint32_t low, std::uint32_t high) {
  return kPresent | (absolute ? kAbsoluteFlag : 0) | (one_push ? 0x10000000U : 0) | 0x08000000U |
         (switchable ? 0x04000000U : 0) | (automatic ? 0x02000000U : 0) | 0x01000000U | low << 12 |
         high;
}

}  // namespace

CameraRegisters::CameraRegisters(const CameraModel& model) : model_(&model) {
  restore_factory_settings();
}

void CameraRegisters::restore_factory_settings() {
  std::uint32_t formats = 0x01000000U;  // Format_7
  for (int format = 0; format <= model_->largest_format; ++format) formats |= kPresent >> format;
  values_ = {
      {0x000, 0},
      {0x100, formats},
      {0x19C, 0xE0000000U},
      {0x2E0, quadlet_offset(kScalableBase)},
      {0x2E4, quadlet_offset(kScalableBase + kScalableSize)},
      {0x2E8, quadlet_offset(kScalableBase + 2 * kScalableSize)},
      // advanced features, mode error status, optional functions, power, one shot, multi shot,
      // two memory channels
      {0x400, 0xD0009802U},
      {0x40C, 0x50000000U},  // PIO, strobe
      {0x480, quadlet_offset(0x1000)},
      {0x484, quadlet_offset(kPioBase)},
      {0x488, 0},
      {0x48C, quadlet_offset(kStrobeBase)},
      {0x600, 4U << 29},
      {0x604, 5U << 29},
      {0x608, 0},
      {0x60C, 0x02000000U},
      {0x610, kPresent},
      {0x614, 0},
      {0x618, 0},
      {0x61C, 0},
      {0x620, 0},
      {0x624, 0},
      {0x628, 0},
      {0x62C, 0},
      {0x1040, 0x52474742U},  // BAYER_TILE_MAPPING: "RGGB"
      {0x11F8, 0},            // PIO_DIRECTION
      {0x12F8, kPresent},     // FRAME_INFO
      {kStrobeBase, 0xF0000000U},
      {kPioBase, 0},
      {kPioBase + 4, 0},
      {kTableBase, 0x84000000U | 9U << 19 | 9U << 14 | 1U << 8 | 1U},
      {kTableBase + 0x4, kPresent},
      {kTableBase + 0x8, kPresent},
      {kTableBase + 0xC, kPresent},
      {kTableBase + 0x10, quadlet_offset(kTableEntries)},
  };
  for (std::uint32_t pin = 0; pin < 4; ++pin) {
    values_[kStrobeBase + 0x100 + 4 * pin] = 0x8E000FFFU;
    values_[kStrobeBase + 0x200 + 4 * pin] = kPresent;
  }
  for (std::uint32_t i = 0; i < 512; ++i) values_[kTableEntries + 4 * i] = i;
  add_features();
  for (int i = 0; i < 3; ++i) {
    const ScalableMode& mode = model_->scalable[i];
    scalable_[static_cast<std::size_t>(i)] = {
        0, static_cast<std::uint32_t>(mode.max_width << 16 | mode.max_height), 0, 0};
  }
}

void CameraRegisters::add_features() {
  std::uint32_t present = 0;
  values_[0x408] = 0;
  const auto add = [&](int index, std::uint32_t what, std::uint32_t control) {
    add_feature(index, what, control);
    present |= kPresent >> index;
  };
  const bool colour = model_->colour;
  add(kBrightness, inquiry(true, false, false, false, 0, 255), 0x80000010U);
  add(kExposure, inquiry(true, true, true, true, 1, 1023), 0x83000190U);
  add(kSharpness, inquiry(false, false, true, true, 0, 4095), 0x82000400U);
  if (colour) {
    add(kWhiteBalance, inquiry(false, true, true, true, 0, 1023), 0x82000000U | 512U << 12 | 700U);
    add(kHue, inquiry(true, false, true, false, 0, 4095), 0x82000800U);
    add(kSaturation, inquiry(true, true, true, true, 0, 4095), 0x82000400U);
  }
  add(kGamma, inquiry(true, false, true, false, 512, 4095), 0x80000400U);
  add(kShutter, inquiry(true, true, false, true, 1, 1600), 0x83000200U);
  add(kGain, inquiry(true, true, false, true, 192, 820), 0x83000100U);
  add(kIris, inquiry(false, false, true, true, 0, 255), 0x82000020U);
  // Switchable, polarity, value readable; sources 0 to 3 and software.
  std::uint32_t trigger = kPresent | 0x0E000000U | 0x00F10000U;
  for (int mode = 0; mode < 16; ++mode) {
    if ((model_->trigger_modes & 1U << mode) != 0) trigger |= 0x8000U >> mode;
  }
  add(kTrigger, trigger, kPresent | 0x01000000U);
  add(kTriggerDelay, inquiry(true, false, true, false, 0, 4095), kPresent);
  add(kFrameRate, inquiry(true, false, true, true, 1, 480), 0x83000100U);
  values_[0x404] = present;
  add_absolute(kBrightness, 0, 6.24F, 0.4F);
  add_absolute(kExposure, -7.58F, 2.41F, 0.5F);
  add_absolute(kHue, -180, 180, 0);
  add_absolute(kSaturation, 0, 400, 100);
  add_absolute(kGamma, 0.5F, 4, 1);
  add_absolute(kShutter, 0.00001F, 0.0666F, 0.01F);
  add_absolute(kGain, 0, 24, 6);
  add_absolute(kTriggerDelay, 0, 0.0666F, 0);
  add_absolute(kFrameRate, 1, 60, 30);
}

void CameraRegisters::add_feature(int index, std::uint32_t what, std::uint32_t control) {
  const std::uint32_t at = static_cast<std::uint32_t>(index) * 4;
  values_[0x500 + at] = what;
  values_[0x800 + at] = control;
}

void CameraRegisters::add_absolute(int index, float low, float high, float value) {
  const std::uint32_t at = static_cast<std::uint32_t>(index);
  const std::uint32_t base = kAbsoluteBase + at * 0x10;
  values_[0x700 + at * 4] = quadlet_offset(base);
  values_[base] = std::bit_cast<std::uint32_t>(low);
  values_[base + 4] = std::bit_cast<std::uint32_t>(high);
  values_[base + 8] = std::bit_cast<std::uint32_t>(value);
}

std::optional<std::uint32_t> CameraRegisters::read(std::uint64_t offset) const {
  if (offset < kCommandBase) return std::nullopt;
  const auto at = static_cast<std::uint32_t>(offset - kCommandBase);
  const std::uint32_t page = (at - kScalableBase) / kScalableSize;
  const bool scalable = at >= kScalableBase && page < 3;
  if (garbage_ && ((at >= 0x200 && at < 0x600 && at != 0x2E0) || scalable)) return garbage_;
  if (scalable) return read_scalable(static_cast<int>(page), at % kScalableSize);
  if (at >= 0x180 && at < 0x2E0) return read_modes(at);
  // With the frame rate off, exposures may be longer than a frame: "extended shutter".
  const bool extended = (values_.at(0x83C) & kOnBit) == 0;
  if (at == kAbsoluteBase + kShutter * 0x10 + 4 && extended) {
    return std::bit_cast<std::uint32_t>(5.3F);
  }
  if (at == 0x630) {
    const Coding coding = format().coding;
    return (coding == Coding::mono16 || coding == Coding::raw16 ? 12U : 8U) << 24;
  }
  const auto found = values_.find(at);
  if (found != values_.end()) return found->second;
  // Absent registers of the inquiry and control pages read as zero.
  if (at < 0x1000) return 0;
  return std::nullopt;
}

std::optional<std::uint32_t> CameraRegisters::read_modes(std::uint32_t offset) const {
  if (offset < 0x1A0) {  // V_MODE_INQ
    const int format = static_cast<int>(offset - 0x180) / 4;
    if (format == 7) return values_.at(0x19C);
    std::uint32_t bits = 0;
    for (int mode = 0; mode < 8; ++mode) {
      const FixedMode* row = find_fixed_mode(format, mode);
      if (row != nullptr && has_fixed_mode(*model_, *row)) bits |= kPresent >> mode;
    }
    return bits;
  }
  if (offset < 0x200) return 0;
  const int format = static_cast<int>(offset - 0x200) / 0x20;  // V_RATE_INQ
  const FixedMode* row = find_fixed_mode(format, static_cast<int>(offset % 0x20) / 4);
  if (row == nullptr || !has_fixed_mode(*model_, *row)) return 0;
  return frame_rates(*model_, *row) << 24;
}

bool CameraRegisters::write(std::uint64_t offset, std::uint32_t value) {
  if (offset < kCommandBase) return false;
  const auto at = static_cast<std::uint32_t>(offset - kCommandBase);
  if (refused_.contains(at)) return false;
  const std::uint32_t page = (at - kScalableBase) / kScalableSize;
  if (at >= kScalableBase && page < 3) {
    return write_scalable(static_cast<int>(page), at % kScalableSize, value);
  }
  if (at >= 0x800 && at < 0x900) {
    write_feature(at, value);
    return true;
  }
  if (at >= kAbsoluteBase && at < kAbsoluteBase + 0x200) {
    write_absolute(at, value);
    return true;
  }
  return write_command(at, value);
}

// What the camera keeps of a write: presence stays, switches and modes only where it has them.
void CameraRegisters::write_feature(std::uint32_t offset, std::uint32_t value) {
  const auto found = values_.find(offset);
  if (found == values_.end()) return;  // an absent feature ignores what is written
  const std::uint32_t what = values_.at(offset - 0x300);
  std::uint32_t kept = (value & ~kPresent) | kPresent;
  if (offset != 0x830) {
    if ((what & 0x04000000U) == 0) kept = (kept & ~kOnBit) | (found->second & kOnBit);
    if ((what & 0x02000000U) == 0) kept &= ~kAutoBit;
    if ((what & kAbsoluteFlag) == 0) kept &= ~kAbsoluteFlag;
    kept &= ~kOnePushBit;  // done at once
  }
  found->second = kept;
}

void CameraRegisters::write_absolute(std::uint32_t offset, std::uint32_t value) {
  const auto found = values_.find(offset);
  if (found == values_.end() || (offset & 0xFU) != 8) return;
  const float low = std::bit_cast<float>(*read(kCommandBase + offset - 8));
  const float high = std::bit_cast<float>(*read(kCommandBase + offset - 4));
  found->second = std::bit_cast<std::uint32_t>(std::clamp(std::bit_cast<float>(value), low, high));
}

bool CameraRegisters::write_command(std::uint32_t offset, std::uint32_t value) {
  if (offset == 0x000) {
    if ((value & kPresent) != 0) restore_factory_settings();
    return true;
  }
  if (offset == 0x618) {  // MEMORY_SAVE: done at once
    memory_[values_.at(0x620) >> 28] = values_;
    return true;
  }
  if (offset == 0x624) {  // CUR_MEM_CH
    const auto saved = memory_.find(value >> 28);
    if (saved != memory_.end()) values_ = saved->second;
    values_[0x624] = value;
    return true;
  }
  const auto found = values_.find(offset);
  if (found == values_.end()) return offset < 0x1000;
  if (offset >= 0x100 && offset < 0x600) return true;  // inquiries can't be written
  const bool has_presence = offset == 0x12F8 || (offset >= kStrobeBase && offset < kPioBase);
  found->second = value | (has_presence ? kPresent : 0);
  return true;
}

int CameraRegisters::iso_channel() const {
  const std::uint32_t value = values_.at(0x60C);
  const bool b_mode = (value & 0x8000U) != 0;
  return static_cast<int>(b_mode ? value >> 8 & 0x3FU : value >> 28);
}

void CameraRegisters::set_iso(bool on, int channel) {
  values_[0x614] = on ? kPresent : 0;
  values_[0x60C] = (values_[0x60C] & 0x0FFFFFFFU) | static_cast<std::uint32_t>(channel) << 28;
}

bool CameraRegisters::waits_for_trigger() const { return (values_.at(0x830) & kOnBit) != 0; }

bool CameraRegisters::take_software_trigger() {
  const bool fired = flag(0x62C);
  values_[0x62C] = 0;
  return fired;
}

float CameraRegisters::frame_rate() const {
  return std::bit_cast<float>(values_.at(kAbsoluteBase + kFrameRate * 0x10 + 8));
}

PictureFormat CameraRegisters::format() const {
  constexpr double rates[] = {1.875, 3.75, 7.5, 15, 30, 60, 120, 240};
  const int format = static_cast<int>(values_.at(0x608) >> 29);
  const int mode = static_cast<int>(values_.at(0x604) >> 29);
  PictureFormat picture;
  if (format != 7) {
    const FixedMode* row = find_fixed_mode(format, mode);
    if (row == nullptr) return picture;
    picture = {row->width, row->height, 0, 0, row->coding, 0, 0};
    picture.period_us = std::llround(1e6 / rates[values_.at(0x600) >> 29]);
    return picture;
  }
  const Scalable& now = scalable_[static_cast<std::size_t>(std::min(mode, 2))];
  picture.width = static_cast<int>(now.size >> 16);
  picture.height = static_cast<int>(now.size & 0xFFFFU);
  picture.left = static_cast<int>(now.position >> 16);
  picture.top = static_cast<int>(now.position & 0xFFFFU);
  picture.coding = static_cast<Coding>(now.coding);
  picture.bytes_per_packet = static_cast<int>(now.packet);
  const std::int64_t bus_us = static_cast<std::int64_t>(packets(std::min(mode, 2))) * 125;
  const bool rate_on = (values_.at(0x83C) & kOnBit) != 0;
  const std::int64_t rate_us = rate_on ? std::llround(1e6 / frame_rate()) : 0;
  picture.period_us = std::max(bus_us, rate_us);
  return picture;
}

}  // namespace anneal6d::emulated
