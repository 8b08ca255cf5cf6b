// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include "twist.h"

namespace anneal6d {

/// How far the object may have moved unseen, such as a cup that turns while its handle is hidden:
/// a covariance that grows with the motion between frames and shrinks where edges show the pose
/// (the prediction and update of a Kalman filter whose gain the refinement has chosen).
class PoseUncertainty {
 public:
  using Covariance = Eigen::Matrix<double, 6, 6>;

  /// The pose is known.
  void reset() { covariance_.setZero(); }

  /// A frame later. `sigma`: what the motion model left open lately, standard deviations of a
  /// twist. `unseen`: what the image leaves of a deviation, as a map of twists. `error`: how far
  /// what it shows may be wrong.
  void update(const Twist& sigma, const Covariance& unseen, const Covariance& error);

  /// Probability that the pose is right to `distance_mm` and `angle_rad`, as far as unseen motion
  /// goes. Turns about `axis` (unit, camera frame; zero: none) do not count.
  double probability_within(double distance_mm, double angle_rad,
                            const Eigen::Vector3d& axis) const;

 private:
  Covariance covariance_ = Covariance::Zero();
};

}  // namespace anneal6d
