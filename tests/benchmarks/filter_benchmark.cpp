// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// What the particle filter does beside scoring; the argument is the number of particles.
#include <benchmark/benchmark.h>

#include <vector>

#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/random.h"
#include "anneal6d/framework/resampling.h"

namespace anneal6d {
namespace {

/// Weights of a peaked likelihood, summing to 1.
std::vector<double> weights_of(std::size_t count) {
  std::vector<double> logarithms(count), weights(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    logarithms[i] = 3 * random_normals({1, 0, 0, i}, 0)[0];
  }
  normalize_log_weights(logarithms, weights);
  return weights;
}

void draw(benchmark::State& state, Resampling resampling) {
  const std::vector<double> weights = weights_of(static_cast<std::size_t>(state.range()));
  std::vector<std::uint32_t> indices(weights.size());
  RandomKey key;
  for ([[maybe_unused]] auto _ : state) {
    ++key.frame;
    draw_indices(weights, key, resampling, indices);
    benchmark::DoNotOptimize(indices.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range());
}

void mean_pose(benchmark::State& state) {
  const std::vector<double> weights = weights_of(static_cast<std::size_t>(state.range()));
  std::vector<Pose> poses(weights.size());
  for (std::uint32_t i = 0; i < poses.size(); ++i) {
    const RandomKey key{2, 0, 0, i};
    const auto a = random_normals(key, 0), b = random_normals(key, 1), c = random_normals(key, 2);
    poses[i] = {rotation_from_vector(0.1 * Eigen::Vector3d(a[0], a[1], b[0])),
                5 * Eigen::Vector3d(b[1], c[0], c[1])};
  }
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(weighted_mean(poses, weights));
  }
  state.SetItemsProcessed(state.iterations() * state.range());
}

BENCHMARK_CAPTURE(draw, multinomial, Resampling::multinomial)->Arg(200)->Arg(2000);
BENCHMARK_CAPTURE(draw, systematic, Resampling::systematic)->Arg(200)->Arg(2000);
BENCHMARK(mean_pose)->Arg(200)->Arg(2000);

}  // namespace
}  // namespace anneal6d
