// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "appearance.h"
#include "contour_kernels.h"
#include "line_kernels.h"
#include "smooth_picture.h"
#include "twist.h"
#include "view_model.h"

namespace anneal6d {

/// How far an edge moved across itself, pixels, and how sharp it is, see LineEdges.
struct MovedEdge {
  float moved_px, sharpness;
};

/// What the distances of edges say of the shading's share, see LineJob: squares of how far all of
/// the shading would move them, and products of that with how far they are off, both without what a
/// motion of the object explains.
struct ShadingEvidence {
  double information_px2 = 0, left_px2 = 0;
};

/// The visible contour at a pose, what the image shows across it, and the motion that brings both
/// together. For one refinement at a time.
class ContourMatch {
 public:
  /// `center_mm`: the centre of the object, object frame; `shading_share`: see LineJob. Picture and
  /// camera outlive the match.
  ContourMatch(const SmoothPicture& picture, const CameraModel& camera,
               const Eigen::Vector3d& center_mm, double shading_share);

  /// What the edges leave open, such as the turn of a cup whose handle is hidden, is taken from
  /// this pose (camera_from_center). Errors of the contour let edges seem to show `feigned_share`
  /// of a motion, 0..1, that they do not show.
  void expect(const Pose& camera_from_center, double feigned_share) {
    expected_center_ = camera_from_center;
    feigned_share_ = feigned_share;
  }

  /// Takes the first `most_points` of a view's contour, as far as they are in the picture, and
  /// returns their number.
  std::size_t project(const Pose& camera_from_object, const ModelView& view,
                      std::size_t most_points);

  std::size_t size() const { return count_; }
  /// The points that project() took, in the picture.
  const ProjectedContour& points() const { return points_; }
  std::size_t silhouettes() const;

  /// The points that were projected move by this while the shutter is open, about the object's
  /// centre: edges are found where they are in the middle of that time.
  void blur(const Twist& motion);

  /// Finds the edges up to `reach_px` from each point.
  void observe(int reach_px, const Appearance& appearance);

  /// Finds the silhouettes by colours alone, up to `reach_px` from each point.
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
  /// See Refiner::Result; at the last step.
  Eigen::Matrix<double, 6, 6> error_px2() const;

  /// Shares of the points, 0..1, that have an edge within `reach_px` where colours agree, and, as
  /// far as it is there to `fit_px`; those of Refiner::Result. Takes the place of what was
  /// observed.
  struct Confirmation {
    double support = 0, fit = 0;
  };
  Confirmation confirm(double reach_px, double fit_px, const Appearance& appearance);

  /// The edges of outlines that have none beside them, where the object moved by this since the
  /// last frame. Takes the place of what was observed.
  std::vector<MovedEdge> moved_edges(const Twist& motion, const Appearance& appearance);

  /// What edges nearer than `reach_px` say of shading.
  ShadingEvidence shading_evidence(int reach_px, const Appearance& appearance);

  /// The share of the points, 0..1, that have an edge `from_px` to `to_px` beside them, of both
  /// sides the mean.
  double edges_beside(int from_px, int to_px) const;

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  void reserve(std::size_t most_points);
  /// How far each entry of a twist moves a point across its edge, pixels.
  Eigen::Matrix<float, 6, 1> jacobian(std::size_t point) const;
  /// How far a motion moves the points across their edges.
  void move(const Twist& motion);
  /// Of the last step, along each eigenvector: share^2 + feigned^2. What is solved with it goes
  /// from nothing at share 0 to the edges' word at share 1, half of it at the feigned one.
  Matrix6 gain(double feigned_share) const;
  /// The lines across the points; colours of null say nothing.
  LineJob lines(int reach_px, const Appearance* appearance) const;

  SmoothPicture picture_;
  const CameraModel& camera_;
  Eigen::Vector3d center_mm_;
  float shading_share_;
  Pose expected_center_;
  double feigned_share_ = 1;
  std::unique_ptr<float[]> rows_;  ///< of points_, moved_px_ and candidates_
  std::size_t capacity_ = 0;       ///< of rows_
  ProjectedContour points_{};
  float* moved_px_ = nullptr;  ///< across edges; an entry a point
  LineCandidates candidates_{};
  std::size_t count_ = 0;
  bool blurred_ = false;  ///< by motion: moved_px_ is how far
  Pose start_;            ///< camera_from_center of the projection
  Twist motion_ = Twist::Zero();
  // Of the last step: how far each entry of a twist is to move the points equally far, the normal
  // matrix in these units, and the sum of the weights.
  Twist unit_ = Twist::Ones();
  Matrix6 shares_ = Matrix6::Zero();
  double whole_weight_ = 0;
};

}  // namespace anneal6d
