// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/edge_detector.h"

#include <array>
#include <opencv2/imgproc.hpp>
#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

constexpr std::array<std::string_view, 3> kOperatorNames{"sobel", "prewitt", "canny"};

// Automatic thresholds: the strongest tenth of the pixels are edges, yet no gradient below 24 grey
// levels, which is what sensor noise of about 3 grey levels reaches in a Sobel response.
constexpr double kEdgeShare = 0.10;
constexpr int kLowestAutomatic = 24;
constexpr double kLowToHigh = 0.4;
constexpr int kMaxSobelThreshold = 254;
constexpr int kMaxCannyThreshold = 10000;

EdgeThresholds automatic_thresholds(const cv::Mat& gradient) {
  std::array<int, 256> histogram{};
  for (int row = 0; row < gradient.rows; ++row) {
    const auto* const line = gradient.ptr<std::uint8_t>(row);
    for (int column = 0; column < gradient.cols; ++column) ++histogram[line[column]];
  }
  const double wanted = kEdgeShare * static_cast<double>(gradient.total());
  int high = kMaxSobelThreshold;
  // The largest number of pixels above the threshold that is still at most the wanted share.
  for (double above = histogram[255]; high > kLowestAutomatic; --high) {
    above += histogram[static_cast<std::size_t>(high)];
    if (above > wanted) break;
  }
  return {static_cast<int>(kLowToHigh * high), high};
}

}  // namespace

EdgeOperator parse_edge_operator(std::string_view text) {
  for (std::size_t i = 0; i < kOperatorNames.size(); ++i) {
    if (text == kOperatorNames[i]) return static_cast<EdgeOperator>(i);
  }
  throw ConfigError("unknown edge operator '" + std::string(text) +
                    "'; there are: sobel, prewitt, canny");
}

std::string_view to_string(EdgeOperator op) { return kOperatorNames[static_cast<std::size_t>(op)]; }

void EdgeOptions::validate() const {
  const int largest = op == EdgeOperator::canny ? kMaxCannyThreshold : kMaxSobelThreshold;
  if (threshold && (*threshold < 0 || *threshold > largest)) {
    throw ConfigError("edge threshold " + std::to_string(*threshold) + " is not in 0.." +
                      std::to_string(largest) + " for " + std::string(to_string(op)));
  }
  if (low_threshold && op != EdgeOperator::canny) {
    throw ConfigError("a low edge threshold belongs to canny, not to " +
                      std::string(to_string(op)));
  }
  if (low_threshold && (*low_threshold < 0 || (threshold && *low_threshold > *threshold))) {
    throw ConfigError("low edge threshold " + std::to_string(*low_threshold) +
                      " is negative or above the high one");
  }
  if (!(blur_sigma_px >= 0 && blur_sigma_px <= 5)) {
    throw ConfigError("edge blur of " + std::to_string(blur_sigma_px) + " px is not in 0..5");
  }
  if (dilation_px < 0 || dilation_px > 8) {
    throw ConfigError("edge dilation of " + std::to_string(dilation_px) + " px is not in 0..8");
  }
}

cv::Mat EdgeDetector::Scratch::image(cv::Size size, int type) {
  const int wanted = static_cast<int>(CV_ELEM_SIZE(type)) * size.area();
  if (bytes_.cols < wanted) bytes_.create(1, wanted, CV_8UC1);
  return {size, type, bytes_.data};
}

cv::Mat EdgeDetector::blurred(const cv::Mat& image, double sigma_px) {
  if (sigma_px <= 0) return image;
  cv::Mat result = blurred_.image(image.size(), image.type());
  cv::GaussianBlur(image, result, {}, sigma_px, sigma_px, cv::BORDER_REPLICATE);
  return result;
}

/// Fills gx_ and gy_, 16 bits signed.
void EdgeDetector::differentiate(const cv::Mat& image, EdgeOperator op) {
  const int type = CV_MAKETYPE(CV_16S, image.channels());
  gx_ = gx_scratch_.image(image.size(), type);
  gy_ = gy_scratch_.image(image.size(), type);
  // Prewitt's kernel is the unweighted column sum, [1 1 1] across [-1 0 1].
  const cv::Matx13f difference(-1, 0, 1);
  const cv::Matx13f smooth =
      op == EdgeOperator::prewitt ? cv::Matx13f(1, 1, 1) : cv::Matx13f(1, 2, 1);
  cv::sepFilter2D(image, gx_, CV_16S, difference, smooth, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::sepFilter2D(image, gy_, CV_16S, smooth, difference, {-1, -1}, 0, cv::BORDER_REPLICATE);
}

/// Of gx_ and gy_.
cv::Mat EdgeDetector::magnitude() {
  const int channels = gx_.channels();
  cv::Mat x = magnitude_x_.image(gx_.size(), CV_MAKETYPE(CV_8U, channels));
  cv::Mat y = magnitude_y_.image(gx_.size(), CV_MAKETYPE(CV_8U, channels));
  cv::convertScaleAbs(gx_, x);  // saturates at 255
  cv::convertScaleAbs(gy_, y);
  cv::max(x, y, x);
  if (channels == 1) return x;
  cv::Mat largest = largest_.image(x.size(), CV_8UC1);
  cv::Mat next = channel_.image(x.size(), CV_8UC1);
  cv::extractChannel(x, largest, 0);
  for (int c = 1; c < channels; ++c) {
    cv::extractChannel(x, next, c);
    cv::max(largest, next, largest);
  }
  return largest;
}

cv::Mat EdgeDetector::gradient(const cv::Mat& image, EdgeOperator op) {
  differentiate(image, op);
  return magnitude();
}

/// Automatic ones are those of gx_ and gy_.
EdgeThresholds EdgeDetector::resolved(const EdgeOptions& options) {
  EdgeThresholds thresholds;
  if (options.threshold) {
    thresholds.high = *options.threshold;
    thresholds.low = static_cast<int>(kLowToHigh * thresholds.high);
  } else {
    thresholds = automatic_thresholds(magnitude());
  }
  if (options.low_threshold) thresholds.low = std::min(*options.low_threshold, thresholds.high);
  return thresholds;
}

EdgeThresholds EdgeDetector::thresholds(const cv::Mat& image, const EdgeOptions& options) {
  if (!options.threshold) differentiate(blurred(image, options.blur_sigma_px), options.op);
  return resolved(options);
}

void EdgeDetector::detect(const cv::Mat& image, const EdgeOptions& options, EdgeImage& edges) {
  differentiate(blurred(image, options.blur_sigma_px), options.op);
  if (options.op == EdgeOperator::canny) {
    const EdgeThresholds limits = resolved(options);
    cv::Canny(gx_, gy_, edges.binary, limits.low, limits.high);
  } else {
    const cv::Mat strength = magnitude();
    const int limit = options.threshold ? *options.threshold : automatic_thresholds(strength).high;
    cv::threshold(strength, edges.binary, limit, 255, cv::THRESH_BINARY);
  }
  if (options.dilation_px > 0) {
    const int side_px = 2 * options.dilation_px + 1;
    cv::dilate(edges.binary, edges.binary,
               cv::getStructuringElement(cv::MORPH_RECT, {side_px, side_px}));
  }
}

EdgeImage detect_edges(const cv::Mat& image, const EdgeOptions& options) {
  EdgeImage edges;
  EdgeDetector().detect(image, options, edges);
  return edges;
}

EdgeThresholds resolve_thresholds(const cv::Mat& image, const EdgeOptions& options) {
  return EdgeDetector().thresholds(image, options);
}

}  // namespace anneal6d
