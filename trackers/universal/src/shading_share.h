// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include "contour_match.h"

namespace anneal6d {

/// Of the fading towards outlines that the drawing has, how much the scene has: all of it where one
/// light shines from the camera, almost none where light comes from all around. It is learned from
/// the distances of edges that no motion explains.
class ShadingShare {
 public:
  /// How far shading moves an edge is known from a drawing, with noise, which makes a line through
  /// how far edges are off too flat: by this share of its slope.
  static constexpr double kReliability = 0.75;

  void reset() { *this = {}; }

  /// What the edges of a frame say, which were located with share(); if they say nothing, nothing
  /// is learned or forgotten.
  void observe(const ShadingEvidence& evidence);

  double share() const { return share_; }  ///< 0..1

 private:
  static constexpr double kUsual = 0.3;

  double share_ = kUsual;
  // Sums over frames, older ones count less; in the beginning as if little had been seen.
  double information_px2_ = 0.5, explained_px2_ = kReliability * kUsual * information_px2_;
};

}  // namespace anneal6d
