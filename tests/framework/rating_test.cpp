// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/rating.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/random.h"
#include "parameter_names.h"
#include "special_numbers.h"

namespace anneal6d {
namespace {

using test::kInfinity;

std::vector<double> rated(const RatingOptions& options, const std::vector<EdgeMatch>& matches) {
  std::vector<double> log_likelihoods(matches.size(), 123.0);
  rate(options, matches, log_likelihoods);
  return log_likelihoods;
}

std::vector<double> rated(RatingRule rule, const std::vector<EdgeMatch>& matches) {
  return rated(RatingOptions{.rule = rule}, matches);
}

/// The constants of the thesis's example (4.2.3).
const RatingOptions kOfTheThesis{.rule = RatingRule::normalized, .c1 = 0.4, .c2 = 2, .c3 = 4};

TEST(MatchRatio, IsTheMatchedShare) {
  EXPECT_DOUBLE_EQ(match_ratio({200, 50}), 0.25);
  EXPECT_EQ(match_ratio({0, 0}), 0.0);
}

TEST(RatioRating, IsAlgorithm4) {
  const auto values = rated(RatingRule::ratio, {{100, 100}, {100, 40}, {100, 0}});
  EXPECT_DOUBLE_EQ(values[0], 0.0);
  EXPECT_DOUBLE_EQ(values[1], -20 * 0.6);
  EXPECT_DOUBLE_EQ(values[2], -20);
}

TEST(NormalizedRating, IsAlgorithm5) {
  // Rendered 200..400 and matched 50..250: the middle pose is at 1/2 and 1/4 of the ranges.
  const auto values = rated(kOfTheThesis, {{200, 50}, {300, 100}, {400, 250}});
  EXPECT_DOUBLE_EQ(values[0], -20 * (1 - 0.4 * 0.25));
  EXPECT_DOUBLE_EQ(values[1], -20 * (1 - (0.4 / 3 + 2.0 / 16 + 4.0 / 4)));
  EXPECT_DOUBLE_EQ(values[2], -20 * (1 - (0.4 * 0.625 + 2 + 4)));
}

TEST(NormalizedRating, UsesItsConstants) {
  const RatingOptions options{
      .rule = RatingRule::normalized, .c = 3, .c1 = 0.5, .c2 = 0.25, .c3 = 0.125};
  const auto values = rated(options, {{100, 10}, {200, 50}});
  EXPECT_DOUBLE_EQ(values[1], -3 * (1 - (0.5 * 0.25 + 0.25 + 0.125)));
}

TEST(NormalizedRating, ComparesNothingWhereAllAreEqual) {
  const auto values = rated(kOfTheThesis, {{100, 50}, {100, 50}});
  EXPECT_DOUBLE_EQ(values[0], -20 * (1 - 0.4 * 0.5));
  EXPECT_EQ(values[0], values[1]);
}

// Thesis 4.2.3: the pose of 715 rendered edge pixels, tilted back, matches 307 (43 %); the better
// one of 739 matches 310 (42 %).
const std::vector<EdgeMatch> kTiltedAndBetter{{715, 307}, {739, 310}};

TEST(RatioRating, PrefersTheTiltedCupAsTheThesisFound) {
  const auto values = rated(RatingRule::ratio, kTiltedAndBetter);
  EXPECT_GT(values[0], values[1]);
}

TEST(NormalizedRating, PrefersTheBetterCup) {
  for (const RatingOptions& options : {kOfTheThesis, {.rule = RatingRule::normalized}}) {
    const auto values = rated(options, kTiltedAndBetter);
    EXPECT_LT(values[0], values[1]) << "c3 = " << options.c3;
  }
}

TEST(NormalizedRating, IsNotWonByANearPoseThatHardlyMatches) {
  const std::vector<EdgeMatch> right_near_far{{500, 480}, {700, 430}, {300, 285}};
  const auto values = rated(RatingRule::normalized, right_near_far);
  EXPECT_GT(values[0], values[1] + 1);
  EXPECT_GT(values[0], values[2] + 1);
  for (const double value : values) EXPECT_LE(value, 0);
  // As it is with the constants of the thesis, which is why they are not the default.
  const auto of_the_thesis = rated(kOfTheThesis, right_near_far);
  EXPECT_LT(of_the_thesis[0], of_the_thesis[1]);
}

TEST(BalancedRating, HardlyTellsTheTwoCupsApart) {
  const auto by_ratio = rated(RatingRule::ratio, kTiltedAndBetter);
  const auto balanced = rated(RatingRule::balanced, kTiltedAndBetter);
  EXPECT_LT(std::abs(balanced[0] - balanced[1]), std::abs(by_ratio[0] - by_ratio[1]) / 3);
}

/// 9 poses about right at their distance, and one at index 9 beside them.
std::vector<EdgeMatch> batch_with(const EdgeMatch& odd) {
  std::vector<EdgeMatch> matches;
  for (int i = 0; i < 9; ++i) matches.push_back({700 + 5 * i, 500 + 3 * i});
  matches.push_back(odd);
  return matches;
}

// Thesis 4.2.3, "disappearing in z".
TEST(BalancedRating, LetsAFarPoseOfFewPixelsThatAllMatchLose) {
  for (const EdgeMatch& far : {EdgeMatch{30, 30}, EdgeMatch{120, 120}, EdgeMatch{350, 350}}) {
    const auto values = rated(RatingRule::balanced, batch_with(far));
    for (std::size_t i = 0; i < 9; ++i) EXPECT_LT(values[9], values[i]) << far.rendered;
  }
}

TEST(RatioRating, LetsAFarPoseOfFewPixelsThatAllMatchWin) {
  const auto values = rated(RatingRule::ratio, batch_with({30, 30}));
  for (std::size_t i = 0; i < 9; ++i) EXPECT_GT(values[9], values[i]);
}

TEST(BalancedRating, LetsANearPoseThatRendersMuchMoreLose) {
  const auto values = rated(RatingRule::balanced, batch_with({1500, 600}));
  for (std::size_t i = 0; i < 9; ++i) EXPECT_LT(values[9], values[i]);
}

TEST(BalancedRating, IsTheRatioAgainstTheMeanOfOwnAndTypicalPixels) {
  const auto values = rated(RatingRule::balanced, {{100, 60}, {200, 90}, {300, 90}});
  EXPECT_DOUBLE_EQ(values[0], -20 * (1 - 60.0 / 150));
  EXPECT_DOUBLE_EQ(values[1], -20 * (1 - 90.0 / 200));
  EXPECT_DOUBLE_EQ(values[2], -20 * (1 - 90.0 / 250));
}

TEST(BalancedRating, IsTheRatioForAPoseAlone) {
  EXPECT_DOUBLE_EQ(rated(RatingRule::balanced, {{100, 60}})[0], -20 * 0.4);
}

class RatingBy : public testing::TestWithParam<RatingRule> {};

TEST_P(RatingBy, MakesPosesOfWhichNothingWasRenderedImpossible) {
  const auto values = rated(GetParam(), {{0, 0}, {100, 50}, {0, 0}});
  EXPECT_EQ(values[0], -kInfinity);
  EXPECT_TRUE(std::isfinite(values[1]));
  EXPECT_EQ(values[2], -kInfinity);
}

TEST_P(RatingBy, TakesABatchInWhichNothingWasRendered) {
  for (const double value : rated(GetParam(), {{0, 0}, {0, 0}})) EXPECT_EQ(value, -kInfinity);
}

TEST_P(RatingBy, TakesAnEmptyBatch) { EXPECT_TRUE(rated(GetParam(), {}).empty()); }

TEST_P(RatingBy, PrefersMoreMatchesOfEquallyManyPixels) {
  const auto values = rated(GetParam(), {{500, 100}, {500, 101}, {500, 499}, {500, 500}});
  for (std::size_t i = 1; i < values.size(); ++i) EXPECT_GT(values[i], values[i - 1]);
}

TEST_P(RatingBy, IsNeverNaN) {
  for (std::uint32_t batch = 0; batch < 500; ++batch) {
    std::vector<EdgeMatch> matches(1 + batch % 8);
    for (std::uint32_t i = 0; i < matches.size(); ++i) {
      const auto words = random_words({.seed = 8, .layer = batch, .particle = i}, 0);
      // Mostly small numbers, zeros among them, and sometimes the greatest.
      matches[i].rendered = words[0] % 16 == 0 ? std::numeric_limits<std::int32_t>::max()
                                               : static_cast<std::int32_t>(words[1] % 4);
      matches[i].matched = static_cast<std::int32_t>(
          words[2] % (1U + static_cast<std::uint32_t>(matches[i].rendered)));
    }
    for (const double value : rated(GetParam(), matches)) EXPECT_FALSE(std::isnan(value));
  }
}

INSTANTIATE_TEST_SUITE_P(Rule, RatingBy,
                         testing::Values(RatingRule::ratio, RatingRule::normalized,
                                         RatingRule::balanced),
                         [](const auto& test) { return parameter_name(test.param); });

TEST(RatingOptionsCheck, AcceptsTheDefaults) { EXPECT_NO_THROW(RatingOptions{}.validate()); }

TEST(RatingOptionsCheck, NamesTheBadConstant) {
  const auto expect_bad = [](double RatingOptions::*field, double value, const char* name) {
    RatingOptions options;
    options.*field = value;
    try {
      options.validate();
      ADD_FAILURE() << name << " = " << value << " was accepted";
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find(std::string(name) + " = "), std::string::npos)
          << error.what();
    }
  };
  expect_bad(&RatingOptions::c, 0, "c");
  expect_bad(&RatingOptions::c, -1, "c");
  expect_bad(&RatingOptions::c, kInfinity, "c");
  expect_bad(&RatingOptions::c1, -0.1, "c1");
  expect_bad(&RatingOptions::c2, std::nan(""), "c2");
  expect_bad(&RatingOptions::c3, -2, "c3");
}

}  // namespace
}  // namespace anneal6d
