// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cstddef>

#include "anneal6d/framework/srgb.h"

namespace anneal6d {

/// Cameras mix light within a pixel and encode the mixture afterwards, so that the slope of grey
/// levels across a step from level a to level b is centred off the step, on its dark side, by up to
/// 0.19 px: bright objects look large and near. For a pixel that mixes evenly, integration by parts
/// gives the offset (mean(a, b) - mean level over the mixtures) / (b - a) in pixels, counted from a
/// towards b, where levels are encoded values, 0..1, and the mean level is the rise of `integral`
/// over the rise of `light`.
struct EncodingBias {
  std::array<float, 256> light = srgb_light_table();  ///< of each grey level
  std::array<float, 256> integral{};                  ///< of the encoded value over light

  static const EncodingBias& table() {
    static const EncodingBias bias;
    return bias;
  }

 private:
  EncodingBias() {
    double sum = 0;
    for (std::size_t i = 1; i < integral.size(); ++i) {
      const double middle = (static_cast<double>(i) - 0.5) / 255.0;  // trapezoids
      sum += middle * (static_cast<double>(light[i]) - static_cast<double>(light[i - 1]));
      integral[i] = static_cast<float>(sum);
    }
  }
};

}  // namespace anneal6d
