// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <cstdint>

namespace anneal6d {

/// Gradients of a picture, and what is found in them.
struct RidgeJob {
  const std::int16_t *along_x, *along_y;
  std::ptrdiff_t stride;  ///< entries from row to row, of all pictures
  int columns, rows;
  int margin;             ///< so near to the border, at least 1, nothing is looked for
  std::int32_t least;     ///< squared length of a gradient on a ridge
  std::int32_t* squared;  ///< out: squared lengths
  std::uint32_t* places;  ///< out: `columns` * y + x, row by row; room for all pixels
};

/// Finds pixels whose gradient is as long as that of one neighbour and longer than that of the
/// other, along the axis to which it is closer. Returns their number.
std::size_t find_ridges(const RidgeJob& job);

}  // namespace anneal6d
