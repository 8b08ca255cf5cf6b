// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "region_cue.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "anneal6d/framework/shading.h"

namespace anneal6d {
namespace {

constexpr std::size_t kPoints = 80;
constexpr std::array<double, 3> kDistances_px = {3.0, 8.0, 16.0};
constexpr double kClear = 1.0 * Appearance::kScale;  // odds that count as certain

}  // namespace

RegionCue::RegionCue(const ViewModel& views, const CameraModel& camera)
    : views_(views), camera_(camera) {}

void RegionCue::set_image(const SmoothPicture& picture, const Appearance& appearance) {
  const cv::Mat& smooth = picture.smooth;
  origin_ = picture.origin;
  columns_ = smooth.cols / 2;
  rows_ = smooth.rows / 2;
  log_odds_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const int channels = smooth.channels();
  std::int8_t* out = log_odds_.data();
  for (int y = 0; y < rows_; ++y) {
    const auto* const line = smooth.ptr<std::uint8_t>(2 * y);
    for (int x = 0; x < columns_; ++x) {
      *out++ = appearance.log_odds(appearance.bin(line + 2 * x * channels));
    }
  }
}

int RegionCue::log_odds_at(double x_px, double y_px) const {
  const double column = 0.5 * (x_px - origin_.x), row = 0.5 * (y_px - origin_.y);
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_)) return 0;
  const int x = static_cast<int>(column), y = static_cast<int>(row);
  return log_odds_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(x)];
}

double RegionCue::score_one(const Pose& camera_from_object) const {
  const ModelView& view = views_.seen_from(camera_from_object);
  const Eigen::Matrix3f rotation = camera_from_object.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = camera_from_object.translation_mm.cast<float>();
  const float fx = static_cast<float>(camera_.fx_px), fy = static_cast<float>(camera_.fy_px);
  double sum = 0;
  std::size_t used = 0;
  for (const ContourSample& sample : view.contour) {
    if (!sample.silhouette) continue;
    const Eigen::Vector3f p = rotation * sample.object_mm + translation;
    if (p.z() < kNearPlane_mm) continue;
    const Eigen::Vector3f n = rotation * sample.normal;
    const float inv_z = 1.0F / p.z();
    const float x = fx * p.x() * inv_z + static_cast<float>(camera_.cx_px);
    const float y = fy * p.y() * inv_z + static_cast<float>(camera_.cy_px);
    float nx = fx * (n.x() - p.x() * inv_z * n.z()), ny = fy * (n.y() - p.y() * inv_z * n.z());
    const float length = std::sqrt(nx * nx + ny * ny);
    nx /= length;
    ny /= length;
    const float px_per_mm = length * inv_z;
    double contrast = 0;
    for (const double distance : kDistances_px) {
      const double inside = std::min<double>(distance, sample.inside_mm * px_per_mm);
      const double outside = std::min<double>(distance, sample.outside_mm * px_per_mm);
      contrast += log_odds_at(x - inside * nx, y - inside * ny);
      contrast -= log_odds_at(x + outside * nx, y + outside * ny);
    }
    sum += std::clamp(contrast / (2 * kDistances_px.size() * kClear), -1.0, 1.0);
    if (++used == kPoints) break;
  }
  return used > 0 ? sum / static_cast<double>(used) : 0.0;
}

void RegionCue::score(std::span<const Pose> camera_from_object, std::span<double> scores) const {
  for (std::size_t i = 0; i < scores.size(); ++i) scores[i] = score_one(camera_from_object[i]);
}

}  // namespace anneal6d
