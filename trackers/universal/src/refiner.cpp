// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "refiner.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "twist.h"

namespace anneal6d {
namespace {

constexpr double kSpacing_px = 3.0;
constexpr double kBlurSigma_px = 1.0;
constexpr int kMaxReach_px = 32;
constexpr double kFaintest = 2.5;       // grey levels a pixel: weaker slopes are no edge
constexpr double kHalfStrength = 10.0;  // slope at which an edge counts half of a strong one
constexpr double kCrowdedTrust = 0.1;
constexpr double kSupport_px = 2.0;
constexpr std::size_t kFewestPoints = 8;

double square(double x) { return x * x; }

// Cameras mix light within a pixel and encode it afterwards. On the encoded values an edge seems to lie
// some tenths of a pixel on the dark side of where it is, which makes bright objects large and near.
// So edges are found by the contrast of encoded values, as people see it, but located in linear light.
constexpr int kLightLevels = 65535;
constexpr int kEncodedSteps = 4096;

double decoded_srgb(double encoded) {  // both 0..1
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encoded_srgb(double light) {  // both 0..1
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

const std::array<std::uint16_t, 256>& light_table() {
  static const auto table = [] {
    std::array<std::uint16_t, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<std::uint16_t>(
          std::lround(kLightLevels * decoded_srgb(static_cast<double>(i) / 255.0)));
    }
    return values;
  }();
  return table;
}

/// Grey levels 0..255 of linear light 0..kLightLevels.
double grey_level(double light) {
  static const auto table = [] {
    std::array<float, kEncodedSteps + 1> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] =
          static_cast<float>(255.0 * encoded_srgb(static_cast<double>(i) / kEncodedSteps));
    }
    return values;
  }();
  return table[static_cast<std::size_t>(light * (static_cast<double>(kEncodedSteps) / kLightLevels))];
}

}  // namespace

Refiner::Refiner(const RasterModel& model, const CameraModel& camera)
    : model_(model),
      camera_(camera),
      rasterizer_(model, camera, Shading{}),
      contour_(*model.mesh) {}

void Refiner::set_image(const cv::Mat& image, const Pose& expected_camera_from_object) {
  const double margin_px = kMaxReach_px + 40;
  const Eigen::Vector3d center =
      expected_camera_from_object * model_.mesh->center_mm().cast<double>();
  cv::Rect window(0, 0, camera_.width_px, camera_.height_px);
  if (center.z() > 2 * model_.mesh->radius_mm()) {
    const Eigen::Vector2d middle = camera_.project(center);
    const double radius_px =
        camera_.fx_px * model_.mesh->radius_mm() / (center.z() - model_.mesh->radius_mm()) +
        margin_px;
    window &= cv::Rect(cv::Point(static_cast<int>(middle.x() - radius_px),
                                 static_cast<int>(middle.y() - radius_px)),
                       cv::Size(static_cast<int>(2 * radius_px), static_cast<int>(2 * radius_px)));
  }
  window_ = window;
  if (window_.empty()) return;
  const cv::Mat encoded = image(window_);
  linear_.create(encoded.size(), CV_16UC(encoded.channels()));
  const auto& table = light_table();
  for (int row = 0; row < encoded.rows; ++row) {
    const auto* const from = encoded.ptr<std::uint8_t>(row);
    auto* const to = linear_.ptr<std::uint16_t>(row);
    for (int i = 0; i < encoded.cols * encoded.channels(); ++i) to[i] = table[from[i]];
  }
  cv::GaussianBlur(linear_, smooth_, {}, kBlurSigma_px, kBlurSigma_px, cv::BORDER_REPLICATE);
}

void Refiner::see(const Pose& camera_from_object) {
  points_.clear();
  const Region region = rasterizer_.draw(camera_from_object, 4);
  if (region.empty()) return;
  rasterizer_.take_images(grey_, depth_mm_);
  contour_.extract({camera_from_object, camera_, region, grey_, depth_mm_}, kSpacing_px,
                   !model_.textures.empty(), points_);
}

Refiner::Observation Refiner::observe(const Eigen::Vector2d& image_px,
                                      const Eigen::Vector2d& normal, int reach_px) const {
  // The image along the normal at whole steps: light, and squared slopes of light and of grey levels,
  // summed over the channels.
  constexpr int kLongest = 2 * kMaxReach_px + 5;
  const int channels = smooth_.channels();
  const int last = 2 * reach_px + 4;
  std::array<std::array<double, kLongest>, 3> light, grey;
  for (int i = 0; i <= last; ++i) {
    const Eigen::Vector2d p = image_px + (i - reach_px - 2) * normal;
    const double x = std::clamp(p.x() - window_.x, 0.0, smooth_.cols - 1.001);
    const double y = std::clamp(p.y() - window_.y, 0.0, smooth_.rows - 1.001);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const double fx = x - column, fy = y - row;
    const auto* const upper = smooth_.ptr<std::uint16_t>(row) + column * channels;
    const auto* const lower = smooth_.ptr<std::uint16_t>(row + 1) + column * channels;
    for (int c = 0; c < channels; ++c) {
      light[c][i] = (1 - fy) * ((1 - fx) * upper[c] + fx * upper[c + channels]) +
                    fy * ((1 - fx) * lower[c] + fx * lower[c + channels]);
      grey[c][i] = grey_level(light[c][i]);
    }
  }
  std::array<double, kLongest> light_slope, slope;
  for (int i = 1; i < last; ++i) {
    double light_sum = 0, grey_sum = 0;
    for (int c = 0; c < channels; ++c) {
      light_sum += square(light[c][i + 1] - light[c][i - 1]);
      grey_sum += square(0.5 * (grey[c][i + 1] - grey[c][i - 1]));
    }
    light_slope[i] = std::sqrt(light_sum);
    slope[i] = std::sqrt(grey_sum);
  }

  Observation best{std::numeric_limits<double>::quiet_NaN(), 0};
  double best_score = 0;
  for (int i = 2; i <= last - 2; ++i) {
    if (slope[i] < kFaintest || slope[i] < slope[i - 1] || slope[i] <= slope[i + 1]) continue;
    // The light's slope peaks at the same step or at a neighbour.
    int peak = i;
    if (light_slope[i - 1] > light_slope[peak] && i > 2) peak = i - 1;
    if (light_slope[i + 1] > light_slope[peak] && i < last - 2) peak = i + 1;
    const double before = light_slope[peak - 1], after = light_slope[peak + 1];
    const double curvature = before - 2 * light_slope[peak] + after;
    const double between = curvature < 0 ? 0.5 * (before - after) / curvature : 0.0;
    const double offset_px = peak - reach_px - 2 + std::clamp(between, -1.0, 1.0);
    // Prefer strong edges, but near ones more.
    const double score =
        slope[i] / (slope[i] + kHalfStrength) * std::exp(-square(offset_px / (0.6 * reach_px)));
    if (score > best_score) {
      best_score = score;
      best = {offset_px, slope[i]};
    }
  }
  return best;
}

double Refiner::step(Pose& camera_from_object, double reach_px) {
  const Eigen::Vector3d center = camera_from_object * model_.mesh->center_mm().cast<double>();
  const Eigen::Matrix3d rotation = camera_from_object.rotation.toRotationMatrix();
  const int reach = std::clamp(static_cast<int>(std::ceil(reach_px)), 2, kMaxReach_px);
  const double cutoff_px = reach_px + 0.5;

  Eigen::Matrix<double, 6, 6> normal_matrix = Eigen::Matrix<double, 6, 6>::Zero();
  Twist right_side = Twist::Zero();
  int supported = 0;
  for (const ContourPoint& point : points_) {
    const Eigen::Vector3d p = rotation * point.object_mm + camera_from_object.translation_mm;
    if (p.z() < kNearPlane_mm) continue;
    const Observation seen = observe(camera_.project(p), point.normal, reach);
    if (std::isnan(seen.offset_px) || std::abs(seen.offset_px) >= cutoff_px) continue;
    supported += std::abs(seen.offset_px) < kSupport_px;

    // d(image)/d(point), then d(point)/d(twist) about the object's centre.
    const double inv_z = 1.0 / p.z();
    const Eigen::RowVector3d gradient(
        point.normal.x() * camera_.fx_px * inv_z, point.normal.y() * camera_.fy_px * inv_z,
        -(point.normal.x() * camera_.fx_px * p.x() + point.normal.y() * camera_.fy_px * p.y()) *
            inv_z * inv_z);
    Twist jacobian;
    jacobian << (p - center).cross(gradient.transpose()), gradient.transpose();

    const double tukey = square(1 - square(seen.offset_px / cutoff_px));
    const double trust = point.crowded ? kCrowdedTrust : 1.0;
    const double weight = trust * tukey * seen.strength / (seen.strength + kHalfStrength);
    normal_matrix += weight * jacobian * jacobian.transpose();
    right_side += weight * seen.offset_px * jacobian;
  }
  // Directions that no edge constrains (the turn of a bowl about its axis) stay as they are.
  const double radius_mm = model_.mesh->radius_mm();
  const double scale = 5e-4 * (normal_matrix(3, 3) + normal_matrix(4, 4)) + 1e-9;
  for (int i = 0; i < 3; ++i) {
    normal_matrix(i, i) += scale * square(radius_mm) * 0.3;
    normal_matrix(i + 3, i + 3) += scale;
  }
  const Twist twist = normal_matrix.ldlt().solve(right_side);
  if (twist.allFinite()) {
    const Pose centered = moved({camera_from_object.rotation, center}, twist);
    camera_from_object = {centered.rotation, centered * -model_.mesh->center_mm().cast<double>()};
  }
  return points_.empty() ? 0.0
                         : static_cast<double>(supported) / static_cast<double>(points_.size());
}

Refiner::Result Refiner::refine(const Pose& start_camera_from_object, double reach_px) {
  Result result{start_camera_from_object, 0, 0};
  if (window_.empty()) return result;
  Pose pose = start_camera_from_object;
  double reach = reach_px;
  for (int round = 0; round < 4; ++round) {
    see(pose);
    if (points_.size() < kFewestPoints) return result;
    for (int i = 0; i < 3; ++i) step(pose, reach);
    reach = std::max(2.5, 0.55 * reach);
  }
  see(pose);
  if (points_.size() < kFewestPoints) return result;
  result.points = static_cast<int>(points_.size());
  Pose last = pose;
  result.support = step(last, 2.5);
  result.camera_from_object = pose;
  return result;
}

}  // namespace anneal6d
