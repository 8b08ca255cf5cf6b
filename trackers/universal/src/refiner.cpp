// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "refiner.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "anneal6d/framework/srgb.h"

namespace anneal6d {
namespace {

constexpr double kSpacing_px = 3.0;
constexpr double kBlurSigma_px = 1.0;
constexpr int kMaxReach_px = 32;
constexpr double kFaintest = 2.5;      // grey levels a pixel: weaker slopes are no edge
constexpr double kHalfStrength = 4.0;  // slope at which an edge counts half of a strong one
constexpr int kRenderedReach_px = 2;
constexpr double kMostShading_px = 0.7;  // shift of an edge that stands alone
constexpr double kCrowdedTrust = 0.5;
constexpr double kBlindTrust = 0.1;
constexpr double kSupport_px = 2.0;
constexpr double kStartWeight_px2 = 0.3;  // variance of an edge's place, errors of neighbours alike
constexpr std::size_t kFewestPoints = 8;

double square(double x) { return x * x; }

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
  double operator()(double a, double b) const {
    const auto i = static_cast<std::size_t>(std::clamp(std::lround(a), 0L, 255L));
    const auto j = static_cast<std::size_t>(std::clamp(std::lround(b), 0L, 255L));
    if (i == j) return 0.0;
    const double mean_level = (integral_[j] - integral_[i]) / (light_[j] - light_[i]);
    const double low = static_cast<double>(i) / 255.0, high = static_cast<double>(j) / 255.0;
    return (0.5 * (low + high) - mean_level) / (high - low);
  }

 private:
  std::array<float, 256> light_;
  std::array<double, 256> integral_{};
};

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
  cv::GaussianBlur(image(window_), smooth_, {}, kBlurSigma_px, kBlurSigma_px, cv::BORDER_REPLICATE);
}

void Refiner::see(const Pose& camera_from_object) {
  targets_.clear();
  const Region region = rasterizer_.draw(camera_from_object, 8);
  if (region.empty()) return;
  rasterizer_.take_images(grey_, depth_mm_);
  contour_.extract({camera_from_object, camera_, region, grey_, depth_mm_}, kSpacing_px,
                   !model_.textures.empty(), points_);
  cv::GaussianBlur(grey_, smooth_grey_, {}, kBlurSigma_px, kBlurSigma_px, cv::BORDER_REPLICATE);
  for (const ContourPoint& point : points_) {
    // Blur pushes edges that run side by side apart, and shading pulls a silhouette inwards; it
    // does the same to the rendered picture.
    const Observation rendered = observe({smooth_grey_, {region.x, region.y}},
                                         camera_.project(camera_from_object * point.object_mm),
                                         point.normal, kRenderedReach_px, false);
    const double most_px = point.crowded ? kRenderedReach_px : kMostShading_px;
    const bool seen = std::abs(rendered.offset_px) < most_px;  // false for NaN
    Target target{point, seen ? rendered.offset_px : 0.0, 1.0};
    if (point.crowded) target.trust = seen ? kCrowdedTrust : kBlindTrust;
    targets_.push_back(target);
  }
}

Refiner::Observation Refiner::observe(const Picture& picture, const Eigen::Vector2d& image_px,
                                      const Eigen::Vector2d& normal, int reach_px,
                                      bool camera_encoded) {
  // The image along the normal at whole steps: grey levels of each channel, and their slopes'
  // length.
  constexpr int kMargin = 3;
  constexpr int kLongest = 2 * (kMaxReach_px + kMargin) + 1;
  const cv::Mat& smooth = picture.smooth;
  const int channels = smooth.channels();
  const int middle = reach_px + kMargin, last = 2 * middle;
  std::array<std::array<double, kLongest>, 3> grey;
  for (int i = 0; i <= last; ++i) {
    const Eigen::Vector2d p = image_px + (i - middle) * normal;
    const double x = std::clamp(p.x() - picture.origin.x, 0.0, smooth.cols - 1.001);
    const double y = std::clamp(p.y() - picture.origin.y, 0.0, smooth.rows - 1.001);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const double fx = x - column, fy = y - row;
    const auto* const upper = smooth.ptr<std::uint8_t>(row) + column * channels;
    const auto* const lower = smooth.ptr<std::uint8_t>(row + 1) + column * channels;
    for (int c = 0; c < channels; ++c) {
      grey[c][i] = (1 - fy) * ((1 - fx) * upper[c] + fx * upper[c + channels]) +
                   fy * ((1 - fx) * lower[c] + fx * lower[c + channels]);
    }
  }
  std::array<double, kLongest> slope;
  for (int i = 1; i < last; ++i) {
    double sum = 0;
    for (int c = 0; c < channels; ++c) sum += square(0.5 * (grey[c][i + 1] - grey[c][i - 1]));
    slope[i] = std::sqrt(sum);
  }

  int best = -1;
  double best_score = 0;
  for (int i = kMargin; i <= last - kMargin; ++i) {
    if (slope[i] < kFaintest || slope[i] < slope[i - 1] || slope[i] <= slope[i + 1]) continue;
    // Prefer strong edges, but near ones more.
    const double score =
        slope[i] / (slope[i] + kHalfStrength) * std::exp(-square((i - middle) / (0.6 * reach_px)));
    if (score > best_score) {
      best_score = score;
      best = i;
    }
  }
  if (best < 0) return {std::numeric_limits<double>::quiet_NaN(), 0};

  static const EncodingBias encoding_bias;
  const auto rise = [&](int c) { return std::abs(grey[c][best + 2] - grey[c][best - 2]); };
  int channel = 0;  // the one with the most contrast
  for (int c = 1; c < channels; ++c) {
    if (rise(c) > rise(channel)) channel = c;
  }
  const double before = slope[best - 1], after = slope[best + 1];
  const double between = 0.5 * (before - after) / (before - 2 * slope[best] + after);
  if (!camera_encoded) return {best - middle + between, slope[best]};
  const double bias = encoding_bias(grey[channel][best - 2], grey[channel][best + 2]);
  return {best - middle + between - bias, slope[best]};
}

double Refiner::step(Pose& camera_from_object, double reach_px) {
  const Eigen::Vector3d center = camera_from_object * model_.mesh->center_mm().cast<double>();
  const Eigen::Matrix3d rotation = camera_from_object.rotation.toRotationMatrix();
  const int reach = std::clamp(static_cast<int>(std::ceil(reach_px)), 2, kMaxReach_px);
  const double cutoff_px = reach_px + 0.5;

  Eigen::Matrix<double, 6, 6> normal_matrix = Eigen::Matrix<double, 6, 6>::Zero();
  Twist right_side = Twist::Zero();
  int supported = 0;
  for (const auto& [point, bias_px, trust] : targets_) {
    const Eigen::Vector3d p = rotation * point.object_mm + camera_from_object.translation_mm;
    if (p.z() < kNearPlane_mm) continue;
    Observation seen =
        observe({smooth_, window_.tl()}, camera_.project(p), point.normal, reach, true);
    seen.offset_px -= bias_px;
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
    const double weight = trust * tukey * seen.strength / (seen.strength + kHalfStrength);
    normal_matrix += weight * jacobian * jacobian.transpose();
    right_side += weight * seen.offset_px * jacobian;
  }
  const Pose here = to_center(camera_from_object);
  normal_matrix += Eigen::Matrix<double, 6, 6>(start_precision_.asDiagonal());
  right_side += start_precision_.cwiseProduct(twist_between(here, start_center_));
  const Twist twist = normal_matrix.ldlt().solve(right_side);
  if (twist.allFinite()) {
    const Pose centered = moved(here, twist);
    camera_from_object = {centered.rotation, centered * -model_.mesh->center_mm().cast<double>()};
  }
  return targets_.empty() ? 0.0
                          : static_cast<double>(supported) / static_cast<double>(targets_.size());
}

Pose Refiner::to_center(const Pose& camera_from_object) const {
  return {camera_from_object.rotation,
          camera_from_object * model_.mesh->center_mm().cast<double>()};
}

Refiner::Result Refiner::refine(const Pose& start_camera_from_object, double reach_px,
                                const Twist& sigma) {
  Result result{start_camera_from_object, 0, 0};
  start_center_ = to_center(start_camera_from_object);
  start_precision_ = kStartWeight_px2 * sigma.cwiseProduct(sigma).cwiseInverse();
  if (window_.empty()) return result;
  Pose pose = start_camera_from_object;
  double reach = reach_px;
  for (int round = 0; round < 4; ++round) {
    see(pose);
    if (targets_.size() < kFewestPoints) return result;
    for (int i = 0; i < 3; ++i) step(pose, reach);
    reach = std::max(2.5, 0.55 * reach);
  }
  see(pose);
  if (targets_.size() < kFewestPoints) return result;
  result.points = static_cast<int>(targets_.size());
  Pose last = pose;
  result.support = step(last, 2.5);
  result.camera_from_object = pose;
  return result;
}

}  // namespace anneal6d
