// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/annealing.h"

#include <gtest/gtest.h>

namespace anneal6d {
namespace {

TEST(Annealing, StartsAtFullNoise) {
  EXPECT_EQ(annealing_factor(AnnealingRule::thesis, 0, 0.9, 0.5), 1.0);
  EXPECT_EQ(annealing_factor(AnnealingRule::geometric, 0, 0.9, 0.5), 1.0);
}

TEST(Annealing, ScalesTheAmplitudeByWhatTheRatingLeavesInThesisMode) {
  EXPECT_DOUBLE_EQ(annealing_factor(AnnealingRule::thesis, 1, 0.75, 1.0), 0.25);
  EXPECT_DOUBLE_EQ(annealing_factor(AnnealingRule::thesis, 4, 0.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(annealing_factor(AnnealingRule::thesis, 2, 1.0, 1.0), 0.0);
}

TEST(Annealing, NarrowsAsTheRatingsOfAFrameRise) {
  EXPECT_NEAR(annealing_factor(AnnealingRule::thesis, 1, 0.12, 1.0), 0.88, 1e-12);
  EXPECT_NEAR(annealing_factor(AnnealingRule::thesis, 2, 0.34, 1.0), 0.66, 1e-12);
  EXPECT_NEAR(annealing_factor(AnnealingRule::thesis, 3, 0.57, 1.0), 0.43, 1e-12);
}

TEST(Annealing, TakesScoresOutsideTheirRangeAsItsEnds) {
  EXPECT_EQ(annealing_factor(AnnealingRule::thesis, 1, 1.0 + 1e-12, 1.0), 0.0);
  EXPECT_EQ(annealing_factor(AnnealingRule::thesis, 1, -0.1, 1.0), 1.0);
}

TEST(Annealing, NarrowsGeometricallyWhateverTheScore) {
  EXPECT_DOUBLE_EQ(annealing_factor(AnnealingRule::geometric, 1, 0.9, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(annealing_factor(AnnealingRule::geometric, 3, 0.1, 0.5), 0.125);
}

}  // namespace
}  // namespace anneal6d
