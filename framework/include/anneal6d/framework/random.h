// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cstdint>

namespace anneal6d {

/// Counter-based random numbers (Philox4x32-10; Salmon, Moraes, Dror, Shaw, "Parallel Random
/// Numbers: As Easy as 1, 2, 3", SC 2011): the value depends on the key and counter alone, so that
/// results are the same in any order and on any number of threads.
struct RandomKey {
  std::uint64_t seed = 0;
  std::uint32_t frame = 0;
  std::uint32_t layer = 0;
  std::uint32_t particle = 0;
};

/// Four independent 32-bit words for draw `draw` of the key.
std::array<std::uint32_t, 4> random_words(const RandomKey& key, std::uint32_t draw);

/// Uniform in [0, 1), 53 bits.
double random_uniform(const RandomKey& key, std::uint32_t draw);

/// Two independent standard normals (Box-Muller) per draw.
std::array<double, 2> random_normals(const RandomKey& key, std::uint32_t draw);

}  // namespace anneal6d
