// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <span>

#include "appearance.h"
#include "line_kernels.h"

namespace anneal6d {

/// Blur of the pictures in which edges are located, sigma of the Gaussian.
inline constexpr double kEdgeBlur_px = 1.0;

/// How much an edge counts, 0..1, whose slope is `strength` grey levels a pixel.
inline float edge_weight(float strength) {
  constexpr float kHalf = 4.0F;  // the slope that counts half
  return strength / (strength + kHalf);
}

/// A blurred picture, CV_8UC1 or CV_8UC3, and where its first pixel lies in the image.
struct SmoothPicture {
  const cv::Mat& smooth;
  cv::Point origin;
};

/// The picture along a short line across an expected edge: where are edges on it, and which of them
/// is the object's?
class EdgeLine {
 public:
  static constexpr int kMaxReach_px = 32;

  struct Edge {
    float offset_px = 0;  ///< from the middle, along the normal
    float strength = 0;   ///< grey levels a pixel; 0: there is no edge
    float score = 0;      ///< 0..1, how much speaks for it
  };

  /// Samples `reach_px` (1..kMaxReach_px) pixels to both sides of `middle_px`.
  EdgeLine(const SmoothPicture& picture, const Eigen::Vector2d& middle_px,
           const Eigen::Vector2d& normal, int reach_px);

  /// Lets colours speak: an edge of the object has its colours before it and others behind it.
  /// Only the given stretches, in pixels from the middle, show nothing but object and background.
  void compare(const Appearance& appearance, float inside_px, float outside_px);

  /// Only edges count whose far side is brighter (1) or darker (-1); 0: all.
  void require(int polarity) { polarity_ = polarity; }

  /// The best edge, located where the slope of grey levels is greatest.
  Edge strongest() const;

  /// The best edges, best first, located in light: cameras mix light within a pixel and encode the
  /// mixture, which moves the greatest slope off a step, to its dark side. Returns their number.
  int find(std::span<Edge> edges) const;

  /// Where colours alone put the object's border: mean and variance of its place.
  struct Border {
    float offset_px, variance_px2;
  };
  /// Needs no edge, which far away may be any; as of Stoiber et al., SRT3D (IJCV 2022). The middle
  /// without colours.
  Border border() const;

  /// Whether there is an edge from one place to another, in pixels from the middle.
  bool has_edge(int from_px, int to_px) const;

  /// How well colours agree with an edge in the middle, 0..1; 1 without colours.
  float agreement() const;

 private:
  static constexpr int kMargin = 3;
  static constexpr int kLongest = 2 * (kMaxReach_px + kMargin) + 1;

  /// How likely the object ends at step i by its colours and the distance from the middle; 1 at
  /// most.
  float likelihood(int i) const;
  /// Score of a slope at step i; 0 if it is no edge.
  float score(int i) const;
  /// Place of the greatest slope around step i, between steps, from the middle.
  float between(int i) const;
  float encoding_shift(int i) const;

  int channels_, middle_, last_;
  int polarity_ = 0;
  float inv_reach_;
  std::array<std::array<float, kLongest + LineJob::kPadding>, 3> grey_;
  std::array<float, kLongest + LineJob::kPadding> slope_;
  std::array<float, kLongest> region_;  ///< log likelihood at each step, 0 at the greatest
};

}  // namespace anneal6d
