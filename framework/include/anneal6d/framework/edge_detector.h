// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <optional>
#include <string_view>

#include "anneal6d/framework/edge_image.h"

namespace anneal6d {

enum class EdgeOperator { sobel, prewitt, canny };

/// "sobel", "prewitt", "canny"; anything else throws ConfigError.
EdgeOperator parse_edge_operator(std::string_view text);
std::string_view to_string(EdgeOperator op);

/// How an edge image is made from a grey or colour image (thesis 4.1.1, Alg. 4, 4.2.2).
struct EdgeOptions {
  EdgeOperator op = EdgeOperator::sobel;
  /// Sobel and Prewitt: an edge is where min(max(|Gx|, |Gy|), 255) > threshold, 0..254 grey levels.
  /// Canny: the high hysteresis threshold, 1..10000 (OpenCV's units). Empty: automatic, from the
  /// statistics of the image's gradient.
  std::optional<int> threshold = std::nullopt;
  /// Canny's low hysteresis threshold, at most the high one; empty: 0.4 of the high one.
  std::optional<int> low_threshold = std::nullopt;
  double blur_sigma_px = 0;  ///< Gaussian before the operator, 0..5; 0: none
  int dilation_px = 0;       ///< edges are widened by this radius afterwards, 0..8; 1 is 3x3

  /// Throws ConfigError naming the bad field.
  void validate() const;
};

/// Thresholds for `gradient` (as of `gradient_magnitude`): `high` such that the strongest
/// tenth of the pixels passes, at least 24 grey levels; low is 0.4 of it.
struct EdgeThresholds {
  int low = 0;
  int high = 0;
};

/// min(max(|Gx|, |Gy|), 255) per pixel (Alg. 4), CV_8UC1, with Sobel's or Prewitt's kernels and
/// replicated borders; for colour the largest of the channels. `image`: CV_8UC1 or CV_8UC3.
cv::Mat gradient_magnitude(const cv::Mat& image, EdgeOperator op);

/// The thresholds that `options` mean for `image`: those given, or automatic ones.
EdgeThresholds resolve_thresholds(const cv::Mat& image, const EdgeOptions& options);

/// Blur, operator, threshold, dilation. `image`: CV_8UC1 or CV_8UC3, distortion removed.
EdgeImage detect_edges(const cv::Mat& image, const EdgeOptions& options);

}  // namespace anneal6d
