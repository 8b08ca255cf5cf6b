// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "vector_width.h"

namespace anneal6d {

// Inner loops over lines across expected edges, compiled for several instruction sets and chosen at
// run time: each lane of a vector walks along a line of its own.

/// Straight lines through a picture, one sample a pixel, and what is known of the edges expected in
/// the middle of each. Arrays have room for whole vectors.
struct LineJob {
  static constexpr std::size_t kPadding = kLongestVector;  ///< floats
  static constexpr int kMaxReach_px = 32;
  static constexpr std::size_t kCandidates = 3;

  // The picture: 1 or 3 channels of 8 bits, at least 2x2 pixels; beyond its border it goes on as
  // at the border.
  const std::uint8_t* data;
  std::ptrdiff_t stride;  ///< bytes from row to row
  int columns, rows, channels;
  int reach_px;  ///< 1..kMaxReach_px: edges count so far to both sides of the middle

  std::size_t count;                 ///< lines
  const float *x, *y;                ///< middles, pixels of the picture
  const float *normal_x, *normal_y;  ///< unit, along the line
  /// From the middle, to both sides: only so far there is nothing but object (against the normal)
  /// and background; colours farther off say nothing. Negative: colours say nothing at all.
  const float *inside_px, *outside_px;
  /// 1: only edges count whose far side is brighter, -1: darker, 0: all.
  const float* polarity;
  /// How far shading moves the edge of an outline, along the normal, before a black background. It
  /// is taken back from where edges are found, by as much of it as contrast allows; null: it moves
  /// none.
  const float* shading_px;
  float shading_share;  ///< how much of that there is, 0..1
  /// How far the edge moved along its line while the shutter was open; null: nothing moved.
  const float* blur_px;
  /// Logarithm of the odds that a colour is the object's, as of Appearance, with its padding; null:
  /// no colours are known.
  const std::int8_t* log_odds;
};

/// The edges that have most to say for them, the first one first: by their strength, by colours
/// (before the object's border there are its own colours, behind it others), and the nearer the
/// better. Located in light: cameras mix light, within a pixel and while the shutter is open, and
/// encode the mixture, which moves the greatest slope off a step, to its dark side.
struct LineCandidates {
  // For each candidate an entry a line, as many as the lines padded to whole vectors.
  float* offset_px[LineJob::kCandidates];  ///< from the middle, along the normal
  float* weight[LineJob::kCandidates];     ///< 0..1, by the edge's strength; 0: there is none
  float* log_score[LineJob::kCandidates];  ///< how much speaks for it; very low: there is none
  /// Of the first one: how far it would have been moved by all of the shading. Null: not wanted.
  float* whole_shading_px = nullptr;
};
void find_candidates(const LineJob& job, const LineCandidates& candidates);

/// The best edge of each line, located where the slope of grey levels is greatest, but for shading.
struct LineEdges {
  float* offset_px;
  float* strength;   ///< grey levels a pixel; 0: there is no edge
  float* agreement;  ///< 0..1: of the colours with an edge in the middle; 1 without colours
  /// Half of the inverse of the edge's variance, px^-2, as far as a Gaussian fits its slopes; 0
  /// where it is too faint to tell. Null: not wanted.
  float* sharpness = nullptr;
};
void find_strongest(const LineJob& job, const LineEdges& edges);

/// Where colours alone put the object's border: mean and variance of its place, as of Stoiber et
/// al., SRT3D (IJCV 2022); without colours the middle.
void find_borders(const LineJob& job, float* offset_px, float* variance_px2);

/// Counts lines that have an edge from `from_px` to `to_px` away from the middle, along the normal
/// and against it: up to two a line.
int count_edges_beside(const LineJob& job, int from_px, int to_px);

/// Samples of a line beyond its reach, on both sides.
inline constexpr int kLineMargin = 2;
/// Samples of a line at most.
inline constexpr int kLongestLine = 2 * (LineJob::kMaxReach_px + kLineMargin) + 1;

/// The samples themselves, of the first vector of lines, for tests: values of each channel and
/// slopes, values a pixel, norm over the channels, of sample i of line `lane` at
/// [i * kLongestVector + lane].
struct LineSamples {
  float* grey[3];
  float* slope;
};
void sample_lines(const LineJob& job, const LineSamples& samples);

}  // namespace anneal6d
