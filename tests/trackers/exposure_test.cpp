// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace anneal6d {
namespace {

constexpr float kFastest_px = 12;

/// The edges of a frame, of which some move faster than others across themselves.
std::vector<MovedEdge> edges_of_a_frame(double share, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.0F, 0.04F);
  std::vector<MovedEdge> edges;
  for (int i = 0; i < 60; ++i) {
    const float moved_px = kFastest_px * static_cast<float>(random() % 1000) / 1000.0F;
    const double ramp_px = share * moved_px;
    const double variance = 2.0 + ramp_px * ramp_px / 12;
    const auto sharpness = static_cast<float>(1 / (2 * variance));
    edges.push_back({moved_px, std::max(0.0F, sharpness + noise(random))});
  }
  return edges;
}

double learned(double share, std::uint32_t frames) {
  Exposure exposure;
  for (std::uint32_t i = 0; i < frames; ++i) exposure.observe(edges_of_a_frame(share, i));
  return exposure.share();
}

TEST(Exposure, IsLearnedFromMovedEdges) {
  for (const double share : {0.3, 0.5, 0.9}) EXPECT_NEAR(learned(share, 20), share, 0.06) << share;
}

TEST(Exposure, IsNoneWhereNothingBlurs) {
  EXPECT_EQ(learned(0, 1), 0);
  EXPECT_EQ(learned(0, 50), 0);
}

TEST(Exposure, IsNoneWhereAllMovesAlike) {
  Exposure exposure;
  for (int i = 0; i < 20; ++i) {
    exposure.observe(std::vector<MovedEdge>(40, MovedEdge{.moved_px = 8, .sharpness = 0.1F}));
  }
  EXPECT_EQ(exposure.share(), 0) << "edges may be soft for other reasons";
}

TEST(Exposure, LeavesOutEdgesTooFaintToTell) {
  Exposure exposure, without;
  for (std::uint32_t i = 0; i < 20; ++i) {
    std::vector<MovedEdge> edges = edges_of_a_frame(0.5, i);
    without.observe(edges);
    for (int k = 0; k < 30; ++k) edges.push_back({.moved_px = 1, .sharpness = 0});
    exposure.observe(edges);
  }
  EXPECT_EQ(exposure.share(), without.share());
}

TEST(Exposure, FollowsTheCamera) {
  Exposure exposure;
  for (std::uint32_t i = 0; i < 50; ++i) exposure.observe(edges_of_a_frame(0.2, i));
  for (std::uint32_t i = 0; i < 150; ++i) exposure.observe(edges_of_a_frame(0.8, i));
  EXPECT_NEAR(exposure.share(), 0.8, 0.06);
}

TEST(Exposure, IsForgottenAtAReset) {
  Exposure exposure;
  for (std::uint32_t i = 0; i < 20; ++i) exposure.observe(edges_of_a_frame(0.5, i));
  exposure.reset();
  EXPECT_EQ(exposure.share(), 0);
  exposure.observe({});
  EXPECT_EQ(exposure.share(), 0);
}

}  // namespace
}  // namespace anneal6d
