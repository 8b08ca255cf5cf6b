// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "shading_share.h"

#include <gtest/gtest.h>

#include <random>

namespace anneal6d {
namespace {

/// What edges say that were located with `located_with` where `there_is` so much shading.
ShadingEvidence evidence(double there_is, double located_with, double information_px2) {
  return {.information_px2 = information_px2,
          .left_px2 = (ShadingShare::kReliability * there_is - located_with) * information_px2};
}

TEST(ShadingShare, IsLearnedFromWhatIsLeft) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.2);
  for (const double share : {0.1, 0.5, 0.9}) {
    ShadingShare learned;
    for (int frame = 0; frame < 60; ++frame) {
      learned.observe(evidence(share + noise(random), learned.share(), 2.0));
    }
    EXPECT_NEAR(learned.share(), share, 0.1);
  }
}

TEST(ShadingShare, FollowsTheLight) {
  ShadingShare learned;
  for (int frame = 0; frame < 30; ++frame) learned.observe(evidence(0.9, learned.share(), 2.0));
  for (int frame = 0; frame < 100; ++frame) learned.observe(evidence(0.1, learned.share(), 2.0));
  EXPECT_NEAR(learned.share(), 0.1, 0.05);
}

TEST(ShadingShare, IsNeverLessThanNoneOrMoreThanAll) {
  ShadingShare less, more;
  for (int frame = 0; frame < 30; ++frame) {
    less.observe(evidence(-2, less.share(), 2.0));
    more.observe(evidence(3, more.share(), 2.0));
  }
  EXPECT_EQ(less.share(), 0);
  EXPECT_EQ(more.share(), 1);
}

TEST(ShadingShare, StaysAsItWasWhereEdgesSayNothing) {
  ShadingShare learned;
  for (int frame = 0; frame < 30; ++frame) learned.observe(evidence(0.8, learned.share(), 2.0));
  const double before = learned.share();
  for (int frame = 0; frame < 10'000; ++frame) learned.observe({});
  EXPECT_NEAR(learned.share(), before, 1e-9);
}

TEST(ShadingShare, IsForgottenAtAReset) {
  ShadingShare learned;
  const double usual = learned.share();
  for (int frame = 0; frame < 30; ++frame) learned.observe(evidence(0.9, learned.share(), 2.0));
  ASSERT_GT(learned.share(), usual + 0.3);
  learned.reset();
  EXPECT_EQ(learned.share(), usual);
}

}  // namespace
}  // namespace anneal6d
