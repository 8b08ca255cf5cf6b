// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "pose_uncertainty.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace anneal6d {
namespace {

/// Of a normal deviation along the longest axis of a covariance, which outweighs the others.
double probability_below(const Eigen::Matrix3d& covariance, double limit) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance, Eigen::EigenvaluesOnly);
  const double variance = axes.eigenvalues()[2];
  if (!(variance > 0)) return 1.0;
  return std::erf(limit / std::sqrt(2 * variance));
}

}  // namespace

void PoseUncertainty::update(const Twist& sigma, const Covariance& unseen,
                             const Covariance& error) {
  covariance_.diagonal() += sigma.cwiseAbs2();
  covariance_ = (unseen * covariance_ * unseen.transpose() + error).eval();
}

double PoseUncertainty::probability_within(double distance_mm, double angle_rad,
                                           const Eigen::Vector3d& axis) const {
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
  return probability_below(across * covariance_.topLeftCorner<3, 3>() * across, angle_rad) *
         probability_below(covariance_.bottomRightCorner<3, 3>(), distance_mm);
}

}  // namespace anneal6d
