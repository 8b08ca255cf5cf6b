// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "frame_clock.h"

#include <gtest/gtest.h>

namespace anneal6d::dc1394 {
namespace {

constexpr std::uint64_t kPeriod_us = 33'333;

TEST(FrameClock, CountsLossesByTheCamerasCounter) {
  FrameClock clock(0);
  EXPECT_EQ(clock.stamp(0, 7, 0).lost_before, 0);
  EXPECT_EQ(clock.stamp(1, 8, 0).lost_before, 0);
  const FrameClock::Stamp stamp = clock.stamp(2, 12, 0);
  EXPECT_EQ(stamp.lost_before, 3);
  EXPECT_EQ(stamp.index, 5);
}

TEST(FrameClock, CountsLossesByTimeWithoutACounter) {
  FrameClock clock(1.0 / 30);
  EXPECT_EQ(clock.stamp(1000, {}, 0).lost_before, 0);
  EXPECT_EQ(clock.stamp(1000 + kPeriod_us + 4000, {}, 0).lost_before, 0) << "a little late";
  EXPECT_EQ(clock.stamp(1000 + 4 * kPeriod_us, {}, 0).lost_before, 2);
}

TEST(FrameClock, DoesNotCountFramesThatWerePassedOver) {
  FrameClock clock(1.0 / 30);
  clock.stamp(0, 0, 0);
  const FrameClock::Stamp stamp = clock.stamp(5 * kPeriod_us, 5, 3);
  EXPECT_EQ(stamp.lost_before, 1);
  EXPECT_EQ(stamp.index, 5);
}

TEST(FrameClock, KnowsThatACounterOverflows) {
  FrameClock clock(0);
  clock.stamp(0, 0xFFFFFFFE, 0);
  EXPECT_EQ(clock.stamp(1, 1, 0).lost_before, 2);
}

TEST(FrameClock, GoesByTimeAfterACameraWasStartedAnew) {
  FrameClock clock(1.0 / 30);
  clock.stamp(0, 500, 0);
  clock.restart();
  EXPECT_EQ(clock.stamp(30 * kPeriod_us, 0, 0).lost_before, 29);
}

TEST(FrameClock, TakesACounterThatJumpsBackForNoLoss) {
  FrameClock clock(1.0 / 30);
  clock.stamp(0, 500, 0);
  EXPECT_EQ(clock.stamp(kPeriod_us, 3, 0).lost_before, 0);
}

TEST(FrameClock, NeverLetsTimeRunBackwards) {
  FrameClock clock(1.0 / 30);
  clock.stamp(1'000'000, {}, 0);
  const double later = clock.stamp(2'000'000, {}, 0).timestamp_s;
  EXPECT_EQ(clock.stamp(1'500'000, {}, 0).timestamp_s, later);
}

}  // namespace
}  // namespace anneal6d::dc1394
