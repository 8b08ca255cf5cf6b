// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "edge_line.h"

#include <algorithm>
#include <cmath>

#include "anneal6d/framework/srgb.h"
#include "ridge.h"

namespace anneal6d {
namespace {

constexpr float kFaintest = 2.5F;     // grey levels a pixel: weaker slopes are no edge
constexpr float kPixelWeight = 0.5F;  // pixels beside each other show the same
constexpr float kNear = 0.6F;         // of the reach: what is farther away is expected less

float square(float x) { return x * x; }

/// Cameras mix light within a pixel and encode the mixture afterwards, so that the slope of grey
/// levels across a step from level a to level b is centred off the step, on its dark side, by up to
/// 0.19 px: bright objects look large and near. For a pixel that mixes evenly, integration by parts
/// gives the offset (mean(a, b) - mean level over the mixtures) / (b - a), counted from a towards
/// b.
class EncodingBias {
 public:
  EncodingBias() : light_(srgb_light_table()) {
    // Integral of the encoded value over light, by trapezoids between grey levels.
    for (std::size_t i = 1; i < integral_.size(); ++i) {
      const double middle = (static_cast<double>(i) - 0.5) / 255.0;
      integral_[i] = integral_[i - 1] + middle * (light_[i] - light_[i - 1]);
    }
  }

  /// In pixels; `a` and `b` in grey levels.
  float operator()(float a, float b) const {
    const auto i = static_cast<std::size_t>(std::clamp(std::lround(a), 0L, 255L));
    const auto j = static_cast<std::size_t>(std::clamp(std::lround(b), 0L, 255L));
    if (i == j) return 0.0F;
    const double mean_level = (integral_[j] - integral_[i]) / (light_[j] - light_[i]);
    const double low = static_cast<double>(i) / 255.0, high = static_cast<double>(j) / 255.0;
    return static_cast<float>((0.5 * (low + high) - mean_level) / (high - low));
  }

 private:
  std::array<float, 256> light_;
  std::array<double, 256> integral_{};
};

}  // namespace

EdgeLine::EdgeLine(const SmoothPicture& picture, const Eigen::Vector2d& middle_px,
                   const Eigen::Vector2d& normal, int reach_px)
    : channels_(picture.smooth.channels()),
      middle_(reach_px + kMargin),
      last_(2 * middle_),
      inv_reach_(1.0F / static_cast<float>(reach_px)) {
  const cv::Mat& smooth = picture.smooth;
  const auto reach = static_cast<double>(middle_);
  sample_line({.data = smooth.ptr<std::uint8_t>(),
               .stride = static_cast<std::ptrdiff_t>(smooth.step[0]),
               .columns = smooth.cols,
               .rows = smooth.rows,
               .channels = channels_,
               .x = static_cast<float>(middle_px.x() - picture.origin.x - reach * normal.x()),
               .y = static_cast<float>(middle_px.y() - picture.origin.y - reach * normal.y()),
               .step_x = static_cast<float>(normal.x()),
               .step_y = static_cast<float>(normal.y()),
               .count = last_ + 1,
               .grey = {grey_[0].data(), grey_[1].data(), grey_[2].data()},
               .slope = slope_.data()});
  std::fill_n(region_.begin(), last_, 0.0F);
}

void EdgeLine::compare(const Appearance& appearance, float inside_px, float outside_px) {
  if (!appearance.learned()) return;
  // Sum of the log odds of what lies before each step: the edge is where it is greatest.
  float sum = 0, greatest = 0;
  const int begin = std::max(1, middle_ - static_cast<int>(inside_px));
  const int end = std::min(last_ - 1, middle_ + static_cast<int>(outside_px));
  for (int i = 1; i < last_; ++i) {
    if (i >= begin && i <= end) {
      std::array<std::uint8_t, 3> pixel;
      for (int c = 0; c < channels_; ++c) pixel[c] = static_cast<std::uint8_t>(grey_[c][i] + 0.5F);
      const float odds = appearance.log_odds(appearance.bin(pixel.data()));
      const float half = odds * (0.5F * kPixelWeight / Appearance::kScale);
      region_[i] = sum + half;
      sum += 2 * half;
    } else {
      region_[i] = sum;
    }
    greatest = i == 1 ? region_[i] : std::max(greatest, region_[i]);
  }
  for (int i = 1; i < last_; ++i) region_[i] -= greatest;
}

float EdgeLine::likelihood(int i) const {
  return std::exp(region_[i] - square(static_cast<float>(i - middle_) * inv_reach_ / kNear));
}

float EdgeLine::score(int i) const {
  if (slope_[i] < kFaintest || slope_[i] < slope_[i - 1] || slope_[i] <= slope_[i + 1]) return 0;
  if (polarity_ != 0) {
    float rise = 0;
    for (int c = 0; c < channels_; ++c) rise += grey_[c][i + 1] - grey_[c][i - 1];
    if (rise * static_cast<float>(polarity_) < 0) return 0;
  }
  // Prefer strong edges, but near ones more.
  return edge_weight(slope_[i]) * likelihood(i);
}

float EdgeLine::between(int i) const {
  return static_cast<float>(i - middle_) + ridge_offset(slope_[i - 1], slope_[i], slope_[i + 1]);
}

float EdgeLine::encoding_shift(int i) const {
  static const EncodingBias encoding_bias;
  const auto rise = [&](int c) { return std::abs(grey_[c][i + 2] - grey_[c][i - 2]); };
  int channel = 0;  // the one with the most contrast
  for (int c = 1; c < channels_; ++c) {
    if (rise(c) > rise(channel)) channel = c;
  }
  return encoding_bias(grey_[channel][i - 2], grey_[channel][i + 2]);
}

EdgeLine::Edge EdgeLine::strongest() const {
  Edge best;
  for (int i = kMargin; i <= last_ - kMargin; ++i) {
    const float here = score(i);
    if (here > best.score) best = {between(i), slope_[i], here};
  }
  return best;
}

float EdgeLine::agreement() const { return std::exp(region_[middle_]); }

EdgeLine::Border EdgeLine::border() const {
  float sum = 0, first = 0, second = 0;
  for (int i = kMargin; i <= last_ - kMargin; ++i) {
    const float here = likelihood(i), offset_px = static_cast<float>(i - middle_);
    sum += here;
    first += here * offset_px;
    second += here * square(offset_px);
  }
  const float mean_px = first / sum;
  return {mean_px, std::max(0.0F, second / sum - square(mean_px))};
}

bool EdgeLine::has_edge(int from_px, int to_px) const {
  const int end = std::min(middle_ + to_px, last_ - kMargin);
  for (int i = std::max(middle_ + from_px, kMargin); i <= end; ++i) {
    if (score(i) > 0) return true;
  }
  return false;
}

int EdgeLine::find(std::span<Edge> edges) const {
  std::size_t count = 0;
  for (int i = kMargin; i <= last_ - kMargin; ++i) {
    const float here = score(i);
    if (here <= 0 || (count == edges.size() && here <= edges.back().score)) continue;
    if (count < edges.size()) ++count;
    std::size_t place = count - 1;
    for (; place > 0 && edges[place - 1].score < here; --place) edges[place] = edges[place - 1];
    edges[place] = {between(i) - encoding_shift(i), slope_[i], here};
  }
  return static_cast<int>(count);
}

}  // namespace anneal6d
