// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <span>

#include "contour_match.h"

namespace anneal6d {

/// Of the time from frame to frame, how long the shutter is open. It is learned from edges: a step
/// that moves by d pixels across itself while light is gathered becomes a ramp, whose variance is
/// larger by d^2 / 12 square pixels.
class Exposure {
 public:
  /// Nothing is known: motion blurs nothing.
  void reset() { *this = {}; }

  /// The edges of a frame, and how far they moved since the last one; if there are none, nothing is
  /// learned or forgotten.
  void observe(std::span<const MovedEdge> edges);

  /// 0..1; of what can be told apart from none.
  double share() const { return share_; }

 private:
  static constexpr int kBins = 10;
  struct Bin {
    double count = 0, sharpness = 0, moved2 = 0;  ///< sums over edges, older ones count less
  };
  double fitted_share() const;

  std::array<Bin, kBins> bins_;  ///< by how far edges moved
  double share_ = 0;
};

}  // namespace anneal6d
