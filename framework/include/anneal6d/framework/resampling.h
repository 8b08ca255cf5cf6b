// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <span>

#include "anneal6d/framework/random.h"

namespace anneal6d {

/// How particles are drawn in proportion to their weights.
enum class Resampling {
  multinomial,  ///< independent draws, as in the thesis (Alg. 2, CONDENSATION)
  systematic,   ///< low variance: one random offset, then equal steps (Kitagawa 1996)
};

/// Fills `indices` with draws from 0..weights.size()-1 in proportion to `weights`, which are
/// non-negative and sum to 1. Both spans are non-empty. Draws of systematic resampling are
/// ascending.
void draw_indices(std::span<const double> weights, const RandomKey& key, Resampling resampling,
                  std::span<std::uint32_t> indices);

/// exp of the logarithms, normalised to sum to 1, safe against overflow and underflow. NaN counts
/// as -infinity; if nothing is possible, all weights are equal. Returns false in that last case.
bool normalize_log_weights(std::span<const double> log_weights, std::span<double> weights);

/// 1 / sum w^2 of weights that sum to 1: how many equally weighted particles they are worth.
double effective_sample_size(std::span<const double> weights);

/// The exponent beta > 0 for which the weights w^beta, normalised, keep `survival_rate` (0..1] of
/// the particles effective (Deutscher, Blake, Reid, "Articulated Body Motion Capture by Annealed
/// Particle Filtering", CVPR 2000). `log_weights` as above.
double annealing_exponent(std::span<const double> log_weights, double survival_rate);

}  // namespace anneal6d
