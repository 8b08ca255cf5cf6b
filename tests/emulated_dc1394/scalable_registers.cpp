// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Format_7: IIDC 1.31, 4.9. Image size, position and coding are written first; the camera then
// says whether they fit and which packets it needs.
#include <algorithm>
#include <bit>

#include "camera_registers.h"

namespace anneal6d::emulated {
namespace {

constexpr std::uint32_t kUnitBytes = 4;
constexpr std::uint32_t kMostBytes = 4096;
constexpr std::uint32_t kWrongSettings = 0x00800000U;
constexpr std::uint32_t kWrongPacket = 0x00400000U;

std::uint32_t pack(int high, int low) {
  return static_cast<std::uint32_t>(high) << 16 | static_cast<std::uint32_t>(low);
}

}  // namespace

bool CameraRegisters::is_valid(int mode) const {
  const ScalableMode& limits = model_->scalable[mode];
  const Scalable& now = scalable_[static_cast<std::size_t>(mode)];
  const int width = static_cast<int>(now.size >> 16), height = static_cast<int>(now.size & 0xFFFF);
  const int left = static_cast<int>(now.position >> 16);
  const int top = static_cast<int>(now.position & 0xFFFF);
  return width > 0 && height > 0 && width % limits.unit_width == 0 &&
         height % limits.unit_height == 0 && left % limits.unit_left == 0 &&
         top % limits.unit_top == 0 && left + width <= limits.max_width &&
         top + height <= limits.max_height;
}

// Packets a frame: as many as the chosen packet size needs; the recommended one if none is chosen.
std::uint32_t CameraRegisters::packets(int mode) const {
  const Scalable& now = scalable_[static_cast<std::size_t>(mode)];
  const std::uint64_t bits =
      static_cast<std::uint64_t>(now.size >> 16) * (now.size & 0xFFFF) *
      static_cast<std::uint64_t>(bits_per_pixel(static_cast<Coding>(now.coding)));
  const std::uint64_t bytes = bits / 8;
  const std::uint64_t each = now.packet != 0 ? now.packet : kMostBytes;
  return static_cast<std::uint32_t>((bytes + each - 1) / each);
}

std::optional<std::uint32_t> CameraRegisters::read_scalable(int mode, std::uint32_t offset) const {
  const ScalableMode& limits = model_->scalable[mode];
  const Scalable& now = scalable_[static_cast<std::size_t>(mode)];
  const std::uint32_t bits =
      static_cast<std::uint32_t>(bits_per_pixel(static_cast<Coding>(now.coding)));
  const std::uint32_t pixels = (now.size >> 16) * (now.size & 0xFFFF);
  switch (offset) {
    case 0x00:
      return pack(limits.max_width, limits.max_height);
    case 0x04:
      return pack(limits.unit_width, limits.unit_height);
    case 0x08:
      return now.position;
    case 0x0C:
      return now.size;
    case 0x10:
      return now.coding << 24;
    case 0x14:  // mono8, mono16; with colour also yuv411, yuv422, rgb8, raw8, raw16
      return model_->colour ? 0xEC600000U : 0x84000000U;
    case 0x34:
      return pixels;
    case 0x38:
      return 0;
    case 0x3C:
      return packets(mode) * (now.packet != 0 ? now.packet : kMostBytes);
    case 0x40:
      return pack(static_cast<int>(kUnitBytes), static_cast<int>(kMostBytes));
    case 0x44: {
      // Recommended: what carries the frame at 30 a second, or the most.
      const std::uint64_t wanted =
          (static_cast<std::uint64_t>(pixels) * bits / 8 * 30 / 8000 + kUnitBytes) / kUnitBytes *
          kUnitBytes;
      return pack(static_cast<int>(now.packet),
                  static_cast<int>(std::min<std::uint64_t>(wanted, kMostBytes)));
    }
    case 0x48:
      return packets(mode);
    case 0x4C:
      return pack(limits.unit_left, limits.unit_top);
    case 0x50:
      return std::bit_cast<std::uint32_t>(static_cast<float>(packets(mode)) * 125e-6F);
    case 0x54:
      return (static_cast<Coding>(now.coding) == Coding::mono16 ||
                      static_cast<Coding>(now.coding) == Coding::raw16
                  ? 12U
                  : 8U)
             << 24;
    case 0x58:
      return 0;  // RGGB
    case 0x7C: {
      const bool packet_fits = now.packet % kUnitBytes == 0 && now.packet <= kMostBytes;
      return kPresent | (is_valid(mode) ? 0 : kWrongSettings) | (packet_fits ? 0 : kWrongPacket);
    }
    default:
      return 0;
  }
}

bool CameraRegisters::write_scalable(int mode, std::uint32_t offset, std::uint32_t value) {
  Scalable& now = scalable_[static_cast<std::size_t>(mode)];
  switch (offset) {
    case 0x08:
      now.position = value;
      return true;
    case 0x0C:
      now.size = value;
      return true;
    case 0x10:
      now.coding = value >> 24;
      return true;
    case 0x44:
      now.packet = value >> 16;
      return true;
    case 0x7C:  // setting_1 starts the check, which is done at once
      return true;
    default:
      return false;
  }
}

}  // namespace anneal6d::emulated
