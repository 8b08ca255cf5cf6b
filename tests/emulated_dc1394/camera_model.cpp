// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "camera_model.h"

#include <stdexcept>
#include <string>

namespace anneal6d::emulated {
namespace {

// IIDC 1.31, 3.2.1: formats 0 to 2.
constexpr FixedMode kFixedModes[] = {
    {0, 0, 160, 120, Coding::yuv444},  {0, 1, 320, 240, Coding::yuv422},
    {0, 2, 640, 480, Coding::yuv411},  {0, 3, 640, 480, Coding::yuv422},
    {0, 4, 640, 480, Coding::rgb8},    {0, 5, 640, 480, Coding::mono8},
    {0, 6, 640, 480, Coding::mono16},  {1, 0, 800, 600, Coding::yuv422},
    {1, 1, 800, 600, Coding::rgb8},    {1, 2, 800, 600, Coding::mono8},
    {1, 3, 1024, 768, Coding::yuv422}, {1, 4, 1024, 768, Coding::rgb8},
    {1, 5, 1024, 768, Coding::mono8},  {1, 6, 800, 600, Coding::mono16},
    {1, 7, 1024, 768, Coding::mono16}, {2, 0, 1280, 960, Coding::yuv422},
    {2, 1, 1280, 960, Coding::rgb8},   {2, 2, 1280, 960, Coding::mono8},
    {2, 6, 1280, 960, Coding::mono16},
};

constexpr std::uint32_t modes(std::initializer_list<int> numbers) {
  std::uint32_t bits = 0;
  for (int number : numbers) bits |= 1U << number;
  return bits;
}

// Sensor sizes and trigger modes from the data sheet; unit steps as the technical reference of the
// family gives them (8 x 2 for regions, 4 x 2 for positions).
constexpr std::uint32_t kTriggers = modes({0, 1, 3, 4, 5, 14});
constexpr std::uint32_t kTriggers13S2 = modes({0, 1, 3, 14});
constexpr CameraModel kModels[] = {
    {"Dragonfly2 DR2-BW",
     "DR2-BW",
     false,
     0,
     {{648, 488, 8, 2, 4, 2}, {320, 240, 8, 2, 4, 2}, {640, 240, 8, 2, 4, 2}},
     kTriggers},
    {"Dragonfly2 DR2-COL",
     "DR2-COL",
     true,
     0,
     {{648, 488, 8, 2, 4, 2}, {320, 240, 8, 2, 4, 2}, {640, 240, 8, 2, 4, 2}},
     kTriggers},
    {"Dragonfly2 DR2-HIBW",
     "DR2-HIBW",
     false,
     1,
     {{1032, 776, 8, 2, 4, 2}, {512, 384, 8, 2, 4, 2}, {1024, 384, 8, 2, 4, 2}},
     kTriggers},
    {"Dragonfly2 DR2-HICOL",
     "DR2-HICOL",
     true,
     1,
     {{1032, 776, 8, 2, 4, 2}, {512, 384, 8, 2, 4, 2}, {1024, 384, 8, 2, 4, 2}},
     kTriggers},
    {"Dragonfly2 DR2-13S2M",
     "DR2-13S2M",
     false,
     2,
     {{1296, 964, 8, 2, 4, 2}, {640, 480, 8, 2, 4, 2}, {1280, 480, 8, 2, 4, 2}},
     kTriggers13S2},
    {"Dragonfly2 DR2-13S2C",
     "DR2-13S2C",
     true,
     2,
     {{1296, 964, 8, 2, 4, 2}, {640, 480, 8, 2, 4, 2}, {1280, 480, 8, 2, 4, 2}},
     kTriggers13S2},
};

bool is_grey(Coding coding) { return coding == Coding::mono8 || coding == Coding::mono16; }

// The largest of IIDC's rates (30, 15, ... 60) that fits: sensor speed and 4096 bytes a packet.
double fastest(const CameraModel& model, const FixedMode& mode) {
  const double sensor = model.largest_format == 0 ? 60 : model.largest_format == 1 ? 30 : 15;
  const double bytes = mode.width * mode.height * bits_per_pixel(mode.coding) / 8.0;
  const double bus = 4096.0 * 8000 / bytes;
  return sensor < bus ? sensor : bus;
}

}  // namespace

int bits_per_pixel(Coding coding) {
  switch (coding) {
    case Coding::mono8:
    case Coding::raw8:
      return 8;
    case Coding::yuv411:
      return 12;
    case Coding::yuv422:
    case Coding::mono16:
    case Coding::raw16:
      return 16;
    case Coding::yuv444:
    case Coding::rgb8:
      return 24;
  }
  throw std::invalid_argument("unknown colour coding");
}

const FixedMode* find_fixed_mode(int format, int mode) {
  for (const FixedMode& row : kFixedModes) {
    if (row.format == format && row.mode == mode) return &row;
  }
  return nullptr;
}

std::span<const CameraModel> camera_models() { return kModels; }

const CameraModel& find_camera_model(std::string_view key) {
  for (const CameraModel& model : kModels) {
    if (model.key == key) return model;
  }
  throw std::invalid_argument("no such camera model: " + std::string(key));
}

std::uint32_t frame_rates(const CameraModel& model, const FixedMode& mode) {
  constexpr double rates[] = {1.875, 3.75, 7.5, 15, 30, 60};
  std::uint32_t bits = 0;
  for (int i = 0; i < 6; ++i) {
    if (rates[i] <= fastest(model, mode)) bits |= 0x80U >> i;
  }
  return bits;
}

bool has_fixed_mode(const CameraModel& model, const FixedMode& mode) {
  return mode.format <= model.largest_format && (model.colour || is_grey(mode.coding));
}

}  // namespace anneal6d::emulated
