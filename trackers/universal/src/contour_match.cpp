// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "contour_match.h"

#include <Eigen/Dense>
#include <cmath>

#include "anneal6d/framework/shading.h"

namespace anneal6d {
namespace {

constexpr double kDoubt = 5;  // how much larger feigned shares may be than is assumed for steps

double squared(double x) { return x * x; }

}  // namespace

ContourMatch::ContourMatch(const SmoothPicture& picture, const CameraModel& camera,
                           const Eigen::Vector3d& center_mm)
    : picture_(picture), camera_(camera), center_mm_(center_mm) {}

void ContourMatch::project(const Pose& camera_from_object, const ModelView& view,
                           std::size_t most_points) {
  targets_.clear();
  const cv::Rect window(picture_.origin, picture_.smooth.size());
  const Eigen::Matrix3d rotation = camera_from_object.rotation.toRotationMatrix();
  const Eigen::Vector3d camera_mm = camera_from_object.inverse().translation_mm;
  const std::size_t count = std::min(most_points, view.contour.size());
  targets_.reserve(count);
  start_ = {camera_from_object.rotation, camera_from_object * center_mm_};
  motion_.setZero();
  for (std::size_t i = 0; i < count; ++i) {
    const ContourSample& sample = view.contour[i];
    Target target;
    Eigen::Vector3d object_mm = sample.object_mm.cast<double>();
    const Eigen::Vector3d normal = sample.normal.cast<double>();
    // On a round surface the contour slides to where the normal is square to the line of sight.
    const Eigen::Vector3d sight = (object_mm - camera_mm).normalized();
    const Eigen::Vector3d turned = (normal - normal.dot(sight) * sight).normalized();
    object_mm += sample.curve_mm * (turned - normal);

    const Eigen::Vector3d p = rotation * object_mm + camera_from_object.translation_mm;
    if (p.z() < kNearPlane_mm) continue;
    target.camera_mm = p;
    target.image_px = camera_.project(p);
    if (!(target.image_px.x() > window.x + 1 && target.image_px.y() > window.y + 1 &&
          target.image_px.x() < window.br().x - 2 && target.image_px.y() < window.br().y - 2)) {
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

void ContourMatch::observe(int reach_px, const Appearance& appearance) {
  std::array<EdgeLine::Edge, kCandidates> edges;
  for (Target& target : targets_) {
    EdgeLine line(picture_, target.image_px, target.normal, reach_px);
    if (target.silhouette) line.compare(appearance, target.inside_px, target.outside_px);
    line.require(target.polarity);
    target.candidate_count = line.find(edges);
    if (target.candidate_count == 0) continue;
    for (int i = 0; i < target.candidate_count; ++i) {
      target.candidates[i] = {edges[i].offset_px - target.shift_px, edge_weight(edges[i].strength),
                              edges[i].score};
    }
    differentiate(target);
  }
}

void ContourMatch::observe_colours(int reach_px, const Appearance& appearance) {
  for (Target& target : targets_) {
    target.candidate_count = 0;
    if (!target.silhouette) continue;
    EdgeLine line(picture_, target.image_px, target.normal, reach_px);
    line.compare(appearance, target.inside_px, target.outside_px);
    const EdgeLine::Border border = line.border();
    target.candidate_count = 1;
    target.candidates[0] = {border.offset_px, 1.0 / (1.0 + border.variance_px2), 1.0};
    differentiate(target);
  }
}

void ContourMatch::differentiate(Target& target) const {
  // d(image)/d(point), then d(point)/d(twist) about the object's centre.
  const Eigen::Vector3d& p = target.camera_mm;
  const Eigen::Vector3d arm = p - start_.translation_mm;
  const double fx = camera_.fx_px / p.z(), fy = camera_.fy_px / p.z();
  Twist along_x, along_y;
  const Eigen::Vector3d x_gradient(fx, 0, -fx * p.x() / p.z());
  const Eigen::Vector3d y_gradient(0, fy, -fy * p.y() / p.z());
  along_x << arm.cross(x_gradient), x_gradient;
  along_y << arm.cross(y_gradient), y_gradient;
  target.jacobian = target.normal.x() * along_x + target.normal.y() * along_y;
  target.sweep = along_x.cwiseAbs2() + along_y.cwiseAbs2();
}

void ContourMatch::step(double reach_px) {
  const double cutoff_px = reach_px + 0.5;
  Matrix6 normal_matrix = Matrix6::Zero();
  Twist right_side = Twist::Zero();
  Twist sweep = Twist::Constant(1e-12);
  double whole_weight = 0;
  for (const Target& target : targets_) {
    if (target.candidate_count == 0) continue;
    const double moved_px = target.jacobian.dot(motion_);
    const Candidate* best = &target.candidates[0];
    double residual_px = best->offset_px - moved_px;
    if (target.candidate_count > 1) {
      double best_score = -1;
      for (int i = 0; i < target.candidate_count; ++i) {
        const Candidate& candidate = target.candidates[i];
        const double distance_px = candidate.offset_px - moved_px;
        const double score = candidate.score * std::exp(-squared(distance_px / cutoff_px));
        if (score <= best_score) continue;
        best_score = score;
        best = &candidate;
        residual_px = distance_px;
      }
    }
    if (std::abs(residual_px) >= cutoff_px) continue;
    const double tukey = squared(1 - squared(residual_px / cutoff_px));
    const double weight = target.trust * tukey * best->weight;
    normal_matrix.noalias() += (weight * target.jacobian) * target.jacobian.transpose();
    right_side += (weight * residual_px) * target.jacobian;
    sweep += weight * target.sweep;
    whole_weight += weight;
  }
  // In units that move the points equally far, eigenvalues are shares of the points' motion that
  // edges can see. Errors of the contour's normals feign small ones.
  unit_ = sweep.cwiseSqrt().cwiseInverse();
  shares_ = unit_.asDiagonal() * normal_matrix * unit_.asDiagonal();
  whole_weight_ = whole_weight;
  // Along each eigenvector: the expected pose at share 0, the edges' at share 1, half of each at
  // the feigned one.
  const Twist away = twist_between(expected_center_, moved(start_, motion_)).cwiseQuotient(unit_);
  const Twist pull = right_side.cwiseProduct(unit_);
  const Matrix6 gain = shares_ * shares_ + feigned_share_ * feigned_share_ * Matrix6::Identity();
  const Twist along = gain.ldlt().solve(shares_ * (shares_ * away + pull)) - away;
  const Twist twist = unit_.cwiseProduct(along);
  if (twist.allFinite()) motion_ += twist;
}

Pose ContourMatch::camera_from_object() const {
  const Pose centered = moved(start_, motion_);
  return {centered.rotation, centered * -center_mm_};
}

ContourMatch::Matrix6 ContourMatch::unseen() const {
  // With feigned shares as large as they are seen to be, instead of as they do the least harm.
  const double doubtful = kDoubt * feigned_share_;
  const Matrix6 doubt = doubtful * doubtful * Matrix6::Identity();
  const Matrix6 unseen = (shares_ * shares_ + doubt).ldlt().solve(doubt);
  return unit_.asDiagonal() * unseen * unit_.cwiseInverse().asDiagonal();
}

std::array<Twist, 2> ContourMatch::weak_motions() const {
  const Eigen::SelfAdjointEigenSolver<Matrix6> shares(shares_);
  std::array<Twist, 2> motions;
  for (int k = 0; k < 2; ++k) {
    motions[k] = unit_.cwiseProduct(shares.eigenvectors().col(k)) * std::sqrt(whole_weight_);
  }
  return motions;
}

}  // namespace anneal6d
