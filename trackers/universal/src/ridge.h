// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

namespace anneal6d {

/// Where between its neighbours a ridge is highest, in pixels from the middle one: the vertex of
/// the parabola through three values. Within half a pixel if the middle one is the largest.
template <class Number>
Number ridge_offset(Number before, Number here, Number after) {
  return Number(0.5) * (before - after) / (before - 2 * here + after);
}

}  // namespace anneal6d
