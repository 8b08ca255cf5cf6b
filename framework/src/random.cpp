// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/random.h"

#include <cmath>
#include <numbers>

namespace anneal6d {
namespace {

// Constants of Philox4x32 (Salmon et al., table 2 and section 4.3).
constexpr std::uint32_t kMultiplier0 = 0xD2511F53;
constexpr std::uint32_t kMultiplier1 = 0xCD9E8D57;
constexpr std::uint32_t kWeyl0 = 0x9E3779B9;
constexpr std::uint32_t kWeyl1 = 0xBB67AE85;
constexpr int kRounds = 10;

double unit_interval(std::uint32_t high, std::uint32_t low) {
  const std::uint64_t bits = (static_cast<std::uint64_t>(high) << 32 | low) >> 11;
  return static_cast<double>(bits) * 0x1.0p-53;
}

}  // namespace

std::array<std::uint32_t, 4> random_words(const RandomKey& key, std::uint32_t draw) {
  std::array<std::uint32_t, 4> counter{draw, key.particle, key.layer, key.frame};
  auto key0 = static_cast<std::uint32_t>(key.seed);
  auto key1 = static_cast<std::uint32_t>(key.seed >> 32);
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t product0 = std::uint64_t{kMultiplier0} * counter[0];
    const std::uint64_t product1 = std::uint64_t{kMultiplier1} * counter[2];
    counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key0,
               static_cast<std::uint32_t>(product1),
               static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key1,
               static_cast<std::uint32_t>(product0)};
    key0 += kWeyl0;
    key1 += kWeyl1;
  }
  return counter;
}

double random_uniform(const RandomKey& key, std::uint32_t draw) {
  const auto words = random_words(key, draw);
  return unit_interval(words[0], words[1]);
}

std::array<double, 2> random_normals(const RandomKey& key, std::uint32_t draw) {
  const auto words = random_words(key, draw);
  // 1 - u is in (0, 1]: the logarithm stays finite.
  const double radius = std::sqrt(-2.0 * std::log(1.0 - unit_interval(words[0], words[1])));
  const double angle_rad = 2.0 * std::numbers::pi * unit_interval(words[2], words[3]);
  return {radius * std::cos(angle_rad), radius * std::sin(angle_rad)};
}

}  // namespace anneal6d
