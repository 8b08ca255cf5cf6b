// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Geometry>
#include <span>

namespace anneal6d {

/// Rigid motion on SE(3). The variable's name says its frames: `camera_from_object` maps a point
/// given in object coordinates to camera coordinates (x right, y down, z forward), millimetres.
struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< unit length
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();

  /// Maps a point: R p + t.
  Eigen::Vector3d operator*(const Eigen::Vector3d& point_mm) const {
    return rotation * point_mm + translation_mm;
  }
  /// Chains motions: `a_from_b * b_from_c` is `a_from_c`. The rotation is renormalised.
  Pose operator*(const Pose& other) const;
  Pose inverse() const;
  bool is_finite() const;
};

/// Rotation of `angle_rad` about `axis` (any length but zero), thesis (A.1). A zero or non-finite
/// axis throws ConfigError.
Eigen::Quaterniond rotation_from_axis_angle(const Eigen::Vector3d& axis, double angle_rad);

/// Rotation vector (axis times angle, radians, length at most pi) of a rotation, and back.
Eigen::Vector3d rotation_vector_from(const Eigen::Quaterniond& rotation);
Eigen::Quaterniond rotation_from_vector(const Eigen::Vector3d& rotation_vector_rad);

/// Euler angles z-x-z (thesis App. A): turn by `psi` about z, by `theta` about the new x, by `phi`
/// about the newest z; R = Rz(psi) Rx(theta) Rz(phi). Radians.
struct EulerZxz {
  double psi_rad = 0;
  double theta_rad = 0;  ///< in [0, pi] when computed from a rotation
  double phi_rad = 0;    ///< zero when computed from a rotation with theta of 0 or pi
};
Eigen::Quaterniond rotation_from_euler(const EulerZxz& angles);
EulerZxz euler_from(const Eigen::Quaterniond& rotation);

/// Angle of the rotation between two orientations, radians, in [0, pi].
double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

/// Weighted mean orientation: the principal eigenvector of sum w q q^T (Markley, Cheng, Crassidis,
/// Oshman, "Averaging Quaternions", JGCD 2007), indifferent to the sign of each quaternion.
/// Weights are non-negative with a positive sum; both spans have the same non-zero length.
Eigen::Quaterniond weighted_mean(std::span<const Eigen::Quaterniond> rotations,
                                 std::span<const double> weights);

/// Weighted mean pose: arithmetic mean of translations, `weighted_mean` of rotations.
Pose weighted_mean(std::span<const Pose> poses, std::span<const double> weights);

}  // namespace anneal6d
