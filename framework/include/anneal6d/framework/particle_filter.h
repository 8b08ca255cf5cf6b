// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "anneal6d/framework/random.h"
#include "anneal6d/framework/resampling.h"

namespace anneal6d {

/// A skeleton for particle filters over any state (thesis Alg. 1 and 2), as a template method:
/// `run_layer` is the loop, a derived class fills in prediction, measurement and mean.
///
/// Measurement works on the whole batch of states, since a GPU or a thread pool needs that.
template <class State>
class ParticleFilter {
 public:
  virtual ~ParticleFilter() = default;

  /// Every particle starts at `initial` with weight 1/count (thesis Alg. 1). `count` >= 1.
  void initialize(const State& initial, std::size_t count) {
    assert(count >= 1);
    states_.assign(count, initial);
    drawn_.resize(count);
    log_likelihoods_.resize(count);
    weights_.assign(count, 1.0 / static_cast<double>(count));
    best_ = 0;
  }

  /// One pass over the particles (thesis Alg. 2): draw in proportion to the weights, predict,
  /// measure, weigh. Called several times on the same image it is one *layer* of an annealed
  /// particle filter. `key` decides every random number together with the particle's index. Returns
  /// the weighted mean.
  State run_layer(const RandomKey& key, Resampling resampling) {
    resample(key, resampling);           // Alg. 2, line 2
    predict(states_, key);               // Alg. 2, line 3
    measure(states_, log_likelihoods_);  // Alg. 2, line 4
    weigh();                             // Alg. 2, line 5
    return mean(states_, weights_);
  }

  std::span<const State> states() const { return states_; }
  /// Non-negative, summing to 1.
  std::span<const double> weights() const { return weights_; }
  /// The particle with the greatest weight; the first of equals.
  std::size_t best_index() const { return best_; }
  const State& best() const { return states_[best_]; }
  double effective_sample_size() const { return anneal6d::effective_sample_size(weights_); }

 protected:
  /// Moves every particle: drift and diffusion. Draws random numbers from `key` with the particle's
  /// index, so that the order of particles does not matter.
  virtual void predict(std::span<State> states, const RandomKey& key) = 0;
  /// Writes the logarithm of each state's likelihood, up to a common constant; -infinity for
  /// impossible states. NaN counts as impossible.
  virtual void measure(std::span<const State> states, std::span<double> log_likelihoods) = 0;
  /// Weighted mean of states; weights sum to 1.
  virtual State mean(std::span<const State> states, std::span<const double> weights) const = 0;

 private:
  void resample(const RandomKey& key, Resampling resampling) {
    draw_indices(weights_, key, resampling, drawn_);
    drawn_states_.clear();
    for (const std::uint32_t index : drawn_) drawn_states_.push_back(states_[index]);
    states_.swap(drawn_states_);
  }

  void weigh() {
    normalize_log_weights(log_likelihoods_, weights_);
    best_ = static_cast<std::size_t>(std::max_element(weights_.begin(), weights_.end()) -
                                     weights_.begin());
  }

  std::vector<State> states_, drawn_states_;
  std::vector<std::uint32_t> drawn_;
  std::vector<double> log_likelihoods_;
  std::vector<double> weights_;
  std::size_t best_ = 0;
};

}  // namespace anneal6d
