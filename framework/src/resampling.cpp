// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/resampling.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace anneal6d {
namespace {

// Draws of resampling; prediction uses those from 0 up.
constexpr std::uint32_t kResamplingDraw = 0xFFFFFFFF;

constexpr int kHalvings = 20;  // of log(beta): exact to 0.002 %

double largest(std::span<const double> log_weights) {
  double result = -std::numeric_limits<double>::infinity();
  for (const double value : log_weights) {
    if (value > result) result = value;  // false for NaN
  }
  return result;
}

/// Effective sample size of exp(beta * log_weights), normalised.
double effective_at(std::span<const double> log_weights, double top, double beta) {
  double sum = 0, sum_of_squares = 0;
  for (const double value : log_weights) {
    const double weight = std::exp(beta * (value - top));
    if (!(weight > 0)) continue;
    sum += weight;
    sum_of_squares += weight * weight;
  }
  return sum * sum / sum_of_squares;
}

}  // namespace

void draw_indices(std::span<const double> weights, const RandomKey& key, Resampling resampling,
                  std::span<std::uint32_t> indices) {
  assert(!weights.empty() && !indices.empty());
  const auto last = static_cast<std::uint32_t>(weights.size() - 1);
  if (resampling == Resampling::systematic) {
    RandomKey own = key;
    own.particle = 0;
    const double offset = random_uniform(own, kResamplingDraw);
    const double step = 1.0 / static_cast<double>(indices.size());
    double cumulated = weights[0];
    std::uint32_t index = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const double target = (static_cast<double>(i) + offset) * step;
      while (cumulated <= target && index < last) cumulated += weights[++index];
      indices[i] = index;
    }
    return;
  }
  std::vector<double> cumulated(weights.size());
  std::partial_sum(weights.begin(), weights.end(), cumulated.begin());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    RandomKey own = key;
    own.particle = static_cast<std::uint32_t>(i);
    const auto above =
        std::upper_bound(cumulated.begin(), cumulated.end(), random_uniform(own, kResamplingDraw));
    // Rounding may leave the sum of all below 1: the last index catches what lies above.
    indices[i] = std::min(static_cast<std::uint32_t>(above - cumulated.begin()), last);
  }
}

bool normalize_log_weights(std::span<const double> log_weights, std::span<double> weights) {
  assert(log_weights.size() == weights.size());
  const double top = largest(log_weights);
  if (!std::isfinite(top)) {
    std::fill(weights.begin(), weights.end(), 1.0 / static_cast<double>(weights.size()));
    return false;
  }
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double weight = std::exp(log_weights[i] - top);
    weights[i] = weight > 0 ? weight : 0.0;  // NaN becomes 0
    sum += weights[i];                       // at least 1: the largest contributes exp(0)
  }
  for (double& weight : weights) weight /= sum;
  return true;
}

double effective_sample_size(std::span<const double> weights) {
  double sum_of_squares = 0;
  for (const double weight : weights) sum_of_squares += weight * weight;
  return 1.0 / sum_of_squares;
}

double annealing_exponent(std::span<const double> log_weights, double survival_rate) {
  const double top = largest(log_weights);
  if (!std::isfinite(top)) return 1.0;
  // The effective size falls as beta grows: bisect in log(beta).
  const double wanted = survival_rate * static_cast<double>(log_weights.size());
  double low = std::log(1e-4), high = std::log(1e4);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (effective_at(log_weights, top, std::exp(middle)) > wanted ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace anneal6d
