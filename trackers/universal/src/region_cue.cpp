// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "region_cue.h"

#include <limits>

#include "anneal6d/framework/shading.h"
#include "region_kernels.h"

namespace anneal6d {
namespace {

constexpr std::size_t kPoints = 80;  // of each view's silhouette
constexpr std::size_t kEntries = 8;  // of a point: place, normal, inside, outside
constexpr std::size_t kPosesPerColourTask = 32;
constexpr float kClear = 6.0F * Appearance::kScale;
static_assert(kPoints % ColourJob::kPadding == 0);

}  // namespace

RegionCue::RegionCue(const ViewModel& views, const CameraModel& camera, Workers& workers)
    : views_(views),
      camera_(camera),
      workers_(workers),
      silhouettes_(views.views().size() * kEntries * kPoints,
                   std::numeric_limits<float>::quiet_NaN()) {
  float* block = silhouettes_.data();
  for (const ModelView& view : views.views()) {
    std::size_t count = 0;
    for (const ContourSample& sample : view.contour) {
      if (!sample.silhouette) continue;
      float* entry = block + count;
      for (const float value :
           {sample.object_mm.x(), sample.object_mm.y(), sample.object_mm.z(), sample.normal.x(),
            sample.normal.y(), sample.normal.z(), sample.inside_mm, sample.outside_mm}) {
        *entry = value;
        entry += kPoints;
      }
      if (++count == kPoints) break;
    }
    block += kEntries * kPoints;
  }
}

void RegionCue::set_image(const SmoothPicture& picture, const Appearance& appearance) {
  constexpr std::size_t kReadBehind = 4;  // bytes, from the first place on if there is none
  const cv::Mat& smooth = picture.smooth;
  origin_ = picture.origin;
  columns_ = smooth.cols / 2;
  rows_ = smooth.rows / 2;
  log_odds_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) +
                   kReadBehind);
  const int channels = smooth.channels();
  std::int8_t* out = log_odds_.data();
  for (int y = 0; y < rows_; ++y) {
    const auto* const line = smooth.ptr<std::uint8_t>(2 * y);
    for (int x = 0; x < columns_; ++x) {
      *out++ = appearance.log_odds(appearance.bin(line + 2 * x * channels));
    }
  }
}

double RegionCue::score_one(const Pose& camera_from_object) const {
  const auto index =
      static_cast<std::size_t>(&views_.seen_from(camera_from_object) - views_.views().data());
  const float* const block = silhouettes_.data() + index * kEntries * kPoints;
  ColourJob job{.x = block,
                .y = block + kPoints,
                .z = block + 2 * kPoints,
                .nx = block + 3 * kPoints,
                .ny = block + 4 * kPoints,
                .nz = block + 5 * kPoints,
                .inside = block + 6 * kPoints,
                .outside = block + 7 * kPoints,
                .count = kPoints,
                .rotation = {},
                .translation_mm = {},
                .fx = static_cast<float>(camera_.fx_px),
                .fy = static_cast<float>(camera_.fy_px),
                .cx = static_cast<float>(camera_.cx_px - origin_.x),
                .cy = static_cast<float>(camera_.cy_px - origin_.y),
                .near_mm = static_cast<float>(kNearPlane_mm),
                .log_odds = log_odds_.data(),
                .columns = columns_,
                .rows = rows_,
                .clear = kClear};
  const Eigen::Matrix3d rotation = camera_from_object.rotation.toRotationMatrix();
  for (int i = 0; i < 9; ++i) job.rotation[i] = static_cast<float>(rotation(i / 3, i % 3));
  for (int i = 0; i < 3; ++i) {
    job.translation_mm[i] = static_cast<float>(camera_from_object.translation_mm[i]);
  }
  return compare_colours(job);
}

void RegionCue::score(std::span<const Pose> camera_from_object, std::span<double> scores) const {
  workers_.each(scores.size(), kPosesPerColourTask,
                [&](std::size_t i) { scores[i] = score_one(camera_from_object[i]); });
}

}  // namespace anneal6d
