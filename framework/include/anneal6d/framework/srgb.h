// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace anneal6d {

// The encoding of images (IEC 61966-2-1). Light is mixed within a pixel before it is encoded, so
// averages and the places of edges between pixels belong to linear light.

/// Linear light, 0..1, of an encoded value, 0..1.
inline double decoded_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Encoded value, 0..1, of linear light, 0..1.
inline double encoded_srgb(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

/// Linear light, 0..1, of each 8-bit grey level.
inline std::array<float, 256> srgb_light_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(decoded_srgb(static_cast<double>(i) / 255.0));
  }
  return table;
}

}  // namespace anneal6d
