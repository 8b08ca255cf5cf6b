// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "parameter_names.h"
#include "special_numbers.h"

namespace anneal6d {
namespace {

using test::kInfinity;
using test::kNaN;

std::vector<int> frequencies(const std::vector<std::uint32_t>& indices, std::size_t count) {
  std::vector<int> result(count);
  for (const std::uint32_t index : indices) ++result.at(index);
  return result;
}

std::vector<double> normalized(const std::vector<double>& log_weights) {
  std::vector<double> weights(log_weights.size());
  EXPECT_TRUE(normalize_log_weights(log_weights, weights));
  return weights;
}

class DrawingBy : public testing::TestWithParam<Resampling> {
 protected:
  std::vector<std::uint32_t> draw(const std::vector<double>& weights, std::size_t count,
                                  std::uint64_t seed = 1) {
    std::vector<std::uint32_t> indices(count);
    draw_indices(weights, {.seed = seed}, GetParam(), indices);
    return indices;
  }
};

TEST_P(DrawingBy, DrawsInProportionToTheWeights) {
  const std::vector<double> weights{0.5, 0.0, 0.2, 0.3};
  constexpr int kCount = 40000;
  const auto counts = frequencies(draw(weights, kCount), weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double sigma = std::sqrt(kCount * weights[i] * (1 - weights[i]));
    EXPECT_NEAR(counts[i], kCount * weights[i], 5 * sigma) << "index " << i;
  }
}

TEST_P(DrawingBy, NeverDrawsAWeightOfZero) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    for (const std::uint32_t index : draw({0, 0.25, 0, 0, 0.75, 0}, 7, seed)) {
      EXPECT_TRUE(index == 1 || index == 4) << index << " with seed " << seed;
    }
  }
}

TEST_P(DrawingBy, StaysInRangeIfTheWeightsSumToALittleLessThanOne) {
  const std::vector<double> weights(10, 0.1 - 1e-6);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    for (const std::uint32_t index : draw(weights, 100, seed)) ASSERT_LT(index, 10U);
  }
}

TEST_P(DrawingBy, DependsOnTheKeyAlone) {
  const std::vector<double> weights{0.1, 0.2, 0.3, 0.4};
  EXPECT_EQ(draw(weights, 50, 7), draw(weights, 50, 7));
  const std::vector<double> uneven{0.13, 0.22, 0.31, 0.34};
  EXPECT_NE(draw(uneven, 47, 7), draw(uneven, 47, 9));
}

TEST_P(DrawingBy, CopiesTheOnlyParticle) {
  EXPECT_EQ(draw({1.0}, 3), (std::vector<std::uint32_t>{0, 0, 0}));
}

INSTANTIATE_TEST_SUITE_P(Resampling, DrawingBy,
                         testing::Values(Resampling::multinomial, Resampling::systematic),
                         [](const auto& test) { return parameter_name(test.param); });

TEST(SystematicResampling, DrawsEachIndexAsOftenAsItsShareRoundedUpOrDown) {
  const std::vector<double> weights{0.07, 0.31, 0.02, 0.4, 0.2};
  constexpr int kCount = 37;
  std::vector<std::uint32_t> indices(kCount);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    draw_indices(weights, {.seed = seed}, Resampling::systematic, indices);
    EXPECT_TRUE(std::is_sorted(indices.begin(), indices.end()));
    const auto counts = frequencies(indices, weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      EXPECT_LT(std::abs(counts[i] - kCount * weights[i]), 1.0) << "index " << i;
    }
  }
}

TEST(SystematicResampling, KeepsEveryOneOfEqualParticles) {
  const std::vector<double> weights(64, 1.0 / 64);
  std::vector<std::uint32_t> indices(64), all(64);
  std::iota(all.begin(), all.end(), 0U);
  draw_indices(weights, {.seed = 4}, Resampling::systematic, indices);
  EXPECT_EQ(indices, all);
}

TEST(MultinomialResampling, DrawsIndependently) {
  // Of n draws by equal weights, about a share of 1/e of the particles is not drawn.
  const std::vector<double> weights(2000, 1.0 / 2000);
  std::vector<std::uint32_t> indices(2000);
  draw_indices(weights, {.seed = 4}, Resampling::multinomial, indices);
  const auto counts = frequencies(indices, weights.size());
  EXPECT_NEAR(std::count(counts.begin(), counts.end(), 0) / 2000.0, std::exp(-1.0), 0.05);
}

TEST(NormalizingLogWeights, GivesTheirShares) {
  const auto weights = normalized({std::log(1.0), std::log(3.0), std::log(4.0)});
  EXPECT_NEAR(weights[0], 0.125, 1e-15);
  EXPECT_NEAR(weights[1], 0.375, 1e-15);
  EXPECT_NEAR(weights[2], 0.5, 1e-15);
}

TEST(NormalizingLogWeights, SurvivesHugeAndTinyValues) {
  EXPECT_EQ(normalized({-1e300, -1e300}), (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(normalized({1e300, -1e300}), (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(normalized({-100000.0, -100800.0}), (std::vector<double>{1.0, 0.0}));
  EXPECT_NEAR(normalized({5000.0, 5000.0 - std::log(3.0)})[0], 0.75, 1e-12);
}

TEST(NormalizingLogWeights, CountsImpossibleAndNaNAsZero) {
  EXPECT_EQ(normalized({-kInfinity, -3.0, kNaN, -3.0}), (std::vector<double>{0.0, 0.5, 0.0, 0.5}));
  EXPECT_EQ(normalized({kNaN, 2.0}), (std::vector<double>{0.0, 1.0}));
}

TEST(NormalizingLogWeights, MakesAllEqualIfNothingIsPossible) {
  for (const double impossible : {-kInfinity, kNaN}) {
    std::vector<double> weights(4, 9.0);
    EXPECT_FALSE(normalize_log_weights(std::vector<double>(4, impossible), weights));
    EXPECT_EQ(weights, std::vector<double>(4, 0.25));
  }
}

TEST(EffectiveSampleSize, CountsTheParticlesThatMatter) {
  EXPECT_DOUBLE_EQ(effective_sample_size(std::vector<double>(10, 0.1)), 10);
  EXPECT_DOUBLE_EQ(effective_sample_size(std::vector<double>{0, 1, 0}), 1);
  EXPECT_DOUBLE_EQ(effective_sample_size(std::vector<double>{0.5, 0.5, 0, 0}), 2);
}

TEST(AnnealingExponent, KeepsTheWantedShareEffective) {
  std::vector<double> log_weights;
  for (std::uint32_t i = 0; i < 500; ++i) {
    log_weights.push_back(-20.0 * random_uniform({.seed = 2, .particle = i}, 0));
  }
  for (const double rate : {0.05, 0.25, 0.5, 0.9}) {
    const double beta = annealing_exponent(log_weights, rate);
    std::vector<double> powered = log_weights;
    for (double& value : powered) value *= beta;
    EXPECT_NEAR(effective_sample_size(normalized(powered)) / 500, rate, 1e-3) << rate;
  }
}

TEST(AnnealingExponent, DoesNotDependOnACommonFactorOfTheWeights) {
  const std::vector<double> log_weights{-1, -2, -5, -6, -9}, shifted{999, 998, 995, 994, 991};
  EXPECT_NEAR(annealing_exponent(log_weights, 0.4), annealing_exponent(shifted, 0.4), 1e-9);
}

TEST(AnnealingExponent, IgnoresImpossibleParticles) {
  std::vector<double> log_weights{-1, -2, -3, -kInfinity, kNaN, -4};
  const double beta = annealing_exponent(log_weights, 0.4);
  EXPECT_TRUE(std::isfinite(beta));
  for (double& value : log_weights) value *= beta;
  EXPECT_NEAR(effective_sample_size(normalized(log_weights)), 0.4 * 6, 1e-3);
}

TEST(AnnealingExponent, IsPositiveAndFiniteWhereNoExponentReachesTheRate) {
  for (const std::vector<double>& log_weights :
       {std::vector<double>(5, -3.0), std::vector<double>(5, -kInfinity),
        std::vector<double>{-1, -kInfinity, -kInfinity}}) {
    for (const double rate : {0.01, 0.5, 1.0}) {
      const double beta = annealing_exponent(log_weights, rate);
      EXPECT_TRUE(std::isfinite(beta) && beta > 0) << beta;
    }
  }
}

}  // namespace
}  // namespace anneal6d
