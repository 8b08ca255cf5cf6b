// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "vector_width.h"

namespace anneal6d {

/// A straight line through a picture of 1 or 3 channels of 8 bits, at least 2x2 pixels.
struct LineJob {
  static constexpr std::size_t kPadding = kLongestVector;  ///< floats

  const std::uint8_t* data;
  std::ptrdiff_t stride;  ///< bytes from row to row
  int columns, rows, channels;
  float x, y;            ///< first sample, pixels
  float step_x, step_y;  ///< from sample to sample
  int count;             ///< samples
  float* grey[3];        ///< out: values of each channel, room for whole vectors
  /// Out: how steep they are at each sample but the first and the last, values a sample, norm over
  /// the channels; room for whole vectors.
  float* slope;
};

/// Samples the picture along the line, interpolating between pixels; outside, as at its border.
void sample_line(const LineJob& job);

}  // namespace anneal6d
