// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "camera_registers.h"
#include "pictures.h"

namespace anneal6d::emulated {

/// What goes wrong, and at which frame of the camera's life (counted from 0, also over replugs).
struct Fault {
  enum class Kind {
    drop,         ///< the frame never arrives
    late,         ///< the frame arrives two periods late; the next one is on time again
    short_frame,  ///< only the first half of the frame arrives
    bus_reset,    ///< the bus is reset; the camera goes on sending
    reset_stops,  ///< the bus is reset and the camera stops sending
    stall,        ///< the camera stops sending until transmission is switched off and on again
    dies,         ///< the camera stops sending for good, but still answers
    unplug,       ///< the device is gone; it comes back after `replug_after` enumerations
  };
  Kind kind = Kind::drop;
  std::int64_t at_frame = 0;
};

/// One camera on the emulated bus. The bus's lock guards it.
class EmulatedCamera {
 public:
  EmulatedCamera(const CameraModel& model, std::uint64_t guid, Pictures pictures);

  const CameraModel& model() const { return *model_; }
  std::uint64_t guid() const { return guid_; }
  CameraRegisters& registers() { return registers_; }
  const CameraRegisters& registers() const { return registers_; }
  const std::vector<std::uint32_t>& config_rom() const { return rom_; }
  /// A quadlet of the register space: of the configuration ROM or a register.
  std::optional<std::uint32_t> read(std::uint64_t offset) const;

  void add_fault(Fault fault) { faults_.push_back(fault); }
  /// The faults of the frame that comes next; each is handed out once.
  std::vector<Fault::Kind> take_faults();

  /// Writes the next frame's bytes, as many as fit, frame information included.
  void expose(std::span<std::uint8_t> buffer, std::uint32_t cycle_time);
  /// The next frame comes to nothing, but is counted.
  void miss() { ++frame_, ++counter_; }
  std::int64_t frame() const { return frame_; }

  /// As a camera that was without power.
  void power_cycle();

  bool plugged = true;
  bool stalled = false;
  bool dead = false;
  /// How many times a program looks for cameras before an unplugged one is back; -1: never.
  int replug_after = -1;
  std::int64_t next_frame_us = -1;  ///< time on the bus; -1: not yet known
  /// Off from the other cameras' exposures; the bus keeps it within 125 us.
  std::int64_t skew_us = 0;

 private:
  const CameraModel* model_;
  std::uint64_t guid_;
  CameraRegisters registers_;
  std::vector<std::uint32_t> rom_;
  Pictures pictures_;
  std::vector<Fault> faults_;
  std::int64_t frame_ = 0;     // of its life
  std::uint32_t counter_ = 0;  // since it has power; what FRAME_INFO shows
};

}  // namespace anneal6d::emulated
