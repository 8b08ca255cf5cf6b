// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "reliability.h"

#include <algorithm>
#include <cmath>

namespace anneal6d {

namespace {

/// `hits` of `bin.frames`, a count of at least 1.
void set_right_share(ReliabilityBin& bin, double hits) {
  constexpr double kZ = 1.959964;  // of the normal distribution, two-sided 95 %
  const double n = static_cast<double>(bin.frames), p = hits / n;
  const double shrink = 1 / (1 + kZ * kZ / n);
  const double middle = shrink * (p + kZ * kZ / (2 * n));
  const double half = shrink * kZ * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n));
  bin.right_share = p;
  bin.right_low = std::max(0.0, middle - half);
  bin.right_high = std::min(1.0, middle + half);
}

}  // namespace

Reliability reliability_of(std::span<const JudgedFrame> frames, std::size_t bins) {
  Reliability reliability;
  reliability.frames = frames.size();
  reliability.bins.resize(bins);
  std::vector<double> hits(bins);
  for (const JudgedFrame& frame : frames) {
    const double place = std::clamp(frame.quality, 0.0, 1.0) * static_cast<double>(bins);
    const std::size_t i = std::min(static_cast<std::size_t>(place), bins - 1);
    ++reliability.bins[i].frames;
    reliability.bins[i].mean_quality += frame.quality;  // the sum, for now
    if (frame.error.is_within(kPrecise_mm, kPrecise_deg)) ++hits[i];
  }
  for (std::size_t i = 0; i < bins; ++i) {
    ReliabilityBin& bin = reliability.bins[i];
    bin.low = static_cast<double>(i) / static_cast<double>(bins);
    bin.high = static_cast<double>(i + 1) / static_cast<double>(bins);
    if (bin.frames == 0) continue;
    bin.mean_quality /= static_cast<double>(bin.frames);
    set_right_share(bin, hits[i]);
    reliability.calibration_error += static_cast<double>(bin.frames) /
                                     static_cast<double>(reliability.frames) *
                                     std::abs(bin.mean_quality - bin.right_share);
  }
  return reliability;
}

}  // namespace anneal6d
