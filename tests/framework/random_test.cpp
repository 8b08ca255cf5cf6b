// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace anneal6d {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Known answers of philox4x32-10, distributed with the authors' Random123 library.
TEST(RandomWords, AreZerosKnownAnswer) {
  EXPECT_EQ(random_words({}, 0), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
}

TEST(RandomWords, AreAllOnesKnownAnswer) {
  constexpr std::uint32_t kOnes = 0xffffffff;
  EXPECT_EQ(random_words({0xffffffffffffffff, kOnes, kOnes, kOnes}, kOnes),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
}

// Counter 243f6a88 85a308d3 13198a2e 03707344, key a4093822 299f31d0: the digits of pi tell every
// word from the others, so this also fixes which field is which word of counter and key.
TEST(RandomWords, ArePisKnownAnswer) {
  const RandomKey key{.seed = 0x299f31d0'a4093822,
                      .frame = 0x03707344,
                      .layer = 0x13198a2e,
                      .particle = 0x85a308d3};
  EXPECT_EQ(random_words(key, 0x243f6a88), (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomWords, DifferInEveryPartOfTheKey) {
  const RandomKey key{.seed = 5, .frame = 1, .layer = 2, .particle = 3};
  std::set<Words> seen{random_words(key, 0), random_words(key, 1)};
  for (auto part : {&RandomKey::frame, &RandomKey::layer, &RandomKey::particle}) {
    RandomKey other = key;
    other.*part += 100;
    seen.insert(random_words(other, 0));
  }
  for (const std::uint64_t seed : {std::uint64_t{6}, 5 + (std::uint64_t{1} << 40)}) {
    RandomKey other = key;
    other.seed = seed;
    seen.insert(random_words(other, 0));
  }
  EXPECT_EQ(seen.size(), 7U);
}

TEST(RandomUniform, TakesItsBitsFromTheFirstTwoWords) {
  // 0x6627e8d5e169c58d without its lowest 11 bits, over 2^53.
  EXPECT_EQ(random_uniform({}, 0), static_cast<double>(0x6627e8d5e169c58d >> 11) * 0x1.0p-53);
}

TEST(RandomUniform, IsUniform) {
  constexpr int kCount = 100000, kBins = 20;
  std::vector<int> bins(kBins);
  double sum = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double value = random_uniform({.seed = 11, .particle = i}, 4);
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    ++bins[static_cast<std::size_t>(value * kBins)];
  }
  EXPECT_NEAR(sum / kCount, 0.5, 5 * std::sqrt(1.0 / 12 / kCount));
  double chi_squared = 0;
  for (const int bin : bins) {
    chi_squared += std::pow(bin - kCount / kBins, 2) / (kCount / kBins);
  }
  EXPECT_LT(chi_squared, 43.8);  // 99.9 % of 19 degrees of freedom
}

TEST(RandomNormals, AreStandardNormalAndIndependent) {
  constexpr int kCount = 100000;
  double mean[2] = {}, square[2] = {}, fourth[2] = {}, product = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const auto normals = random_normals({.seed = 12, .frame = i / 100, .particle = i % 100}, 0);
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_TRUE(std::isfinite(normals[k]));
      mean[k] += normals[k] / kCount;
      square[k] += std::pow(normals[k], 2) / kCount;
      fourth[k] += std::pow(normals[k], 4) / kCount;
    }
    product += normals[0] * normals[1] / kCount;
  }
  // Five standard deviations of each mean: of x, x^2, x^4 and of a product the variance of one
  // sample is 1, 2, 96 and 1.
  const double five = 5 / std::sqrt(static_cast<double>(kCount));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(mean[k], 0, five);
    EXPECT_NEAR(square[k], 1, five * std::sqrt(2.0));
    EXPECT_NEAR(fourth[k], 3, five * std::sqrt(96.0));
  }
  EXPECT_NEAR(product, 0, five);
}

TEST(RandomNormals, OfNeighbouringParticlesAndDrawsDoNotCorrelate) {
  constexpr int kCount = 50000;
  double particles = 0, draws = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double here = random_normals({.seed = 13, .particle = i}, 0)[0];
    particles += here * random_normals({.seed = 13, .particle = i + 1}, 0)[0] / kCount;
    draws += here * random_normals({.seed = 13, .particle = i}, 1)[0] / kCount;
  }
  const double five = 5 / std::sqrt(static_cast<double>(kCount));
  EXPECT_NEAR(particles, 0, five);
  EXPECT_NEAR(draws, 0, five);
}

}  // namespace
}  // namespace anneal6d
