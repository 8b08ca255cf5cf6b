// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "evaluation.h"

namespace anneal6d {

/// Frames whose quality is alike, and how many of them were right: within kPrecise_mm and
/// kPrecise_deg.
struct ReliabilityBin {
  double low = 0, high = 0;  ///< the qualities that belong here: low <= q < high, or high = 1
  std::size_t frames = 0;
  double mean_quality = 0;  ///< what was predicted; 0 without frames
  double right_share = 0;   ///< what came true; 0 without frames
  /// 95 % interval of `right_share` (Wilson, "Probable inference", JASA 1927), as if the frames
  /// were independent; [0, 1] without frames.
  double right_low = 0, right_high = 1;
};

/// How far a quality can be taken for the probability that the pose is right.
struct Reliability {
  std::vector<ReliabilityBin> bins;  ///< of equal width, from 0 to 1
  std::size_t frames = 0;
  /// Mean distance between prediction and truth, every frame counting alike: the expected
  /// calibration error (Naeini, Cooper, Hauskrecht, "Obtaining Well Calibrated Probabilities Using
  /// Bayesian Binning", AAAI 2015).
  double calibration_error = 0;
};

/// `bins` is at least 1.
Reliability reliability_of(std::span<const JudgedFrame> frames, std::size_t bins);

}  // namespace anneal6d
