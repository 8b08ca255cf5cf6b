// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "view_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <random>

#include "blur_kernels.h"
#include "smooth_picture.h"

namespace anneal6d {
namespace {

constexpr double kSpacing_px = 2.5;
constexpr std::size_t kMostContour = 240;
constexpr std::size_t kSamplesPerTask = 120;
constexpr std::size_t kMostEdges = 300;
constexpr float kProbe_px = 1.6F;  // beside a contour, to tell object from background
constexpr float kBend_px = 2.0F;
constexpr int kFarthest_px = 16;
constexpr int kShiftReach_px = 2;
constexpr double kMostShift_px = 0.7;  // of an edge that stands alone
constexpr float kCrowdedTrust = 0.5F;
constexpr float kBlindTrust = 0.1F;
constexpr float kInnerTrust = 0.5F;  // where the edge is inside the outline depends on light

/// Reproducible on every platform, which std::shuffle is not.
template <class Values>
void shuffle(Values& values, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random() % i]);
}

void blur(const cv::Mat& picture, cv::Mat& smooth) {
  smooth.create(picture.size(), picture.type());
  blur_rows(picture, cv::Rect({}, picture.size()), 0, picture.rows, smooth);
}

}  // namespace

CameraModel view_camera() {
  constexpr int kSize = 256;
  CameraModel camera;
  camera.width_px = camera.height_px = kSize;
  camera.fx_px = camera.fy_px = ViewModel::kRadius_px * ViewModel::kDistance;
  camera.cx_px = camera.cy_px = 0.5 * (kSize - 1);
  return camera;
}

ViewPainter::ViewPainter(const RasterModel& model, const EdgeOptions& edges, const Shading& shading,
                         const CameraModel& camera)
    : model_(model),
      edges_(edges),
      camera_(camera),
      rasterizer_(model, camera_, shading),
      extractor_(*model.mesh) {}

ModelView ViewPainter::paint(const Eigen::Vector3d& direction, std::uint32_t seed) {
  Pose camera_from_object;
  const Eigen::Vector3d forward = -direction;
  const Eigen::Vector3d right = forward.unitOrthogonal();
  Eigen::Matrix3d rotation;
  rotation << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  camera_from_object.rotation = Eigen::Quaterniond(rotation).normalized();
  const Eigen::Vector3d center_mm = model_.mesh->center_mm().cast<double>();
  camera_from_object.translation_mm =
      Eigen::Vector3d(0, 0, ViewModel::kDistance * model_.mesh->radius_mm()) -
      camera_from_object.rotation * center_mm;

  Workers alone(1);  // views are painted side by side
  ModelView view = paint_contour(camera_from_object, kMostContour, seed, alone);
  if (region_.empty()) return view;
  sample_edges(camera_from_object, seed, view);
  return view;
}

float ViewPainter::depth_at(float x, float y) const {
  const int column = cvRound(x), row = cvRound(y);
  if (column < 0 || row < 0 || column >= region_.width || row >= region_.height) return 0.0F;
  return depth_mm_.at<float>(row, column);
}

bool ViewPainter::all_in_image() const {
  return region_.x > 0 && region_.y > 0 && region_.x + region_.width < camera_.width_px &&
         region_.y + region_.height < camera_.height_px;
}

ModelView ViewPainter::paint_contour(const Pose& camera_from_object, std::size_t most_samples,
                                     std::uint32_t seed, Workers& workers) {
  ModelView view;
  workers.each(2, 1, [&](std::size_t part) {
    if (part == 1) return extractor_.pick_edges(camera_from_object);
    region_ = rasterizer_.draw_images(camera_from_object, 8, grey_, &depth_mm_);
  });
  if (region_.empty()) return view;
  workers.each(2, 1, [&](std::size_t part) {
    if (part == 0) {
      extractor_.extract({camera_from_object, camera_, region_, grey_, depth_mm_}, kSpacing_px,
                         model_.patterned, workers, points_);
    } else {
      blur(grey_, smooth_grey_);
      cv::compare(depth_mm_, 0, flat_, cv::CMP_GT);
      blur(flat_, smooth_flat_);
    }
  });
  shuffle(points_, seed);
  if (points_.size() > most_samples) points_.resize(most_samples);
  view.contour.resize(points_.size());
  const std::size_t tasks = (points_.size() + kSamplesPerTask - 1) / kSamplesPerTask;
  workers.each(tasks, 1, [&](std::size_t task) {
    const std::size_t first = task * kSamplesPerTask;
    const std::size_t count = std::min(kSamplesPerTask, points_.size() - first);
    take_samples(std::span(points_).subspan(first, count), camera_from_object,
                 std::span(view.contour).subspan(first, count));
  });
  return view;
}

void ViewPainter::take_samples(std::span<const ContourPoint> points, const Pose& camera_from_object,
                               std::span<ContourSample> samples) const {
  using Row = std::array<float, kSamplesPerTask + LineJob::kPadding>;
  Row x{}, y{}, normal_x{}, normal_y{};
  const Row any_polarity{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d camera_mm = camera_from_object * points[i].object_mm;
    const Eigen::Vector2d image_px = camera_.project(camera_mm);
    Eigen::Vector2d normal = points[i].normal;
    samples[i] = sample_of(points[i], camera_from_object, camera_mm, image_px, normal);
    x[i] = static_cast<float>(image_px.x() - region_.x);
    y[i] = static_cast<float>(image_px.y() - region_.y);
    normal_x[i] = static_cast<float>(normal.x());
    normal_y[i] = static_cast<float>(normal.y());
  }
  struct Edges {
    Row offset_px, strength, agreement;
  } shaded, flat;
  const auto find = [&](const cv::Mat& picture, Edges& edges) {
    LineJob lines = lines_through(picture, kShiftReach_px);
    lines.count = points.size();
    lines.x = x.data();
    lines.y = y.data();
    lines.normal_x = normal_x.data();
    lines.normal_y = normal_y.data();
    lines.polarity = any_polarity.data();
    find_strongest(lines, {edges.offset_px.data(), edges.strength.data(), edges.agreement.data()});
  };
  find(smooth_grey_, shaded);
  find(smooth_flat_, flat);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ContourSample& sample = samples[i];
    if (!sample.silhouette && !points[i].texture) sample.trust = kInnerTrust;
    if (points[i].bend) continue;
    const bool crowded = points[i].crowded;
    const double most_px = crowded ? kShiftReach_px : kMostShift_px;
    const bool found = shaded.strength[i] > 0 && std::abs(shaded.offset_px[i]) < most_px;
    if (found) sample.shift_px = shaded.offset_px[i];
    // If the object were of one brightness, there would be the steps of its outline's pixels.
    if (found && sample.silhouette && !crowded) sample.shift_px -= flat.offset_px[i];
    if (crowded) sample.trust = found ? kCrowdedTrust : kBlindTrust;
  }
}

ContourSample ViewPainter::sample_of(const ContourPoint& point, const Pose& camera_from_object,
                                     const Eigen::Vector3d& camera_mm,
                                     const Eigen::Vector2d& image_px,
                                     Eigen::Vector2d& normal) const {
  const double mm_per_px = camera_mm.z() / camera_.fx_px;
  ContourSample sample;
  if (point.texture) sample.polarity = 1;
  const auto x = static_cast<float>(image_px.x() - region_.x);
  const auto y = static_cast<float>(image_px.y() - region_.y);
  Eigen::Vector2f across_px = normal.cast<float>();
  const auto beside = [&](float px) {
    return depth_at(x + px * across_px.x(), y + px * across_px.y());
  };
  const auto empty_beside = [&](float sign) {
    return beside(sign * kProbe_px) == 0.0F && beside(sign * 2 * kProbe_px) == 0.0F;
  };
  if (empty_beside(-1) || (!empty_beside(1) && beside(-kProbe_px) > beside(kProbe_px))) {
    normal = -normal;  // towards what is farther away
    across_px = -across_px;
    sample.polarity = -sample.polarity;
  }

  sample.object_mm = point.object_mm.cast<float>();
  // Square to the line of sight.
  const Eigen::Vector3d sight = camera_mm.normalized();
  Eigen::Vector3d across(normal.x(), normal.y(), 0);
  across = (across - across.dot(sight) * sight).normalized();
  sample.normal = (camera_from_object.rotation.conjugate() * across).cast<float>();
  sample.silhouette = empty_beside(1) && beside(-kProbe_px) > 0.0F;

  // A sphere of radius r falls back by sqrt(2 r d) at a distance d inside its contour.
  const float behind = beside(kBend_px), before = beside(-kBend_px);
  const double step_mm = 0.03 * model_.mesh->radius_mm();
  if (before > 0.0F && (behind == 0.0F || behind - camera_mm.z() > step_mm)) {
    const double fall_mm = std::max(0.0, camera_mm.z() - before);
    sample.curve_mm = static_cast<float>(
        std::min<double>(fall_mm * fall_mm / (2 * kBend_px * mm_per_px), model_.mesh->radius_mm()));
  }
  if (sample.silhouette) {
    int inside = 1, outside = 1;
    const auto behind_px = [&](int px) { return beside(static_cast<float>(px)); };
    while (inside < kFarthest_px && behind_px(-inside - 1) > 0.0F) ++inside;
    while (outside < kFarthest_px && behind_px(outside + 1) == 0.0F) ++outside;
    sample.inside_mm = static_cast<float>(inside * mm_per_px);
    sample.outside_mm = static_cast<float>(outside * mm_per_px);
  }
  return sample;
}

void ViewPainter::sample_edges(const Pose& camera_from_object, std::uint32_t seed,
                               ModelView& view) {
  std::vector<cv::Point> pixels;
  cv::findNonZero(detect_edges(grey_, edges_).binary, pixels);
  view.edge_px = static_cast<float>(pixels.size());
  shuffle(pixels, seed);
  const Pose object_from_camera = camera_from_object.inverse();
  const int reach = 2 + edges_.dilation_px;
  for (const cv::Point& pixel : pixels) {
    if (view.edge_x.size() == kMostEdges) break;
    // An edge is also found on the pixel beside the object; its depth is that of the object there.
    float depth_mm = 0;
    int nearest = std::numeric_limits<int>::max();
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const int x = pixel.x + dx, y = pixel.y + dy;
        if (x < 0 || y < 0 || x >= region_.width || y >= region_.height) continue;
        const float here = depth_mm_.at<float>(y, x);
        if (here == 0.0F || dx * dx + dy * dy >= nearest) continue;
        nearest = dx * dx + dy * dy;
        depth_mm = here;
      }
    }
    if (depth_mm == 0.0F) continue;
    const Eigen::Vector3d camera_mm(
        (pixel.x + region_.x - camera_.cx_px) / camera_.fx_px * depth_mm,
        (pixel.y + region_.y - camera_.cy_px) / camera_.fy_px * depth_mm, depth_mm);
    const Eigen::Vector3f object_mm = (object_from_camera * camera_mm).cast<float>();
    view.edge_x.push_back(object_mm.x());
    view.edge_y.push_back(object_mm.y());
    view.edge_z.push_back(object_mm.z());
  }
  view.pad_edges();
}

}  // namespace anneal6d
