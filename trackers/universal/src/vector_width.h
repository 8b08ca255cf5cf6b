// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>

namespace anneal6d {

/// Floats of the longest vector that loops over contours, lines and depths use, whatever the
/// processor has: arrays have room for whole ones. The rasterizer's have a margin of their own.
inline constexpr std::size_t kLongestVector = 16;

}  // namespace anneal6d
