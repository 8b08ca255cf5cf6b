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

/// `high` such that the strongest tenth of the gradient's pixels passes, at least 24 grey levels;
/// low is 0.4 of it. Or what `EdgeOptions` give.
struct EdgeThresholds {
  int low = 0;
  int high = 0;
};

/// Detects edges image after image. It keeps its intermediate images, so that it allocates none
/// once it has met the largest (but for OpenCV's Canny, which has one of its own). Images are
/// CV_8UC1 or CV_8UC3, their distortion removed. One thread at a time.
class EdgeDetector {
 public:
  /// Blur, operator, threshold, dilation, into `edges.binary`: in place if that has the image's
  /// size already, so that whoever shares its pixels sees them change.
  void detect(const cv::Mat& image, const EdgeOptions& options, EdgeImage& edges);

  /// The thresholds that `options` mean for `image`: those given, or automatic ones.
  EdgeThresholds thresholds(const cv::Mat& image, const EdgeOptions& options);

  /// min(max(|Gx|, |Gy|), 255) per pixel (Alg. 4), CV_8UC1, with Sobel's or Prewitt's kernels and
  /// replicated borders; for colour the largest of the channels. Overwritten by the next call.
  cv::Mat gradient(const cv::Mat& image, EdgeOperator op);

 private:
  /// Memory for an image of changing size and type; grows and never shrinks.
  class Scratch {
   public:
    cv::Mat image(cv::Size size, int type);

   private:
    cv::Mat bytes_;
  };

  cv::Mat blurred(const cv::Mat& image, double sigma_px);
  void differentiate(const cv::Mat& image, EdgeOperator op);
  cv::Mat magnitude();
  EdgeThresholds resolved(const EdgeOptions& options);

  Scratch blurred_, gx_scratch_, gy_scratch_, magnitude_x_, magnitude_y_, largest_, channel_;
  cv::Mat gx_, gy_;
};

/// `EdgeDetector::detect` for a single image.
EdgeImage detect_edges(const cv::Mat& image, const EdgeOptions& options);

/// `EdgeDetector::thresholds` for a single image.
EdgeThresholds resolve_thresholds(const cv::Mat& image, const EdgeOptions& options);

}  // namespace anneal6d
