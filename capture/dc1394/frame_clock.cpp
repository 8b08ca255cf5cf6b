// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "frame_clock.h"

#include <algorithm>
#include <cmath>

namespace anneal6d::dc1394 {
namespace {

// A larger step of the counter is not a loss but a camera that counts from somewhere else.
constexpr std::uint32_t kLargestStep = 1'000'000;

}  // namespace

std::int64_t FrameClock::missing(std::uint64_t time_us, std::optional<std::uint32_t> counter,
                                 std::int64_t passed_over) const {
  if (counter && last_counter_) {
    const std::uint32_t step = *counter - *last_counter_;  // also past its overflow
    if (step > 0 && step < kLargestStep) return std::int64_t{step} - 1 - passed_over;
  }
  if (period_s_ <= 0 || time_us <= last_us_) return 0;
  const double periods = static_cast<double>(time_us - last_us_) * 1e-6 / period_s_;
  return std::llround(periods) - 1 - passed_over;
}

FrameClock::Stamp FrameClock::stamp(std::uint64_t time_us, std::optional<std::uint32_t> counter,
                                    std::int64_t passed_over) {
  Stamp stamp;
  if (first_us_) {
    stamp.lost_before = std::max<std::int64_t>(missing(time_us, counter, passed_over), 0);
    index_ += passed_over + stamp.lost_before;
    // The host's clock may be set; time must not run backwards for whoever divides by it.
    time_us = std::max(time_us, last_us_);
  } else {
    first_us_ = time_us;
  }
  stamp.index = ++index_;
  stamp.timestamp_s = static_cast<double>(time_us - *first_us_) * 1e-6;
  last_us_ = time_us;
  last_counter_ = counter;
  return stamp;
}

}  // namespace anneal6d::dc1394
