// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <algorithm>

namespace anneal6d {

/// Share of frames with such support whose pose was right to 10 mm and 2 degrees, by and large,
/// 0..1, where edges are near `chance` of a contour that is not the object's (both 0..1); see
/// README.md, "Quality".
inline double confirmation_of(double support, double chance) {
  // 1: all that is possible, 0: no more than by chance.
  const double beyond_chance = (support - chance) / std::max(1e-6, 1.0 - chance);
  return 0.92 * std::clamp((beyond_chance + 0.05) / 0.28, 0.0, 1.0) +
         0.08 * std::clamp((beyond_chance - 0.25) / 0.5, 0.0, 1.0);
}

}  // namespace anneal6d
