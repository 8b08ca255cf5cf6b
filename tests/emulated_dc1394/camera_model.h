// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace anneal6d::emulated {

/// IIDC colour coding numbers, as COLOR_CODING_ID holds them (IIDC 1.31, 3.3.1).
enum class Coding : std::uint32_t {
  mono8 = 0,
  yuv411 = 1,
  yuv422 = 2,
  yuv444 = 3,
  rgb8 = 4,
  mono16 = 5,
  raw8 = 9,
  raw16 = 10,
};

int bits_per_pixel(Coding coding);

/// A fixed video mode: V_FORMAT and V_MODE, and what they mean.
struct FixedMode {
  int format = 0;
  int mode = 0;
  int width = 0;
  int height = 0;
  Coding coding = Coding::mono8;
};

/// The mode of a format and mode number; null if IIDC knows none.
const FixedMode* find_fixed_mode(int format, int mode);

/// A Format_7 mode: region of interest (0), 2x2 binning (1), 1x2 binning (2).
struct ScalableMode {
  int max_width = 0;
  int max_height = 0;
  int unit_width = 0;
  int unit_height = 0;
  int unit_left = 0;
  int unit_top = 0;
};

/// One of the models of the Dragonfly2 data sheet.
struct CameraModel {
  std::string_view name;  ///< "Dragonfly2 DR2-COL"
  std::string_view key;   ///< "DR2-COL"
  bool colour = false;
  int largest_format = 0;  ///< fixed formats 0..largest_format are there
  ScalableMode scalable[3];
  std::uint32_t trigger_modes = 0;  ///< one bit a mode
};

std::span<const CameraModel> camera_models();

/// The model of a key; throws std::invalid_argument.
const CameraModel& find_camera_model(std::string_view key);

/// Frames a second that the model gives in a fixed mode; one bit for each of IIDC's eight rates
/// (bit 7: 1.875, ... bit 2: 60), as V_RATE_INQ has them in its upper byte.
std::uint32_t frame_rates(const CameraModel& model, const FixedMode& mode);

/// Whether the model has this fixed mode: grey cameras give grey pictures only.
bool has_fixed_mode(const CameraModel& model, const FixedMode& mode);

}  // namespace anneal6d::emulated
