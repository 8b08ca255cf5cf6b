// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "contour_match.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "anneal6d/framework/shading.h"

namespace anneal6d {
namespace {

constexpr int kConfirmingLine_px = 4;
constexpr double kRidge = 1e-4;  // of a normal matrix, where a motion does not show
constexpr double kDoubt = 5;     // how much larger feigned shares may be than is assumed for steps

float squared(float x) { return x * x; }

}  // namespace

ContourMatch::ContourMatch(const SmoothPicture& picture, const CameraModel& camera,
                           const Eigen::Vector3d& center_mm, double shading_share)
    : picture_(picture),
      camera_(camera),
      center_mm_(center_mm),
      shading_share_(static_cast<float>(shading_share)) {}

std::size_t ContourMatch::project(const Pose& camera_from_object, const ModelView& view,
                                  std::size_t most_points) {
  const auto samples = std::span(view.contour).first(std::min(most_points, view.contour.size()));
  reserve(samples.size());
  start_ = with_origin_at(center_mm_, camera_from_object);
  motion_.setZero();
  blurred_ = false;

  ProjectionJob job{.samples = samples,
                    .rotation = {},
                    .translation_mm = {},
                    .eye_mm = {},
                    .fx = static_cast<float>(camera_.fx_px),
                    .fy = static_cast<float>(camera_.fy_px),
                    .cx = static_cast<float>(camera_.cx_px - picture_.origin.x),
                    .cy = static_cast<float>(camera_.cy_px - picture_.origin.y),
                    .near_mm = static_cast<float>(kNearPlane_mm),
                    .last_x = static_cast<float>(picture_.smooth.cols - 2),
                    .last_y = static_cast<float>(picture_.smooth.rows - 2)};
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(job.rotation.data()) =
      camera_from_object.rotation.toRotationMatrix().cast<float>();
  Eigen::Map<Eigen::Vector3f>(job.translation_mm.data()) =
      camera_from_object.translation_mm.cast<float>();
  Eigen::Map<Eigen::Vector3f>(job.eye_mm.data()) =
      camera_from_object.inverse().translation_mm.cast<float>();
  count_ = project_contour(job, points_);
  return count_;
}

void ContourMatch::reserve(std::size_t most_points) {
  constexpr std::size_t kRows =
      (sizeof(ProjectedContour) + sizeof(LineCandidates)) / sizeof(float*) + 1;
  const std::size_t length = most_points + LineJob::kPadding;
  if (capacity_ < kRows * length) {
    capacity_ = kRows * length;
    rows_ = std::make_unique_for_overwrite<float[]>(capacity_);
  }
  float* next = rows_.get();
  const auto row = [&] { return std::exchange(next, next + length); };
  points_ = {row(), row(), row(), row(), row(), row(), row(),
             row(), row(), row(), row(), row(), row()};
  moved_px_ = row();
  for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
    candidates_.offset_px[k] = row();
    candidates_.weight[k] = row();
    candidates_.log_score[k] = row();
  }
  candidates_.whole_shading_px = row();
}

LineJob ContourMatch::lines(int reach_px, const Appearance* appearance) const {
  LineJob job = lines_through(picture_.smooth, reach_px);
  job.count = count_;
  job.x = points_.image_x;
  job.y = points_.image_y;
  job.normal_x = points_.normal_x;
  job.normal_y = points_.normal_y;
  job.inside_px = points_.inside_px;
  job.outside_px = points_.outside_px;
  job.polarity = points_.polarity;
  job.shading_px = points_.shading_px;
  job.shading_share = shading_share_;
  if (blurred_) job.blur_px = moved_px_;
  if (appearance && appearance->learned()) job.log_odds = appearance->log_odds();
  return job;
}

std::size_t ContourMatch::silhouettes() const {
  return static_cast<std::size_t>(std::count_if(points_.inside_px, points_.inside_px + count_,
                                                [](float inside_px) { return inside_px >= 0; }));
}

Eigen::Matrix<float, 6, 1> ContourMatch::jacobian(std::size_t point) const {
  const Eigen::Vector3f at(points_.camera_x[point], points_.camera_y[point],
                           points_.camera_z[point]);
  const float x_px = static_cast<float>(camera_.fx_px) * points_.normal_x[point] / at.z();
  const float y_px = static_cast<float>(camera_.fy_px) * points_.normal_y[point] / at.z();
  const Eigen::Vector3f shift(x_px, y_px, -(x_px * at.x() + y_px * at.y()) / at.z());
  const Eigen::Vector3f arm = at - start_.translation_mm.cast<float>();
  Eigen::Matrix<float, 6, 1> jacobian;
  // The cross product by hand: GCC 12 warns of Eigen's.
  jacobian << arm.y() * shift.z() - arm.z() * shift.y(), arm.z() * shift.x() - arm.x() * shift.z(),
      arm.x() * shift.y() - arm.y() * shift.x(), shift;
  return jacobian;
}

void ContourMatch::move(const Twist& motion) {
  const Eigen::Matrix<float, 6, 1> twist = motion.cast<float>();
  for (std::size_t i = 0; i < count_; ++i) moved_px_[i] = std::abs(jacobian(i).dot(twist));
}

void ContourMatch::blur(const Twist& motion) {
  move(motion);
  blurred_ = true;
}

void ContourMatch::observe(int reach_px, const Appearance& appearance) {
  find_candidates(lines(reach_px, &appearance), candidates_);
  for (float* const offset_px : candidates_.offset_px) {
    for (std::size_t i = 0; i < count_; ++i) offset_px[i] -= points_.shift_px[i];
  }
}

void ContourMatch::observe_colours(int reach_px, const Appearance& appearance) {
  float* const variance_px2 = candidates_.weight[1];  // there is no second candidate
  find_borders(lines(reach_px, &appearance), candidates_.offset_px[0], variance_px2);
  for (std::size_t i = 0; i < count_; ++i) {
    const bool silhouette = points_.inside_px[i] >= 0;
    candidates_.weight[0][i] = silhouette ? 1.0F / (1.0F + variance_px2[i]) : 0.0F;
    candidates_.log_score[0][i] = 0;
    for (std::size_t k = 1; k < LineJob::kCandidates; ++k) {
      candidates_.log_score[k][i] = -std::numeric_limits<float>::max();
    }
  }
}

ContourMatch::Confirmation ContourMatch::confirm(double reach_px, double fit_px,
                                                 const Appearance& appearance) {
  if (count_ == 0) return {};
  const LineEdges edges = {candidates_.offset_px[0], candidates_.weight[0], candidates_.weight[1]};
  find_strongest(lines(kConfirmingLine_px, &appearance), edges);
  const auto reach = static_cast<float>(reach_px);
  const auto inverse_fit = static_cast<float>(1.0 / fit_px);
  Confirmation sum;
  for (std::size_t i = 0; i < count_; ++i) {
    const float away_px = std::abs(edges.offset_px[i] - points_.shift_px[i]);
    if (edges.strength[i] <= 0 || away_px >= reach) continue;
    sum.support += edges.agreement[i];
    sum.fit += edges.agreement[i] * std::exp(-0.5F * squared(away_px * inverse_fit));
  }
  const auto count = static_cast<double>(count_);
  return {sum.support / count, sum.fit / count};
}

std::vector<MovedEdge> ContourMatch::moved_edges(const Twist& motion,
                                                 const Appearance& appearance) {
  move(motion);
  float* const sharpness = candidates_.log_score[0];
  find_strongest(
      lines(kConfirmingLine_px, &appearance),
      {candidates_.offset_px[0], candidates_.weight[0], candidates_.weight[1], sharpness});
  std::vector<MovedEdge> edges;
  for (std::size_t i = 0; i < count_; ++i) {
    if (points_.inside_px[i] < 0 || points_.trust[i] < 1) continue;
    edges.push_back({moved_px_[i], sharpness[i]});
  }
  return edges;
}

ShadingEvidence ContourMatch::shading_evidence(int reach_px, const Appearance& appearance) {
  observe(reach_px, appearance);
  // Of how far motions and shading would move an edge, and how far it is off.
  Eigen::Matrix<float, 8, 8> products = Eigen::Matrix<float, 8, 8>::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    const float off_px = candidates_.offset_px[0][i];
    const float near = std::max(0.0F, 1.0F - squared(off_px / static_cast<float>(reach_px)));
    const float weight = candidates_.weight[0][i] * points_.trust[i] * squared(near);
    if (weight <= 0) continue;
    Eigen::Matrix<float, 8, 1> row;
    row << jacobian(i), candidates_.whole_shading_px[i], off_px;
    products.noalias() += weight * row * row.transpose();
  }
  // What no motion explains is the Schur complement of what motions do.
  Matrix6 motions = products.topLeftCorner<6, 6>().cast<double>();
  motions.diagonal() = (1 + kRidge) * motions.diagonal().array() + kRidge;
  const Eigen::Matrix<double, 6, 2> mixed = products.topRightCorner<6, 2>().cast<double>();
  const Eigen::Matrix2d left = products.bottomRightCorner<2, 2>().cast<double>() -
                               mixed.transpose() * motions.ldlt().solve(mixed);
  return {.information_px2 = left(0, 0), .left_px2 = left(0, 1)};
}

double ContourMatch::edges_beside(int from_px, int to_px) const {
  if (count_ == 0) return 0;
  const int hits = count_edges_beside(lines(to_px, nullptr), from_px, to_px);
  return 0.5 * hits / static_cast<double>(count_);
}

void ContourMatch::step(double reach_px) {
  StepJob job{.points = points_,
              .candidates = candidates_,
              .count = count_,
              .center_mm = {},
              .motion = {},
              .fx = static_cast<float>(camera_.fx_px),
              .fy = static_cast<float>(camera_.fy_px),
              .cutoff_px = static_cast<float>(reach_px + 0.5)};
  Eigen::Map<Eigen::Vector3f>(job.center_mm.data()) = start_.translation_mm.cast<float>();
  Eigen::Map<Eigen::Matrix<float, 6, 1>>(job.motion.data()) = motion_.cast<float>();
  const StepSums sums = sum_step(job);
  Matrix6 normal_matrix;
  std::size_t entry = 0;
  for (Eigen::Index row = 0; row < 6; ++row) {
    for (Eigen::Index column = row; column < 6; ++column) {
      normal_matrix(row, column) = normal_matrix(column, row) = sums.normal[entry++];
    }
  }
  const Twist right_side =
      Eigen::Map<const Eigen::Matrix<float, 6, 1>>(sums.right.data()).cast<double>();
  const Twist sweep =
      Twist::Constant(1e-12) +
      Eigen::Map<const Eigen::Matrix<float, 6, 1>>(sums.sweep.data()).cast<double>();
  // In units that move the points equally far, eigenvalues are shares of the points' motion that
  // edges can see. Errors of the contour's normals feign small ones.
  unit_ = sweep.cwiseSqrt().cwiseInverse();
  shares_ = unit_.asDiagonal() * normal_matrix * unit_.asDiagonal();
  whole_weight_ = sums.weight;
  // Along each eigenvector: the expected pose at share 0, the edges' at share 1, half of each at
  // the feigned one.
  const Twist away = twist_between(expected_center_, moved(start_, motion_)).cwiseQuotient(unit_);
  const Twist pull = right_side.cwiseProduct(unit_);
  const Twist along = gain(feigned_share_).ldlt().solve(shares_ * (shares_ * away + pull)) - away;
  const Twist twist = unit_.cwiseProduct(along);
  if (twist.allFinite()) motion_ += twist;
}

Pose ContourMatch::camera_from_object() const {
  return with_origin_at(-center_mm_, moved(start_, motion_));
}

ContourMatch::Matrix6 ContourMatch::gain(double feigned_share) const {
  return shares_ * shares_ + feigned_share * feigned_share * Matrix6::Identity();
}

// For both, feigned shares are as large as they are seen to be, instead of as they do the least
// harm.
ContourMatch::Matrix6 ContourMatch::unseen() const {
  const double doubtful = kDoubt * feigned_share_;
  const Matrix6 doubt = doubtful * doubtful * Matrix6::Identity();
  const Matrix6 unseen = gain(doubtful).ldlt().solve(doubt);
  return unit_.asDiagonal() * unseen * unit_.cwiseInverse().asDiagonal();
}

ContourMatch::Matrix6 ContourMatch::error_px2() const {
  // Along each eigenvector: 1 / share is the squared motion that shows as a pixel, and as much of
  // it is taken over as is not left open.
  const Matrix6 taken = gain(kDoubt * feigned_share_).ldlt().solve(shares_);
  return whole_weight_ *
         (unit_.asDiagonal() * (taken * shares_ * taken.transpose()) * unit_.asDiagonal());
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
