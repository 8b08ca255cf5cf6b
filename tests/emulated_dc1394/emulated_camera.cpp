// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "emulated_camera.h"

#include <algorithm>
#include <cstring>

#include "config_rom.h"

namespace anneal6d::emulated {
namespace {

constexpr std::uint64_t kRomStart = 0x400, kRomEnd = 0x800;
constexpr std::uint32_t kTimestamp = 0x1;
constexpr std::uint32_t kFrameCounter = 0x40;

void put_big_endian(std::span<std::uint8_t> bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
  }
}

}  // namespace

EmulatedCamera::EmulatedCamera(const CameraModel& model, std::uint64_t guid, Pictures pictures)
    : model_(&model),
      guid_(guid),
      registers_(model),
      rom_(make_config_rom(guid, "Point Grey Research", model.name)),
      pictures_(std::move(pictures)) {}

std::optional<std::uint32_t> EmulatedCamera::read(std::uint64_t offset) const {
  if (offset < kRomStart || offset >= kRomEnd) return registers_.read(offset);
  const std::size_t quadlet = (offset - kRomStart) / 4;
  return quadlet < rom_.size() ? rom_[quadlet] : 0;
}

std::vector<Fault::Kind> EmulatedCamera::take_faults() {
  std::vector<Fault::Kind> now;
  std::erase_if(faults_, [&](const Fault& fault) {
    if (fault.at_frame != frame_) return false;
    now.push_back(fault.kind);
    return true;
  });
  return now;
}

void EmulatedCamera::expose(std::span<std::uint8_t> buffer, std::uint32_t cycle_time) {
  const std::vector<std::uint8_t>& bytes = pictures_.encoded(frame_, registers_.format(), *model_);
  std::copy_n(bytes.begin(), std::min(bytes.size(), buffer.size()), buffer.begin());
  std::size_t at = 0;
  for (std::uint32_t bit = 1; bit <= 0x200; bit <<= 1) {
    if ((registers_.frame_info() & bit) == 0) continue;
    put_big_endian(buffer, at,
                   bit == kTimestamp      ? cycle_time
                   : bit == kFrameCounter ? counter_
                                          : 0);
    at += 4;
  }
  ++frame_;
  ++counter_;
}

void EmulatedCamera::power_cycle() {
  registers_.restore_factory_settings();
  counter_ = 0;
  stalled = false;
  next_frame_us = -1;
}

}  // namespace anneal6d::emulated
