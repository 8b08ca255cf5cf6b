// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "appearance.h"
#include "edge_line.h"
#include "twist.h"
#include "view_model.h"

namespace anneal6d {

/// The visible contour at a pose, what the image shows across it, and the motion that brings both
/// together. For one refinement at a time.
class ContourMatch {
 public:
  static constexpr std::size_t kCandidates = 3;

  /// Where a contour point may be.
  struct Candidate {
    double offset_px = 0;  ///< along the normal
    double weight = 0;     ///< 0..1, in the least squares
    double score = 0;      ///< beside other candidates
  };

  /// A visible contour point and where the image shows it.
  struct Target {
    Eigen::Vector3d camera_mm;
    Eigen::Vector2d image_px, normal;
    double shift_px, trust;
    float inside_px, outside_px;
    bool silhouette;
    int polarity;
    std::array<Candidate, kCandidates> candidates;
    int candidate_count = 0;
    /// Of the place along the normal, and of the squared motion in the image (both directions), for
    /// each entry of a twist about the object's centre; only where there are candidates.
    Twist jacobian = Twist::Zero(), sweep = Twist::Zero();
  };

  /// `center_mm`: the centre of the object, object frame. Picture and camera outlive the match.
  ContourMatch(const SmoothPicture& picture, const CameraModel& camera,
               const Eigen::Vector3d& center_mm);

  /// What the edges leave open, such as the turn of a cup whose handle is hidden, is taken from
  /// this pose (camera_from_center). Errors of the contour let edges seem to show `feigned_share`
  /// of a motion, 0..1, that they do not show.
  void expect(const Pose& camera_from_center, double feigned_share) {
    expected_center_ = camera_from_center;
    feigned_share_ = feigned_share;
  }

  /// Takes the first `most_points` of a view's contour, as far as they are in the picture.
  void project(const Pose& camera_from_object, const ModelView& view, std::size_t most_points);

  const std::vector<Target>& targets() const { return targets_; }

  /// Finds the edges up to `reach_px` from each target.
  void observe(int reach_px, const Appearance& appearance);

  /// Finds the silhouettes by colours alone, up to `reach_px` from each target.
  void observe_colours(int reach_px, const Appearance& appearance);

  /// One Gauss-Newton step on what was observed; what is farther away than `reach_px` counts
  /// nothing.
  void step(double reach_px);

  /// Where the steps since the projection led.
  Pose camera_from_object() const;

  /// See Refiner::Result; at the last step.
  std::array<Twist, 2> weak_motions() const;
  /// See Refiner::Result; at the last step.
  Eigen::Matrix<double, 6, 6> unseen() const;

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  void differentiate(Target& target) const;

  SmoothPicture picture_;
  const CameraModel& camera_;
  Eigen::Vector3d center_mm_;
  Pose expected_center_;
  double feigned_share_ = 1;
  std::vector<Target> targets_;
  Pose start_;  ///< camera_from_center of the projection
  Twist motion_ = Twist::Zero();
  // Of the last step: how far each entry of a twist is to move the points equally far, the normal
  // matrix in these units, and the sum of the weights.
  Twist unit_ = Twist::Ones();
  Matrix6 shares_ = Matrix6::Zero();
  double whole_weight_ = 0;
};

}  // namespace anneal6d
