// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "camera_model.h"

namespace anneal6d::emulated {

/// Bit 0 of IIDC 1.31, the highest: there, or on.
inline constexpr std::uint32_t kPresent = 0x80000000U;

/// What the registers say of the pictures to send.
struct PictureFormat {
  int width = 0;
  int height = 0;
  int left = 0;
  int top = 0;
  Coding coding = Coding::mono8;
  int bytes_per_packet = 0;    ///< Format_7 only; else 0
  std::int64_t period_us = 0;  ///< from frame to frame
};

/// The command registers of an IIDC 1.31 camera with Point Grey's additions. Offsets count from
/// the start of the register space (0xFFFFF0000000), as in requests on the bus. Not thread safe.
class CameraRegisters {
 public:
  explicit CameraRegisters(const CameraModel& model);

  /// Empty: no such register, the camera answers "address error".
  std::optional<std::uint32_t> read(std::uint64_t offset) const;
  bool write(std::uint64_t offset, std::uint32_t value);

  /// As after switching on: memory channel 0.
  void restore_factory_settings();

  bool transmitting() const { return flag(0x614); }
  void stop_transmitting() { values_[0x614] = 0; }
  bool powered() const { return flag(0x610); }
  int iso_channel() const;
  void set_iso(bool on, int channel);
  PictureFormat format() const;
  /// The insertion bits of FRAME_INFO: 1 timestamp, 0x40 frame counter.
  std::uint32_t frame_info() const { return values_.at(0x12F8) & 0x3FFU; }
  bool waits_for_trigger() const;
  bool take_software_trigger();

  /// 1394b: speeds beyond 400. The Dragonfly2 has it not, others do.
  void add_b_mode() { values_[0x400] |= 0x00800000U; }

  /// Faults: writes to this control register (0x80C, ...) are answered with an error.
  void refuse_writes_to(std::uint32_t register_offset) { refused_.insert(register_offset); }
  /// Faults: every inquiry register (200..5FF and Format_7) answers this instead.
  void answer_inquiries_with(std::optional<std::uint32_t> garbage) { garbage_ = garbage; }

 private:
  struct Scalable {
    std::uint32_t position = 0, size = 0, coding = 0, packet = 0;
  };

  bool flag(std::uint32_t offset) const { return (values_.at(offset) & 0x80000000U) != 0; }
  void add_features();
  void add_feature(int index, std::uint32_t inquiry, std::uint32_t control);
  void add_absolute(int index, float low, float high, float value);
  std::optional<std::uint32_t> read_modes(std::uint32_t offset) const;
  std::optional<std::uint32_t> read_scalable(int mode, std::uint32_t offset) const;
  bool write_scalable(int mode, std::uint32_t offset, std::uint32_t value);
  bool write_command(std::uint32_t offset, std::uint32_t value);
  void write_feature(std::uint32_t offset, std::uint32_t value);
  void write_absolute(std::uint32_t offset, std::uint32_t value);
  bool is_valid(int mode) const;
  std::uint32_t packets(int mode) const;
  float frame_rate() const;

  const CameraModel* model_;
  std::map<std::uint32_t, std::uint32_t> values_;  // by offset from the command base
  std::array<Scalable, 3> scalable_;
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> memory_;  // channels 1 and 2
  std::set<std::uint32_t> refused_;
  std::optional<std::uint32_t> garbage_;
};

}  // namespace anneal6d::emulated
