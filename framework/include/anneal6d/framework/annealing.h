// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <algorithm>
#include <cmath>

namespace anneal6d {

/// How the noise narrows from layer to layer of one frame.
enum class AnnealingRule {
  thesis,     ///< sigma_t = sigma_0 (1 - rating of the last layer's estimate), 4.1.2
  geometric,  ///< sigma_t = sigma_0 * ratio^t
};

/// Factor on the standard deviations of layer `layer` (from 0). `last_rating` (0..1) is the
/// rating (Alg. 4) of the previous layer's estimate and used by the thesis's rule only, which
/// leaves the first layer at full noise; `ratio` (0..1] is used by the geometric rule only.
inline double annealing_factor(AnnealingRule rule, int layer, double last_rating, double ratio) {
  if (layer == 0) return 1.0;
  if (rule == AnnealingRule::geometric) return std::pow(ratio, layer);
  // Alg. 3 multiplies a random number by "variance", in millimetres and degrees: an amplitude.
  return 1.0 - std::clamp(last_rating, 0.0, 1.0);
}

}  // namespace anneal6d
