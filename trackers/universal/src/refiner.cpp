// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "refiner.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "anneal6d/framework/shading.h"

namespace anneal6d {
namespace {

constexpr std::size_t kFewPoints = 100;
constexpr std::size_t kAllPoints = 240;
constexpr int kCoarseRounds = 2;  // with few points; quick refinements have no others
constexpr int kRounds = 4;
constexpr int kPolishingRounds = 2;
constexpr int kStepsPerRound = 3;
constexpr double kFinestReach_px = 2.5;
constexpr double kSupport_px = 2.0;
constexpr double kFit_px = 0.5;
constexpr int kAside_px = 8, kAsideReach_px = 2;  // where edges are no edges of the contour
constexpr std::size_t kFewestPoints = 8;
constexpr double kFeigned = 0.005;  // share of visible motion, see `solve`
constexpr int kColourGap_px = 2;    // blurred edges are of neither colour
constexpr int kColourReach_px = 12;

double squared(double x) { return x * x; }

}  // namespace

Refiner::Refiner(const ViewModel& views, const CameraModel& camera)
    : views_(views), camera_(camera) {}

void Refiner::set_image(const cv::Mat& image, const cv::Rect& window) {
  window_ = window & cv::Rect(0, 0, image.cols, image.rows);
  if (window_.width < 4 || window_.height < 4) window_ = {};
  if (window_.empty()) return;
  cv::GaussianBlur(image(window_), smooth_, {5, 5}, kEdgeBlur_px, kEdgeBlur_px,
                   cv::BORDER_REPLICATE);
}

void Refiner::project(const Pose& camera_from_object, const ModelView& view,
                      std::size_t most_points) {
  targets_.clear();
  const Eigen::Matrix3d rotation = camera_from_object.rotation.toRotationMatrix();
  const Eigen::Vector3d camera_mm = camera_from_object.inverse().translation_mm;
  const std::size_t count = std::min(most_points, view.contour.size());
  for (std::size_t i = 0; i < count; ++i) {
    const ContourSample& sample = view.contour[i];
    Target target;
    target.object_mm = sample.object_mm.cast<double>();
    Eigen::Vector3d normal = sample.normal.cast<double>();
    // On a round surface the contour slides to where the normal is square to the line of sight.
    const Eigen::Vector3d sight = (target.object_mm - camera_mm).normalized();
    const Eigen::Vector3d turned = (normal - normal.dot(sight) * sight).normalized();
    target.object_mm += sample.curve_mm * (turned - normal);

    const Eigen::Vector3d p = rotation * target.object_mm + camera_from_object.translation_mm;
    if (p.z() < kNearPlane_mm) continue;
    target.image_px = camera_.project(p);
    if (!(target.image_px.x() > window_.x + 1 && target.image_px.y() > window_.y + 1 &&
          target.image_px.x() < window_.br().x - 2 && target.image_px.y() < window_.br().y - 2)) {
      continue;
    }
    // How the normal looks in the image.
    const Eigen::Vector3d n = rotation * turned;
    const Eigen::Vector2d across(camera_.fx_px * (n.x() - p.x() / p.z() * n.z()),
                                 camera_.fy_px * (n.y() - p.y() / p.z() * n.z()));
    const double length = across.norm();
    if (!(length > 1e-9)) continue;
    target.normal = across / length;
    const double px_per_mm = length / p.z();
    target.shift_px = sample.shift_px;
    target.trust = sample.trust;
    target.silhouette = sample.silhouette;
    target.polarity = sample.polarity;
    target.inside_px = static_cast<float>(sample.inside_mm * px_per_mm);
    target.outside_px = static_cast<float>(sample.outside_mm * px_per_mm);
    targets_.push_back(target);
  }
}

void Refiner::observe(int reach_px, const Appearance& appearance) {
  for (Target& target : targets_) {
    EdgeLine line(picture(), target.image_px, target.normal, reach_px);
    if (target.silhouette) line.compare(appearance, target.inside_px, target.outside_px);
    line.require(target.polarity);
    target.edge_count = line.find(target.edges);
    for (int i = 0; i < target.edge_count; ++i) {
      target.edges[i].offset_px -= static_cast<float>(target.shift_px);
    }
  }
}

void Refiner::step(Pose& camera_from_object, double reach_px) {
  const Eigen::Vector3d center = camera_from_object * views_.center_mm();
  const Eigen::Matrix3d rotation = camera_from_object.rotation.toRotationMatrix();
  const double cutoff_px = reach_px + 0.5;

  Matrix6 normal_matrix = Matrix6::Zero();
  Twist right_side = Twist::Zero();
  double whole_weight = 0;
  Twist whole_motion = Twist::Constant(1e-12);  // of the points in the image, squared
  for (const Target& target : targets_) {
    if (target.edge_count == 0) continue;
    const Eigen::Vector3d p = rotation * target.object_mm + camera_from_object.translation_mm;
    if (p.z() < kNearPlane_mm) continue;
    const double moved_px = target.normal.dot(camera_.project(p) - target.image_px);
    const EdgeLine::Edge* best = nullptr;
    double best_score = 0, residual_px = 0;
    for (int i = 0; i < target.edge_count; ++i) {
      const double distance_px = target.edges[i].offset_px - moved_px;
      const double score = target.edges[i].score * std::exp(-squared(distance_px / cutoff_px));
      if (score <= best_score) continue;
      best_score = score;
      best = &target.edges[i];
      residual_px = distance_px;
    }
    if (!best || std::abs(residual_px) >= cutoff_px) continue;

    // d(image)/d(point), then d(point)/d(twist) about the object's centre.
    const double inv_z = 1.0 / p.z();
    const double gx = target.normal.x() * camera_.fx_px * inv_z;
    const double gy = target.normal.y() * camera_.fy_px * inv_z;
    const Eigen::Vector3d gradient(gx, gy, -(gx * p.x() + gy * p.y()) * inv_z);
    Twist jacobian;
    jacobian << (p - center).cross(gradient), gradient;

    const double tukey = squared(1 - squared(residual_px / cutoff_px));
    const double weight = target.trust * tukey * edge_weight(best->strength);
    normal_matrix.selfadjointView<Eigen::Lower>().rankUpdate(jacobian, weight);
    right_side += weight * residual_px * jacobian;
    whole_weight += weight;
    const double fx = camera_.fx_px * inv_z, fy = camera_.fy_px * inv_z;
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(fx, 0, -fx * p.x() * inv_z),
                                        Eigen::Vector3d(0, fy, -fy * p.y() * inv_z)}) {
      Twist motion;
      motion << (p - center).cross(axis), axis;
      whole_motion += weight * motion.cwiseAbs2();
    }
  }
  const Pose here = to_center(camera_from_object);
  const Twist twist = solve(here, normal_matrix, right_side, whole_motion, whole_weight);
  if (!twist.allFinite()) return;
  const Pose centered = moved(here, twist);
  camera_from_object = {centered.rotation, centered * -views_.center_mm()};
}

Twist Refiner::solve(const Pose& here, const Matrix6& normal_matrix, const Twist& right_side,
                     const Twist& whole_motion, double whole_weight) {
  // In units that move the points equally far, eigenvalues are shares of the points' motion that
  // edges can see. Errors of the contour's normals feign small ones.
  const Twist unit = whole_motion.cwiseSqrt().cwiseInverse();
  const Matrix6 whole = normal_matrix.selfadjointView<Eigen::Lower>();
  const Eigen::SelfAdjointEigenSolver<Matrix6> shares(unit.asDiagonal() * whole *
                                                      unit.asDiagonal());
  const Matrix6& axes = shares.eigenvectors();
  const Twist away = axes.transpose() * twist_between(expected_center_, here).cwiseQuotient(unit);
  const Twist pull = axes.transpose() * right_side.cwiseProduct(unit);
  Twist along;
  for (int k = 0; k < 6; ++k) {
    // The expected pose at share 0, the edges' at share 1, half of each at kFeigned.
    const double share = std::max(0.0, shares.eigenvalues()[k]);
    along[k] = (share * share * away[k] + share * pull[k]) / (share * share + kFeigned * kFeigned) -
               away[k];
  }
  for (int k = 0; k < 2; ++k) {
    weak_motions_[k] = unit.cwiseProduct(axes.col(k)) * std::sqrt(whole_weight);
  }
  return unit.cwiseProduct(axes * along);
}

Pose Refiner::to_center(const Pose& camera_from_object) const {
  return {camera_from_object.rotation, camera_from_object * views_.center_mm()};
}

Refiner::Result Refiner::refine(const Pose& start_camera_from_object,
                                const Pose& expected_camera_from_object, double reach_px,
                                const Appearance& appearance, Care care) {
  expected_center_ = to_center(expected_camera_from_object);
  Pose pose = start_camera_from_object;
  double reach = reach_px;
  const int rounds = care == Care::quick ? kCoarseRounds : kRounds;
  for (int round = 0; round < rounds && !window_.empty(); ++round) {
    project(pose, views_.seen_from(pose), round < kCoarseRounds ? kFewPoints : kAllPoints);
    if (targets_.size() < kFewestPoints) break;
    observe(std::clamp(static_cast<int>(std::ceil(reach)), 2, EdgeLine::kMaxReach_px), appearance);
    for (int i = 0; i < kStepsPerRound; ++i) step(pose, reach);
    reach = std::max(kFinestReach_px, 0.5 * reach);
  }
  return examine(pose, appearance, care);
}

Pose Refiner::polish(const Pose& refined_camera_from_object,
                     const Pose& expected_camera_from_object, const ModelView& view,
                     const Appearance& appearance) {
  expected_center_ = to_center(expected_camera_from_object);
  Pose pose = refined_camera_from_object;
  for (int round = 0; round < kPolishingRounds && !window_.empty(); ++round) {
    project(pose, view, view.contour.size());
    if (targets_.size() < kFewestPoints) return refined_camera_from_object;
    observe(static_cast<int>(std::ceil(kFinestReach_px)), appearance);
    for (int i = 0; i < kStepsPerRound; ++i) step(pose, kFinestReach_px);
  }
  return pose;
}

Refiner::Result Refiner::examine(const Pose& camera_from_object, const Appearance& appearance,
                                 Care care) {
  Result result{camera_from_object, 0, 0};
  if (window_.empty()) return result;
  project(camera_from_object, views_.seen_from(camera_from_object),
          care == Care::quick ? kFewPoints : kAllPoints);
  if (targets_.size() < kFewestPoints) return result;
  double confirmed = 0, fitting = 0;
  for (const Target& target : targets_) {
    EdgeLine line(picture(), target.image_px, target.normal, 4);
    if (target.silhouette) line.compare(appearance, target.inside_px, target.outside_px);
    line.require(target.polarity);
    const EdgeLine::Edge edge = line.strongest();
    const bool near = edge.strength > 0 && std::abs(edge.offset_px - target.shift_px) < kSupport_px;
    if (!near) continue;
    confirmed += line.agreement();
    fitting +=
        line.agreement() * std::exp(-0.5 * squared((edge.offset_px - target.shift_px) / kFit_px));
  }
  result.fit = fitting / static_cast<double>(targets_.size());
  result.support = confirmed / static_cast<double>(targets_.size());
  return result;
}

double Refiner::chance(const Pose& camera_from_object) {
  if (window_.empty()) return 0;
  project(camera_from_object, views_.seen_from(camera_from_object), kAllPoints);
  if (targets_.empty()) return 0;
  int hits = 0;
  for (const Target& target : targets_) {
    EdgeLine line(picture(), target.image_px, target.normal, kAside_px + kAsideReach_px);
    line.require(target.polarity);
    hits += line.has_edge(kAside_px - kAsideReach_px, kAside_px + kAsideReach_px);
    hits += line.has_edge(-kAside_px - kAsideReach_px, -kAside_px + kAsideReach_px);
  }
  return 0.5 * hits / static_cast<double>(targets_.size());
}

void Refiner::teach(const Pose& camera_from_object, Appearance& appearance) {
  if (window_.empty()) return;
  project(camera_from_object, views_.seen_from(camera_from_object), kAllPoints);
  object_bins_.clear();
  beside_bins_.clear();
  const auto collect = [&](const Target& target, int from, int to,
                           std::vector<std::uint16_t>& bins) {
    for (int along = from; along <= to; ++along) {
      const Eigen::Vector2d place = target.image_px + along * target.normal;
      const int x = static_cast<int>(std::lround(place.x())) - window_.x;
      const int y = static_cast<int>(std::lround(place.y())) - window_.y;
      if (x < 0 || y < 0 || x >= smooth_.cols || y >= smooth_.rows) continue;
      bins.push_back(appearance.bin(smooth_.ptr<std::uint8_t>(y) + x * smooth_.channels()));
    }
  };
  for (const Target& target : targets_) {
    if (!target.silhouette) continue;
    const int inside = std::min(static_cast<int>(target.inside_px), kColourReach_px);
    const int outside = std::min(static_cast<int>(target.outside_px), kColourReach_px);
    collect(target, -inside, -kColourGap_px, object_bins_);
    collect(target, kColourGap_px, outside, beside_bins_);
  }
  appearance.learn(object_bins_, beside_bins_);
}

}  // namespace anneal6d
